//! To be filled in.
use crate::{EncodeError, ParseError, Place, Problem};
use std::io::Write;
use tress_geometry::Groom;

/// Reads.
pub fn read(_bytes: &[u8]) -> Result<Groom, ParseError> {
    Err(Problem::Unsupported("not yet".into()).at(Place::File))
}

/// Writes.
pub fn write(_groom: &Groom, _out: &mut impl Write) -> Result<(), EncodeError> {
    Err(EncodeError::Groom("not yet".into()))
}
