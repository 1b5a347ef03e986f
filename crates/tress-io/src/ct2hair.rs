//! `CT2Hair` strands, `.bin`: a count of strands; for each, a count of points and seven `f32` for
//! each point: position, normal and label.
//!
//! Normals and labels become the point attributes `normal` and `label` when any of them is not 0;
//! hairutil's files leave all of them 0.

use std::io::Write;

use tress_geometry::{Column, Groom};

use crate::binary::{Bytes, narrow, narrow_point, point, widen};
use crate::columns::{PointValues, misfit};
use crate::counts::{Builder, signed_count};
use crate::format::{LABEL, NORMAL};
use crate::{EncodeError, ParseError};

/// Bytes of a point.
const POINT: usize = 28;

/// Reads the bytes of a file.
///
/// # Errors
///
/// If a count is below 0 or the counts do not end where the file does.
pub fn read(bytes: &[u8]) -> Result<Groom, ParseError> {
    let mut bytes = Bytes::new(bytes);
    let strands = bytes.count("strands")?;
    bytes.expect(strands, size_of::<i32>())?;
    let mut builder = Builder::with_room(strands, bytes.left() / POINT);
    let mut rows = Vec::with_capacity(strands);
    for i in 0..strands {
        let points = bytes.count("points").map_err(|error| error.in_strand(i))?;
        let items = bytes.items::<POINT>(points).map_err(|error| error.in_strand(i))?;
        builder.push(items.iter().map(point))?;
        rows.push(items);
    }
    bytes.finish()?;
    let mut groom = Groom::new(builder.finish()?);
    let field =
        |at: usize, item: &[u8; POINT]| widen([item[at], item[at + 1], item[at + 2], item[at + 3]]);
    for (name, fields) in [(NORMAL, &[12, 16, 20][..]), (LABEL, &[24])] {
        let values = || {
            rows.iter().copied().flatten().flat_map(|item| fields.iter().map(|&at| field(at, item)))
        };
        if values().any(|value| value != 0.0) {
            let column = Column::Float { components: fields.len(), values: values().collect() };
            groom.insert_point_attribute(name, column).map_err(misfit)?;
        }
    }
    Ok(groom)
}

/// Writes positions, and the attributes `normal` and `label` where the groom has them.
///
/// # Errors
///
/// If the stream takes no more, or a count needs more than 31 bits.
pub fn write(groom: &Groom, out: &mut impl Write) -> Result<(), EncodeError> {
    let normals = PointValues::new(groom, NORMAL, 3);
    let labels = PointValues::new(groom, LABEL, 1);
    let strands = groom.strands();
    out.write_all(&signed_count(strands.len())?.to_le_bytes())?;
    for i in 0..strands.len() {
        out.write_all(&signed_count(strands.strand(i).len())?.to_le_bytes())?;
        for point in strands.range(i) {
            out.write_all(&narrow_point(strands.points()[point]))?;
            let normal = normals.as_ref().map_or([0.0; 3], |normals| normals.row(i, point));
            let label: [f64; 1] = labels.as_ref().map_or([0.0], |labels| labels.row(i, point));
            for value in normal.into_iter().chain(label) {
                out.write_all(&narrow(value))?;
            }
        }
    }
    Ok(())
}
