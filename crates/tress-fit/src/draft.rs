//! The start of a refinement: joints on the smooth curve through the points, and between them
//! elements that are right by themselves but need not meet the joints.

use std::f64::consts::PI;

use glam::DVec3;
use tress_geometry::polyline::place;
use tress_geometry::{Element, Frame, SuperHelix};

use crate::direct::circle;
use crate::measure::greatest_distance;
use crate::{HelixArc, Spline, StrandFit, float_tangent};

/// A chain whose joints need not be the ends of its elements.
#[derive(Clone, Debug, Default)]
pub(crate) struct Draft {
    /// Frames at the joints: one more than elements.
    pub(crate) joints: Vec<Frame>,
    pub(crate) elements: Vec<Element>,
    /// Where each point is nearest: an element, and the arc length on it. Ascending.
    pub(crate) places: Vec<(usize, f64)>,
}

/// The curve is followed by arcs that turn no more than this.
const GREATEST_TURN: f64 = 0.5 * PI;

/// An element is drafted from at most so many arcs, or as many as it has segments.
const MOST_ARCS: f64 = 256.0;

impl Draft {
    /// Elements between the joints at these arc lengths of the curve, from 0 to its length.
    pub(crate) fn on(spline: &Spline, joints: &[f64]) -> Self {
        let n = joints.len() - 1;
        let turn = spline.turning() / (n as f64 * GREATEST_TURN);
        let segments = (spline.points().len() - 1) / n;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
        let arcs = segments.max(turn.ceil().clamp(1.0, MOST_ARCS) as usize);
        let (start, tangent) = spline.at(0.0);
        let mut draft = Self::default();
        let mut frame = Frame::along(start, tangent).unwrap_or(Frame::IDENTITY);
        draft.joints.push(frame);
        for ends in joints.windows(2) {
            let (element, (point, tangent)) = element_along(spline, ends[0], ends[1], arcs, &frame);
            frame = element.advance(&frame).turned_to(tangent);
            frame.position = point;
            draft.joints.push(frame);
            draft.elements.push(element);
        }
        let corresponding = |&s: &f64| {
            let (i, beyond) = place(joints, s);
            if i < n { (i, beyond * draft.elements[i].length) } else { (n - 1, f64::INFINITY) }
        };
        draft.places = spline.arc_lengths().iter().map(corresponding).collect();
        draft
    }

    /// Other elements along this draft, which begin at `joints`, arc lengths of it from 0 to its
    /// length.
    pub(crate) fn redrawn(&self, joints: &[f64]) -> Self {
        let n = joints.len() - 1;
        let mut drawn = Self { joints: vec![self.joints[0]], ..Self::default() };
        let mut walk = Walk { draft: self, index: 0, begun: 0.0 };
        let mut frame = self.joints[0];
        for ends in joints.windows(2) {
            let element = walk.mean(ends[1] - ends[0], &frame);
            let there = walk.frame();
            // The frame behind the element, moved to where this draft is.
            let behind = element.advance(&frame).turned_to(there.tangent());
            frame = Frame { position: there.position, ..behind };
            drawn.joints.push(frame);
            drawn.elements.push(element);
        }
        let corresponding = |s: f64| {
            let (i, beyond) = place(joints, s);
            if i < n { (i, beyond * drawn.elements[i].length) } else { (n - 1, f64::INFINITY) }
        };
        drawn.places = self.arc_lengths().into_iter().map(corresponding).collect();
        drawn
    }

    /// One element along this draft, which has a joint at each point, from one point to another.
    pub(crate) fn piece(&self, begin: usize, end: usize) -> Self {
        let elements = &self.elements[begin..end];
        let length = elements.iter().map(|element| element.length).sum();
        let start = self.joints[begin];
        let element = Walk { draft: self, index: begin, begun: 0.0 }.mean(length, &start);
        let mut s = 0.0;
        let behind = elements.iter().map(|element| {
            s += element.length;
            (0, s)
        });
        let places = std::iter::once((0, 0.0)).chain(behind).collect();
        Self { joints: vec![start, self.joints[end]], elements: vec![element], places }
    }

