//! Objects: names in a tree, each with properties.
//!
//! In the file an object is a group: its properties, its children, and data with the headers of the
//! children and two digests, of the properties and of the children.

use std::io::{self, Seek, Write};

use crate::chunks::{Address, Chunks};
use crate::digest::{Digest, digest};
use crate::error::Error;
use crate::property::Compound;
use crate::schema::Schema;
use crate::texts::{INLINE, Texts};

/// An object under construction.
#[derive(Debug)]
pub(crate) struct Node {
    pub(crate) name: String,
    /// Nothing of the top object.
    pub(crate) schema: Option<Schema>,
    /// The parent's place among the objects; nothing of the top object.
    pub(crate) parent: Option<usize>,
    /// The place of what an instance stands for.
    pub(crate) source: Option<usize>,
    pub(crate) properties: Compound,
    /// Samples written so far, and the time sampling they are of.
    pub(crate) samples: usize,
    pub(crate) time: u32,
}

impl Node {
    pub(crate) fn new(name: &str, schema: Option<Schema>, parent: Option<usize>) -> Self {
        let properties = Compound::default();
        let (source, samples, time) = (None, 0, 0);
        Self { name: name.into(), schema, parent, source, properties, samples, time }
    }

    /// The properties of its schema.
    ///
    /// # Errors
    ///
    /// If it is the top object, which has none.
    pub(crate) fn schema(&mut self) -> Result<&mut Compound, Error> {
        let schema = self.schema.ok_or(Error::NoObject)?;
        self.properties.compound(schema.property, schema.meta_data)
    }
}

/// An object that is in the file.
struct Done {
    address: Address,
    header: Vec<u8>,
    digest: Digest,
}

/// Writes all objects; parents come before their children, the top one first.
pub(crate) fn write<W: Write + Seek>(
    nodes: &[Node],
    out: &mut Chunks<W>,
    texts: &mut Texts,
) -> io::Result<Address> {
    let mut done: Vec<Vec<Done>> = nodes.iter().map(|_| Vec::new()).collect();
    let mut top = Address::NO_GROUP;
    for (i, node) in nodes.iter().enumerate().rev() {
        let mut children = std::mem::take(&mut done[i]);
        // They were written from the last to the first.
        children.reverse();
        let written = write_one(node, &children, out, texts)?;
        top = written.address;
        if let Some(parent) = node.parent {
            done[parent].push(written);
        }
    }
    Ok(top)
}

fn write_one<W: Write + Seek>(
    node: &Node,
    children: &[Done],
    out: &mut Chunks<W>,
    texts: &mut Texts,
) -> io::Result<Done> {
    let mut addresses = vec![node.properties.write(out, texts)?];
    addresses.extend(children.iter().map(|child| child.address));
    let mut data: Vec<u8> = children.iter().flat_map(|child| &child.header).copied().collect();
    let own = node.properties.digest();
    let below: Vec<u8> = children.iter().flat_map(|child| child.digest).collect();
    let below = if below.is_empty() { [0; 16] } else { digest(&below) };
    data.extend(own);
    data.extend(below);
    addresses.push(out.data(&[], &data)?);
    let address = out.group(&addresses)?;
    let header = header(node, texts);
    let digest = digest(&[header.as_slice(), &own, &below].concat());
    Ok(Done { address, header, digest })
}

/// What the parent says of an object: its name and its text.
fn header(node: &Node, texts: &mut Texts) -> Vec<u8> {
    let long = |length: usize| u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes();
    let mut header = long(node.name.len()).to_vec();
    header.extend(node.name.as_bytes());
    let meta_data = node.schema.map_or("", |schema| schema.object);
    let text = texts.index(meta_data);
    header.push(text);
    if text == INLINE {
        header.extend(long(meta_data.len()));
        header.extend(meta_data.as_bytes());
    }
    header
}
