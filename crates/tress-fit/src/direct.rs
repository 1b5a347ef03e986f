//! The unrefined fit: joints on the smooth curve through the points, one G1 helix arc between
//! neighbours.
//!
//! The chain is built from where it really is: each arc starts at the end and with the tangent of
//! the arc before it and aims at the next joint, with the joint's tangent turned onto the cone
//! that makes it co-helical. Where joints are co-helical already (floating points) that turning
//! is rounding; where no arc exists, what is missed is caught up with by the next one.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::PI;

use glam::DVec3;
use tress_geometry::polyline::place;
use tress_geometry::{Element, Frame};

use crate::{Floating, HelixArc, Spline, StrandFit, float_points, float_tangent};

/// The chain through one joint a point of the curve.
pub(crate) fn per_segment(spline: &Spline, floating: Floating) -> StrandFit {
    let (root, elements) = Joints::at_points(spline).chain(floating);
    let arc_lengths = joint_arc_lengths(&elements);
    StrandFit { root, elements, arc_lengths }
}

/// `n` elements, at least as many as segments, through every point: tangents float, and arcs are
/// cut where there are more elements than segments.
pub(crate) fn through_points(spline: &Spline, n: usize) -> StrandFit {
    let fit = per_segment(spline, Floating::Tangents);
    let elements = cut(&fit.elements, &parts(spline, n));
    StrandFit { elements, ..fit }
}

/// Arc lengths of `n + 1` joints: one at each of the curve's points, of which there are no more,
/// and the rest between them where segments are long and turn.
pub(crate) fn at_points_and_between(spline: &Spline, n: usize) -> Vec<f64> {
    let mut joints = Vec::with_capacity(n + 1);
    let arc_lengths = spline.arc_lengths();
    for (ends, parts) in arc_lengths.windows(2).zip(parts(spline, n)) {
        let along = |i: usize| ends[0] + (ends[1] - ends[0]) * (i as f64 / parts as f64);
        joints.extend((0..parts).map(along));
    }
    joints.extend(arc_lengths.last());
    joints
}

/// Into how many parts each segment is cut so that there are `n`. A segment's share is its length
/// times 1 and its turning; the greatest share of a part is as small as can be.
fn parts(spline: &Spline, n: usize) -> Vec<usize> {
    let tangents: Vec<DVec3> = spline.tangents().collect();
    let turning = tangents.windows(2).map(|t| t[0].distance(t[1]));
    let lengths = spline.arc_lengths().windows(2).map(|ends| ends[1] - ends[0]);
    let shares: Vec<f64> = lengths.zip(turning).map(|(l, turn)| l * (1.0 + turn)).collect();
    let mut parts = vec![1; shares.len()];
    // The bits of numbers that are not negative are in the order of the numbers.
    let of = |i: usize, parts: usize| ((shares[i] / parts as f64).to_bits(), Reverse(i));
    let mut greatest: BinaryHeap<_> = (0..shares.len()).map(|i| of(i, 1)).collect();
    for _ in shares.len()..n {
        let Some((_, Reverse(i))) = greatest.pop() else { break };
        parts[i] += 1;
        greatest.push(of(i, parts[i]));
    }
    parts
}

/// The same arcs, each in so many pieces of one length.
fn cut(arcs: &[Element], parts: &[usize]) -> Vec<Element> {
    let piece = |arc: &Element, parts: usize| Element { length: arc.length / parts as f64, ..*arc };
    let pieces = arcs.iter().zip(parts).flat_map(|(arc, &n)| (0..n).map(move |_| piece(arc, n)));
    pieces.collect()
}

/// How many arcs an element needs if `n` of them share the curve.
fn arcs_per_element(spline: &Spline, n: usize) -> f64 {
    let arcs = spline.turning() / (n as f64 * GREATEST_TURN);
    arcs.ceil().clamp(1.0, MOST_PARTS)
}

