//! Reading archives: objects, properties and their samples, straight from the bytes of a file.

mod error;
mod headers;
mod meta_data;
mod sample;
mod tree;

pub use error::ReadError;
pub use headers::Property;
pub use meta_data::MetaData;
pub use sample::Sample;

use headers::{object_headers, property_headers};
use tree::{Address, Tree};

/// What archives begin with, before a byte that says whether they are whole.
const MAGIC: &[u8] = b"Ogawa";
/// What that byte is then.
const WHOLE: u8 = 0xff;
/// What the older kind of archives begins with.
const HDF5: &[u8] = b"\x89HDF";
/// Bytes at the end of the headers of an object's children: two digests.
const DIGESTS: usize = 32;

/// An archive in memory.
///
/// ```
/// use std::io::Cursor;
/// use tress_alembic::{Archive, CurvesSample, Kind, Reader};
///
/// let mut archive = Archive::new(Cursor::new(Vec::new()), "")?;
/// let time = archive.add_time(0.0, 0.5);
/// let hair = archive.add_curves(archive.top(), "hair", Kind::Linear, time)?;
/// for x in [1.0, 2.0] {
///     let points = [[x, 0.0, 0.0]];
///     let sample = CurvesSample { points: &points, counts: &[1], ..CurvesSample::default() };
///     archive.write_curves(hair, &sample)?;
/// }
/// let bytes = archive.finish()?.into_inner();
///
/// let reader = Reader::new(&bytes)?;
/// let hair = &reader.children(&reader.top())?[0];
/// assert_eq!((hair.name.as_str(), hair.meta_data.schema()), ("hair", Some("AbcGeom_Curve_v2")));
/// let geometry = reader.get(&hair.properties, ".geom")?.expect("what curves have");
/// let points = reader.get(&geometry, "P")?.expect("positions");
/// assert_eq!((points.len(), reader.time(&points, 1)), (2, 0.5));
/// assert_eq!(reader.sample(&points, 1)?.floats(), Some(vec![2.0, 0.0, 0.0]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Reader<'a> {
    tree: Tree<'a>,
    /// Texts that headers refer to.
    texts: Vec<MetaData>,
    times: Vec<Times>,
    top: Address,
}

/// An object of an archive that is read.
#[derive(Clone, Debug)]
pub struct ReadObject {
    /// Its name.
    pub name: String,
    /// Its name behind those of the objects it is in.
    pub path: String,
    /// What it says of itself.
    pub meta_data: MetaData,
    /// The compound of its properties.
    pub properties: Property,
    group: Address,
}

/// A time sampling: times that repeat with a period.
#[derive(Clone, Debug)]
struct Times {
    period: f64,
    times: Vec<f64>,
}

impl<'a> Reader<'a> {
    /// Looks at an archive's frame.
    ///
    /// # Errors
    ///
    /// If it is none, is not whole, or its groups are no tree within the file.
    pub fn new(bytes: &'a [u8]) -> Result<Self, ReadError> {
        if bytes.starts_with(HDF5) {
            return Err(ReadError::Hdf5);
        }
        if !bytes.starts_with(MAGIC) {
            return Err(ReadError::NoArchive);
        }
        match bytes.get(MAGIC.len()) {
            Some(&WHOLE) => {}
            Some(_) => return Err(ReadError::NotWhole),
            None => {
                return Err(ReadError::Truncated { at: 0, needed: 16, left: MAGIC.len() as u64 });
            }
        }
        let tree = Tree::new(bytes)?;
        let root = tree.children(tree.root())?;
        let broken = ReadError::Broken { at: tree.root().byte(), what: "the root group" };
        let (top, times, texts) = match root[..] {
            [_, _, top, _, times, texts, ..] if !top.is_data() => (top, times, texts),
            _ => return Err(broken),
        };
        let texts = meta_data::shared(tree.data(texts)?, texts.byte())?;
        let times = read_times(tree.data(times)?, times.byte())?;
        Ok(Self { tree, texts, times, top })
    }

    /// The object that all others are in.
    #[must_use]
    pub fn top(&self) -> ReadObject {
        let header = headers::ObjectHeader { name: "ABC".into(), meta_data: MetaData::default() };
        self.object(header, "", self.top)
    }

