//! The generalized helicoid: a field of directions around a hair [GH 1-2].
//!
//! In the frame of the root, with the hair leaving along x, two angles give the direction of the
//! flow at `(x, y, z)`:
//!
//! `theta = atan2(kT x + kN y, 1 + kN x - kT y) + kB z`, `phi = alpha theta` [GH 1],
//!
//! and with them the frame there [GH 2]:
//!
//! `E_T = (cos phi cos theta, cos phi sin theta, sin phi)`, `E_N = (-sin theta, cos theta, 0)`,
//! `E_B = (-sin phi cos theta, -sin phi sin theta, cos phi)`.
//!
//! Written with complex numbers, `kappa = kN + i kT` and `w = x + i y`, the first angle is
//! `arg U + kB z` with `U = 1 + kappa w`. So it is harmonic, grows by 2 pi around the line
//! `w = -1/kappa`, where `U = 0`, and has no value on it: there the field is *singular*. `|U|` is
//! the [clearance](Helicoid::clearance) from it, 1 at the root.
//!
//! Along a line of the flow the frame turns with `theta' = grad theta . E_T`, which makes its
//! material curvatures `q = theta' (sin phi, -alpha, cos phi)`: `kT` is the curvature at the root,
//! `alpha kT` its part out of the plane, and the torsion at the root is 0 whatever the parameters.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

/// The four parameters of a generalized helicoid; the first three are one over length.
///
/// ```
/// use glam::DVec3;
/// use tress_helicoid::Helicoid;
///
/// // kT alone gives circles of radius 1/kT: after a quarter of it the flow points along y.
/// let circle = Helicoid::new(0.5, 0.0, 0.0, 0.0);
/// let quarter = DVec3::new(2.0, 2.0, 0.0);
/// assert!(circle.direction(circle.theta(quarter)).distance(DVec3::Y) < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Helicoid {
    /// Tangential curvature `kT`: how the hair itself bends at the root.
    pub kt: f64,
    /// Normal curvature `kN`: neighbours fan out (positive) or run together (negative).
    pub kn: f64,
    /// Binormal curvature `kB`: directions turn as one climbs out of the plane.
    pub kb: f64,
    /// Elevation `alpha`: how much the flow climbs as it turns.
    pub alpha: f64,
}

/// Clearance below which a direction is rounding.
pub(crate) const LEAST_CLEARANCE: f64 = 1e-9;

impl Helicoid {
    /// The helicoid of `k = (kT, kN, kB, alpha)`.
    #[must_use]
    pub const fn new(kt: f64, kn: f64, kb: f64, alpha: f64) -> Self {
        Self { kt, kn, kb, alpha }
    }

    /// Real and imaginary part of `U = 1 + kappa w`.
    fn u(&self, p: DVec3) -> (f64, f64) {
        (1.0 + self.kn * p.x - self.kt * p.y, self.kt * p.x + self.kn * p.y)
    }

    /// How far from singular the field is: `|U|`, 1 at the root and 0 where it has no direction.
    #[must_use]
    pub fn clearance(&self, p: DVec3) -> f64 {
        let (re, im) = self.u(p);
        re.hypot(im)
    }

    /// `theta` without counted cycles: its arctangent lies in -pi to pi.
    #[must_use]
    pub fn theta(&self, p: DVec3) -> f64 {
        let (re, im) = self.u(p);
        im.atan2(re) + self.kb * p.z
    }

    /// `theta` with as many cycles of 2 pi as bring it next to `near`: what a path that comes from
    /// a place where `theta` was `near` finds.
    #[must_use]
    pub fn theta_near(&self, p: DVec3, near: f64) -> f64 {
        use std::f64::consts::TAU;
        let theta = self.theta(p);
        theta + TAU * ((near - theta) / TAU).round()
    }

    /// `phi = alpha theta`.
    #[must_use]
    pub fn phi(&self, theta: f64) -> f64 {
        self.alpha * theta
    }

    /// `E_T` where the first angle is `theta` (cycles counted).
    #[must_use]
    pub fn direction(&self, theta: f64) -> DVec3 {
        let (sine, cosine) = theta.sin_cos();
        let (rise, run) = self.phi(theta).sin_cos();
        DVec3::new(run * cosine, run * sine, rise)
    }

    /// `[E_T E_N E_B]` where the first angle is `theta` (cycles counted).
    #[must_use]
    pub fn frame(&self, theta: f64) -> DMat3 {
        let (sine, cosine) = theta.sin_cos();
        let (rise, run) = self.phi(theta).sin_cos();
        DMat3::from_cols(
            DVec3::new(run * cosine, run * sine, rise),
            DVec3::new(-sine, cosine, 0.0),
            DVec3::new(-rise * cosine, -rise * sine, run),
        )
    }

    /// The gradient of `theta`, one over length; `None` where the field is singular.
    ///
    /// With `f = kappa / U` it is `(Im f, Re f, kB)`.
    #[must_use]
    pub fn gradient(&self, p: DVec3) -> Option<DVec3> {
        let (re, im) = self.u(p);
        let square = re * re + im * im;
        let (a, b) = (self.kn * re + self.kt * im, self.kt * re - self.kn * im);
        (LEAST_CLEARANCE * LEAST_CLEARANCE < square)
            .then(|| DVec3::new(b / square, a / square, self.kb))
    }

    /// Material curvatures `(k0, k1, k2)` of the line of flow through `p`, where the first angle is
    /// `theta`, in the frame `[E_T E_N E_B]`; `None` where the field is singular.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_helicoid::Helicoid;
    ///
    /// let q = Helicoid::new(2.0, 0.3, 0.1, 0.5).curvatures(DVec3::ZERO, 0.0);
    /// assert_eq!(q, Some(DVec3::new(0.0, -1.0, 2.0)));
    /// ```
    #[must_use]
    pub fn curvatures(&self, p: DVec3, theta: f64) -> Option<DVec3> {
        let rate = self.gradient(p)?.dot(self.direction(theta));
        let (rise, run) = self.phi(theta).sin_cos();
        Some(rate * DVec3::new(rise, -self.alpha, run))
    }

    /// The helicoid whose `kT` has the other sign; in a frame turned by half a turn about `E_T` it
    /// has the very same lines of flow.
    ///
    /// [GH 3] prints a half turn about `E_N`, which would send the hair off backwards: with
    /// `y` and `z` negated `theta` changes sign if and only if `kT` does, so the axis is `E_T`.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { kt: -self.kt, ..*self }
    }

    /// Whether all parameters are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        [self.kt, self.kn, self.kb, self.alpha].into_iter().all(f64::is_finite)
    }
}

#[cfg(test)]
mod tests;
