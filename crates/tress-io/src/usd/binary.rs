//! Writing `.usdc`: the prims that `.usda` is written with, in the binary crate format.
//!
//! What is the same on all frames becomes a default, what changes becomes time samples, a sample a
//! frame, equal ones stored once.

mod crate_file;

use std::io::{Seek, Write};

use glam::DVec3;
use tress_geometry::{Column, Groom, UpAxis};

use super::primvars::{self, Primvar, Rows, primvars};
use crate::binary::{narrow, narrow_point, packed};
use crate::widths::{Extent, Widths};
use crate::{EncodeError, Frames, UsdCurves};
use crate_file::{CrateFile, Kind, Rep, Type};

/// What prims that are there, rather than said more of, are specified by.
const DEF: Rep = Rep::inlined(Type::Specifier, 0);

/// The box around nothing, as USD has it.
const EMPTY: (DVec3, DVec3) = (DVec3::splat(f32::MAX as f64), DVec3::splat(f32::MIN as f64));

/// A layer that grooms are written to, a frame each.
pub(crate) struct Writer<W> {
    file: CrateFile<W>,
    frames: Option<Frames>,
    curves: UsdCurves,
    unit: Option<f64>,
    up: Option<UpAxis>,
    attributes: Vec<Attribute>,
    written: usize,
}

/// An attribute with what is written of it.
struct Attribute {
    name: String,
    type_name: &'static str,
    rows: Option<Rows>,
    size: usize,
    /// The value on each frame.
    reps: Vec<Rep>,
    /// The last value.
    last: Vec<u8>,
}

impl<W: Write + Seek> Writer<W> {
    /// Begins a layer; without frames it holds one groom.
    pub(crate) fn new(
        out: W,
        first: &Groom,
        curves: UsdCurves,
        frames: Option<Frames>,
    ) -> Result<Self, EncodeError> {
        Ok(Self {
            file: CrateFile::new(out)?,
            frames,
            curves,
            unit: first.unit,
            up: first.up,
            attributes: Vec::new(),
            written: 0,
        })
    }

    /// Writes a frame.
    pub(crate) fn push(&mut self, groom: &Groom) -> Result<(), EncodeError> {
        super::check_counts(groom)?;
        let strands = groom.strands();
        let counts: Vec<i32> =
            strands.counts().map(|count| i32::try_from(count).unwrap_or(i32::MAX)).collect();
        let counts = packed(&counts, i32::to_le_bytes);
        self.set(("curveVertexCounts", "int[]", None, 1), Type::Int, strands.len(), counts)?;
        let points = packed(strands.points(), narrow_point);
        self.set(("points", "point3f[]", None, 1), Type::Vec3f, strands.points().len(), points)?;

        self.widths(groom)?;
        for primvar in primvars(groom) {
            self.primvar(&primvar)?;
        }
        self.written += 1;
        match self.attributes.iter().find(|attribute| attribute.reps.len() != self.written) {
            None => Ok(()),
            Some(attribute) => Err(changed(&attribute.name)),
        }
    }

    /// Writes the widths, and the box around curves of that width.
    fn widths(&mut self, groom: &Groom) -> Result<(), EncodeError> {
        let widths = Widths::of(groom);
        // What is on one frame must be on all.
        let nothing = self.frames.map(|_| EMPTY);
        if let Some((low, high)) = Extent::of(groom).with(&widths).or(nothing) {
            let corners = [narrow_point(low), narrow_point(high)].concat();
            self.set(("extent", "float3[]", None, 1), Type::Vec3f, 2, corners)?;
        }
        let constant;
        let (values, rows) = match widths {
            Widths::Constant(width) => {
                constant = [width];
                (constant.as_slice(), Rows::Constant)
            }
            Widths::Uniform(values) => (values, Rows::Uniform),
            Widths::Vertex(values) => (values, Rows::Vertex),
        };
        let bytes = packed(values, narrow);
        self.set(("widths", "float[]", Some(rows), 1), Type::Float, values.len(), bytes)
    }

    fn primvar(&mut self, primvar: &Primvar<'_>) -> Result<(), EncodeError> {
        let (type_name, kind, components) = types(primvar.kind);
        let (numbers, bytes) = match (primvar.column, kind) {
            (Column::Float { values, .. }, _) => (values.len(), packed(values, narrow)),
            (Column::Int(values), Type::Int64) => (values.len(), packed(values, i64::to_le_bytes)),
            (Column::Int(values), _) => {
                let short = |i| i32::try_from(i).unwrap_or(i32::MAX).to_le_bytes();
                (values.len(), packed(values, short))
            }
        };
        let name = format!("primvars:{}", primvar.name);
        let what = (name.as_str(), type_name, Some(primvar.rows), primvar.size);
        self.set(what, kind, numbers / components, bytes)
    }

