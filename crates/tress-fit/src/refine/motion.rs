//! What an element does to a frame, and what that means for rows and deviations.

use glam::{DMat3, DVec3};
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

    pub(super) fn transition(&self, from: &Frame, q: DVec3, to: &Frame) -> Transition {
        let axes = to.axes.transpose() * from.axes;
        Transition::new(&axes, &self.rotation, &self.turning, &self.moving, q)
    }

    /// The two components across the curve of the miss `from_start + V e0`.
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
    let lean = into_axes * (frame.axes * whole.rotation.x_axis);
    [off.x, off.y, off.z, lean.y, lean.z]
}

/// A joint moved by a deviation of its state.
pub(super) fn moved(joint: &Frame, state: &[f64; 5]) -> Frame {
    let [x, y, z, u, v] = *state;
    let tangent = joint.axes * DVec3::new(1.0, u, v).normalize();
    let position = joint.position + joint.axes * DVec3::new(x, y, z);
    Frame { position, ..joint.turned_to(tangent) }
}
