//! `TressFX` 3 and 4: a header of counts and offsets, and the arrays these point to.

use glam::DVec3;
use tress_geometry::{Column, Groom, Strands, names};

use super::HELD_POINTS;
use crate::binary::{Bytes, point, same, widen};
use crate::columns::misfit;
use crate::counts::too_many;
use crate::format::{INVERSE_MASS, VERTEX_UV};
use crate::{ParseError, Problem};

/// Where the header of a version says what.
pub(super) struct Version {
    header: usize,
    /// Byte of the offset of the positions, and bytes of a position.
    positions: (usize, usize),
    /// Bytes of the offsets of other arrays.
    strand_uv: usize,
    vertex_uv: usize,
    thickness: usize,
    colors: usize,
}

pub(super) const VERSION_3: Version = Version {
    header: 296,
    positions: (144, 12),
    thickness: 148,
    strand_uv: 152,
    colors: 156,
    vertex_uv: 164,
};

pub(super) const VERSION_4: Version = Version {
    header: 160,
    positions: (12, 16),
    strand_uv: 16,
    vertex_uv: 20,
    thickness: 24,
    colors: 28,
};

/// Arrays may begin at multiples of so many bytes, and the file may be filled up to one.
const ALIGNMENT: usize = 8;

pub(super) fn read(version: &Version, bytes: &[u8]) -> Result<Groom, ParseError> {
    let header = Bytes::new(bytes).items::<1>(version.header)?.as_flattened();
    let (strands, each) = (field(header, 4), field(header, 8));
    if each == 0 && 0 < strands {
        return Err(Problem::unexpected("points in every strand", "0").at_byte(8));
    }
    let points = strands.saturating_mul(each);
    let mut arrays = Arrays { bytes, header, end: version.header };
    let (positions, mass) = if version.positions.1 == 16 {
        let items = arrays.get::<16>(version.positions.0, points)?;
        (items.map(|items| items.iter().map(point).collect()), items.and_then(|i| masses(i, each)))
    } else {
        let items = arrays.get::<12>(version.positions.0, points)?;
        (items.map(|items| items.iter().map(point).collect()), None)
    };
    let positions: Vec<DVec3> = positions.ok_or_else(|| {
        Problem::unexpected("an offset of positions", "0").at_byte(version.positions.0)
    })?;
    let counts = std::iter::repeat_n(each, strands);
    let mut groom = Groom::new(Strands::from_counts(counts, positions).map_err(too_many)?);
    if let Some(mass) = mass {
        groom.insert_point_attribute(INVERSE_MASS, mass).map_err(misfit)?;
    }
    attach(version, &mut arrays, strands, &mut groom)?;
    arrays.finish()?;
    Ok(groom)
}

fn attach(
    version: &Version,
    arrays: &mut Arrays<'_>,
    strands: usize,
    groom: &mut Groom,
) -> Result<(), ParseError> {
    let points = groom.strands().points().len();
    if let Some(widths) = arrays.get::<4>(version.thickness, strands)? {
        let widths = widths.iter().map(|&width| widen(width)).collect();
        groom.insert_strand_attribute(names::WIDTH, Column::scalar(widths)).map_err(misfit)?;
    }
    if let Some(uv) = arrays.get::<8>(version.strand_uv, strands)? {
        groom.insert_strand_attribute(names::ROOT_UV, pairs(uv)).map_err(misfit)?;
    }
    if let Some(uv) = arrays.get::<8>(version.vertex_uv, points)? {
        groom.insert_point_attribute(VERTEX_UV, pairs(uv)).map_err(misfit)?;
    }
    if let Some(colors) = arrays.get::<16>(version.colors, points)? {
        let rgb = colors.iter().flat_map(|color| point(color).to_array()).collect();
        let column = Column::Float { components: 3, values: rgb };
        groom.insert_point_attribute(names::COLOR, column).map_err(misfit)?;
        let opacities = colors.iter().map(fourth).collect();
        groom.insert_point_attribute(names::OPACITY, Column::scalar(opacities)).map_err(misfit)?;
    }
    Ok(())
}

/// The `u32` at a byte of the header.
fn field(header: &[u8], at: usize) -> usize {
    header[at..].first_chunk().map_or(0, |&bytes| u32::from_le_bytes(bytes) as usize)
}

fn fourth(item: &[u8; 16]) -> f64 {
    widen([item[12], item[13], item[14], item[15]])
}

fn pairs(items: &[[u8; 8]]) -> Column {
    let values = items.as_flattened().as_chunks().0.iter().map(|&bytes| widen(bytes)).collect();
    Column::Float { components: 2, values }
}

/// Inverse masses, unless they are what they are where nothing else is said.
fn masses(items: &[[u8; 16]], each: usize) -> Option<Column> {
    let unsaid = |i: usize| if i % each < HELD_POINTS { 0.0 } else { 1.0 };
    let said = items.iter().enumerate().any(|(i, item)| !same([fourth(item)], [unsaid(i)]));
    said.then(|| Column::scalar(items.iter().map(fourth).collect()))
}

/// The arrays that a header points to.
struct Arrays<'a> {
    bytes: &'a [u8],
    header: &'a [u8],
    /// Where the last of those read so far ends.
    end: usize,
}

impl<'a> Arrays<'a> {
    /// The array whose offset is at this byte of the header, if it is there.
    fn get<const SIZE: usize>(
        &mut self,
        at: usize,
        count: usize,
    ) -> Result<Option<&'a [[u8; SIZE]]>, ParseError> {
        let offset = field(self.header, at);
        if offset == 0 {
            return Ok(None);
        }
        if offset < self.header.len() {
            let expected = format!("an offset behind the header of {} bytes", self.header.len());
            return Err(Problem::unexpected(expected, offset.to_string()).at_byte(at));
        }
        let mut bytes = Bytes::new(self.bytes);
        bytes.items::<1>(offset)?;
        let items = bytes.items::<SIZE>(count)?;
        self.end = self.end.max(bytes.position());
        Ok(Some(items))
    }

    /// An error if the file goes on behind the last array.
    fn finish(self) -> Result<(), ParseError> {
        let left = self.bytes.len() - self.end;
        if left == 0 || left < ALIGNMENT && self.bytes.len().is_multiple_of(ALIGNMENT) {
            return Ok(());
        }
        Err(Problem::Trailing { bytes: left as u64 }.at_byte(self.end))
    }
}