    /// Writes an attribute's next value.
    fn set(
        &mut self,
        (name, type_name, rows, size): (&str, &'static str, Option<Rows>, usize),
        kind: Type,
        count: usize,
        bytes: Vec<u8>,
    ) -> Result<(), EncodeError> {
        let known = self.attributes.iter().position(|attribute| attribute.name == name);
        let index = match known {
            Some(index) => index,
            None if self.written == 0 => {
                let (name, reps, last) = (name.to_owned(), Vec::new(), Vec::new());
                self.attributes.push(Attribute { name, type_name, rows, size, reps, last });
                self.attributes.len() - 1
            }
            None => return Err(changed(name)),
        };
        let attribute = &mut self.attributes[index];
        if (attribute.type_name, attribute.rows, attribute.size) != (type_name, rows, size) {
            return Err(changed(name));
        }
        let rep = match attribute.reps.last() {
            Some(&before) if attribute.last == bytes => before,
            _ => self.file.array(kind, count, &bytes)?,
        };
        attribute.reps.push(rep);
        attribute.last = bytes;
        Ok(())
    }

    /// Writes the structure of the layer.
    pub(crate) fn finish(mut self) -> Result<W, EncodeError> {
        self.root()?;
        let group = [
            ("specifier", DEF),
            ("typeName", self.file.token("Xform")),
            ("primChildren", self.file.token_vector(&["strands".into()])?),
        ];
        self.file.spec(Kind::Prim, "groom", &group);

        let tokens: &[(&str, &str)] = match self.curves {
            UsdCurves::Linear => &[("type", "linear")],
            UsdCurves::CatmullRom => {
                &[("type", "cubic"), ("basis", "catmullRom"), ("wrap", "pinned")]
            }
        };
        let own = tokens.iter().map(|(name, _)| (*name).to_owned());
        let names = self.attributes.iter().map(|attribute| attribute.name.clone());
        let names: Vec<String> = own.chain(names).collect();
        let prim = [
            ("specifier", DEF),
            ("typeName", self.file.token("BasisCurves")),
            ("properties", self.file.token_vector(&names)?),
        ];
        self.file.spec(Kind::Prim, "strands", &prim);
        for (name, value) in tokens {
            let fields = [
                ("typeName", self.file.token("token")),
                ("variability", Rep::inlined(Type::Variability, 1)),
                ("default", self.file.token(value)),
            ];
            self.file.spec(Kind::Attribute, name, &fields);
        }
        for attribute in std::mem::take(&mut self.attributes) {
            self.attribute(&attribute)?;
        }
        Ok(self.file.finish()?)
    }

    /// What the layer says of itself.
    fn root(&mut self) -> Result<(), EncodeError> {
        let mut fields = vec![
            ("defaultPrim", self.file.token("groom")),
            ("primChildren", self.file.token_vector(&["groom".into()])?),
        ];
        if let Some(metres) = self.unit {
            fields.push(("metersPerUnit", self.file.double(metres)?));
        }
        if let Some(up) = self.up {
            let axis = if up == UpAxis::Y { "Y" } else { "Z" };
            fields.push(("upAxis", self.file.token(axis)));
        }
        if let Some(frames) = self.frames {
            let last = frames.start + self.written.saturating_sub(1) as f64;
            fields.push(("startTimeCode", self.file.double(frames.start)?));
            fields.push(("endTimeCode", self.file.double(last)?));
            fields.push(("timeCodesPerSecond", self.file.double(frames.rate)?));
            fields.push(("framesPerSecond", self.file.double(frames.rate)?));
        }
        self.file.spec(Kind::Root, "", &fields);
        Ok(())
    }

    fn attribute(&mut self, attribute: &Attribute) -> Result<(), EncodeError> {
        let mut fields = vec![("typeName", self.file.token(attribute.type_name))];
        if let Some(rows) = attribute.rows {
            fields.push(("interpolation", self.file.token(rows.name())));
        }
        if attribute.size != 1 {
            let size = u32::try_from(attribute.size).unwrap_or(u32::MAX);
            fields.push(("elementSize", Rep::inlined(Type::Int, size)));
        }
        match (self.frames, attribute.reps.as_slice()) {
            (_, []) => {}
            (Some(frames), reps) if reps.iter().any(|rep| *rep != reps[0]) => {
                let times = (0..reps.len()).map(|i| frames.start + i as f64);
                let samples: Vec<_> = times.zip(reps.iter().copied()).collect();
                fields.push(("timeSamples", self.file.time_samples(&samples)?));
            }
            (_, reps) => fields.push(("default", reps[0])),
        }
        self.file.spec(Kind::Attribute, &attribute.name, &fields);
        Ok(())
    }
}

fn changed(name: &str) -> EncodeError {
    EncodeError::Groom(format!("attribute {name:?} is not on all frames, or of another kind"))
}

/// The name of an array type, the type of its items, and how many numbers an item has.
fn types(kind: primvars::Kind) -> (&'static str, Type, usize) {
    match kind {
        primvars::Kind::Int => ("int[]", Type::Int, 1),
        primvars::Kind::Int64 => ("int64[]", Type::Int64, 1),
        primvars::Kind::Float => ("float[]", Type::Float, 1),
        primvars::Kind::Float2 => ("float2[]", Type::Vec2f, 2),
        primvars::Kind::Float3 => ("float3[]", Type::Vec3f, 3),
        primvars::Kind::Float4 => ("float4[]", Type::Vec4f, 4),
        primvars::Kind::TexCoord2 => ("texCoord2f[]", Type::Vec2f, 2),
        primvars::Kind::Color3 => ("color3f[]", Type::Vec3f, 3),
    }
}
