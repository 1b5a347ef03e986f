//! The header of a PLY file: what elements there are and what properties each row of them has.

use crate::text::{integer, quoted, words};
use crate::{ParseError, Place, Problem};

/// What a header says, and where the body begins.
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Bytes of the header.
    pub(super) bytes: usize,
    /// Lines of the header.
    pub(super) lines: u64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A table.
pub(super) struct Element {
    pub(super) name: String,
    pub(super) rows: usize,
    pub(super) properties: Vec<Property>,
}

/// A column.
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// For a list, the type of the count before it.
    pub(super) list: Option<Kind>,
}

/// The type of a number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn named(word: &[u8]) -> Result<Self, Problem> {
        Ok(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return Err(Problem::unexpected("the type of a property", quoted(word))),
        })
    }

    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The greatest whole number of the type.
    pub(super) fn greatest(self) -> Option<f64> {
        match self {
            Self::I8 => Some(i8::MAX.into()),
            Self::U8 => Some(u8::MAX.into()),
            Self::I16 => Some(i16::MAX.into()),
            Self::U16 => Some(u16::MAX.into()),
            Self::I32 => Some(i32::MAX.into()),
            Self::U32 => Some(u32::MAX.into()),
            Self::F32 | Self::F64 => None,
        }
    }
}

impl Property {
    fn read<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<Self, Problem> {
        let mut next = || words.next().unwrap_or(b"");
        let (kind, list) = match next() {
            b"list" => {
                let count = Kind::named(next())?;
                (Kind::named(next())?, Some(count))
            }
            word => (Kind::named(word)?, None),
        };
        let name = String::from_utf8_lossy(next()).into_owned();
        Ok(Self { name, kind, list })
    }
}

impl Element {
    fn read<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<Self, Problem> {
        let name = String::from_utf8_lossy(words.next().unwrap_or(b"")).into_owned();
        let rows = integer(words.next().unwrap_or(b""), "a number of rows")?;
        Ok(Self { name, rows, properties: Vec::new() })
    }

    /// Bytes that a row takes, at least; in ascii, a digit and what parts it from the next.
    pub(super) fn row_bytes(&self, encoding: Encoding) -> usize {
        let bytes = |property: &Property| match encoding {
            Encoding::Ascii => 2,
            _ => property.list.unwrap_or(property.kind).size(),
        };
        self.properties.iter().map(bytes).sum()
    }
}

impl Header {
    /// Reads the lines up to `end_header`.
    pub(super) fn read(file: &[u8]) -> Result<Self, ParseError> {
        if !file.starts_with(b"ply") {
            let found = quoted(&file[..file.len().min(4)]);
            return Err(Problem::unexpected("\"ply\"", found).at(Place::Byte(0)));
        }
        let mut header =
            Self { encoding: Encoding::Ascii, elements: Vec::new(), bytes: 0, lines: 0 };
        let mut encoding = None;
        for line in file.split_inclusive(|&byte| byte == b'\n') {
            header.bytes += line.len();
            header.lines += 1;
            let ended = header.add(line, &mut encoding);
            if ended.map_err(|problem| problem.at(Place::Line(header.lines)))? {
                let missing = || Problem::unexpected("a line \"format ...\"", "none");
                header.encoding =
                    encoding.ok_or_else(|| missing().at(Place::Line(header.lines)))?;
                return Ok(header);
            }
        }
        let problem = Problem::unexpected("\"end_header\"", "the end of the file");
        Err(problem.at(Place::Line(header.lines)))
    }

    /// Adds a line; whether it is the last.
    fn add(&mut self, line: &[u8], encoding: &mut Option<Encoding>) -> Result<bool, Problem> {
        let mut words = words(line);
        match words.next() {
            Some(b"end_header") => return Ok(true),
            Some(b"format") => {
                *encoding = Some(match words.next() {
                    Some(b"ascii") => Encoding::Ascii,
                    Some(b"binary_little_endian") => Encoding::LittleEndian,
                    Some(b"binary_big_endian") => Encoding::BigEndian,
                    other => {
                        let found = quoted(other.unwrap_or(b""));
                        return Err(Problem::unexpected("ascii or binary_..._endian", found));
                    }
                });
            }
            Some(b"element") => self.elements.push(Element::read(words)?),
            Some(b"property") => match self.elements.last_mut() {
                Some(element) => element.properties.push(Property::read(words)?),
                None => return Err(Problem::unexpected("an element", "a property of none")),
            },
            None | Some(b"ply" | b"comment" | b"obj_info") => {}
            Some(other) => {
                return Err(Problem::unexpected("a line of a PLY header", quoted(other)));
            }
        }
        Ok(false)
    }
}
