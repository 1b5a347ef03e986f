//! Cubic curves through and near points: Catmull-Rom for fitting, the bases that files use, and
//! Hermite's by its ends and slopes.
//!
//! A cubic segment is `p(t) = sum_k w_k(t) P_k` over four control points, `t` in 0 to 1, with the
//! weights of its basis. Only Catmull-Rom passes through its points; a B-spline's points are *not*
//! on the curve, and reading them as a polyline makes a coil too wide.

use std::ops::{Add, Mul, Sub};

use glam::DVec3;

/// How the control points of a cubic curve act.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CubicBasis {
    /// Every third point is on the curve, those between are handles.
    Bezier,
    /// Uniform cubic B-spline: no point is on the curve.
    BSpline,
    /// Uniform Catmull-Rom: the curve passes through the points.
    CatmullRom,
}

impl CubicBasis {
    /// The weights of four control points at `t`.
    #[must_use]
    pub fn weights(self, t: f64) -> [f64; 4] {
        let (t2, t3) = (t * t, t * t * t);
        let r = 1.0 - t;
        match self {
            Self::Bezier => [r * r * r, 3.0 * t * r * r, 3.0 * t2 * r, t3],
            Self::BSpline => [
                r * r * r / 6.0,
                (3.0 * t3 - 6.0 * t2 + 4.0) / 6.0,
                (-3.0 * t3 + 3.0 * t2 + 3.0 * t + 1.0) / 6.0,
                t3 / 6.0,
            ],
            Self::CatmullRom => [
                0.5 * (-t3 + 2.0 * t2 - t),
                0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
                0.5 * (-3.0 * t3 + 4.0 * t2 + t),
                0.5 * (t3 - t2),
            ],
        }
    }

    /// The position at `t` between the middle points of four (for Bezier, between the outer).
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_geometry::curves::CubicBasis;
    ///
    /// let p = [0.0, 1.0, 3.0, 4.0].map(|x| DVec3::new(x, 0.0, 0.0));
    /// assert_eq!(CubicBasis::CatmullRom.position(&p, 0.0), p[1]);
    /// assert_eq!(CubicBasis::BSpline.position(&p, 0.5).x, 2.0);
    /// ```
    #[must_use]
    pub fn position(self, p: &[DVec3; 4], t: f64) -> DVec3 {
        let w = self.weights(t);
        p[0] * w[0] + p[1] * w[1] + p[2] * w[2] + p[3] * w[3]
    }

    /// How many control points one segment lies behind the next.
    #[must_use]
    pub fn step(self) -> usize {
        match self {
            Self::Bezier => 3,
            Self::BSpline | Self::CatmullRom => 1,
        }
    }
}

/// The cubic that leaves `ends[0]` with the derivative `slopes[0]` and arrives at `ends[1]` with
/// `slopes[1]`, at `u` from 0 to 1. Numbers and vectors alike.
///
/// ```
/// use tress_geometry::curves::hermite;
///
/// // The cubic is u^3.
/// assert_eq!(hermite([0.0, 1.0], [0.0, 3.0], 0.5), 0.125);
/// ```
#[must_use]
pub fn hermite<V>(ends: [V; 2], slopes: [V; 2], u: f64) -> V
where
    V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
{
    let ([p, q], [m, n], v) = (ends, slopes, 1.0 - u);
    p + (q - p) * (u * u * (3.0 - 2.0 * u)) + m * (u * v * v) - n * (u * u * v)
}

/// The derivative of [`hermite`] by `u`.
///
/// ```
/// use tress_geometry::curves::hermite_derivative;
///
/// assert_eq!(hermite_derivative([0.0, 1.0], [0.0, 3.0], 0.5), 0.75);
/// ```
#[must_use]
pub fn hermite_derivative<V>(ends: [V; 2], slopes: [V; 2], u: f64) -> V
where
    V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
{
    let ([p, q], [m, n], v) = (ends, slopes, 1.0 - u);
    (q - p) * (6.0 * u * v) + m * (v * (1.0 - 3.0 * u)) - n * (u * (2.0 - 3.0 * u))
}

/// The point before the first (or behind the last) that makes a cubic curve begin at `end`: the
/// neighbour mirrored, as USD's `pinned` wrap does for both B-spline and Catmull-Rom.
#[must_use]
pub fn phantom_end(end: DVec3, neighbour: DVec3) -> DVec3 {
    2.0 * end - neighbour
}

