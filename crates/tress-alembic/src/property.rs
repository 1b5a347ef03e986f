//! Properties: names with values, or with further properties.
//!
//! In the file a property is a group of its samples; a compound is a group of its properties'
//! groups followed by data: their headers.

use std::io::{self, Seek, Write};

use crate::chunks::{Address, Chunks};
use crate::digest::{Digest, digest};
use crate::error::Error;
use crate::samples::Samples;
use crate::texts::{INLINE, Texts};

/// Properties by name, in the order in which they were added.
#[derive(Debug, Default)]
pub(crate) struct Compound(Vec<Property>);

/// A name, what it says of itself, and what it holds.
#[derive(Debug)]
struct Property {
    name: String,
    meta_data: String,
    contents: Contents,
}

#[derive(Debug)]
enum Contents {
    Compound(Compound),
    Samples(Samples),
}

impl Compound {
    /// Whether there is a property of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.0.iter().any(|property| property.name == name)
    }

    /// The samples of this name, none yet if there is no such property.
    ///
    /// # Errors
    ///
    /// If the name is that of a compound.
    pub(crate) fn samples(
        &mut self,
        name: &str,
        make: impl FnOnce() -> (String, Samples),
    ) -> Result<&mut Samples, Error> {
        let property = self.property(name, || {
            let (meta_data, samples) = make();
            (meta_data, Contents::Samples(samples))
        });
        match property {
            Contents::Samples(samples) => Ok(samples),
            Contents::Compound(_) => Err(Error::Taken(name.into())),
        }
    }

    /// The compound of this name, empty if there is no such property.
    ///
    /// # Errors
    ///
    /// If the name is that of samples.
    pub(crate) fn compound(&mut self, name: &str, meta_data: &str) -> Result<&mut Self, Error> {
        let make = || (meta_data.into(), Contents::Compound(Self::default()));
        match self.property(name, make) {
            Contents::Compound(compound) => Ok(compound),
            Contents::Samples(_) => Err(Error::Taken(name.into())),
        }
    }

    fn property(&mut self, name: &str, make: impl FnOnce() -> (String, Contents)) -> &mut Contents {
        let known = self.0.iter().position(|property| property.name == name);
        let index = known.unwrap_or_else(|| {
            let (meta_data, contents) = make();
            self.0.push(Property { name: name.into(), meta_data, contents });
            self.0.len() - 1
        });
        &mut self.0[index].contents
    }

    /// Calls `visit` for all samples in it.
    pub(crate) fn visit(&self, visit: &mut impl FnMut(&Samples)) {
        for property in &self.0 {
            match &property.contents {
                Contents::Compound(compound) => compound.visit(visit),
                Contents::Samples(samples) => visit(samples),
            }
        }
    }

    /// Writes the group of its properties.
    pub(crate) fn write<W: Write + Seek>(
        &self,
        out: &mut Chunks<W>,
        texts: &mut Texts,
    ) -> io::Result<Address> {
        if self.0.is_empty() {
            return Ok(Address::NO_GROUP);
        }
        let mut addresses = Vec::new();
        let mut headers = Vec::new();
        for property in &self.0 {
            addresses.push(match &property.contents {
                Contents::Compound(compound) => compound.write(out, texts)?,
                Contents::Samples(samples) => samples.write(out)?,
            });
            headers.extend(property.header(texts));
        }
        addresses.push(out.data(&[], &headers)?);
        out.group(&addresses)
    }

    /// A digest of names, types and all samples.
    pub(crate) fn digest(&self) -> Digest {
        let mut bytes = Vec::new();
        for property in &self.0 {
            bytes.extend(property.name.as_bytes());
            bytes.extend(property.meta_data.as_bytes());
            match &property.contents {
                Contents::Compound(compound) => bytes.extend(compound.digest()),
                Contents::Samples(samples) => bytes.extend(samples.digests()),
            }
        }
        digest(&bytes)
    }
}

impl Property {
    /// What the compound says of this property: flags, numbers, its name, and its text if that is
    /// not shared.
    fn header(&self, texts: &mut Texts) -> Vec<u8> {
        let (mut info, mut numbers) = match &self.contents {
            Contents::Compound(_) => (0, Vec::new()),
            Contents::Samples(samples) => samples.info(),
        };
        numbers.push(self.name.len());
        let text = texts.index(&self.meta_data);
        info |= u32::from(text) << 20;
        let inline = if text == INLINE { self.meta_data.as_str() } else { "" };
        // All numbers of a header have the same size: 1, 2 or 4 bytes.
        let size = match numbers.iter().copied().max().unwrap_or(0).max(inline.len()) {
            0..=0xff => 1,
            0x100..=0xffff => 2,
            _ => 4,
        };
        info |= (size / 2) << 2;
        let number = |n: usize| n.to_le_bytes().into_iter().take(size as usize);
        let mut header = info.to_le_bytes().to_vec();
        header.extend(numbers.into_iter().flat_map(number));
        header.extend(self.name.as_bytes());
        if text == INLINE {
            header.extend(number(inline.len()));
            header.extend(inline.as_bytes());
        }
        header
    }
}
