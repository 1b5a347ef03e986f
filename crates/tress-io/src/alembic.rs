//! Alembic curves.

use std::path::Path;

use tress_geometry::Groom;

use crate::{ParseError, Place, Problem};

/// Reads the curves of an archive.
///
/// # Errors
///
/// If the file is not an archive with curves.
pub fn read(_path: &Path) -> Result<Groom, ParseError> {
    Err(Problem::Unsupported("Alembic".into()).at(Place::File))
}
