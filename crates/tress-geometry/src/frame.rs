//! A position and an orthonormal material frame: an element of SE(3).

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

/// A position and an orthonormal material frame `[t u v]`.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::Frame;
///
/// let root = Frame::along(DVec3::ZERO, DVec3::Y).expect("a direction");
/// assert_eq!(root.tangent(), DVec3::Y);
/// assert!(root.orthonormality_error() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Where the frame sits.
    pub position: DVec3,
    /// The axes as columns: tangent `t`, and the cross-section directions `u` and `v`.
    pub axes: DMat3,
}

impl Frame {
    /// At the origin, with `t u v` along x, y, z.
    pub const IDENTITY: Self = Self { position: DVec3::ZERO, axes: DMat3::IDENTITY };

    /// A frame whose tangent is along `direction`, `u` and `v` chosen as in [CSE 9] with the
    /// coordinate axis farthest from the tangent as the auxiliary vector `k`.
    ///
    /// `None` when the direction is zero or not finite.
    #[must_use]
    pub fn along(position: DVec3, direction: DVec3) -> Option<Self> {
        let t = direction.try_normalize()?;
        let a = t.abs();
        let k = if a.x <= a.y && a.x <= a.z {
            DVec3::X
        } else if a.y <= a.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let u = k.cross(t).normalize();
        Some(Self { position, axes: DMat3::from_cols(t, u, t.cross(u)) })
    }

    /// The unit tangent `t`.
    #[must_use]
    pub fn tangent(&self) -> DVec3 {
        self.axes.x_axis
    }

    /// This frame moved so that its tangent is `t` (a unit vector), by the least rotation.
    ///
    /// A tangent turned to its exact opposite goes by a half turn about `u`.
    #[must_use]
    pub fn turned_to(&self, t: DVec3) -> Self {
        let from = self.tangent();
        let w = from.cross(t);
        let cosine = from.dot(t);
        if cosine < -1.0 + 1e-12 {
            let half_turn = DMat3::from_axis_angle(self.axes.y_axis, std::f64::consts::PI);
            return Self { position: self.position, axes: half_turn * self.axes };
        }
        // Rodrigues' formula for the rotation that takes `from` to `t`.
        let turn = |a: DVec3| a * cosine + w.cross(a) + w * (w.dot(a) / (1.0 + cosine));
        let u = turn(self.axes.y_axis);
        let u = (u - t * t.dot(u)).normalize();
        Self { position: self.position, axes: DMat3::from_cols(t, u, t.cross(u)) }
    }

    /// This frame carried to `position` and the unit tangent `t` with no turn about the curve on
    /// the way, by the double reflection of Wang, Juettler, Zheng and Liu, "Computation of rotation
    /// minimizing frames", ACM TOG 27(1), 2008: in the plane between the positions, and in that
    /// which takes the reflected tangent to `t`. The error is of fourth order in the step.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_geometry::Frame;
    ///
    /// // A quarter of a circle in a plane: what stands across the plane goes on standing so.
    /// let end = Frame::IDENTITY.reflected_to(DVec3::new(1.0, 1.0, 0.0), DVec3::Y);
    /// assert!(end.axes.z_axis.distance(DVec3::Z) < 1e-12);
    /// ```
    #[must_use]
    pub fn reflected_to(&self, position: DVec3, t: DVec3) -> Self {
        let mirrored = |a: DVec3, n: DVec3| {
            let square = n.length_squared();
            if square > 0.0 { a - n * (2.0 * n.dot(a) / square) } else { a }
        };
        let across = position - self.position;
        let tangent = mirrored(self.tangent(), across);
        let u = mirrored(mirrored(self.axes.y_axis, across), t - tangent);
        match (u - t * t.dot(u)).try_normalize() {
            Some(u) => Self { position, axes: DMat3::from_cols(t, u, t.cross(u)) },
            None => Self { position, axes: self.turned_to(t).axes },
        }
    }

