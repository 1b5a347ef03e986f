//! What an element does to a frame, and what that means for rows and deviations.

use std::f64::consts::PI;

use glam::{DMat3, DVec2, DVec3};
use tress_geometry::{Element, Frame};

use super::quadratic::{Row, Transition};

/// What an element does over an arc length, in the axes of its start.
pub(super) struct Motion {
    /// `V(q, s)`; its first column is the displacement.
    turning: DMat3,
    /// `D(q, s)`.
    moving: DMat3,
    /// `R(q, s) = I + V [q]x`.
    rotation: DMat3,
}

impl Motion {
    #[inline(always)]
    pub(super) fn new(element: &Element, s: f64) -> Self {
        let (turning, moving) = element.derivatives(s);
        let q = element.curvature;
        let column = |e: DVec3, spin: DVec3| e + turning * spin;
        let rotation = DMat3::from_cols(
            column(DVec3::X, DVec3::new(0.0, q.z, -q.y)),
            column(DVec3::Y, DVec3::new(-q.z, 0.0, q.x)),
            column(DVec3::Z, DVec3::new(q.y, -q.x, 0.0)),
        );
        Self { turning, moving, rotation }
    }

    #[inline(always)]
    pub(super) fn transition(&self, from: &Frame, q: DVec3, to: &Frame) -> Transition {
        let axes = to.axes.transpose() * from.axes;
        let straightened = axes * straightening(self.rotation.x_axis, axes);
        Transition::new(&axes, &straightened, &self.rotation, &self.turning, &self.moving, q)
    }

    /// The two components across the curve of the miss `from_start + V e0`.
    #[inline(always)]
    pub(super) fn across(&self, from_start: DVec3) -> [Row; 2] {
        let miss = from_start + self.turning.x_axis;
        [self.rotation.y_axis, self.rotation.z_axis].map(|n| {
            let lean = self.turning.transpose() * n;
            let bend = self.moving.transpose() * n;
            let slope = [n.x, n.y, n.z, lean.y, lean.z, bend.x, bend.y, bend.z];
            Row { slope, value: n.dot(miss) }
        })
    }
}

/// How far the end of an element, which starts at `frame`, is from the joint behind it.
pub(super) fn gap(frame: &Frame, whole: &Motion, joint: &Frame) -> [f64; 5] {
    let into_axes = joint.axes.transpose();
    let end = frame.position + frame.axes * whole.turning.x_axis;
    let off = into_axes * (end - joint.position);
    let lean = lean(into_axes * (frame.axes * whole.rotation.x_axis));
    [off.x, off.y, off.z, lean.x, lean.y]
}

/// A joint moved by a deviation of its state: the tangent turns by the angle `|a|`.
pub(super) fn moved(joint: &Frame, state: &[f64; 5]) -> Frame {
    let [x, y, z, u, v] = *state;
    let square = u * u + v * v;
    let (ratio, cosine) = if square < SMALL {
        let ratio = 1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0 - square / 5040.0));
        (ratio, (1.0 - square * ratio * ratio).sqrt())
    } else {
        let angle = square.sqrt();
        let (sine, cosine) = angle.sin_cos();
        (sine / angle, cosine)
    };
    let tangent = joint.axes * DVec3::new(cosine, ratio * u, ratio * v);
    let position = joint.position + joint.axes * DVec3::new(x, y, z);
    Frame { position, ..joint.turned_to(tangent) }
}

/// The way from the axis x to a unit tangent, across the axis and as long as their angle: the
/// inverse of what [`moved`] does.
pub(super) fn lean(tangent: DVec3) -> DVec2 {
    let across = DVec2::new(tangent.y, tangent.z);
    let square = across.length_squared();
    if square < SMALL && 0.0 < tangent.x {
        let fourth = 5.0 / 112.0 + square * 35.0 / 1152.0;
        return across * (1.0 + square * (1.0 / 6.0 + square * (0.075 + square * fourth)));
    }
    let sine = square.sqrt();
    if sine < OPPOSITE {
        return DVec2::new(PI, 0.0);
    }
    across * (sine.atan2(tangent.x) / sine)
}

/// Squares of angles for which a few terms of a series do: they leave 2e-8.
const SMALL: f64 = 0.06;

/// Sines, and `1 + cos`, of angles that are half a turn but for rounding.
const OPPOSITE: f64 = 1e-9;

/// `4 tan^2(phi / 2)` of the angle between unit tangents: the angle's square where it is small, and
/// without bound where they are opposite, so that no gap stays there.
pub(super) fn tan_square(a: DVec3, b: DVec3) -> f64 {
    let cosine = a.dot(b);
    4.0 * (1.0 - cosine).max(0.0) / (1.0 + cosine).max(OPPOSITE)
}

/// The least rotation that brings `end` to where `axes` take it to the axis x; the identity where
/// they nearly are, for the difference is of second order.
fn straightening(end: DVec3, axes: DMat3) -> DMat3 {
    let there = axes.row(0);
    let cosine = end.dot(there);
    if ALIGNED < cosine {
        return DMat3::IDENTITY;
    }
    let w = end.cross(there);
    let spin = |a: DVec3| a * cosine + w.cross(a) + w * (w.dot(a) / (1.0 + cosine).max(OPPOSITE));
    DMat3::from_cols(spin(DVec3::X), spin(DVec3::Y), spin(DVec3::Z))
}

/// The cosine of the angle, 8 degrees, up to which tangents are nearly along each other.
const ALIGNED: f64 = 0.99;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_a_tangent_is_its_lean() {
        for angle in [0.0, 1e-9, 1e-3, 0.24, 0.25, 1.0, 2.0, 3.1] {
            let joint = moved(&Frame::IDENTITY, &[0.0, 0.0, 0.0, 0.6 * angle, -0.8 * angle]);
            assert!(joint.orthonormality_error() < 1e-14, "{angle}");
            let lean = lean(joint.tangent());
            let wanted = angle * DVec2::new(0.6, -0.8);
            assert!(lean.distance(wanted) <= 3e-8 * angle, "{angle}: {lean}");
            let tan = 2.0 * (0.5 * angle).tan();
            let square = tan_square(DVec3::X, joint.tangent());
            assert!((square - tan * tan).abs() <= 1e-12 + 1e-9 * tan * tan, "{angle}: {square}");
        }
        assert!((lean(DVec3::NEG_X).length() - PI).abs() < 1e-15);
    }

    #[test]
    fn tangents_are_straightened_by_the_least_rotation() {
        let end = DVec3::new(0.6, 0.8, 0.0);
        let turn = straightening(end, DMat3::IDENTITY);
        assert!((turn * end).distance(DVec3::X) < 1e-15);
        assert!((turn * DVec3::Z).distance(DVec3::Z) < 1e-15);
    }
}
