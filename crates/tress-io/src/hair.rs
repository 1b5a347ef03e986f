//! Cem Yuksel's cyHair, `.hair`: a header of 128 bytes and up to five arrays.
//!
//! | byte | | |
//! |---|---|---|
//! | 0 | `char[4]` | `HAIR` |
//! | 4, 8 | `u32` | strands, points |
//! | 12 | `u32` | arrays: bit 0 segments, 1 points, 2 thickness, 3 transparency, 4 colours |
//! | 16 | `u32` | segments a strand where there is no array of them |
//! | 20, 24, 28 | `f32`, `f32`, `f32[3]` | thickness, transparency, colour without an array |
//! | 40 | `char[88]` | a note |
//!
//! The segments are `u16`, one fewer than the strand has points: a strand without points cannot be
//! said, and is an error, as is one of more than 65,536 points unless all strands have as many.
//!
//! Thickness is the hair's diameter and becomes the attribute `width`; `opacity` is one less
//! transparency; colours become `color`. An array gives an attribute of points. A header's value
//! gives an attribute of strands, unless it is the one that the format's own library leaves where
//! nothing is said (1, 0 and white). Attributes of strands that are all alike go to the header.

use std::io::Write;

use tress_geometry::{Column, Groom, Strands, names};

use crate::binary::{Bytes, narrow, narrow_point, same};
use crate::columns::{PointValues, Rows, every_point, misfit};
use crate::counts::too_many;
use crate::{EncodeError, ParseError, Problem};

const MAGIC: &[u8; 4] = b"HAIR";
const HEADER: usize = 128;
const NOTE: &[u8] = b"strands written by tress";
const SEGMENTS: u32 = 1;
const POINTS: u32 = 2;

/// What an array holds beside positions, and how the file says it.
struct Quantity<const N: usize> {
    name: &'static str,
    flag: u32,
    /// The header's value where nothing is said.
    unsaid: [f64; N],
    /// The attribute's value of the file's and the file's of the attribute's.
    turn: fn(f64) -> f64,
}

const THICKNESS: Quantity<1> =
    Quantity { name: names::WIDTH, flag: 4, unsaid: [1.0], turn: |thickness| thickness };
const TRANSPARENCY: Quantity<1> =
    Quantity { name: names::OPACITY, flag: 8, unsaid: [0.0], turn: |value| 1.0 - value };
const COLORS: Quantity<3> =
    Quantity { name: names::COLOR, flag: 16, unsaid: [1.0; 3], turn: |channel| channel };

/// Reads the bytes of a file.
///
/// # Errors
///
/// If the bytes do not begin with `HAIR`, if there are no points or arrays of an unknown kind, or
/// if the counts do not match each other and the size of the file.
pub fn read(bytes: &[u8]) -> Result<Groom, ParseError> {
    let mut bytes = Bytes::new(bytes);
    let header = Header::read(&mut bytes)?;
    let offsets = header.offsets(&mut bytes)?;
    let points = bytes.points(header.points)?.collect();
    let mut groom = Groom::new(Strands::new(offsets, points).map_err(too_many)?);
    THICKNESS.read(&mut bytes, &header, [header.thickness], &mut groom)?;
    TRANSPARENCY.read(&mut bytes, &header, [header.transparency], &mut groom)?;
    COLORS.read(&mut bytes, &header, header.color, &mut groom)?;
    bytes.finish()?;
    Ok(groom)
}

struct Header {
    strands: usize,
    points: usize,
    flags: u32,
    segments: usize,
    thickness: f64,
    transparency: f64,
    color: [f64; 3],
}

impl Header {
    fn read(bytes: &mut Bytes<'_>) -> Result<Self, ParseError> {
        let magic = bytes.item::<4>()?;
        if !magic.eq_ignore_ascii_case(MAGIC) {
            let found = format!("\"{}\"", magic.escape_ascii());
            return Err(Problem::unexpected("\"HAIR\"", found).at_byte(0));
        }
        let (strands, points) = (bytes.u32()? as usize, bytes.u32()? as usize);
        let flags = bytes.u32()?;
        if flags & POINTS == 0 || 31 < flags {
            let expected = "flags with bit 1 (points) and none above bit 4";
            return Err(Problem::unexpected(expected, format!("{flags:#b}")).at_byte(12));
        }
        let segments = bytes.u32()? as usize;
        let (thickness, transparency) = (bytes.f32()?, bytes.f32()?);
        let color = [bytes.f32()?, bytes.f32()?, bytes.f32()?];
        bytes.items::<1>(HEADER - bytes.position())?;
        Ok(Self { strands, points, flags, segments, thickness, transparency, color })
    }

    /// Where strands begin, once the points are known to be there.
    fn offsets(&self, bytes: &mut Bytes<'_>) -> Result<Vec<u32>, ParseError> {
        let at = bytes.position();
        let counts =
            if self.flags & SEGMENTS != 0 { Some(bytes.items::<2>(self.strands)?) } else { None };
        bytes.expect(self.points, 12)?;
        let sum = match counts {
            Some(counts) => {
                counts.iter().map(|&n| usize::from(u16::from_le_bytes(n)) + 1).sum::<usize>()
            }
            None => self.strands.saturating_mul(self.segments.saturating_add(1)),
        };
        if sum != self.points {
            let expected = format!("segments of {} points", self.points);
            return Err(Problem::unexpected(expected, format!("segments of {sum}")).at_byte(at));
        }
        let mut offsets = Vec::with_capacity(self.strands + 1);
        let mut end = 0_u32;
        offsets.push(end);
        for i in 0..self.strands {
            // The sum is a `u32`, so no part of it overflows.
            end += match counts {
                Some(counts) => u32::from(u16::from_le_bytes(counts[i])) + 1,
                None => u32::try_from(self.segments + 1).unwrap_or(0),
            };
            offsets.push(end);
        }
        Ok(offsets)
    }
}

