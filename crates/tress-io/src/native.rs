//! To be filled in.
use crate::{EncodeError, ParseError, Place, Problem};
use std::io::Write;
use tress_geometry::HelixGroom;

/// Reads.
pub fn read(_bytes: &[u8]) -> Result<HelixGroom, ParseError> {
    Err(Problem::Unsupported("not yet".into()).at(Place::File))
}

/// Writes.
pub fn write(_groom: &HelixGroom, _out: &mut impl Write) -> Result<(), EncodeError> {
    Err(EncodeError::Groom("not yet".into()))
}
