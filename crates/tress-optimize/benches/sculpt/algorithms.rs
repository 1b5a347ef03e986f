//! Algorithms 1 and 2 of [CSE 5.2] as published: Jacobians from `O(N^2)` tables.
//!
//! Kept as an oracle for tests and to be measured against. Written by the paper's equations, whose
//! numbers stand beside the code; like them it divides by `|Omega|` and has no answer for a
//! straight element.

use glam::{DMat3, DVec3};
use tress_geometry::{Element, Frame, SuperHelix};

/// The tables of Algorithm 1, entry `(m, n)` at `m * N + n`.
#[derive(Default)]
pub(crate) struct Tables {
    /// Endpoint table: `d r(Omega_m, p_m, t_m, l_m) / d q_n`.
    endpoints: Vec<DMat3>,
    /// Frame tables: `d2 r / d q_n ds` for `t`, `u` and `v`.
    frames: [Vec<DMat3>; 3],
    joints: Vec<Frame>,
}

/// Algorithm 2: fills `blocks[k * N + j]` with `d S(lambda_k) / d q_j`.
pub(crate) fn jacobian(
    strand: &SuperHelix<'_>,
    arc_lengths: &[f64],
    tables: &mut Tables,
    blocks: &mut [DMat3],
) {
    let n = strand.elements.len();
    tables.fill(strand);
    blocks.fill(DMat3::ZERO);
    for (k, &lambda) in arc_lengths.iter().enumerate() {
        let (mut i, mut begins) = (0, 0.0);
        while i + 1 < n && begins + strand.elements[i].length < lambda {
            begins += strand.elements[i].length;
            i += 1;
        }
        for j in 0..=i {
            let s = lambda - begins;
            blocks[k * n + j] = tables.endpoint(&strand.elements[i], i, j, n, s);
        }
    }
}

impl Tables {
    /// Algorithm 1.
    fn fill(&mut self, strand: &SuperHelix<'_>) {
        let n = strand.elements.len();
        self.joints.clear();
        self.joints.extend(strand.joints());
        self.endpoints.resize(n * n, DMat3::ZERO);
        for table in &mut self.frames {
            table.resize(n * n, DMat3::ZERO);
        }
        for (m, element) in strand.elements.iter().enumerate() {
            for j in 0..=m {
                self.endpoints[m * n + j] = self.endpoint(element, m, j, n, element.length);
                for axis in 0..3 {
                    self.frames[axis][m * n + j] = self.frame(element, m, j, n, axis);
                }
            }
        }
    }

    /// (17) and (18).
    fn endpoint(&self, element: &Element, i: usize, j: usize, n: usize, s: f64) -> DMat3 {
        let axes = self.joints[i].axes;
        let omega = axes * element.curvature;
        let by_omega = position_by_omega(omega, axes.x_axis, s);
        if i == j {
            return by_omega * axes;
        }
        let before = (i - 1) * n + j;
        by_omega * self.omega(element, before)
            + self.endpoints[before]
            + position_by_tangent(omega, s) * self.frames[0][before]
    }

    /// (23) and (24).
    fn frame(&self, element: &Element, i: usize, j: usize, n: usize, axis: usize) -> DMat3 {
        let axes = self.joints[i].axes;
        let omega = axes * element.curvature;
        let by_omega = direction_by_omega(omega, axes.col(axis), element.length);
        if i == j {
            return by_omega * axes;
        }
        let before = (i - 1) * n + j;
        by_omega * self.omega(element, before)
            + direction_by_itself(omega, element.length) * self.frames[axis][before]
    }

    /// (21).
    fn omega(&self, element: &Element, before: usize) -> DMat3 {
        let q = element.curvature;
        self.frames[0][before] * q.x + self.frames[1][before] * q.y + self.frames[2][before] * q.z
    }
}

/// `a b^T`.
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// `[a]x`.
fn cross(a: DVec3) -> DMat3 {
    DMat3::from_cols(a.cross(DVec3::X), a.cross(DVec3::Y), a.cross(DVec3::Z))
}

/// (19).
fn position_by_omega(omega: DVec3, t: DVec3, s: f64) -> DMat3 {
    let n = omega.length();
    let o = omega / n;
    let along = t.dot(o);
    let (sine, cosine) = (n * s).sin_cos();
    let mirror = DMat3::IDENTITY - 2.0 * outer(o, o);
    outer(o, t) * (s / n)
        + mirror * (along * s / n)
        + outer((t - along * o) * (s * cosine - sine / n), o / n)
        - (outer(o, t) + mirror * along) * (sine / (n * n))
        + outer(o.cross(t) * (s * sine - (2.0 - 2.0 * cosine) / n), o / n)
        - cross(t) * ((1.0 - cosine) / (n * n))
}

/// (25): [CSE 19] differentiated by arc length.
fn direction_by_omega(omega: DVec3, t: DVec3, s: f64) -> DMat3 {
    let n = omega.length();
    let o = omega / n;
    let along = t.dot(o);
    let (sine, cosine) = (n * s).sin_cos();
    let mirror = DMat3::IDENTITY - 2.0 * outer(o, o);
    outer(o, t) * (1.0 / n) + mirror * (along / n)
        - outer((t - along * o) * (s * sine), o)
        - (outer(o, t) + mirror * along) * (cosine / n)
        + outer(o.cross(t) * (s * n * cosine - sine), o / n)
        - cross(t) * (sine / n)
}

/// (26), which is `d2 r / (dt ds)`: the rotation by `|Omega| s` about `Omega`.
fn direction_by_itself(omega: DVec3, s: f64) -> DMat3 {
    let n = omega.length();
    DMat3::from_axis_angle(omega / n, n * s)
}

/// `dr/dt`: the integral of (26).
fn position_by_tangent(omega: DVec3, s: f64) -> DMat3 {
    let n = omega.length();
    let o = omega / n;
    let (sine, cosine) = (n * s).sin_cos();
    outer(o, o) * s + (DMat3::IDENTITY - outer(o, o)) * (sine / n) + cross(o) * ((1.0 - cosine) / n)
}
