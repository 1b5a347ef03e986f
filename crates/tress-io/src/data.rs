//! USC-HairSalon strands, `.data`: a count of strands; for each, a count of points and the points.
//!
//! Counts are `i32`, coordinates `f32`. A strand may have any number of points, none included.

use std::io::Write;

use tress_geometry::Groom;

use crate::binary::{Bytes, narrow_point};
use crate::counts::{Builder, signed_count};
use crate::{EncodeError, ParseError};

/// Reads the bytes of a file.
///
/// ```
/// let bytes = [1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 128, 63, 0, 0, 0, 64, 0, 0, 64, 64];
/// let groom = tress_io::data::read(&bytes)?;
/// assert_eq!(groom.strands().strand(0), [glam::DVec3::new(1.0, 2.0, 3.0)]);
/// # Ok::<(), tress_io::ParseError>(())
/// ```
///
/// # Errors
///
/// If a count is below 0 or the counts do not end where the file does.
pub fn read(bytes: &[u8]) -> Result<Groom, ParseError> {
    let mut bytes = Bytes::new(bytes);
    let strands = bytes.count("strands")?;
    bytes.expect(strands, size_of::<i32>())?;
    let mut builder = Builder::with_room(strands, bytes.left() / 12);
    for i in 0..strands {
        let points = bytes.count("points").map_err(|error| error.in_strand(i))?;
        let points = bytes.points(points).map_err(|error| error.in_strand(i))?;
        builder.push(points)?;
    }
    bytes.finish()?;
    Ok(Groom::new(builder.finish()?))
}

/// Writes the positions of a groom.
///
/// # Errors
///
/// If the stream takes no more, or a count needs more than 31 bits.
pub fn write(groom: &Groom, out: &mut impl Write) -> Result<(), EncodeError> {
    let strands = groom.strands();
    out.write_all(&signed_count(strands.len())?.to_le_bytes())?;
    for strand in strands.iter() {
        out.write_all(&signed_count(strand.len())?.to_le_bytes())?;
        for &point in strand {
            out.write_all(&narrow_point(point))?;
        }
    }
    Ok(())
}