/// Whether each of `n` elements along the curve can be laid as one arc.
pub(crate) fn is_enough(spline: &Spline, n: usize) -> bool {
    arcs_per_element(spline, n) <= 1.0
}

/// `n` elements along the curve, of equal length as far as the curve goes.
pub(crate) fn evenly(spline: &Spline, n: usize, floating: Floating) -> StrandFit {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to MOST_PARTS")]
    let split = arcs_per_element(spline, n) as usize;
    let joints = Joints::evenly(spline, n * split);
    let on_curve = joints.arc_lengths.clone();
    let (root, arcs) = joints.chain(floating);
    let on_chain = joint_arc_lengths(&arcs);
    let corresponding = |&s: &f64| {
        let (i, beyond) = place(&on_curve, s);
        let next = on_chain.get(i + 1).copied().unwrap_or(on_chain[i]);
        on_chain[i] + (next - on_chain[i]) * beyond
    };
    let arc_lengths = spline.arc_lengths().iter().map(corresponding).collect();
    StrandFit { root, elements: arcs.chunks(split).map(mean).collect(), arc_lengths }
}

/// Arc lengths where elements begin, and the whole length.
fn joint_arc_lengths(elements: &[Element]) -> Vec<f64> {
    let mut s = 0.0;
    let ends = elements.iter().map(|element| {
        s += element.length;
        s
    });
    std::iter::once(0.0).chain(ends).collect()
}

/// Joints for arcs: positions, unit tangents and arc lengths on the curve they were taken from.
struct Joints {
    points: Vec<DVec3>,
    tangents: Vec<DVec3>,
    arc_lengths: Vec<f64>,
}

/// An arc may turn this far before it is split for the fit: the short way round is then surely
/// the right one.
const GREATEST_TURN: f64 = 0.9 * PI;

/// One element stands for no more arcs than this: about 19 turns.
const MOST_PARTS: f64 = 64.0;

impl Joints {
    /// One at each point of the curve.
    fn at_points(spline: &Spline) -> Self {
        Self {
            points: spline.points().to_vec(),
            tangents: spline.tangents().collect(),
            arc_lengths: spline.arc_lengths().to_vec(),
        }
    }

    /// `n + 1` evenly along the curve.
    fn evenly(spline: &Spline, n: usize) -> Self {
        let along = |i: usize| spline.length() * (i as f64 / n as f64);
        let arc_lengths: Vec<f64> = (0..=n).map(along).collect();
        let (points, tangents) = arc_lengths.iter().map(|&s| spline.at(s)).unzip();
        Self { points, tangents, arc_lengths }
    }

    /// The chain of arcs from joint to joint.
    fn chain(mut self, floating: Floating) -> (Frame, Vec<Element>) {
        if floating == Floating::Points {
            float_points(&mut self.points, &self.tangents);
        }
        let first = self.tangents.first().copied().unwrap_or(DVec3::X);
        let start = self.points.first().copied().unwrap_or(DVec3::ZERO);
        let root = Frame::along(start, first).unwrap_or(Frame::IDENTITY);
        let mut frame = root;
        let mut elements = Vec::with_capacity(self.points.len());
        for (point, tangent) in self.points.iter().zip(&self.tangents).skip(1) {
            let element = element_towards(&frame, *point - frame.position, *tangent);
            frame = element.advance(&frame);
            elements.push(element);
        }
        (root, elements)
    }
}

/// One element in the place of several: their mean curvature over their whole length.
fn mean(arcs: &[Element]) -> Element {
    let length: f64 = arcs.iter().map(|arc| arc.length).sum();
    let turning: DVec3 = arcs.iter().map(|arc| arc.curvature * arc.length).sum();
    let curvature = if 0.0 < length { turning / length } else { DVec3::ZERO };
    Element { curvature, length }
}

