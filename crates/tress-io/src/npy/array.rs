//! One array in numpy's format: magic, version, the length of the header, the header, the numbers.
//!
//! The header is a Python dictionary of three entries, always printed the same way:
//! `{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }`. It is taken apart here, for the
//! parsers at hand follow nesting to the end of the stack and multiply a shape without a bound.

use std::io::{self, Write};

use glam::DVec3;

use crate::text::quoted;
use crate::{ParseError, Place, Problem};

const MAGIC: &[u8; 6] = b"\x93NUMPY";
/// The header is filled up so that numbers begin at a multiple of this.
const ALIGNMENT: usize = 64;

/// An array whose numbers are still the file's bytes.
pub(crate) struct Array<'a> {
    pub(crate) shape: Vec<usize>,
    kind: Kind,
    fortran_order: bool,
    big_endian: bool,
    /// As many as the shape says, of the kind's size.
    bytes: &'a [u8],
}

/// The type of the numbers.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Float(usize),
    Int(usize),
    Uint(usize),
}

/// The numbers of an array in C order.
pub(crate) enum Numbers {
    Float(Vec<f64>),
    Int(Vec<i64>),
}

impl<'a> Array<'a> {
    /// Reads the bytes of a file.
    pub(crate) fn read(file: &'a [u8]) -> Result<Self, ParseError> {
        let (header, start) = header(file)?;
        let array = Self::describe_by(header, &file[start..]);
        let array = array.map_err(|problem| problem.at_byte(start - header.len()))?;
        let size = array.kind.size();
        let count = array.shape.iter().try_fold(1_usize, |n, &axis| n.checked_mul(axis));
        let needed = count.unwrap_or(usize::MAX).saturating_mul(size);
        let left = array.bytes.len();
        if needed < left {
            let bytes = (left - needed) as u64;
            return Err(Problem::Trailing { bytes }.at_byte(start + needed));
        }
        if left < needed {
            let problem = Problem::Truncated { needed: needed as u64, left: left as u64 };
            return Err(problem.at_byte(start));
        }
        Ok(array)
    }

    fn describe_by(header: &str, bytes: &'a [u8]) -> Result<Self, Problem> {
        let (big_endian, kind) = Kind::named(value(header, "'descr':")?)?;
        let order = value(header, "'fortran_order':")?;
        let fortran_order = match order.split([',', '}']).next().map(str::trim) {
            Some("True") => true,
            Some("False") => false,
            _ => return Err(Problem::unexpected("True or False", quoted(order.as_bytes()))),
        };
        let shape = value(header, "'shape':")?;
        let axes = shape.strip_prefix('(').and_then(|axes| axes.split_once(')'));
        let not_a_shape = || Problem::unexpected("a shape", quoted(shape.as_bytes()));
        let (axes, _) = axes.ok_or_else(not_a_shape)?;
        let axes = axes.split(',').map(str::trim).filter(|axis| !axis.is_empty());
        let shape =
            axes.map(|axis| axis.parse().map_err(|_| not_a_shape())).collect::<Result<_, _>>()?;
        Ok(Self { shape, kind, fortran_order, big_endian, bytes })
    }

    /// The shape and the type, as numpy prints them.
    pub(crate) fn describe(&self) -> String {
        let axes: Vec<_> = self.shape.iter().map(usize::to_string).collect();
        format!(
            "{} of {}",
            if axes.is_empty() { "one".into() } else { axes.join(" x ") },
            self.kind.name()
        )
    }

    /// The numbers as points, three by three.
    pub(crate) fn points(&self) -> Result<Vec<DVec3>, ParseError> {
        if !matches!(self.kind, Kind::Float(_)) {
            let problem = Problem::unexpected("floating-point positions", self.kind.name());
            return Err(problem.at(Place::File));
        }
        let n = self.bytes.len() / self.kind.size() / 3;
        let [x, y, z] = [0, 1, 2];
        let at = |i: usize, axis: usize| self.float(self.item(3 * i + axis));
        Ok((0..n).map(|i| DVec3::new(at(i, x), at(i, y), at(i, z))).collect())
    }

    /// All numbers, in C order.
    pub(crate) fn numbers(&self) -> Numbers {
        let items = (0..self.bytes.len() / self.kind.size()).map(|i| self.item(i));
        match self.kind {
            Kind::Float(_) => Numbers::Float(items.map(|item| self.float(item)).collect()),
            _ => Numbers::Int(items.map(|item| self.int(item)).collect()),
        }
    }

    /// Item `i` in C order, its least significant byte first, extended to 8 bytes.
    fn item(&self, i: usize) -> [u8; 8] {
        let size = self.kind.size();
        let at = size * if self.fortran_order { self.fortran_index(i) } else { i };
        let mut item = [0; 8];
        item[..size].copy_from_slice(&self.bytes[at..at + size]);
        if self.big_endian {
            item[..size].reverse();
        }
        item
    }