/// The derivative by its parameter of a Catmull-Rom curve at `points[i]`, where knots are spaced by
/// the segments' lengths to the power `alpha`: 0 uniform, 0.5 centripetal, 1 chordal.
///
/// The ends take the derivative of the parabola through the last three points, so that the end of
/// an arc does not straighten; two points have the direction between them. A neighbour at the same
/// place is passed over; a point with no neighbour elsewhere has the derivative 0.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::curves::catmull_rom_derivative;
///
/// let p = [DVec3::ZERO, DVec3::X, DVec3::new(2.0, 2.0, 0.0)];
/// assert_eq!(catmull_rom_derivative(&p, 1, 0.0), DVec3::new(1.0, 1.0, 0.0));
/// ```
///
/// # Panics
///
/// If `i` is not the index of a point.
#[must_use]
pub fn catmull_rom_derivative(points: &[DVec3], i: usize, alpha: f64) -> DVec3 {
    let here = points[i];
    let differs = |p: &&DVec3| **p != here;
    let before = points[..i].iter().rev().find(differs).copied();
    let after = points[i + 1..].iter().find(differs).copied();
    let divided = |a: DVec3, b: DVec3| (b - a) / a.distance(b).powf(alpha);
    match (before, after) {
        (Some(a), Some(b)) => parabola_slope(a, here, b, alpha, 0.0),
        (None, Some(b)) => match next_distinct(points[i + 1..].iter(), here, b) {
            Some(c) => parabola_slope(here, b, c, alpha, -1.0),
            None => divided(here, b),
        },
        (Some(a), None) => match next_distinct(points[..i].iter().rev(), here, a) {
            Some(c) => parabola_slope(c, a, here, alpha, 1.0),
            None => divided(a, here),
        },
        (None, None) => DVec3::ZERO,
    }
}

/// The first point of `rest` behind `near` that stands elsewhere than `near`.
fn next_distinct<'a>(
    rest: impl Iterator<Item = &'a DVec3>,
    here: DVec3,
    near: DVec3,
) -> Option<DVec3> {
    rest.copied().skip_while(|p| *p == here || *p == near).find(|p| *p != near)
}

/// Slope of the parabola through three points: at the middle one (`end = 0`), the first (-1) or
/// the last (1).
fn parabola_slope(a: DVec3, b: DVec3, c: DVec3, alpha: f64, end: f64) -> DVec3 {
    let (h, k) = (a.distance(b).powf(alpha), b.distance(c).powf(alpha));
    let (first, second) = ((b - a) / h, (c - b) / k);
    let bend = (second - first) / (h + k);
    let middle = first + bend * h;
    if end < 0.0 {
        middle - 2.0 * h * bend
    } else if 0.0 < end {
        middle + 2.0 * k * bend
    } else {
        middle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const P: [DVec3; 4] = [
        DVec3::new(0.0, 1.0, 2.0),
        DVec3::new(1.0, -1.0, 0.5),
        DVec3::new(2.0, 0.0, 0.0),
        DVec3::new(4.0, 1.0, -2.0),
    ];

    #[test]
    fn weights_sum_to_one() {
        for basis in [CubicBasis::Bezier, CubicBasis::BSpline, CubicBasis::CatmullRom] {
            for t in [0.0, 0.25, 0.7, 1.0] {
                assert!((basis.weights(t).iter().sum::<f64>() - 1.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn curves_pass_where_they_should() {
        let near = |a: DVec3, b: DVec3| a.distance(b) < 1e-14;
        assert!(near(CubicBasis::CatmullRom.position(&P, 1.0), P[2]));
        assert!(near(CubicBasis::Bezier.position(&P, 1.0), P[3]));
        let knot = (P[0] + 4.0 * P[1] + P[2]) / 6.0;
        assert!(near(CubicBasis::BSpline.position(&P, 0.0), knot));
        let pinned = [phantom_end(P[0], P[1]), P[0], P[1], P[2]];
        assert!(near(CubicBasis::BSpline.position(&pinned, 0.0), P[0]));
    }

    #[test]
    fn derivatives_of_a_parabola_are_exact_at_every_point() {
        // x = u is arc length's stand-in: uniform knots one apart.
        let p: Vec<_> = (0..5).map(f64::from).map(|u| DVec3::new(u, u * u, 0.0)).collect();
        for i in 0..5 {
            let d = catmull_rom_derivative(&p, i, 0.0);
            assert!(d.distance(DVec3::new(1.0, 2.0 * i as f64, 0.0)) < 1e-14, "{i}: {d}");
        }
    }

    #[test]
    fn slopes_of_a_parabola_are_in_the_mean_those_of_its_chords() {
        let p = [P[0], P[1], P[3]];
        for alpha in [0.0, 0.5, 1.0] {
            let d = [0, 1, 2].map(|i| catmull_rom_derivative(&p, i, alpha));
            for i in 0..2 {
                let chord = (p[i + 1] - p[i]) / p[i].distance(p[i + 1]).powf(alpha);
                assert!(chord.distance(0.5 * (d[i] + d[i + 1])) < 1e-14, "{alpha} {i}");
            }
        }
    }

    #[test]
    fn repeated_points_are_passed_over() {
        let p = [DVec3::ZERO, DVec3::ZERO, DVec3::X, DVec3::X, DVec3::ONE];
        for i in 0..5 {
            let d = catmull_rom_derivative(&p, i, 0.5);
            assert!(d.is_finite() && d != DVec3::ZERO);
        }
        assert_eq!(catmull_rom_derivative(&[DVec3::ONE; 3], 1, 0.5), DVec3::ZERO);
    }
}
