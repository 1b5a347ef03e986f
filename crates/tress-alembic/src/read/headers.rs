//! Headers of objects and of properties, as their parents hold them.

use super::tree::Address;
use super::{MetaData, ReadError};
use crate::texts::INLINE;

/// What the parent says of an object.
pub(super) struct ObjectHeader {
    pub(super) name: String,
    pub(super) meta_data: MetaData,
}

/// A property of an object that is read: a compound of others, or samples.
#[derive(Clone, Debug)]
pub struct Property {
    /// Its name; that of an object's own compound is empty.
    pub name: String,
    /// What it says of itself.
    pub meta_data: MetaData,
    kind: Kind,
    pub(super) pod: u8,
    pub(super) extent: u8,
    samples: usize,
    /// The first and the last sample that differ from the one before, both 0 if none does.
    changes: (usize, usize),
    pub(super) time: usize,
    pub(super) group: Address,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Compound,
    Scalar,
    Array,
}

impl Property {
    /// The compound whose group this is.
    pub(super) fn compound(group: Address) -> Self {
        Self {
            name: String::new(),
            meta_data: MetaData::default(),
            kind: Kind::Compound,
            pod: 0,
            extent: 0,
            samples: 0,
            changes: (0, 0),
            time: 0,
            group,
        }
    }

    /// Whether it holds properties rather than samples.
    #[must_use]
    pub fn is_compound(&self) -> bool {
        self.kind == Kind::Compound
    }

    /// Whether each sample is one row.
    #[must_use]
    pub fn is_scalar(&self) -> bool {
        self.kind == Kind::Scalar
    }

    /// How many samples there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.samples
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.samples == 0
    }

    /// Whether all samples are equal.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.changes == (0, 0)
    }

    /// Which of the samples in the file the sample `index` is.
    pub(super) fn stored(&self, index: usize) -> usize {
        let (first, last) = self.changes;
        if index < first || self.is_constant() { 0 } else { index.min(last) - first + 1 }
    }
}

/// The headers of an object's children.
pub(super) fn object_headers(
    data: &[u8],
    texts: &[MetaData],
    at: u64,
) -> Result<Vec<ObjectHeader>, ReadError> {
    let mut data = Bytes { data, at, what: "the headers of objects" };
    let mut headers = Vec::new();
    while !data.data.is_empty() {
        let size = data.number(4)?;
        let name = data.text(size)?;
        let meta_data = match data.number(1)? {
            index if index == usize::from(INLINE) => {
                let size = data.number(4)?;
                MetaData::new(data.take(size)?)
            }
            index => data.shared(texts, index)?,
        };
        headers.push(ObjectHeader { name, meta_data });
    }
    Ok(headers)
}

/// The headers of a compound's properties, whose groups these are.
pub(super) fn property_headers(
    data: &[u8],
    texts: &[MetaData],
    groups: &[Address],
    at: u64,
) -> Result<Vec<Property>, ReadError> {
    let mut data = Bytes { data, at, what: "the headers of properties" };
    let mut groups = groups.iter();
    let mut headers = Vec::new();
    while !data.data.is_empty() {
        let group = *groups.next().ok_or(data.broken())?;
        headers.push(property_header(&mut data, texts, group)?);
    }
    Ok(headers)
}

fn property_header(
    data: &mut Bytes<'_>,
    texts: &[MetaData],
    group: Address,
) -> Result<Property, ReadError> {
    let info = data.number(4)?;
    // All numbers of a header have the same size.
    let size = match info >> 2 & 3 {
        0 => 1,
        1 => 2,
        _ => 4,
    };
    let mut property = Property::compound(group);
    property.kind = match info & 3 {
        0 => Kind::Compound,
        1 => Kind::Scalar,
        _ => Kind::Array,
    };
    if property.kind != Kind::Compound {
        property.pod = byte(info >> 4 & 0xf);
        property.extent = byte(info >> 12 & 0xff);
        property.samples = data.number(size)?;
        property.changes = if info & 0x200 != 0 {
            (data.number(size)?, data.number(size)?)
        } else if info & 0x800 != 0 || property.samples < 2 {
            (0, 0)
        } else {
            (1, property.samples - 1)
        };
        property.time = if info & 0x100 == 0 { 0 } else { data.number(size)? };
        let (first, last) = property.changes;
        if last < first || property.samples.max(1) <= last || first == 0 && last != 0 {
            return Err(data.broken());
        }
    }
    let name_size = data.number(size)?;
    property.name = data.text(name_size)?;
    property.meta_data = match info >> 20 & 0xff {
        index if index == usize::from(INLINE) => {
            let size = data.number(size)?;
            MetaData::new(data.take(size)?)
        }
        index => data.shared(texts, index)?,
    };
    Ok(property)
}

/// A number below 256.
fn byte(number: usize) -> u8 {
    u8::try_from(number).unwrap_or(u8::MAX)
}

/// Headers that are not read yet.
struct Bytes<'a> {
    data: &'a [u8],
    at: u64,
    what: &'static str,
}

impl<'a> Bytes<'a> {
    fn broken(&self) -> ReadError {
        ReadError::Broken { at: self.at, what: self.what }
    }

    fn take(&mut self, size: usize) -> Result<&'a [u8], ReadError> {
        let (taken, rest) = self.data.split_at_checked(size).ok_or(self.broken())?;
        self.data = rest;
        Ok(taken)
    }

    /// A number of at most four bytes.
    fn number(&mut self, size: usize) -> Result<usize, ReadError> {
        let bytes = self.take(size)?.iter().rev();
        Ok(bytes.fold(0, |number, &byte| number << 8 | usize::from(byte)))
    }

    fn text(&mut self, size: usize) -> Result<String, ReadError> {
        Ok(String::from_utf8_lossy(self.take(size)?).into_owned())
    }

    fn shared(&self, texts: &[MetaData], index: usize) -> Result<MetaData, ReadError> {
        texts.get(index).cloned().ok_or(self.broken())
    }
}
