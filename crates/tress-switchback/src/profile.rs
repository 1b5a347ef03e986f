//! What a switchback looks like: curvatures along the strand, and the curve they bend.
//!
//! The paper's body frame is `[d1 d2 d3]` with the tangent last; tress has the tangent first. With
//! `t = d3`, `u = -d2`, `v = d1`, which is right-handed, a coil bends about `v` as everywhere in
//! tress: `(k0, k1, k2) = (kappa3, -kappa2, kappa1)`.

use glam::{DMat3, DVec3};
use tress_geometry::{Element, Frame};

/// Curvatures that lead from one coil to another, in units of the rest curvature.
pub trait Profile {
    /// `(kappa1, kappa2, kappa3)` at arc length `s` from the middle.
    fn curvature(&self, s: f64) -> DVec3;

    /// The coils before it and behind.
    fn ends(&self) -> [DVec3; 2];

    /// The distance from the middle beyond which the curvature stays within `share` of the
    /// coil's: half of the room a switchback needs.
    fn half_width(&self, share: f64) -> f64;
}

/// Curvatures in the order and signs of tress: `(k0, k1, k2)` of `(kappa1, kappa2, kappa3)`.
#[must_use]
pub fn material_curvature(kappa: DVec3) -> DVec3 {
    DVec3::new(kappa.z, -kappa.y, kappa.x)
}

/// The profile as helix arcs from `-half_length` to `half_length` about its middle, `steps` of
/// equal length, in units of the rest radius.
///
/// Each arc turns the frame as the fourth-order Magnus expansion says: by the mean of the
/// curvatures at the two Gauss points and their commutator, so that frames at joints are right to
/// the fourth order in the step and positions to the second. [CC 4.3.3] turns by the curvature at
/// the beginning of each step, which is first order in both.
///
/// ```
/// use tress_switchback::{Material, Switchback, arcs};
///
/// let switchback = Switchback::new(0.3, &Material::default())?;
/// let coarse: f64 = arcs(&switchback, 20.0, 40).iter().map(|arc| arc.length).sum();
/// assert!((coarse - 40.0).abs() < 1e-12);
/// # Ok::<(), tress_switchback::SwitchbackError>(())
/// ```
#[must_use]
pub fn arcs(profile: &impl Profile, half_length: f64, steps: usize) -> Vec<Element> {
    let h = 2.0 * half_length / steps.max(1) as f64;
    let arc = |i: usize| {
        let begins = -half_length + h * i as f64;
        let (a, b) = (gauss(profile, begins, h, -1.0), gauss(profile, begins, h, 1.0));
        let curvature = magnus(a, b, h);
        Element { curvature, length: h }
    };
    (0..steps).map(arc).collect()
}

/// A strand with the switchback in its middle: as far as its coils turn `turns` times on either
/// side, of coil radius `radius`, in `arcs_per_turn` arcs to a turn. The axis before the switchback
/// is the x axis.
///
/// ```
/// use tress_geometry::SuperHelix;
/// use tress_switchback::{Material, Switchback, strand};
///
/// let switchback = Switchback::new(0.4, &Material::default())?;
/// let (root, elements) = strand(&switchback, 0.5, 12.0, 32);
/// assert!((elements[0].radius() - 0.5).abs() < 1e-6);
/// // The axis is the same line on both sides.
/// let tip = SuperHelix { root, elements: &elements }.tip().position;
/// assert!((tip.y.hypot(tip.z) - 0.5).abs() < 0.01);
/// # Ok::<(), tress_switchback::SwitchbackError>(())
/// ```
#[must_use]
pub fn strand(
    profile: &impl Profile,
    radius: f64,
    turns: f64,
    arcs_per_turn: usize,
) -> (Frame, Vec<Element>) {
    let [before, _] = profile.ends();
    let coil = Element { curvature: material_curvature(before), length: 0.0 };
    let scale = radius / coil.radius();
    let half_length = turns * std::f64::consts::TAU / before.length();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let steps = (2.0 * turns * arcs_per_turn as f64).ceil() as usize;
    let mut elements = arcs(profile, half_length, steps);
    for element in &mut elements {
        element.curvature /= scale;
        element.length *= scale;
    }
    (coil_frame(coil.curvature / scale), elements)
}

