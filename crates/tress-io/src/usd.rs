//! USD `BasisCurves`.

use std::io::Write;
use std::path::Path;

use tress_geometry::Groom;

use crate::{EncodeError, ParseError, Place, Problem, WriteOptions};

/// Reads the curves of a stage.
///
/// # Errors
///
/// If the file is not a stage with curves.
pub fn read(_path: &Path) -> Result<Groom, ParseError> {
    Err(Problem::Unsupported("USD".into()).at(Place::File))
}

/// Writes a groom as text.
///
/// # Errors
///
/// If the stream takes no more.
pub fn write(
    _groom: &Groom,
    _options: &WriteOptions,
    _out: &mut impl Write,
) -> Result<(), EncodeError> {
    Err(EncodeError::Groom("USD".into()))
}
