//! A groom as one curves object, in one sample or in many.

use std::io::{Seek, Write};

use glam::DVec3;
use rayon::prelude::*;
use tress_alembic::{Archive, CurvesSample, Error, Kind, Numbers, Object, Scope, Values};
use tress_geometry::{Column, Groom, UpAxis, names};

use super::parameters::Parameters;
use crate::binary::narrow_all;
use crate::widths::Widths;
use crate::{EncodeError, Frames};

/// Names that say what an archive's numbers mean, of our own: Alembic has none.
pub(super) const UNIT: &str = "metersPerUnit";
/// The axis that is up.
pub(super) const UP: &str = "upAxis";

/// What attributes are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Names {
    /// As the columns are.
    Own,
    /// As Unreal's groom schema has them.
    Unreal,
}

/// An archive that grooms are written to, a sample each.
pub(crate) struct Writer<W> {
    archive: Archive<W>,
    curves: Object,
    names: Names,
}

impl<W: Write + Seek> Writer<W> {
    /// Begins an archive for samples like `first`.
    pub(crate) fn new(
        out: W,
        first: &Groom,
        frames: Frames,
        names: Names,
    ) -> Result<Self, EncodeError> {
        let application = concat!("tress ", env!("CARGO_PKG_VERSION"));
        let mut archive = Archive::new(out, application)?;
        let time = archive.add_time(frames.start / frames.rate, 1.0 / frames.rate);
        let top = archive.add_transform(archive.top(), "groom", None)?;
        let curves = archive.add_curves(top, "strands", Kind::Linear, time)?;
        let mut say = |name: &str, numbers: Numbers<'_>| {
            archive.set_user_property(top, name, Values::scalars(numbers))
        };
        if let Some(metres) = first.unit {
            say(UNIT, Numbers::F64(&[metres]))?;
        }
        if first.up.is_some() {
            say(UP, Numbers::Text(&["Y"]))?;
        }
        if names == Names::Unreal {
            say("groom_version_major", Numbers::I16(&[1]))?;
            say("groom_version_minor", Numbers::I16(&[5]))?;
            say("groom_tool", Numbers::Text(&[application]))?;
        }
        Ok(Self { archive, curves, names })
    }

    /// Writes a sample.
    pub(crate) fn push(&mut self, groom: &Groom) -> Result<(), EncodeError> {
        let counts = groom.strands().counts().map(crate::counts::signed_count);
        let counts = counts.collect::<Result<Vec<i32>, _>>()?;
        let points = points(groom);
        let (scope, widths) = widths(groom, self.names);
        let uvs = uvs(groom).filter(|_| self.names == Names::Own);
        let parameters = match self.names {
            Names::Own => Parameters::own(groom)?,
            Names::Unreal => Parameters::unreal(groom)?,
        };
        let texts = parameters.texts();
        let sample = CurvesSample {
            points: &points,
            counts: &counts,
            widths: Some((scope, &widths)),
            uvs: uvs.as_ref().map(|(scope, uvs)| (*scope, uvs.as_slice())),
            parameters: &parameters.borrow(&texts),
        };
        Ok(self.archive.write_curves(self.curves, &sample)?)
    }

    /// Ends the archive.
    pub(crate) fn finish(self) -> Result<W, EncodeError> {
        Ok(self.archive.finish()?)
    }
}

impl From<Error> for EncodeError {
    fn from(error: Error) -> Self {
        match error {
            Error::Io(error) => Self::Io(error),
            other => Self::Groom(other.to_string()),
        }
    }
}

/// The points as readers of archives take them: with Y up, where it is known what is.
#[expect(clippy::cast_possible_truncation, reason = "Alembic's points have 32 bits")]
fn points(groom: &Groom) -> Vec<[f32; 3]> {
    let turn: fn(DVec3) -> [f32; 3] = match groom.up {
        Some(UpAxis::Z) => |p| [p.x as f32, p.z as f32, -p.y as f32],
        _ => |p| [p.x as f32, p.y as f32, p.z as f32],
    };
    groom.strands().points().par_iter().map(|&point| turn(point)).collect()
}

#[expect(clippy::cast_possible_truncation, reason = "Alembic's widths have 32 bits")]
fn widths(groom: &Groom, names: Names) -> (Scope, Vec<f32>) {
    match Widths::of(groom) {
        // Not constant: Blender passes over widths that are.
        Widths::Constant(width) => (Scope::Uniform, vec![width as f32; groom.strands().len()]),
        Widths::Vertex(values) => (Scope::Vertex, narrow_all(values)),
        // Unreal's own documents call widths by strand untested.
        Widths::Uniform(values) if names == Names::Unreal => {
            let every_point = crate::columns::every_point(groom);
            (Scope::Vertex, every_point.map(|(strand, _)| values[strand] as f32).collect())
        }
        Widths::Uniform(values) => (Scope::Uniform, narrow_all(values)),
    }
}

/// Texture coordinates, which have a place of their own.
#[expect(clippy::cast_possible_truncation, reason = "Alembic's coordinates have 32 bits")]
fn uvs(groom: &Groom) -> Option<(Scope, Vec<[f32; 2]>)> {
    let tables =
        [(Scope::Vertex, groom.point_attributes()), (Scope::Uniform, groom.strand_attributes())];
    tables.into_iter().find_map(|(scope, table)| match table.get(names::ROOT_UV)? {
        Column::Float { components: 2, values } => {
            let pairs = values.chunks_exact(2).map(|uv| [uv[0] as f32, uv[1] as f32]);
            Some((scope, pairs.collect()))
        }
        _ => None,
    })
}