    /// Where item `i` in C order stands in Fortran order.
    fn fortran_index(&self, mut i: usize) -> usize {
        let mut index = 0;
        let mut place = 1;
        let mut stride = self.bytes.len() / self.kind.size();
        for &axis in &self.shape {
            stride /= axis;
            index += place * (i / stride);
            i %= stride;
            place *= axis;
        }
        index
    }

    fn float(&self, item: [u8; 8]) -> f64 {
        match self.kind {
            Kind::Float(4) => crate::binary::widen([item[0], item[1], item[2], item[3]]),
            _ => f64::from_le_bytes(item),
        }
    }

    fn int(&self, item: [u8; 8]) -> i64 {
        let value = i64::from_le_bytes(item);
        match self.kind {
            // Shifted up and back down, so that the sign fills the bytes that were not there.
            Kind::Int(size) => value << (64 - 8 * size) >> (64 - 8 * size),
            _ => value,
        }
    }
}

impl Kind {
    /// The byte order and type that `'<f8'` and the like name.
    fn named(descr: &str) -> Result<(bool, Self), Problem> {
        let name = descr.strip_prefix('\'').and_then(|name| name.split_once('\''));
        let (order, kind) = name.and_then(|(name, _)| name.split_at_checked(1)).unwrap_or_default();
        let kind = match kind {
            "f4" => Self::Float(4),
            "f8" => Self::Float(8),
            "b1" | "u1" => Self::Uint(1),
            "u2" => Self::Uint(2),
            "u4" => Self::Uint(4),
            "u8" => Self::Uint(8),
            "i1" => Self::Int(1),
            "i2" => Self::Int(2),
            "i4" => Self::Int(4),
            "i8" => Self::Int(8),
            _ => {
                return Err(Problem::unexpected(
                    "numbers of up to 8 bytes",
                    quoted(descr.as_bytes()),
                ));
            }
        };
        match order {
            "<" | "|" => Ok((false, kind)),
            ">" => Ok((true, kind)),
            _ => Err(Problem::unexpected("a byte order, < or >", quoted(descr.as_bytes()))),
        }
    }

    fn size(self) -> usize {
        let (Self::Float(size) | Self::Int(size) | Self::Uint(size)) = self;
        size
    }

    fn name(self) -> String {
        let kind = match self {
            Self::Float(_) => "float",
            Self::Int(_) => "int",
            Self::Uint(_) => "uint",
        };
        format!("{kind}{}", 8 * self.size())
    }
}

/// The text of the header, and where the numbers begin.
fn header(file: &[u8]) -> Result<(&str, usize), ParseError> {
    let truncated = |needed: usize, at: usize| {
        let left = file.len().saturating_sub(at) as u64;
        Problem::Truncated { needed: needed as u64, left }.at_byte(at)
    };
    let begin = file.get(..MAGIC.len()).ok_or_else(|| truncated(MAGIC.len(), 0))?;
    if begin != MAGIC {
        return Err(Problem::unexpected("\"\\x93NUMPY\"", quoted(begin)).at_byte(0));
    }
    let version = *file.get(MAGIC.len()).ok_or_else(|| truncated(1, MAGIC.len()))?;
    let (start, length) = match (version, &file[MAGIC.len()..]) {
        (1, [_, _, a, b, ..]) => (10, usize::from(u16::from_le_bytes([*a, *b]))),
        (2 | 3, [_, _, a, b, c, d, ..]) => (12, u32::from_le_bytes([*a, *b, *c, *d]) as usize),
        (1..=3, _) => return Err(truncated(4, MAGIC.len() + 2)),
        _ => return Err(Problem::unexpected("version 1 to 3", version.to_string()).at_byte(6)),
    };
    let end = start + length;
    let text = file.get(start..end).ok_or_else(|| truncated(length, start))?;
    let text = std::str::from_utf8(text)
        .map_err(|_| Problem::unexpected("a header of text", quoted(text)).at_byte(start))?;
    Ok((text, end))
}

/// What follows a key.
fn value<'a>(header: &'a str, key: &str) -> Result<&'a str, Problem> {
    let rest = header.split_once(key).map(|(_, rest)| rest.trim_start());
    rest.ok_or_else(|| {
        Problem::unexpected(format!("{key} in the header"), quoted(header.as_bytes()))
    })
}

/// Writes what stands before the numbers of an array in C order.
pub(crate) fn write_header(out: &mut impl Write, kind: &str, shape: &[usize]) -> io::Result<()> {
    let axes: String = shape.iter().map(|axis| format!("{axis}, ")).collect();
    let axes = if shape.len() == 1 { axes.trim_end() } else { axes.trim_end_matches(", ") };
    let mut text =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({axes}), }}").into_bytes();
    let whole = (10 + text.len() + 1).next_multiple_of(ALIGNMENT);
    text.resize(whole - 11, b' ');
    text.push(b'\n');
    // A shape has few axes, so that the header is far shorter than 16 bits count.
    let length = u16::try_from(text.len()).map_err(|_| io::ErrorKind::InvalidInput)?;
    out.write_all(MAGIC)?;
    out.write_all(&[1, 0])?;
    out.write_all(&length.to_le_bytes())?;
    out.write_all(&text)
}