    /// The whole length.
    pub(crate) fn length(&self) -> f64 {
        self.elements.iter().map(|element| element.length).sum()
    }

    /// The greatest distance of a point from the chain, which is a true one.
    pub(crate) fn greatest_distance(&self, points: &[DVec3]) -> f64 {
        let strand = SuperHelix { root: self.joints[0], elements: &self.elements };
        greatest_distance(&strand, points, &self.arc_lengths())
    }

    /// The chain, without its joints.
    pub(crate) fn into_fit(self) -> StrandFit {
        let arc_lengths = self.arc_lengths();
        StrandFit { root: self.joints[0], elements: self.elements, arc_lengths }
    }

    /// The arc length of each point.
    pub(crate) fn arc_lengths(&self) -> Vec<f64> {
        let mut begins = 0.0;
        let mut under_way = 0;
        let along = |&(i, s): &(usize, f64)| {
            while under_way < i {
                begins += self.elements[under_way].length;
                under_way += 1;
            }
            begins + s.min(self.elements[i].length)
        };
        self.places.iter().map(along).collect()
    }
}

/// The mean of `arcs` arcs along the curve, in the axes of `frame`, and the curve's end there.
fn element_along(
    spline: &Spline,
    from: f64,
    to: f64,
    arcs: usize,
    frame: &Frame,
) -> (Element, (DVec3, DVec3)) {
    let mut begin = spline.at(from);
    let (mut turning, mut length) = (DVec3::ZERO, 0.0);
    for i in 1..=arcs {
        let end = spline.at(from + (to - from) * (i as f64 / arcs as f64));
        let arc = arc_between(begin, end);
        turning += arc.darboux * arc.length;
        length += arc.length;
        begin = end;
    }
    let darboux = if 0.0 < length { turning / length } else { DVec3::ZERO };
    (Element { curvature: frame.axes.transpose() * darboux, length }, begin)
}

/// The helix arc if it winds no more than the tangents say, else the plane one.
fn arc_between((p0, t0): (DVec3, DVec3), (p1, t1): (DVec3, DVec3)) -> HelixArc {
    let chord = p1 - p0;
    let angle = t0.angle_between(t1);
    HelixArc::joining(chord, t0, float_tangent(t0, chord, t1))
        .filter(|arc| arc.turning() < f64::min(PI, 3.0 * angle))
        .or_else(|| circle(chord, t0))
        .unwrap_or(HelixArc { darboux: DVec3::ZERO, length: chord.length() })
}

/// A walk along a draft's elements, by their lengths.
struct Walk<'a> {
    draft: &'a Draft,
    index: usize,
    /// How far along the element under way.
    begun: f64,
}

impl Walk<'_> {
    /// Goes on by `length`; an element with the mean Darboux vector on the way, in the axes of
    /// `frame`.
    fn mean(&mut self, length: f64, frame: &Frame) -> Element {
        let Draft { joints, elements, .. } = self.draft;
        let mut ahead = length;
        let mut turning = DVec3::ZERO;
        loop {
            let element = &elements[self.index];
            let world = joints[self.index].axes * element.curvature;
            let left = element.length - self.begun;
            if ahead <= left || self.index + 1 == elements.len() {
                turning += world * ahead;
                self.begun += ahead;
                break;
            }
            turning += world * left;
            ahead -= left;
            self.index += 1;
            self.begun = 0.0;
        }
        let darboux = if 0.0 < length { turning / length } else { DVec3::ZERO };
        Element { curvature: frame.axes.transpose() * darboux, length }
    }

    /// The frame where the walk is.
    fn frame(&self) -> Frame {
        self.draft.elements[self.index].frame_at(&self.draft.joints[self.index], self.begun)
    }
}
