//! Writing a PLY file as hairutil does.

use std::io::Write;

use tress_geometry::{Groom, names};

use crate::EncodeError;
use crate::binary::narrow_point;
use crate::columns::{PointValues, Rows};
use crate::counts::signed_count;

/// Writes positions, colours and opacities.
///
/// # Errors
///
/// If a strand has no points, if there are more points than 31 bits count, or if the stream takes
/// no more.
pub fn write(groom: &Groom, out: &mut impl Write) -> Result<(), EncodeError> {
    let strands = groom.strands();
    if let Some(strand) = strands.counts().position(|n| n == 0) {
        let reason = "has no points, which a .ply file cannot say".into();
        return Err(EncodeError::Strand { strand, reason });
    }
    let colors = PointValues::new(groom, names::COLOR, 3);
    let opacities = PointValues::new(groom, names::OPACITY, 1);
    let wide = strands.counts().any(|n| usize::from(u16::MAX) + 1 < n);
    write_header(groom, [colors.is_some(), opacities.is_some(), wide], out)?;
    for i in 0..strands.len() {
        for point in strands.range(i) {
            out.write_all(&narrow_point(strands.points()[point]))?;
            if let Some(colors) = &colors {
                out.write_all(&colors.row::<3>(i, point).map(eight_bits))?;
            }
            if let Some(opacities) = &opacities {
                out.write_all(&opacities.row::<1>(i, point).map(eight_bits))?;
            }
        }
    }
    for n in strands.counts() {
        let segments = signed_count(n - 1)?.to_le_bytes();
        out.write_all(if wide { &segments } else { &segments[..2] })?;
    }
    for range in (0..strands.len()).map(|i| strands.range(i)) {
        for first in range.start..range.end - 1 {
            out.write_all(&signed_count(first)?.to_le_bytes())?;
            out.write_all(&signed_count(first + 1)?.to_le_bytes())?;
        }
    }
    Ok(())
}

fn write_header(
    groom: &Groom,
    [colors, opacities, wide]: [bool; 3],
    out: &mut impl Write,
) -> Result<(), EncodeError> {
    let (points, strands) = (groom.strands().points().len(), groom.strands().len());
    writeln!(out, "ply\nformat binary_little_endian 1.0\ncomment strands written by tress")?;
    writeln!(out, "element vertex {points}")?;
    writeln!(out, "property float x\nproperty float y\nproperty float z")?;
    if colors {
        writeln!(out, "property uchar red\nproperty uchar green\nproperty uchar blue")?;
    }
    if opacities {
        writeln!(out, "property uchar alpha")?;
    }
    writeln!(out, "element strand {strands}")?;
    writeln!(out, "property {} nsegs", if wide { "uint" } else { "ushort" })?;
    writeln!(out, "element edge {}", points - strands)?;
    writeln!(out, "property int vertex1\nproperty int vertex2\nend_header")?;
    Ok(())
}

/// A number in 0 to 1 as 255ths.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a byte")]
fn eight_bits(value: f64) -> u8 {
    (value * 255.0).round().clamp(0.0, 255.0) as u8
}

/// Whether 8 bits hold less than the colours and opacities of a groom.
pub(crate) fn rounds_colors(groom: &Groom) -> bool {
    let exact = |value: f64| (f64::from(eight_bits(value)) / 255.0).to_bits() == value.to_bits();
    let rounds = |name, components| {
        let own = Rows::of_points(groom, name, components);
        let rows = own.or_else(|| Rows::of_strands(groom, name, components));
        rows.is_some_and(|rows| !rows.iter().all(exact))
    };
    rounds(names::COLOR, 3) || rounds(names::OPACITY, 1)
}