/// The arc from a frame along `chord`, ending along `wanted` as nearly as can be.
fn element_towards(frame: &Frame, chord: DVec3, wanted: DVec3) -> Element {
    let t0 = frame.tangent();
    let t1 = float_tangent(t0, chord, wanted);
    let arc = HelixArc::joining(chord, t0, t1)
        .filter(|arc| arc.length <= LONGEST * chord.length())
        .or_else(|| circle(chord, t0))
        .unwrap_or(HelixArc { darboux: DVec3::ZERO, length: 0.0 });
    Element { curvature: frame.axes.transpose() * arc.darboux, length: arc.length }
}

/// An arc longer than so many chords winds where the strand does not.
const LONGEST: f64 = 8.0;

/// The planar arc along `chord` that starts along `t0`; half a turn in the place of one that would
/// have to go back on itself.
pub(crate) fn circle(chord: DVec3, t0: DVec3) -> Option<HelixArc> {
    let reach = chord.length();
    let ahead = chord.try_normalize()?;
    let (sine, cosine) = (t0.cross(ahead), t0.dot(ahead));
    let angle = f64::atan2(sine.length(), cosine);
    let Some(axis) = sine.try_normalize() else {
        let straight = HelixArc { darboux: DVec3::ZERO, length: reach };
        let back = HelixArc { darboux: t0.any_orthonormal_vector() * (PI / reach), length: reach };
        return Some(if 0.0 < cosine { straight } else { back });
    };
    if 0.9 * PI < angle {
        return Some(HelixArc { darboux: axis * (PI / reach), length: reach });
    }
    let length = reach * angle / sine.length();
    Some(HelixArc { darboux: axis * (2.0 * angle / length), length })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TangentRule;

    fn coil() -> Spline {
        let at = |a: f64| DVec3::new(a.cos(), a.sin(), 0.1 * a * (1.0 + 0.03 * a));
        let points: Vec<DVec3> = (0..20).map(|i| at(0.9 * f64::from(i))).collect();
        Spline::through(&points, TangentRule::Helix)
    }

    #[test]
    fn a_circle_ends_where_its_chord_does() {
        let root = Frame::IDENTITY;
        let chord =
            |angle: f64| 1.5 * DVec3::new(angle.cos(), 0.6 * angle.sin(), 0.8 * angle.sin());
        for angle in [0.0, 1e-9, 0.3, 1.6, 2.8_f64] {
            let arc = circle(chord(angle), root.tangent()).expect("a chord");
            let tip = Element { curvature: arc.darboux, length: arc.length }.advance(&root);
            assert!(tip.position.distance(chord(angle)) < 1e-14, "{angle}: {}", tip.position);
            assert!((arc.turning() - 2.0 * angle).abs() < 1e-14, "{angle}");
        }
        for angle in [2.9, PI] {
            let arc = circle(chord(angle), root.tangent()).expect("a chord");
            assert!((arc.length - 1.5).abs() < 1e-15);
            assert!((arc.turning() - PI).abs() < 1e-14, "half a turn in the place of {angle}");
        }
        assert_eq!(circle(DVec3::ZERO, root.tangent()), None);
    }

    #[test]
    fn joints_are_at_all_points_and_as_many_as_asked_for() {
        let spline = coil();
        for n in [19, 20, 37, 38, 500] {
            let joints = at_points_and_between(&spline, n);
            assert_eq!(joints.len(), n + 1);
            assert!(joints.windows(2).all(|s| s[0] < s[1]));
            assert!(spline.arc_lengths().iter().all(|s| joints.contains(s)));
        }
    }

    #[test]
    fn arcs_that_are_cut_still_pass_through_every_point() {
        let spline = coil();
        for n in [19, 33, 90] {
            let fit = through_points(&spline, n);
            assert_eq!(fit.elements.len(), n);
            let frames = fit.super_helix();
            for (frame, p) in frames.frames_at(fit.arc_lengths.clone()).zip(spline.points()) {
                assert!(frame.position.distance(*p) < 1e-12);
            }
        }
    }
}