impl<const N: usize> Quantity<N> {
    /// Attaches the array, or the header's value where it says something.
    fn read(
        &self,
        bytes: &mut Bytes<'_>,
        header: &Header,
        default: [f64; N],
        groom: &mut Groom,
    ) -> Result<(), ParseError> {
        if header.flags & self.flag != 0 {
            let mut values = bytes.f32s(header.points.saturating_mul(N))?;
            values.iter_mut().for_each(|value| *value = (self.turn)(*value));
            let column = Column::Float { components: N, values };
            return groom.insert_point_attribute(self.name, column).map_err(misfit);
        }
        if same(default, self.unsaid) || header.strands == 0 {
            return Ok(());
        }
        let values = default.map(self.turn).repeat(header.strands);
        let column = Column::Float { components: N, values };
        groom.insert_strand_attribute(self.name, column).map_err(misfit)
    }

    /// The header's value: the one that all strands share, when no array need say it.
    fn default(&self, groom: &Groom) -> Option<[f64; N]> {
        if groom.point_attributes().get(self.name).is_some() {
            return None;
        }
        let shared = Rows::of_strands(groom, self.name, N)?.constant::<N>()?.map(self.turn);
        (!same(shared, self.unsaid)).then_some(shared)
    }

    /// The flag that says the array follows, and the values it holds.
    fn array<'a>(&self, groom: &'a Groom) -> (u32, Option<PointValues<'a>>) {
        if self.default(groom).is_some() {
            return (0, None);
        }
        let values = PointValues::new(groom, self.name, N);
        (if values.is_some() { self.flag } else { 0 }, values)
    }

    fn write(&self, groom: &Groom, out: &mut impl Write) -> Result<(), EncodeError> {
        let Some(values) = self.array(groom).1 else { return Ok(()) };
        for (strand, point) in every_point(groom) {
            for value in values.row::<N>(strand, point) {
                out.write_all(&narrow((self.turn)(value)))?;
            }
        }
        Ok(())
    }
}

/// Writes positions, widths, opacities and colours.
///
/// # Errors
///
/// If a strand has no points, or more than 65,536 and not as many as every other, or if the stream
/// takes no more.
pub fn write(groom: &Groom, out: &mut impl Write) -> Result<(), EncodeError> {
    let strands = groom.strands();
    let segments = Segments::of(strands)?;
    let flags = segments.flag()
        | POINTS
        | THICKNESS.array(groom).0
        | TRANSPARENCY.array(groom).0
        | COLORS.array(groom).0;
    let count = |n: usize| {
        u32::try_from(n).map_err(|_| EncodeError::Groom(format!("{n} strands need over 32 bits")))
    };
    out.write_all(MAGIC)?;
    let points = strands.offsets().last().copied().unwrap_or(0);
    for value in [count(strands.len())?, points, flags, segments.default()] {
        out.write_all(&value.to_le_bytes())?;
    }
    let thickness = THICKNESS.default(groom).unwrap_or(THICKNESS.unsaid);
    let transparency = TRANSPARENCY.default(groom).unwrap_or(TRANSPARENCY.unsaid);
    let color = COLORS.default(groom).unwrap_or(COLORS.unsaid);
    for value in thickness.into_iter().chain(transparency).chain(color) {
        out.write_all(&narrow(value))?;
    }
    let mut note = [0; 88];
    note[..NOTE.len()].copy_from_slice(NOTE);
    out.write_all(&note)?;
    if let Segments::Each(segments) = segments {
        for n in segments {
            out.write_all(&n.to_le_bytes())?;
        }
    }
    for &point in strands.points() {
        out.write_all(&narrow_point(point))?;
    }
    THICKNESS.write(groom, out)?;
    TRANSPARENCY.write(groom, out)?;
    COLORS.write(groom, out)
}

/// How a file says the number of segments.
enum Segments {
    All(u32),
    Each(Vec<u16>),
}

impl Segments {
    fn of<T>(strands: &Strands<T>) -> Result<Self, EncodeError> {
        if let Some(strand) = strands.counts().position(|n| n == 0) {
            let reason = "has no points, which a .hair file cannot say".into();
            return Err(EncodeError::Strand { strand, reason });
        }
        let first = strands.counts().next().unwrap_or(1);
        if let Ok(n) = u32::try_from(first - 1)
            && strands.counts().all(|n| n == first)
        {
            return Ok(Self::All(n));
        }
        let each = strands.counts().enumerate().map(|(strand, n)| {
            u16::try_from(n - 1).map_err(|_| EncodeError::Strand {
                strand,
                reason: format!("has {n} points, more than the 65,536 that a .hair file can say"),
            })
        });
        each.collect::<Result<_, _>>().map(Self::Each)
    }

    fn flag(&self) -> u32 {
        match self {
            Self::All(_) => 0,
            Self::Each(_) => SEGMENTS,
        }
    }

    fn default(&self) -> u32 {
        match self {
            Self::All(n) => *n,
            Self::Each(_) => 0,
        }
    }
}
