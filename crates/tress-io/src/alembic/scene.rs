//! The objects of an archive at one sample.

use glam::DMat4;
use tress_alembic::{Property, ReadError, ReadObject, Reader};
use tress_geometry::{Column, Groom, UpAxis};

use super::{curves, transform, writer};
use crate::basis_curves::{Rows, join};
use crate::{ParseError, Place, Problem};

/// Objects within objects, and instances of instances; scenes have some tens.
const DEEPEST: usize = 1000;

/// Objects and instances; in a small file instances of instances can be more than fit in memory.
const MOST: usize = 100_000;

/// An archive, and which of its samples is meant.
pub(super) struct Scene<'a> {
    reader: &'a Reader<'a>,
    sample: usize,
}

/// What is known while objects are visited.
#[derive(Default)]
struct Found {
    parts: Vec<Groom>,
    unit: Option<f64>,
    up: Option<UpAxis>,
    /// Objects visited so far, instances included.
    visited: usize,
}

impl<'a> Scene<'a> {
    /// The archive at this sample of each property.
    pub(super) fn new(reader: &'a Reader<'a>, sample: usize) -> Self {
        Self { reader, sample }
    }

    /// All curves, one groom.
    pub(super) fn groom(&self) -> Result<Groom, ParseError> {
        let mut found = Found::default();
        self.visit(&self.reader.top(), DMat4::IDENTITY, 0, &mut found)?;
        let groom = join(found.parts);
        let groom = groom.map_err(|e| Problem::Unsupported(e.to_string()).at(Place::File))?;
        Ok(groom.in_space(found.unit, found.up))
    }

    /// The times of the samples that the positions of the curves have, of those that have most.
    pub(super) fn times(&self) -> Result<Vec<f64>, ParseError> {
        let mut times = Vec::new();
        let mut pending = vec![(self.reader.top(), 0)];
        while let Some((object, depth)) = pending.pop() {
            if depth <= DEEPEST {
                let children = self.reader.children(&object).map_err(broken)?;
                pending.extend(children.into_iter().map(|child| (child, depth + 1)));
            }
            let geometry = self.get(&object.properties, ".geom")?;
            let points = geometry.map(|geometry| self.get(&geometry, "P")).transpose()?.flatten();
            if let Some(points) = points.filter(|points| times.len() < points.len()) {
                times = (0..points.len()).map(|i| self.reader.time(&points, i)).collect();
            }
        }
        Ok(times)
    }

    /// Adds the curves of an object and of what lies in it, in order.
    fn visit(
        &self,
        object: &ReadObject,
        parent: DMat4,
        depth: usize,
        found: &mut Found,
    ) -> Result<(), ParseError> {
        let place = || Place::Part(object.path.clone());
        found.visited += 1;
        if DEEPEST < depth || MOST < found.visited {
            let problem = "objects lie too deep in each other, or are instances of each other";
            return Err(Problem::Unsupported(problem.into()).at(place()));
        }
        if let Some(source) = self.source(object)? {
            return self.visit(&source, parent, depth + 1, found);
        }
        let schema = object.meta_data.schema();
        let world = match schema {
            Some("AbcGeom_Xform_v3") => {
                self.space(object, found)?;
                transform::world(self, object, parent)?
            }
            _ => parent,
        };
        if schema == Some("AbcGeom_Curve_v2") {
            found.parts.push(curves::read(self, object, world)?);
        }
        for child in self.reader.children(object).map_err(broken)? {
            self.visit(&child, world, depth + 1, found)?;
        }
        Ok(())
    }

    /// The object that an instance stands for.
    fn source(&self, object: &ReadObject) -> Result<Option<ReadObject>, ParseError> {
        let Some(path) = self.get(&object.properties, ".instanceSource")? else { return Ok(None) };
        let path = self.sample(&path)?.and_then(|sample| sample.texts()?.into_iter().next());
        let missing = || {
            let found = path.clone().unwrap_or_default();
            Problem::unexpected("an instance of an object", found)
                .at(Place::Part(object.path.clone()))
        };
        let mut source = self.reader.top();
        for name in path.as_deref().unwrap_or_default().split('/').filter(|name| !name.is_empty()) {
            let children = self.reader.children(&source).map_err(broken)?;
            source = children.into_iter().find(|child| child.name == name).ok_or_else(missing)?;
        }
        if source.path.is_empty() { Err(missing()) } else { Ok(Some(source)) }
    }

