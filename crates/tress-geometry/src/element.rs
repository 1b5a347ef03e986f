//! One helical element: an arc of constant material curvatures [CSE 3.1-3.2].
//!
//! With `R` and `V` of the rotation module, a frame `F` at the element's start becomes `F R(q,s)`
//! at arc length `s`, and the position moves by `F V(q,s) e0`, `e0 = (1,0,0)`. Since
//! `c1 = q x e0 = (0, k2, -k1)` and `c2 = q x c1 = q0 q - |q|^2 e0`, the displacement is
//! `V e0 = s e0 + B c1 + C c2`: no matrix is needed for it.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::Frame;
use crate::rodrigues::{ratios, ratios_and_slopes};

/// One helix arc: constant material curvatures over a length.
///
/// ```
/// use std::f64::consts::TAU;
/// use glam::DVec3;
/// use tress_geometry::{Element, Frame};
///
/// // A coil of radius 0.5 and pitch 1: one turn is hypot(2 pi R, pitch) long.
/// let coil = Element::coil(0.5, 1.0);
/// let turn = Element { length: (TAU * 0.5).hypot(1.0), ..coil };
/// let tip = turn.advance(&Frame::IDENTITY);
/// assert!((tip.position.length() - 1.0).abs() < 1e-14);
/// assert!((turn.turns() - 1.0).abs() < 1e-14);
/// ```
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Serialize,
    Deserialize,
    bytemuck::Pod,
    bytemuck::Zeroable,
)]
#[repr(C)]
pub struct Element {
    /// `q = (k0, k1, k2)`: twist about `t`, curvatures about `u` and `v`; one over length.
    pub curvature: DVec3,
    /// Arc length of the element, at least 0.
    pub length: f64,
}

impl Element {
    /// An element of length 0 on the helix of this radius and pitch (the advance along the axis in
    /// one turn; negative for a left-handed coil), bending about `v`.
    ///
    /// A radius of 0 gives a straight element.
    #[must_use]
    pub fn coil(radius: f64, pitch: f64) -> Self {
        let rise = pitch / std::f64::consts::TAU;
        let square = radius * radius + rise * rise;
        if square <= 0.0 || radius == 0.0 {
            return Self::default();
        }
        Self { curvature: DVec3::new(rise / square, 0.0, radius / square), length: 0.0 }
    }

    /// `R(q,s)`: the frame at arc length `s` in the frame of the element's start.
    #[must_use]
    pub fn rotation(&self, s: f64) -> DMat3 {
        let q = self.curvature;
        let r = ratios(q.length() * s);
        rotation(q, s * r.a, s * s * r.b)
    }

    /// `V(q,s) e0`: the position at arc length `s` in the frame of the element's start.
    #[must_use]
    pub fn displacement(&self, s: f64) -> DVec3 {
        let q = self.curvature;
        let r = ratios(q.length() * s);
        displacement(q, s, s * s * r.b, s * s * s * r.c)
    }

    /// The frame at arc length `s` of the element, which starts at `base`.
    #[must_use]
    pub fn frame_at(&self, base: &Frame, s: f64) -> Frame {
        let q = self.curvature;
        let r = ratios(q.length() * s);
        let (a, b, c) = (s * r.a, s * s * r.b, s * s * s * r.c);
        Frame {
            position: base.position + base.axes * displacement(q, s, b, c),
            axes: base.axes * rotation(q, a, b),
        }
    }

    /// The frame at the end of the element, which starts at `base`.
    #[must_use]
    pub fn advance(&self, base: &Frame) -> Frame {
        self.frame_at(base, self.length)
    }

    /// Geometric curvature `k = sqrt(k1^2 + k2^2)`, one over length.
    #[must_use]
    pub fn bending(&self) -> f64 {
        self.curvature.y.hypot(self.curvature.z)
    }

    /// Twist `k0`, which is the torsion of the helix; its sign is the handedness.
    #[must_use]
    pub fn twist(&self) -> f64 {
        self.curvature.x
    }

