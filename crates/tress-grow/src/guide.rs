//! A guide as its hairs see it.

use glam::DVec3;
use tress_fit::rotation_minimizing_frames_from;
use tress_geometry::{Frame, polyline};

use crate::GrowOptions;
use crate::curve::smoothstep;
use crate::lines::Rest;

/// A guide, frames along its centerline and along itself, and what its hairs add to it.
pub(crate) struct Guide<'a> {
    pub(crate) points: &'a [DVec3],
    /// Frames along the centerline, which do not turn about it.
    pub(crate) line: Vec<Frame>,
    /// Arc length along the centerline.
    pub(crate) arc_lengths: Vec<f64>,
    /// `u` and `v` of the guide's own frames, [CC 3.1.2].
    pub(crate) across: Vec<[DVec3; 2]>,
    /// How much of a hair's own place has given way to its place in the wisp, 0 to 1.
    pub(crate) ease: Vec<f64>,
    /// `w(t)`, as a length.
    pub(crate) wisp: Vec<f64>,
    pub(crate) rest: Rest,
}

impl<'a> Guide<'a> {
    pub(crate) fn new(
        points: &'a [DVec3],
        line: &[DVec3],
        rest: Rest,
        options: &GrowOptions,
    ) -> Self {
        let line = rotation_minimizing_frames_from(line, &rest.line);
        let across = rotation_minimizing_frames_from(points, &rest.strand);
        let mut arc_lengths = Vec::with_capacity(points.len());
        let mut s = 0.0;
        arc_lengths.extend(line.iter().enumerate().map(|(i, frame)| {
            s += i.checked_sub(1).map_or(0.0, |b| line[b].position.distance(frame.position));
            s
        }));
        let n = (points.len() - 1).max(1) as f64;
        let per_turn = points_per_turn(points.len(), rest.turns);
        let merged = merging(rest.turns, options);
        let ease = |i| merged * smoothstep(i as f64 / per_turn);
        let wisp = |i| rest.radius * options.wisp.at(i as f64 / n);
        Self {
            points,
            arc_lengths,
            across: across.iter().map(|f| [f.axes.y_axis, f.axes.z_axis]).collect(),
            ease: (0..points.len()).map(ease).collect(),
            wisp: (0..points.len()).map(wisp).collect(),
            line,
            rest,
        }
    }

    /// How far from the guide's point `i` a hair is: its own root's way from the guide's gives way
    /// to `w(t) (alpha u + beta v)`, [CC 2].
    pub(crate) fn displacement(&self, i: usize, root: DVec3, place: [f64; 2]) -> DVec3 {
        let ease = self.ease[i];
        let [u, v] = self.across[i];
        let in_wisp = self.wisp[i] * (place[0] * u + place[1] * v);
        (1.0 - ease) * (root - self.points[0]) + ease * in_wisp
    }

    /// The part of the displacement that the hair's centerline makes too.
    pub(crate) fn line_displacement(&self, i: usize, root: DVec3) -> DVec3 {
        (1.0 - self.ease[i]) * (root - self.points[0])
    }

    /// Where a hair's point at the guide's point `i` stands in the centerline's frame there.
    pub(crate) fn offset(&self, i: usize, place: [f64; 2]) -> DVec3 {
        let [u, v] = self.across[i];
        let in_wisp = self.ease[i] * self.wisp[i] * (place[0] * u + place[1] * v);
        let frame = &self.line[i];
        frame.axes.transpose() * (self.points[i] - frame.position + in_wisp)
    }

    pub(crate) fn points_per_turn(&self) -> f64 {
        points_per_turn(self.points.len(), self.rest.turns)
    }

    /// Arc length of the centerline in one turn.
    pub(crate) fn wavelength(&self) -> f64 {
        let length = self.arc_lengths.last().copied().unwrap_or(0.0);
        if self.rest.turns > 0.0 { length / self.rest.turns } else { length }
    }

    /// Mean arc length between points of the centerline up to point `i`.
    pub(crate) fn step(&self, i: usize) -> f64 {
        if i > 0 { self.arc_lengths[i] / i as f64 } else { 0.0 }
    }
}

/// How many points a turn takes: all of them where there is no turn.
fn points_per_turn(points: usize, turns: f64) -> f64 {
    let n = points.saturating_sub(1).max(1) as f64;
    if turns > 0.0 { (n / turns).max(1.0) } else { n }
}

/// 0 for guides too short to make wisps, 1 for those long enough, [CC 5.1.3].
pub(crate) fn merging(turns: f64, options: &GrowOptions) -> f64 {
    let (from, to) = options.fade;
    if turns <= 0.0 || turns < from {
        return 0.0;
    }
    if from < to { smoothstep((turns - from) / (to - from)) } else { 1.0 }
}

/// Whether points are a strand that can guide.
pub(crate) fn is_strand(points: &[DVec3]) -> bool {
    polyline::defect(points).is_none()
}