    /// What our own archives say of unit and axis.
    fn space(&self, object: &ReadObject, found: &mut Found) -> Result<(), ParseError> {
        let Some(xform) = self.get(&object.properties, ".xform")? else { return Ok(()) };
        let Some(said) = self.get(&xform, ".userProperties")? else { return Ok(()) };
        if let Some(unit) = self.get(&said, writer::UNIT)? {
            let metres = self.sample(&unit)?.and_then(|sample| sample.floats()?.first().copied());
            found.unit = metres.filter(|metres| 0.0 < *metres && metres.is_finite());
        }
        if let Some(up) = self.get(&said, writer::UP)? {
            let axis = self.sample(&up)?.and_then(|sample| sample.texts()?.into_iter().next());
            found.up = match axis.as_deref() {
                Some("Y") => Some(UpAxis::Y),
                Some("Z") => Some(UpAxis::Z),
                _ => None,
            };
        }
        Ok(())
    }

    /// The property of this name in a compound.
    pub(super) fn get(
        &self,
        compound: &Property,
        name: &str,
    ) -> Result<Option<Property>, ParseError> {
        self.reader.get(compound, name).map_err(broken)
    }

    /// The properties in a compound.
    pub(super) fn properties(&self, compound: &Property) -> Result<Vec<Property>, ParseError> {
        self.reader.properties(compound).map_err(broken)
    }

    /// The values of a property; nothing of a compound or without samples.
    pub(super) fn sample(
        &self,
        property: &Property,
    ) -> Result<Option<tress_alembic::Sample<'a>>, ParseError> {
        if property.is_compound() || property.is_empty() {
            return Ok(None);
        }
        self.reader.sample(property, self.sample).map(Some).map_err(broken)
    }

    /// A geometry parameter: its rows, looked up if it has indices, and what they stand for if it
    /// says. Nothing where it is not of numbers.
    pub(super) fn column(
        &self,
        property: &Property,
        place: &Place,
    ) -> Result<Option<(Column, Option<Rows>)>, ParseError> {
        let rows = scope(property);
        let Some(values) = self.get(property, ".vals")? else {
            return Ok(self.plain_column(property)?.map(|column| (column, rows)));
        };
        let Some(column) = self.plain_column(&values)? else { return Ok(None) };
        let Some(indices) = self.get(property, ".indices")? else {
            return Ok(Some((column, rows)));
        };
        let indices = self.sample(&indices)?.and_then(|sample| sample.integers());
        let Some(indices) = indices else { return Ok(Some((column, rows))) };
        let n = column.rows();
        let inside = indices.iter().map(|&i| usize::try_from(i).ok().filter(|i| *i < n));
        match inside.collect::<Option<Vec<usize>>>() {
            Some(indices) => Ok(Some((column.select(indices), rows))),
            None => {
                let problem = Problem::unexpected(format!("indices below {n}"), "one outside");
                Err(problem.at(place.clone()))
            }
        }
    }

    fn plain_column(&self, property: &Property) -> Result<Option<Column>, ParseError> {
        let Some(sample) = self.sample(property)? else { return Ok(None) };
        let components = sample.extent();
        if let Some(values) = sample.floats() {
            return Ok(Some(Column::Float { components, values }));
        }
        Ok(sample.integers().map(|values| match components {
            1 => Column::Int(values),
            _ => Column::Float { components, values: values.iter().map(|&i| i as f64).collect() },
        }))
    }
}

fn scope(property: &Property) -> Option<Rows> {
    match property.meta_data.get("geoScope")? {
        "con" => Some(Rows::Constant),
        "uni" => Some(Rows::Uniform),
        "var" => Some(Rows::Varying),
        "vtx" | "fvr" => Some(Rows::Vertex),
        _ => None,
    }
}

/// What is wrong with an archive, with its place.
pub(super) fn broken(error: ReadError) -> ParseError {
    match error {
        ReadError::Truncated { at, needed, left } => {
            Problem::Truncated { needed, left }.at(Place::Byte(at))
        }
        ReadError::Broken { at, what } => {
            let what = format!("{what} cannot be made sense of");
            Problem::Unsupported(what).at(Place::Byte(at))
        }
        other => Problem::Unsupported(other.to_string()).at(Place::File),
    }
}
