//! The cut: curvatures of a strand with a switchback in it (see the module above for `F C A S`).

use glam::{DMat3, DQuat, DVec2, DVec3};
use tress_geometry::{Element, Frame, SuperHelix};

use super::shapes::Shape;
use crate::profile::{GAUSS, magnus};

/// The elements of `strand` with a switchback at arc length `place`, which has room.
///
/// `coil` is the strand's mean curvature there and `rest` the rest curvature of its rod.
pub(super) fn operate(
    strand: &SuperHelix<'_>,
    straightened: &[Element],
    place: f64,
    coil: DVec3,
    rest: f64,
    shape: &Shape,
) -> Vec<Element> {
    let half_width = shape.half_width / rest;
    let (begins, ends) = (place - half_width, place + half_width);
    let straight = SuperHelix { root: strand.root, elements: straightened };
    let body = Body::new(coil);
    let n = shape.steps.len();
    let h = 2.0 * half_width / n as f64;
    let at = |i: usize| if i == n { ends } else { begins + h * i as f64 };

    // Where the axis goes over the room, and the straightened strand with its switchback.
    let f = strand.frames_at((0..=n).map(at)).map(|frame| frame.axes);
    let c = straight.frames_at((0..=n).map(at)).map(|frame| frame.axes);
    let (f, c): (Vec<DMat3>, Vec<DMat3>) = (f.collect(), c.collect());
    let arcs = room(straightened, begins, place, h, coil, rest, shape, &body);
    let mut s = Vec::with_capacity(n + 1);
    s.push(c[0]);
    for arc in &arcs {
        let before = Frame { position: DVec3::ZERO, axes: s[s.len() - 1] };
        s.push(arc.advance(&before).axes);
    }

    // What is left between both axes behind the room is made up for over the room.
    let behind = curvature_at(straightened, ends);
    let axis = axis_of(c[n], behind);
    let turn = least_turn(axis_of(s[n], body.mirrored(behind)), axis);
    let made_up = |i: usize| {
        let x = i as f64 / n as f64;
        DMat3::from_quat(DQuat::from_scaled_axis(turn * (x * x * (3.0 - 2.0 * x))))
    };
    let frame = |i: usize| f[i] * c[i].transpose() * made_up(i) * s[i];

    let mut elements = up_to(strand.elements, begins);
    let mut before = frame(0);
    for (i, arc) in arcs.iter().enumerate() {
        let next = frame(i + 1);
        elements.push(between(&before, &next, arc.curvature, h));
        before = next;
    }
    let behind = Behind { f: f[n], c: c[n], s: s[n], turn: made_up(n), result: before };
    behind.mirror(strand.elements, straightened, ends, &body, &mut elements);
    elements
}

/// The arcs of the straightened strand over the room: the shape in the strand's body frame, and
/// towards the ends what the strand's own coil differs from the shape's.
#[expect(clippy::too_many_arguments, reason = "one call; the parts of one formula")]
fn room(
    straightened: &[Element],
    begins: f64,
    place: f64,
    h: f64,
    coil: DVec3,
    rest: f64,
    shape: &Shape,
    body: &Body,
) -> Vec<Element> {
    let half_width = place - begins;
    let hand = if coil.x < 0.0 { -1.0 } else { 1.0 };
    let ideal = body.turned(DVec3::new(hand, hand, 1.0) * shape.coil * rest);
    let curvature = |s: f64, kappa: DVec3| {
        let shaped = body.turned(DVec3::new(hand, hand, 1.0) * kappa * rest);
        let x = ((s - place) / half_width).abs().min(1.0);
        let own = (curvature_at(straightened, s) - ideal) * (x * x * (3.0 - 2.0 * x));
        shaped + if place < s { body.mirrored(own) } else { own }
    };
    let steps = shape.steps.iter().enumerate().map(|(i, &[a, b])| {
        let middle = begins + h * (i as f64 + 0.5);
        let a = curvature(middle - h * GAUSS, a);
        let b = curvature(middle + h * GAUSS, b);
        Element { curvature: magnus(a, b, h), length: h }
    });
    steps.collect()
}

