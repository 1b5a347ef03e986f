//! The helix arc between two points with given tangents (first-order geometric Hermite).
//!
//! Points `p0`, `p1` with unit tangents `t0`, `t1` lie on one circular helix exactly when
//! `(t1 - t0) . (p1 - p0) = 0` (Ghosh's co-helicity). With `D = p1 - p0` and
//!
//! `m = (t0 + t1)/|t0 + t1|`, `n = (t1 - t0)/|t1 - t0|`, `b = m x n`,
//! `delta = atan2(|t1 - t0|, |t0 + t1|)`, `x = D.m`, `y = D.b`,
//!
//! the axis of the helix is `cos psi m + sin psi b` for the one angle `psi` at which
//!
//! `theta = 2 atan2(sin delta, cos delta sin psi)`, the turning angle,
//! `X = theta cos delta cos^2 psi + 2 sin delta sin psi`,
//! `Y = cos psi (theta cos delta sin psi - 2 sin delta)`
//!
//! is parallel to `(x, y)`; then `omega = |(X, Y)| / |(x, y)|` and the length is `theta / omega`.
//! As `psi` falls from `pi/2` to `-pi/2` the direction of `(X, Y)` turns monotonically from 0 to
//! `-pi`, so for `y <= 0` the root is unique; for `y > 0` the mirror image is solved.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

/// A helix arc in the world: its Darboux vector and its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HelixArc {
    /// `Omega = tau t + kappa b`: along the axis, as long as the turning per arc length.
    pub darboux: DVec3,
    /// Arc length.
    pub length: f64,
}

/// Tangents that differ by less are the same: their difference is rounding.
const SAME_TANGENT: f64 = 1e-15;

/// Newton's method needs 4 to 6 steps; each step it cannot take halves the bracket instead, and
/// 60 halvings reach the last digit.
const MAX_STEPS: usize = 60;

impl HelixArc {
    /// The arc of less than one turn along `chord` that starts along `t0` and ends along `t1`.
    ///
    /// The tangents are unit vectors and co-helical with the chord; a part of the chord along
    /// `t1 - t0`, where they are not, is missed by the arc's end. `None` when there is no such
    /// arc: opposite tangents, or equal ones that are not along the chord.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_fit::HelixArc;
    ///
    /// // A quarter of the unit circle.
    /// let arc = HelixArc::joining(DVec3::new(1.0, 1.0, 0.0), DVec3::X, DVec3::Y);
    /// let arc = arc.expect("a quarter circle");
    /// assert!((arc.length - std::f64::consts::FRAC_PI_2).abs() < 1e-14);
    /// assert!(arc.darboux.distance(DVec3::Z) < 1e-14);
    /// ```
    #[must_use]
    pub fn joining(chord: DVec3, t0: DVec3, t1: DVec3) -> Option<Self> {
        let (sum, difference) = (t0 + t1, t1 - t0);
        let (double_cosine, double_sine) = (sum.length(), difference.length());
        if double_cosine < SAME_TANGENT {
            return None;
        }
        let m = sum / double_cosine;
        if double_sine < SAME_TANGENT {
            return Self::straight(chord, m);
        }
        let b = m.cross(difference / double_sine);
        let (x, y) = (chord.dot(m), chord.dot(b));
        let reach = x.hypot(y);
        let tangents = HalfAngle { sine: 0.5 * double_sine, cosine: 0.5 * double_cosine };
        let psi = tangents.axis_angle(x / reach, -y.abs() / reach)?;
        let shape = tangents.shape(psi);
        let omega = shape.x.hypot(shape.y) / reach;
        let (sine, cosine) = psi.sin_cos();
        let cosine = if 0.0 < y { -cosine } else { cosine };
        let arc = Self { darboux: omega * (cosine * m + sine * b), length: shape.theta / omega };
        (arc.darboux.is_finite() && arc.length.is_finite()).then_some(arc)
    }

    /// The turning angle of the tangent about the axis.
    #[must_use]
    pub fn turning(&self) -> f64 {
        self.darboux.length() * self.length
    }

    fn straight(chord: DVec3, m: DVec3) -> Option<Self> {
        let length = chord.dot(m);
        let off = (chord - length * m).length();
        (0.0 < length && off <= 1e-9 * length).then_some(Self { darboux: DVec3::ZERO, length })
    }
}

/// Sine and cosine of `delta`, half the angle between the tangents.
struct HalfAngle {
    sine: f64,
    cosine: f64,
}

/// `theta`, `X` and `Y` of an arc of unit turning rate.
struct Shape {
    theta: f64,
    x: f64,
    y: f64,
}

impl HalfAngle {
    fn shape(&self, psi: f64) -> Shape {
        let (s, c) = psi.sin_cos();
        let theta = 2.0 * f64::atan2(self.sine, self.cosine * s);
        Shape {
            theta,
            x: theta * self.cosine * c * c + 2.0 * self.sine * s,
            y: c * (theta * self.cosine * s - 2.0 * self.sine),
        }
    }

    /// The `psi` at which `(X, Y)` is along the unit vector `(x, y)`, `y <= 0`.
    fn axis_angle(&self, x: f64, y: f64) -> Option<f64> {
        if !(x.is_finite() && y.is_finite()) {
            return None;
        }
        if y == 0.0 && 0.0 < x {
            return Some(FRAC_PI_2);
        }
        // x Y - y X is positive at psi = pi/2 and negative at -pi/2.
        let (mut low, mut high) = (-FRAC_PI_2, FRAC_PI_2);
        let mut psi = self.small_angle_guess(x, y);
        for _ in 0..MAX_STEPS {
            let (value, slope) = self.miss(psi, x, y);
            if value < 0.0 {
                low = psi;
            } else {
                high = psi;
            }
            let newton = psi - value / slope;
            let quadratic = low < newton && newton < high;
            let next = if quadratic { newton } else { 0.5 * (low + high) };
            let step = (next - psi).abs();
            psi = next;
            // What a Newton step leaves is of the order of its square.
            if (quadratic && step <= 1e-9) || high - low <= 4.0 * f64::EPSILON {
                break;
            }
        }
        Some(psi)
    }

    /// The root for a short arc, `cot psi = -3 y / (x tan^2 delta)`.
    fn small_angle_guess(&self, x: f64, y: f64) -> f64 {
        let guess = f64::atan2(x * self.sine * self.sine, -3.0 * y * self.cosine * self.cosine);
        guess.clamp(-0.5 * PI + 1e-3, FRAC_PI_2)
    }

    /// `x Y - y X` and its derivative by `psi`.
    fn miss(&self, psi: f64, x: f64, y: f64) -> (f64, f64) {
        let (s, c) = psi.sin_cos();
        let (sine, cosine) = (self.sine, self.cosine);
        let b = cosine * s;
        let theta = 2.0 * f64::atan2(sine, b);
        let theta_slope = -2.0 * sine * cosine * c / (sine * sine + b * b);
        let bracket = theta * b - 2.0 * sine;
        let bracket_slope = theta_slope * b + theta * cosine * c;
        let value = x * c * bracket - y * (theta * cosine * c * c + 2.0 * sine * s);
        let x_slope = theta_slope * cosine * c * c - 2.0 * theta * b * c + 2.0 * sine * c;
        (value, x * (c * bracket_slope - s * bracket) - y * x_slope)
    }
}

#[cfg(test)]
mod tests;