/// The material curvature at one of the two Gauss points of a step.
fn gauss(profile: &impl Profile, begins: f64, h: f64, side: f64) -> DVec3 {
    let s = begins + h * (0.5 + side * GAUSS);
    material_curvature(profile.curvature(s))
}

/// Distance of the two Gauss points from the middle of a step of length 1, `sqrt(3) / 6`.
pub(crate) const GAUSS: f64 = 0.288675134594812882;

/// The constant curvature that turns as far as one that is `a` and `b` at the Gauss points.
///
/// For `F' = F [q]x`, where the curvature multiplies from the right, the second term of the
/// expansion is `+(sqrt(3)/12) h^2 a x b`.
pub(crate) fn magnus(a: DVec3, b: DVec3, h: f64) -> DVec3 {
    0.5 * (a + b) + (0.5 * GAUSS * h) * a.cross(b)
}

/// The frame at the beginning of a switchback whose coil before it winds about the x axis and has
/// the material curvature `q`; the origin is on the axis.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Element, SuperHelix};
/// use tress_switchback::coil_frame;
///
/// let coil = Element { curvature: DVec3::new(0.3, 0.0, 0.9), length: 50.0 };
/// let root = coil_frame(coil.curvature);
/// let tip = coil.advance(&root).position;
/// assert!((tip.y.hypot(tip.z) - coil.radius()).abs() < 1e-12);
/// ```
#[must_use]
pub fn coil_frame(q: DVec3) -> Frame {
    let axis = (q * q.x.signum()).normalize_or(DVec3::X);
    // The tangent bends towards the axis along `q x e0`.
    let outward = (-q.cross(DVec3::X)).normalize_or(axis.any_orthonormal_vector());
    let axes = DMat3::from_cols(axis, outward, axis.cross(outward)).transpose();
    let bending = q.y.hypot(q.z);
    let radius = if 0.0 < bending { bending / q.length_squared() } else { 0.0 };
    Frame { position: DVec3::Y * radius, axes }
}

#[cfg(test)]
mod tests {
    use tress_geometry::SuperHelix;

    use super::*;
    use crate::{Material, Switchback};

    #[test]
    fn frames_at_joints_are_right_to_the_fourth_order() {
        let switchback = Switchback::new(0.5, &Material::default()).expect("within range");
        let end = |steps| {
            let elements = arcs(&switchback, 6.0, steps);
            SuperHelix { root: Frame::IDENTITY, elements: &elements }.tip().axes
        };
        let exact = end(2048);
        let error = |steps| {
            let off = (end(steps) - exact).to_cols_array();
            off.into_iter().fold(0.0, |worst, entry| f64::max(worst, entry.abs()))
        };
        let (coarse, fine) = (error(32), error(64));
        assert!(fine < 1e-4 && (coarse / fine - 16.0).abs() < 2.0, "{coarse:e} {fine:e}");
    }

    #[test]
    fn coils_of_both_hands_wind_about_the_x_axis_and_climb_it() {
        for twist in [0.3, -0.3] {
            let coil = Element { curvature: DVec3::new(twist, 0.2, 0.9), length: 50.0 };
            let root = coil_frame(coil.curvature);
            assert!(root.orthonormality_error() < 1e-14);
            for part in [0.0, 0.3, 1.0] {
                let s = part * coil.length;
                let p = coil.frame_at(&root, s).position;
                assert!((p.y.hypot(p.z) - coil.radius()).abs() < 1e-12);
                assert!((p.x - s * 0.3 / coil.curvature.length()).abs() < 1e-12);
            }
        }
    }
}