    /// Greatest entry of `F^T F - I`: 0 for a perfect frame.
    #[must_use]
    pub fn orthonormality_error(&self) -> f64 {
        let gram = self.axes.transpose() * self.axes - DMat3::IDENTITY;
        gram.to_cols_array().into_iter().fold(0.0, |worst, entry| f64::max(worst, entry.abs()))
    }

    /// Whether all numbers are finite, the axes orthonormal to `1e-6` and right-handed.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.position.is_finite()
            && self.axes.is_finite()
            && self.orthonormality_error() <= 1e-6
            && 0.0 < self.axes.determinant()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Element;

    #[test]
    fn every_direction_gets_an_orthonormal_frame() {
        for d in [DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::ONE, DVec3::new(1e-200, 0.0, 0.0)] {
            let frame = Frame::along(DVec3::ONE, d);
            if let Some(frame) = frame {
                assert!(frame.is_valid(), "{frame:?}");
                assert!(frame.tangent().dot(d) > 0.0);
            }
        }
        assert_eq!(Frame::along(DVec3::ZERO, DVec3::ZERO), None);
        assert_eq!(Frame::along(DVec3::ZERO, DVec3::NAN), None);
    }

    #[test]
    fn turning_ends_at_the_tangent_even_when_opposite() {
        let frame = Frame::along(DVec3::ZERO, DVec3::new(1.0, 2.0, -0.5)).expect("a direction");
        for t in [DVec3::X, frame.tangent(), -frame.tangent(), DVec3::new(0.6, 0.0, -0.8)] {
            let turned = frame.turned_to(t);
            assert!(turned.tangent().distance(t) < 1e-9 && turned.orthonormality_error() < 1e-12);
            assert!(turned.is_valid());
        }
    }

    #[test]
    fn turning_is_the_least_rotation() {
        let frame = Frame::along(DVec3::ZERO, DVec3::new(1.0, 2.0, -0.5)).expect("a direction");
        for t in [DVec3::X, DVec3::new(0.6, 0.0, -0.8), DVec3::NEG_Y] {
            // It turns about what stands across both tangents, which keeps its place.
            let axis = frame.tangent().cross(t).normalize();
            let turned = frame.turned_to(t);
            let places = [frame, turned].map(|frame| frame.axes.transpose() * axis);
            assert!(places[0].distance(places[1]) < 1e-15, "{places:?}");
        }
    }

    /// How far a frame that is carried along a helix of twist 0.7 is turned about the tangent from
    /// where the material frame says that it does not turn.
    fn turn_along_a_helix(steps: u32) -> f64 {
        let (twist, length) = (0.7, 4.0);
        let helix = Element { curvature: DVec3::new(twist, 0.0, 1.5), length };
        let at =
            |i: u32| helix.frame_at(&Frame::IDENTITY, length * f64::from(i) / f64::from(steps));
        let carried = (1..=steps)
            .map(at)
            .fold(Frame::IDENTITY, |frame, next| frame.reflected_to(next.position, next.tangent()));
        let (sine, cosine) = (twist * length).sin_cos();
        let axes = at(steps).axes;
        carried.axes.y_axis.distance(axes.y_axis * cosine - axes.z_axis * sine)
    }

    #[test]
    fn carried_frames_do_not_turn_about_a_helix_but_for_fourth_order() {
        let (coarse, fine) = (turn_along_a_helix(20), turn_along_a_helix(40));
        assert!(fine < 1e-4 && (coarse / fine - 16.0).abs() < 1.0, "{coarse:e} {fine:e}");
    }

    #[test]
    fn what_is_not_a_frame_is_not_valid() {
        let valid = Frame::IDENTITY;
        assert!(valid.is_valid());
        let left_handed = DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0));
        for axes in [DMat3::ZERO, left_handed, 2.0 * DMat3::IDENTITY, DMat3::NAN] {
            assert!(!Frame { axes, ..valid }.is_valid(), "{axes}");
        }
        assert!(!Frame { position: DVec3::INFINITY, ..valid }.is_valid());
    }
}