    /// Coil radius `R = k / |q|^2` [CSE 12]; 0 for a straight element.
    #[must_use]
    pub fn radius(&self) -> f64 {
        let square = self.curvature.length_squared();
        if square == 0.0 { 0.0 } else { self.bending() / square }
    }

    /// Advance along the axis in one turn, `2 pi k0 / |q|^2`: negative for a left-handed coil, 0
    /// for a planar arc, and 0 for a straight element, which has none.
    #[must_use]
    pub fn pitch(&self) -> f64 {
        let square = self.curvature.length_squared();
        if square == 0.0 { 0.0 } else { std::f64::consts::TAU * self.curvature.x / square }
    }

    /// Turns of the helix over the whole length, `|q| l / 2 pi`; 0 where it does not bend.
    #[must_use]
    pub fn turns(&self) -> f64 {
        if self.bending() == 0.0 {
            return 0.0;
        }
        self.curvature.length() * self.length / std::f64::consts::TAU
    }

    /// `L(q,s)` and `D(q,s)`, the derivatives of the element's motion by its curvatures.
    ///
    /// When `q` changes by `dq`, the frame at `s` turns by the vector `L dq` and the position moves
    /// by `D dq`, both in the frame of the element's start: `L = V(q,s)`, `D = d(V e0)/dq`.
    ///
    /// `D = -B [e0]x + c1 (dB/n q)^T + c2 (dC/n q)^T + C (q e0^T + q0 I - 2 e0 q^T)`, which is
    /// [CSE 19] without a division by `|Omega|`.
    #[must_use]
    pub fn derivatives(&self, s: f64) -> (DMat3, DMat3) {
        let q = self.curvature;
        let (r, db, dc) = ratios_and_slopes(q.length() * s);
        let (s2, s3) = (s * s, s * s * s);
        let (b, c) = (s2 * r.b, s3 * r.c);
        let c1 = DVec3::new(0.0, q.z, -q.y);
        let c2 = q * q.x - DVec3::X * q.length_squared();
        // Column j is the derivative by q_j; slopes is c1 dB/n + c2 dC/n.
        let slopes = c1 * (db * s2 * s2) + c2 * (dc * s2 * s3);
        let d = DMat3::from_cols(
            slopes * q.x + c * (q - DVec3::X * q.x),
            slopes * q.y + DVec3::new(-2.0 * c * q.y, c * q.x, -b),
            slopes * q.z + DVec3::new(-2.0 * c * q.z, b, c * q.x),
        );
        (turning(q, s, b, c), d)
    }
}

/// `I + A [q]x + B [q]x^2`.
fn rotation(q: DVec3, a: f64, b: f64) -> DMat3 {
    polynomial(q, 1.0, a, b)
}

/// `s I + B [q]x + C [q]x^2`.
fn turning(q: DVec3, s: f64, b: f64, c: f64) -> DMat3 {
    polynomial(q, s, b, c)
}

/// `f I + g [q]x + h [q]x^2`.
fn polynomial(q: DVec3, f: f64, g: f64, h: f64) -> DMat3 {
    let (x, y, z) = (q.x, q.y, q.z);
    DMat3::from_cols(
        DVec3::new(f - h * (y * y + z * z), h * x * y + g * z, h * x * z - g * y),
        DVec3::new(h * x * y - g * z, f - h * (x * x + z * z), h * y * z + g * x),
        DVec3::new(h * x * z + g * y, h * y * z - g * x, f - h * (x * x + y * y)),
    )
}

/// `s e0 + B c1 + C c2`.
fn displacement(q: DVec3, s: f64, b: f64, c: f64) -> DVec3 {
    DVec3::new(s - c * (q.y * q.y + q.z * q.z), b * q.z + c * q.x * q.y, c * q.x * q.z - b * q.y)
}

#[cfg(test)]
mod tests;
