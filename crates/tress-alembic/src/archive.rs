//! An archive: objects, their samples, and what ties them together.

use std::collections::HashMap;
use std::io::{Seek, Write};

use rayon::prelude::*;

use crate::chunks::Chunks;
use crate::curves;
use crate::error::Error;
use crate::object::{self, Node};
use crate::samples::{Encoded, Samples, Written};
use crate::schema::{self, CurvesSample, Kind, Schema};
use crate::texts::Texts;
use crate::values::{Numbers, Values};

/// Version of the layout.
const FILE_VERSION: i32 = 0;
/// Version of the C++ library whose archives this one is like: 1.8.0.
const LIBRARY_VERSION: i32 = 10800;

/// An archive that is being written. One that is not [finished](Self::finish) says so to its
/// readers.
#[derive(Debug)]
pub struct Archive<W> {
    out: Chunks<W>,
    application: String,
    /// Start and step of each time sampling.
    times: Vec<(f64, f64)>,
    nodes: Vec<Node>,
    written: Written,
}

/// An object of an archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Object(usize);

/// When samples are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Time(u32);

impl<W: Write + Seek> Archive<W> {
    /// Begins an archive at the stream's beginning; `application` says who writes it.
    ///
    /// # Errors
    ///
    /// If the stream does not take it.
    pub fn new(out: W, application: &str) -> Result<Self, Error> {
        Ok(Self {
            out: Chunks::new(out)?,
            // Texts are pairs as in `key=value;key=value`.
            application: application.replace(['=', ';'], " "),
            times: vec![(0.0, 1.0)],
            nodes: vec![Node::new("ABC", None, None)],
            written: HashMap::new(),
        })
    }

    /// The object that all others are in.
    #[must_use]
    pub fn top(&self) -> Object {
        Object(0)
    }

    /// Says when samples are taken: the first at `start` seconds, each next `step` seconds later.
    pub fn add_time(&mut self, start: f64, step: f64) -> Time {
        let known = self.times.iter().position(|&time| time == (start, step));
        let index = known.unwrap_or_else(|| {
            self.times.push((start, step));
            self.times.len() - 1
        });
        Time(u32::try_from(index).unwrap_or(u32::MAX))
    }

