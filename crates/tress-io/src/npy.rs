//! A numpy array, `.npy`: strands x points x 3, floating-point numbers of 4 or 8 bytes.
//!
//! Either byte order and either memory order are read; all strands have the same number of points.
//! Written are 8 bytes, little-endian, in C order.

mod array;

use std::io::Write;

use glam::DVec3;
use tress_geometry::{Groom, Strands};

use crate::counts::too_many;
use crate::{EncodeError, ParseError, Place, Problem};

pub(crate) use array::{Array, Numbers, write_header};

/// Reads the bytes of a file.
///
/// # Errors
///
/// If the bytes are no array of floating-point numbers, if it is not strands x points x 3, or if
/// its shape does not match the size of the file.
pub fn read(bytes: &[u8]) -> Result<Groom, ParseError> {
    let array = Array::read(bytes)?;
    let &[strands, points, 3] = array.shape.as_slice() else {
        let expected = "an array of strands x points x 3";
        return Err(Problem::unexpected(expected, array.describe()).at(Place::File));
    };
    let points = uniform(strands, points, array.points()?);
    Ok(Groom::new(points.map_err(|problem| problem.at(Place::File))?))
}

/// Strands of so many points each.
pub(crate) fn uniform(
    strands: usize,
    each: usize,
    points: Vec<DVec3>,
) -> Result<Strands<DVec3>, Problem> {
    if each == 0 && 0 < strands {
        // A count that nothing in the file bears out.
        return Err(Problem::unexpected("points in every strand", "0"));
    }
    let counts = std::iter::repeat_n(each, strands);
    Strands::from_counts(counts, points).map_err(|error| too_many(error).problem)
}

/// Writes the positions.
///
/// # Errors
///
/// If not all strands have the same number of points, at least one, or if the stream takes no more.
pub fn write(groom: &Groom, out: &mut impl Write) -> Result<(), EncodeError> {
    let strands = groom.strands();
    let each = strands.counts().next().unwrap_or(0);
    let other = strands.counts().position(|n| n != each || n == 0);
    if let Some(strand) = other {
        let n = strands.strand(strand).len();
        let advice = "a .npy file needs as many, and one at least, in all: write .npz or resample";
        let reason = format!("has {n} points and strand 0 has {each}; {advice}");
        return Err(EncodeError::Strand { strand, reason });
    }
    write_header(out, "<f8", &[strands.len(), each, 3])?;
    for value in strands.points().iter().flat_map(|point| point.to_array()) {
        out.write_all(&value.to_le_bytes())?;
    }
    Ok(())
}