/// How a strand's material frame stands about its tangent: where its coil bends.
struct Body {
    /// Unit vector of `(k1, k2)`.
    bend: DVec2,
}

impl Body {
    fn new(coil: DVec3) -> Self {
        Self { bend: DVec2::new(coil.y, coil.z).normalize_or(DVec2::Y) }
    }

    /// A curvature of a strand that bends about `v`, in the frame of this one.
    fn turned(&self, q: DVec3) -> DVec3 {
        let (cosine, sine) = (self.bend.y, -self.bend.x);
        DVec3::new(q.x, q.y * cosine - q.z * sine, q.y * sine + q.z * cosine)
    }

    /// The curvature of the strand in a mirror through its axis: twist changes sign, and so does
    /// the bending across that of the coil.
    fn mirrored(&self, q: DVec3) -> DVec3 {
        let bend = DVec2::new(q.y, q.z);
        let kept = self.bend * (2.0 * self.bend.dot(bend)) - bend;
        DVec3::new(-q.x, kept.x, kept.y)
    }
}

/// What is known where the room ends.
struct Behind {
    f: DMat3,
    c: DMat3,
    s: DMat3,
    turn: DMat3,
    result: DMat3,
}

impl Behind {
    /// The rest of the strand: its axis as it was, its coil mirrored.
    fn mirror(
        mut self,
        strand: &[Element],
        straightened: &[Element],
        from: f64,
        body: &Body,
        elements: &mut Vec<Element>,
    ) {
        let advance = |axes: DMat3, curvature: DVec3, length: f64| {
            axes * Element { curvature, length }.rotation(length)
        };
        let mut ends = 0.0;
        for (own, straight) in strand.iter().zip(straightened) {
            ends += own.length;
            let length = (ends - from).min(own.length);
            if length <= 0.0 {
                continue;
            }
            self.f = advance(self.f, own.curvature, length);
            self.c = advance(self.c, straight.curvature, length);
            self.s = advance(self.s, body.mirrored(straight.curvature), length);
            let next = self.f * self.c.transpose() * self.turn * self.s;
            elements.push(between(&self.result, &next, body.mirrored(own.curvature), length));
            self.result = next;
        }
    }
}

/// The elements up to an arc length; the last one is cut.
fn up_to(elements: &[Element], s: f64) -> Vec<Element> {
    let mut kept = Vec::with_capacity(elements.len());
    let mut left = s;
    for element in elements {
        let length = element.length.min(left);
        if length <= 0.0 {
            break;
        }
        kept.push(Element { length, ..*element });
        left -= element.length;
    }
    kept
}

/// The curvature at an arc length.
fn curvature_at(elements: &[Element], s: f64) -> DVec3 {
    let mut ends = 0.0;
    let there = elements.iter().find(|element| {
        ends += element.length;
        s < ends
    });
    there.or(elements.last()).map_or(DVec3::ZERO, |element| element.curvature)
}

/// The unit vector along the axis of a coil, root to tip.
fn axis_of(axes: DMat3, q: DVec3) -> DVec3 {
    (axes * (q * q.x.signum())).normalize_or_zero()
}

/// The smallest rotation that takes one unit vector to another, as axis times angle.
fn least_turn(from: DVec3, to: DVec3) -> DVec3 {
    let across = from.cross(to);
    let angle = across.length().atan2(from.dot(to));
    across.normalize_or_zero() * angle
}

/// The element that turns `before` into `after`: of all that do, which differ by whole turns, the
/// nearest to `expected`.
fn between(before: &DMat3, after: &DMat3, expected: DVec3, length: f64) -> Element {
    let turn = DQuat::from_mat3(&(before.transpose() * *after)).normalize();
    let angle = turn.to_scaled_axis();
    let expected_angle = expected * length;
    let axis = angle.normalize_or(expected_angle.normalize_or_zero());
    let turns = ((expected_angle - angle).dot(axis) / std::f64::consts::TAU).round();
    let angle = angle + axis * (turns * std::f64::consts::TAU);
    let curvature = if 0.0 < length { angle / length } else { expected };
    Element { curvature, length }
}