    /// The objects in an object.
    ///
    /// # Errors
    ///
    /// If the file is broken.
    pub fn children(&self, object: &ReadObject) -> Result<Vec<ReadObject>, ReadError> {
        let children = self.tree.children(object.group)?;
        let [_, children @ .., last] = &children[..] else { return Ok(Vec::new()) };
        let data = self.tree.data(*last)?;
        let headers = data.get(..data.len().saturating_sub(DIGESTS)).unwrap_or_default();
        let headers = object_headers(headers, &self.texts, last.byte())?;
        if headers.len() != children.len() {
            return Err(ReadError::Broken { at: last.byte(), what: "the headers of objects" });
        }
        let objects = headers.into_iter().zip(children);
        Ok(objects.map(|(header, group)| self.object(header, &object.path, *group)).collect())
    }

    fn object(&self, header: headers::ObjectHeader, parent: &str, group: Address) -> ReadObject {
        let headers::ObjectHeader { name, meta_data } = header;
        let path = if group == self.top { String::new() } else { format!("{parent}/{name}") };
        let first = self.tree.children(group).ok().and_then(|children| children.first().copied());
        let properties = Property::compound(first.unwrap_or(Address::NONE));
        ReadObject { name, path, meta_data, properties, group }
    }

    /// The properties in a compound; none of what is none.
    ///
    /// # Errors
    ///
    /// If the file is broken.
    pub fn properties(&self, compound: &Property) -> Result<Vec<Property>, ReadError> {
        if !compound.is_compound() {
            return Ok(Vec::new());
        }
        let children = self.tree.children(compound.group)?;
        let [children @ .., last] = &children[..] else { return Ok(Vec::new()) };
        property_headers(self.tree.data(*last)?, &self.texts, children, last.byte())
    }

    /// The property of this name in a compound.
    ///
    /// # Errors
    ///
    /// If the file is broken.
    pub fn get(&self, compound: &Property, name: &str) -> Result<Option<Property>, ReadError> {
        Ok(self.properties(compound)?.into_iter().find(|property| property.name == name))
    }

    /// A sample of a property; one behind the last is the last.
    ///
    /// # Errors
    ///
    /// If the property has no samples, or the file is broken.
    pub fn sample(&self, property: &Property, index: usize) -> Result<Sample<'a>, ReadError> {
        let missing = ReadError::NoSample(property.name.clone());
        if property.is_empty() {
            return Err(missing);
        }
        let index = property.stored(index.min(property.len() - 1));
        let children = self.tree.children(property.group)?;
        let index = if property.is_scalar() { index } else { 2 * index };
        let data = self.tree.data(*children.get(index).ok_or(missing)?)?;
        // A digest stands before what is not empty.
        let bytes = data.get(16..).unwrap_or_default();
        Ok(Sample::new(bytes, property.pod, property.extent))
    }

    /// When a sample of a property is taken, in seconds.
    #[must_use]
    pub fn time(&self, property: &Property, index: usize) -> f64 {
        let Some(Times { period, times }) = self.times.get(property.time) else { return 0.0 };
        let n = times.len().max(1);
        // A period of this size says that the times do not repeat.
        let repeats = if *period < f64::MAX / 64.0 { (index / n) as f64 * period } else { 0.0 };
        times.get(index % n).map_or(0.0, |time| time + repeats)
    }
}

/// Time samplings, one after the other: a `u32` number of samples, an `f64` period, a `u32` count
/// and that many `f64` times.
fn read_times(mut data: &[u8], at: u64) -> Result<Vec<Times>, ReadError> {
    let mut samplings = Vec::new();
    while !data.is_empty() {
        let broken = ReadError::Broken { at, what: "the time samplings" };
        let Some((head, rest)) = data.split_first_chunk::<16>() else { return Err(broken) };
        let [_, _, _, _, period @ .., a, b, c, d] = *head;
        let count = u32::from_le_bytes([a, b, c, d]) as usize;
        let size = count.saturating_mul(8);
        let Some((times, rest)) = rest.split_at_checked(size) else {
            let (needed, left) = (size as u64, rest.len() as u64);
            return Err(ReadError::Truncated { at, needed, left });
        };
        let times = times.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes));
        samplings.push(Times { period: f64::from_le_bytes(period), times: times.collect() });
        data = rest;
    }
    Ok(samplings)
}
