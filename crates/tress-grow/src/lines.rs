//! What is known of all guides before hairs grow: their centerlines and turns.

use glam::{DVec3, Vec3Swizzles};
use rayon::prelude::*;
use tress_fit::{centerline, centerline_of_turns};
use tress_geometry::{Frame, Strands};

/// The centerlines of guides, point for point, and what starts their frames.
#[derive(Clone, Debug)]
pub(crate) struct Lines {
    pub(crate) points: Strands<DVec3>,
    pub(crate) rests: Vec<Rest>,
}

/// What a guide keeps through an animation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rest {
    /// Turns of its coil, 0 if it has none.
    pub(crate) turns: f64,
    /// Root mean square distance from its centerline.
    pub(crate) radius: f64,
    /// Whether it is a strand at all.
    pub(crate) sound: bool,
    /// The first frames of the centerline and of the guide: all others are carried on from them.
    pub(crate) line: Frame,
    pub(crate) strand: Frame,
}

impl Lines {
    /// Finds centerlines, turns and first frames.
    pub(crate) fn new(guides: &Strands<DVec3>) -> Self {
        let of = |points: &[DVec3]| {
            let Ok(line) = centerline(points) else { return (points.to_vec(), Rest::NONE) };
            let across =
                line.offsets(points).into_iter().map(|offset| offset.yz().length_squared());
            let radius = (across.sum::<f64>() / points.len() as f64).sqrt();
            let strand = Frame::along(points[0], first_tangent(points)).unwrap_or(line.frames()[0]);
            let (turns, first) = (line.turns(), line.frames()[0]);
            let rest = Rest { turns, radius, sound: true, line: first, strand };
            (line.points().collect(), rest)
        };
        Self::gather(guides, of)
    }

    /// The same guides elsewhere: turns are as they were, first frames are carried over.
    pub(crate) fn moved(&self, guides: &Strands<DVec3>) -> Self {
        let rests = &self.rests;
        let all: Vec<_> = (0..guides.len())
            .into_par_iter()
            .map(|i| {
                let (points, rest) = (guides.strand(i), rests[i]);
                match centerline_of_turns(points, rest.turns) {
                    Ok(line) if rest.sound => {
                        let points_of_line: Vec<DVec3> = line.points().collect();
                        let line = rest.line.turned_to(line.frames()[0].tangent());
                        let t = first_tangent(points).try_normalize();
                        let strand = rest.strand.turned_to(t.unwrap_or(rest.strand.tangent()));
                        (points_of_line, Rest { line, strand, ..rest })
                    }
                    _ => (points.to_vec(), Rest { sound: false, ..rest }),
                }
            })
            .collect();
        Self::joined(guides, all)
    }

    fn gather(guides: &Strands<DVec3>, of: impl Fn(&[DVec3]) -> (Vec<DVec3>, Rest) + Sync) -> Self {
        let all = (0..guides.len()).into_par_iter().map(|i| of(guides.strand(i))).collect();
        Self::joined(guides, all)
    }

    fn joined(guides: &Strands<DVec3>, all: Vec<(Vec<DVec3>, Rest)>) -> Self {
        let mut points = guides.clone();
        let mut rests = Vec::with_capacity(all.len());
        for (place, (line, rest)) in points.iter_mut().zip(all) {
            place.copy_from_slice(&line);
            rests.push(rest);
        }
        Self { points, rests }
    }
}

impl Rest {
    const NONE: Self = Self {
        turns: 0.0,
        radius: 0.0,
        sound: false,
        line: Frame::IDENTITY,
        strand: Frame::IDENTITY,
    };
}

/// The direction in which the parabola through its first three points leaves the root.
fn first_tangent(points: &[DVec3]) -> DVec3 {
    match points {
        [a, b, c, ..] => 4.0 * b - 3.0 * a - c,
        [a, b] => b - a,
        _ => DVec3::ZERO,
    }
}
