//! Writing `TressFX` 4.

use std::io::Write;

use tress_geometry::{Groom, Strands, names};

use super::HELD_POINTS;
use crate::EncodeError;
use crate::binary::{narrow, narrow_point};
use crate::columns::{PointValues, Rows, every_point};
use crate::format::{INVERSE_MASS, VERTEX_UV};

const HEADER: usize = 160;
/// Points that a strand may have.
const COUNTS: [usize; 5] = [4, 8, 16, 32, 64];

/// Writes version 4: positions, inverse masses, widths, texture coordinates, colours and opacities.
///
/// # Errors
///
/// If strands do not all have the same number of points, one of 4, 8, 16, 32 and 64, if the file
/// would be longer than 32 bits count, or if the stream takes no more.
pub fn write(groom: &Groom, out: &mut impl Write) -> Result<(), EncodeError> {
    let strands = groom.strands();
    let each = points_each(strands)?;
    let colors = PointValues::new(groom, names::COLOR, 3);
    let opacities = PointValues::new(groom, names::OPACITY, 1);
    let strand_uv = Rows::of_strands(groom, names::ROOT_UV, 2);
    let vertex_uv = PointValues::new(groom, VERTEX_UV, 2);
    let widths = Rows::of_strands(groom, names::WIDTH, 1);
    let colored = colors.is_some() || opacities.is_some();
    let (n, points) = (strands.len(), strands.points().len());
    let mut end = HEADER + 16 * points;
    let mut place = |there: bool, bytes: usize| {
        let offset = if there { end } else { 0 };
        end += if there { bytes.next_multiple_of(8) } else { 0 };
        offset
    };
    let offsets = [
        HEADER,
        place(strand_uv.is_some(), 8 * n),
        place(vertex_uv.is_some(), 8 * points),
        place(widths.is_some(), 4 * n),
        place(colored, 16 * points),
    ];
    out.write_all(&4.0_f32.to_le_bytes())?;
    for value in [n, each].into_iter().chain(offsets) {
        let too_long = |_| EncodeError::Groom("a .tfx file of over 4 GiB cannot be said".into());
        out.write_all(&u32::try_from(value).map_err(too_long)?.to_le_bytes())?;
    }
    out.write_all(&[0; 32 * 4])?;
    write_positions(groom, each, out)?;
    if let Some(uv) = strand_uv {
        write_rows((0..n).map(|i| uv.row::<2>(i)), out)?;
    }
    if let Some(uv) = vertex_uv {
        write_rows(every_point(groom).map(|(i, point)| uv.row::<2>(i, point)), out)?;
    }
    if let Some(widths) = widths {
        write_rows((0..n).map(|i| widths.row::<1>(i)), out)?;
        if !n.is_multiple_of(2) {
            out.write_all(&[0; 4])?;
        }
    }
    if colored {
        let rows = every_point(groom).map(|(i, point)| {
            let [r, g, b] = colors.as_ref().map_or([1.0; 3], |colors| colors.row(i, point));
            let [a] = opacities.as_ref().map_or([1.0], |opacities| opacities.row(i, point));
            [r, g, b, a]
        });
        write_rows(rows, out)?;
    }
    Ok(())
}

/// The number of points of every strand.
fn points_each<T>(strands: &Strands<T>) -> Result<usize, EncodeError> {
    let each = strands.counts().next().unwrap_or(COUNTS[0]);
    let advice = "a .tfx file needs 4, 8, 16, 32 or 64 points in every strand: \
                  resample, as in `tress convert --points 32`";
    if !COUNTS.contains(&each) {
        let reason = format!("has {each} points; {advice}");
        return Err(EncodeError::Strand { strand: 0, reason });
    }
    match strands.counts().position(|n| n != each) {
        None => Ok(each),
        Some(strand) => {
            let n = strands.strand(strand).len();
            let reason = format!("has {n} points and strand 0 has {each}; {advice}");
            Err(EncodeError::Strand { strand, reason })
        }
    }
}

fn write_positions(groom: &Groom, each: usize, out: &mut impl Write) -> Result<(), EncodeError> {
    let masses = PointValues::new(groom, INVERSE_MASS, 1);
    for (strand, point) in every_point(groom) {
        out.write_all(&narrow_point(groom.strands().points()[point]))?;
        let held = point % each < HELD_POINTS;
        let unsaid = if held { [0.0] } else { [1.0] };
        let [mass] = masses.as_ref().map_or(unsaid, |masses| masses.row(strand, point));
        out.write_all(&narrow(mass))?;
    }
    Ok(())
}

fn write_rows<const N: usize>(
    rows: impl Iterator<Item = [f64; N]>,
    out: &mut impl Write,
) -> Result<(), EncodeError> {
    for value in rows.flatten() {
        out.write_all(&narrow(value))?;
    }
    Ok(())
}
