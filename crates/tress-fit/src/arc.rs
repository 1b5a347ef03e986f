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
        let shape = tangents.shape(x / reach, -y.abs() / reach)?;
        let omega = shape.x.hypot(shape.y) / reach;
        let cosine = if 0.0 < y { -shape.cosine } else { shape.cosine };
        let arc =
            Self { darboux: omega * (cosine * m + shape.sine * b), length: shape.theta / omega };
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

/// `theta`, `X` and `Y` of an arc of unit turning rate, and sine and cosine of its `psi`.
struct Shape {
    theta: f64,
    x: f64,
    y: f64,
    sine: f64,
    cosine: f64,
}

impl HalfAngle {
    fn shape_at(&self, sine: f64, cosine: f64) -> Shape {
        let theta = 2.0 * f64::atan2(self.sine, self.cosine * sine);
        Shape {
            theta,
            x: theta * self.cosine * cosine * cosine + 2.0 * self.sine * sine,
            y: cosine * (theta * self.cosine * sine - 2.0 * self.sine),
            sine,
            cosine,
        }
    }

    /// The shape whose `(X, Y)` is along the unit vector `(x, y)`, `y <= 0`.
    ///
    /// Solved for `h = tan((pi/2 - psi)/2)`, from 0 to infinity: sine and cosine of `psi` are then
    /// `(1 - h^2)/(1 + h^2)` and `2 h/(1 + h^2)`.
    fn shape(&self, x: f64, y: f64) -> Option<Shape> {
        if !(x.is_finite() && y.is_finite()) {
            return None;
        }
        if y == 0.0 && 0.0 < x {
            return Some(self.shape_at(1.0, 0.0));
        }
        // x Y - y X is positive at h = 0 and negative far out.
        let (mut low, mut high) = (0.0, FARTHEST);
        let mut h = self.small_angle_guess(x, y);
        for _ in 0..MAX_STEPS {
            let (value, slope) = self.miss(h, x, y);
            if value < 0.0 {
                high = h;
            } else {
                low = h;
            }
            let newton = h - value / slope;
            let quadratic = low < newton && newton < high;
            // Half way in the angle, not in its tangent.
            let next =
                if quadratic { newton } else { (0.5 * (f64::atan(low) + f64::atan(high))).tan() };
            let step = (next - h).abs();
            h = next;
            // What a Newton step leaves is of the order of its square.
            if (quadratic && step <= 1e-8 * (1.0 + h * h))
                || high - low <= 4.0 * f64::EPSILON * high
            {
                break;
            }
        }
        let (sine, cosine) = sine_and_cosine(h);
        Some(self.shape_at(sine, cosine))
    }

    /// The root for a short arc, `cot psi = -3 y / (x tan^2 delta)`.
    fn small_angle_guess(&self, x: f64, y: f64) -> f64 {
        let (s, c) = (x * self.sine * self.sine, -3.0 * y * self.cosine * self.cosine);
        // The tangent of half the angle whose cosine goes with s and whose sine goes with c.
        let h = c / (s + s.hypot(c));
        if h.is_finite() { h.clamp(0.0, FARTHEST) } else { 1.0 }
    }

    /// `x Y - y X` and its derivative by `h`.
    fn miss(&self, h: f64, x: f64, y: f64) -> (f64, f64) {
        let (s, c) = sine_and_cosine(h);
        let (sine, cosine) = (self.sine, self.cosine);
        let b = cosine * s;
        let theta = 2.0 * f64::atan2(sine, b);
        let theta_slope = -2.0 * sine * cosine * c / (sine * sine + b * b);
        let bracket = theta * b - 2.0 * sine;
        let bracket_slope = theta_slope * b + theta * cosine * c;
        let value = x * c * bracket - y * (theta * cosine * c * c + 2.0 * sine * s);
        let x_slope = theta_slope * cosine * c * c - 2.0 * theta * b * c + 2.0 * sine * c;
        let by_psi = x * (c * bracket_slope - s * bracket) - y * x_slope;
        (value, by_psi * -2.0 / (1.0 + h * h))
    }
}

/// The greatest `h`: `psi` is `-pi/2` then but for rounding, and the arc a whole turn.
const FARTHEST: f64 = 1e8;

/// Sine and cosine of `psi`.
fn sine_and_cosine(h: f64) -> (f64, f64) {
    let square = h * h;
    ((1.0 - square) / (1.0 + square), 2.0 * h / (1.0 + square))
}

#[cfg(test)]
mod tests;