    /// Adds a transform: a matrix in column-major order for column vectors, its last four numbers
    /// the translation and 1; or nothing, for a transform that only groups what lies in it.
    ///
    /// # Errors
    ///
    /// If the name is no name or taken, or the stream does not take it.
    pub fn add_transform(
        &mut self,
        parent: Object,
        name: &str,
        matrix: Option<&[f64; 16]>,
    ) -> Result<Object, Error> {
        let object = self.add(parent, name, schema::TRANSFORM)?;
        let Self { out, written, nodes, .. } = self;
        let xform = nodes[object.0].schema()?;
        let mut scalar = |name: &str, values: &Values<'_>| {
            let samples = xform.samples(name, || scalar(values, 0))?;
            Ok::<_, Error>(samples.push_scalar(values, out, written)?)
        };
        scalar(".inherits", &schema::YES)?;
        if let Some(matrix) = matrix {
            scalar(".ops", &schema::MATRIX)?;
            scalar(".vals", &Values::rows(Numbers::F64(matrix), 16))?;
            scalar("isNotConstantIdentity", &schema::YES)?;
        }
        Ok(object)
    }

    /// Adds curves, without samples.
    ///
    /// # Errors
    ///
    /// If the name is no name or taken, or the stream does not take it.
    pub fn add_curves(
        &mut self,
        parent: Object,
        name: &str,
        kind: Kind,
        time: Time,
    ) -> Result<Object, Error> {
        let object = self.add(parent, name, schema::CURVES)?;
        let Self { out, written, nodes, .. } = self;
        nodes[object.0].time = time.0;
        let bytes = kind.bytes();
        let basis = Values { numbers: Numbers::U8(&bytes), extent: 4, interpretation: "" };
        let geometry = nodes[object.0].schema()?;
        let samples = geometry.samples("curveBasisAndType", || scalar(&basis, 0))?;
        samples.push_scalar(&basis, out, written)?;
        Ok(object)
    }

    /// Adds an instance: whatever `source` and what lies in it hold, once more under `parent`.
    ///
    /// # Errors
    ///
    /// If the name is no name or taken, if the instance would lie in what it stands for, or the
    /// stream does not take it.
    pub fn add_instance(
        &mut self,
        parent: Object,
        name: &str,
        source: Object,
    ) -> Result<Object, Error> {
        self.nodes.get(source.0).filter(|node| node.source.is_none()).ok_or(Error::NoObject)?;
        if self.shows(source.0, &self.ancestors(parent).collect::<Vec<_>>()) {
            return Err(Error::Circular(name.into()));
        }
        let object = self.add(parent, name, schema::INSTANCE)?;
        self.nodes[object.0].source = Some(source.0);
        let mut names: Vec<&str> =
            self.ancestors(source).map(|index| self.nodes[index].name.as_str()).collect();
        names.pop();
        let path: String = names.iter().rev().flat_map(|name| ["/", name]).collect();
        let Self { out, written, nodes, .. } = self;
        let texts = [path.as_str()];
        let path = Values::scalars(Numbers::Text(&texts));
        let properties = &mut nodes[object.0].properties;
        let samples = properties.samples(schema::INSTANCE.property, || scalar(&path, 0))?;
        samples.push_scalar(&path, out, written)?;
        Ok(object)
    }

    /// Says something of an object that does not change: a scalar among its `.userProperties`. Of
    /// values with several rows the first is written.
    ///
    /// # Errors
    ///
    /// If the name is no name or taken, or the stream does not take it.
    pub fn set_user_property(
        &mut self,
        object: Object,
        name: &str,
        values: Values<'_>,
    ) -> Result<(), Error> {
        check_name(name)?;
        let Self { out, written, nodes, .. } = self;
        let node = nodes.get_mut(object.0).ok_or(Error::NoObject)?;
        let properties = match node.schema {
            Some(_) if node.source.is_some() => return Err(Error::NoObject),
            Some(_) => node.schema()?.compound(".userProperties", "")?,
            None => &mut node.properties,
        };
        if properties.has(name) {
            return Err(Error::Taken(name.into()));
        }
        let samples = properties.samples(name, || scalar(&values, 0))?;
        Ok(samples.push_scalar(&values, out, written)?)
    }

    /// Writes the next sample of curves.
    ///
    /// # Errors
    ///
    /// If counts, points and rows of parameters do not match each other or the first sample, or the
    /// stream does not take it.
    pub fn write_curves(&mut self, curves: Object, sample: &CurvesSample<'_>) -> Result<(), Error> {
        curves::check(sample)?;
        let Self { out, written, nodes, .. } = self;
        let node = nodes.get_mut(curves.0).filter(|node| node.schema == Some(schema::CURVES));
        let node = node.ok_or(Error::NoObject)?;
        let (time, index) = (node.time, node.samples);
        let arrays = curves::arrays(sample);
        // What takes long beside the disk: a look at every number.
        let (bounds, encoded) = rayon::join(
            || schema::bounds(sample.points),
            || arrays.par_iter().map(|array| Encoded::new(&array.values)).collect::<Vec<_>>(),
        );
        let geometry = node.schema()?;
        for (array, encoded) in arrays.iter().zip(&encoded) {
            let compound = if array.is_parameter {
                geometry.compound(".arbGeomParams", "")?
            } else {
                &mut *geometry
            };
            let changed = || Error::Changed(array.name.into());
            if !compound.has(array.name) && 0 < index {
                return Err(changed());
            }
            let make = || (array.meta_data.clone(), Samples::array(&array.values, time));
            let samples = compound.samples(array.name, make)?;
            if !samples.take(&array.values) || samples.len() != index {
                return Err(changed());
            }
            samples.push(encoded, out, written)?;
        }
        let bounds = Values::bounds(&bounds);
        let samples = geometry.samples(".selfBnds", || scalar(&bounds, time))?;
        samples.push_scalar(&bounds, out, written)?;
        node.samples += 1;
        Ok(())
    }

    /// Writes what ties the objects together, and gives the stream back.
    ///
    /// # Errors
    ///
    /// If the stream does not take it.
    pub fn finish(self) -> Result<W, Error> {
        let Self { mut out, application, times, nodes, .. } = self;
        let version = out.data(&[], &FILE_VERSION.to_le_bytes())?;
        let library = out.data(&[], &LIBRARY_VERSION.to_le_bytes())?;
        let mut texts = Texts::default();
        let top = object::write(&nodes, &mut out, &mut texts)?;
        let about = format!(
            "_ai_AlembicVersion=tress-alembic {};_ai_Application={application}",
            env!("CARGO_PKG_VERSION")
        );
        let about = out.data(&[], about.as_bytes())?;
        let times = out.data(&[], &time_samplings(&times, &nodes))?;
        let texts = out.data(&[], texts.bytes())?;
        let root = out.group(&[version, library, top, about, times, texts])?;
        Ok(out.finish(root)?)
    }

    /// The places of an object and of those that it lies in, up to the top; none of an object of
    /// another archive.
    fn ancestors(&self, object: Object) -> impl Iterator<Item = usize> {
        let own = Some(object.0).filter(|index| *index < self.nodes.len());
        std::iter::successors(own, |index| self.nodes[*index].parent)
    }

    /// Whether an object is one of `others` or holds one, instances included.
    fn shows(&self, object: usize, others: &[usize]) -> bool {
        let mut seen = vec![false; self.nodes.len()];
        let mut pending = vec![object];
        while let Some(index) = pending.pop() {
            if others.contains(&index) {
                return true;
            }
            if !std::mem::replace(&mut seen[index], true) {
                let children = self.nodes.iter().enumerate();
                let children = children.filter(|(_, node)| node.parent == Some(index));
                pending.extend(children.map(|(child, _)| child));
                pending.extend(self.nodes[index].source);
            }
        }
        false
    }

    fn add(&mut self, parent: Object, name: &str, schema: Schema) -> Result<Object, Error> {
        check_name(name)?;
        // What an instance holds, its source holds.
        self.nodes.get(parent.0).filter(|node| node.source.is_none()).ok_or(Error::NoObject)?;
        let taken = |node: &Node| node.parent == Some(parent.0) && node.name == name;
        if self.nodes.iter().any(taken) {
            return Err(Error::Taken(name.into()));
        }
        self.nodes.push(Node::new(name, Some(schema), Some(parent.0)));
        Ok(Object(self.nodes.len() - 1))
    }
}

/// A property of one row a sample, as a compound makes it.
fn scalar(values: &Values<'_>, time: u32) -> (String, Samples) {
    (values.meta_data(None), Samples::scalar(values, time))
}

pub(crate) fn check_name(name: &str) -> Result<(), Error> {
    let is_odd = |c: char| c == '/' || c.is_control();
    if name.is_empty() || name.contains(is_odd) { Err(Error::Name(name.into())) } else { Ok(()) }
}

/// For each time sampling the most samples that a property of it has, its step, and the one time
/// that is stored: its start.
fn time_samplings(times: &[(f64, f64)], nodes: &[Node]) -> Vec<u8> {
    let mut most = vec![0_usize; times.len()];
    for node in nodes {
        node.properties.visit(&mut |samples| {
            if let Some(most) = most.get_mut(samples.time() as usize) {
                *most = samples.len().max(*most);
            }
        });
    }
    let mut bytes = Vec::new();
    for (&(start, step), most) in times.iter().zip(most) {
        bytes.extend(u32::try_from(most).unwrap_or(u32::MAX).to_le_bytes());
        bytes.extend(step.to_le_bytes());
        bytes.extend(1_u32.to_le_bytes());
        bytes.extend(start.to_le_bytes());
    }
    bytes
}
