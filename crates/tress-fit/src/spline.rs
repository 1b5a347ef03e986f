//! The smooth curve through the points of a polyline, by arc length.
//!
//! Cubic Hermite segments, with derivatives and knots as the [`TangentRule`] says. Arc length comes
//! from Gauss-Legendre quadrature of the speed and is inverted by Newton's method.

use glam::DVec3;
use tress_geometry::curves::{catmull_rom_derivative, hermite};
use tress_geometry::polyline::place;

use crate::TangentRule;
use crate::tangents::helix_derivative;

/// A smooth curve through points, measured by its arc length.
///
/// ```
/// use glam::DVec3;
/// use tress_fit::{Spline, TangentRule};
///
/// let circle: Vec<_> = (0..=8)
///     .map(|i| f64::from(i) * std::f64::consts::FRAC_PI_4)
///     .map(|a| DVec3::new(a.cos(), a.sin(), 0.0))
///     .collect();
/// let spline = Spline::through(&circle, TangentRule::Helix);
/// assert!((spline.length() / std::f64::consts::TAU - 1.0).abs() < 1e-3);
/// let (point, tangent) = spline.at(0.5 * spline.length());
/// assert!(point.distance(DVec3::NEG_X) < 1e-9 && tangent.distance(DVec3::NEG_Y) < 1e-9);
/// ```
#[derive(Clone, Debug)]
pub struct Spline {
    points: Vec<DVec3>,
    /// Derivative by the knot parameter.
    slopes: Vec<DVec3>,
    /// Knot distance of each segment.
    spans: Vec<f64>,
    /// Arc length at each point.
    arc_lengths: Vec<f64>,
    turning: f64,
}

/// Abscissas in 0 to 1 and weights of the five-point Gauss-Legendre rule.
const GAUSS: [(f64, f64); 5] = [
    (0.046910077030668004, 0.11846344252809454),
    (0.23076534494715845, 0.23931433524968324),
    (0.5, 0.28444444444444444),
    (0.7692346550528415, 0.23931433524968324),
    (0.953089922969332, 0.11846344252809454),
];

/// Newton's method doubles its digits each step; the start is right to a few percent.
const INVERSION_STEPS: usize = 4;

impl Spline {
    /// The curve through `points`, of which neighbours stand in different places.
    #[must_use]
    pub fn through(points: &[DVec3], rule: TangentRule) -> Self {
        let chords = points.windows(2).map(|ends| ends[0].distance(ends[1]));
        let spans: Vec<f64> = match rule {
            TangentRule::Uniform => chords.map(|_| 1.0).collect(),
            TangentRule::Centripetal => chords.map(f64::sqrt).collect(),
            TangentRule::Circle | TangentRule::Helix => chords.collect(),
        };
        let slopes: Vec<DVec3> =
            (0..points.len()).map(|i| slope(points, &spans, i, rule)).collect();
        let angles = slopes.windows(2).map(|s| s[0].angle_between(s[1]));
        let turning = angles.filter(|angle| angle.is_finite()).sum();
        let arc_lengths = Vec::with_capacity(points.len());
        let mut spline = Self { points: points.to_vec(), slopes, spans, arc_lengths, turning };
        let mut length = 0.0;
        spline.arc_lengths.push(length);
        for i in 0..spline.spans.len() {
            length += spline.segment(i).length(1.0);
            spline.arc_lengths.push(length);
        }
        spline
    }

    /// Total arc length.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.arc_lengths.last().copied().unwrap_or(0.0)
    }

    /// The arc length at each point.
    #[must_use]
    pub fn arc_lengths(&self) -> &[f64] {
        &self.arc_lengths
    }

    /// The points it goes through.
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The unit tangent at each point.
    pub fn tangents(&self) -> impl ExactSizeIterator<Item = DVec3> {
        self.slopes.iter().map(|slope| slope.normalize_or(DVec3::X))
    }

    /// Sum of the angles between neighbouring points' tangents, in radians.
    #[must_use]
    pub fn turning(&self) -> f64 {
        self.turning
    }

    /// Position and unit tangent at an arc length, held within the curve.
    ///
    /// A curve of one point has the tangent x.
    #[must_use]
    pub fn at(&self, s: f64) -> (DVec3, DVec3) {
        let (i, _) = place(&self.arc_lengths, s);
        if i >= self.spans.len() {
            let slope = self.slopes.last().map_or(DVec3::X, |slope| slope.normalize_or(DVec3::X));
            return (self.points.last().copied().unwrap_or(DVec3::ZERO), slope);
        }
        let wanted = (s - self.arc_lengths[i]).max(0.0);
        let total = self.arc_lengths[i + 1] - self.arc_lengths[i];
        let segment = self.segment(i);
        let mut u = if 0.0 < total { (wanted / total).min(1.0) } else { 0.0 };
        for _ in 0..INVERSION_STEPS {
            let off = segment.length(u) - wanted;
            let speed = segment.speed(u);
            if speed <= 1e-9 * total {
                break;
            }
            u = (u - off / speed).clamp(0.0, 1.0);
            // What a step leaves is of the order of its square.
            if off.abs() <= 1e-5 * total {
                break;
            }
        }
        let tangent = segment.derivative(u).try_normalize();
        (self.position(i, u), tangent.unwrap_or_else(|| self.slopes[i].normalize_or(DVec3::X)))
    }

    fn segment(&self, i: usize) -> Segment {
        let chord = self.points[i + 1] - self.points[i];
        let (m, n) = (self.slopes[i] * self.spans[i], self.slopes[i + 1] * self.spans[i]);
        Segment::new(m, 6.0 * chord - 4.0 * m - 2.0 * n, 3.0 * (m + n) - 6.0 * chord)
    }

    fn position(&self, i: usize, u: f64) -> DVec3 {
        let (p, q) = (self.points[i], self.points[i + 1]);
        let (m, n) = (self.slopes[i] * self.spans[i], self.slopes[i + 1] * self.spans[i]);
        hermite([p, q], [m, n], u)
    }
}

/// The derivative of a cubic segment, `a + b u + c u^2` with `u` from 0 to 1.
struct Segment {
    a: DVec3,
    b: DVec3,
    c: DVec3,
    /// The square of its length, by powers of `u`.
    speed_square: [f64; 5],
}

impl Segment {
    fn new(a: DVec3, b: DVec3, c: DVec3) -> Self {
        let speed_square =
            [a.dot(a), 2.0 * a.dot(b), b.dot(b) + 2.0 * a.dot(c), 2.0 * b.dot(c), c.dot(c)];
        Self { a, b, c, speed_square }
    }

    fn derivative(&self, u: f64) -> DVec3 {
        self.a + u * (self.b + u * self.c)
    }

    fn speed(&self, u: f64) -> f64 {
        let square = self.speed_square.iter().rev().fold(0.0, |sum, power| sum * u + power);
        // Rounding may leave less than nothing where the curve halts.
        square.max(0.0).sqrt()
    }

    /// The arc length from 0 to `u`.
    fn length(&self, u: f64) -> f64 {
        u * GAUSS.iter().map(|(x, weight)| weight * self.speed(u * x)).sum::<f64>()
    }
}

/// The derivative by the knot at point `i`; across the strand where it doubles back on itself
/// exactly.
fn slope(points: &[DVec3], spans: &[f64], i: usize, rule: TangentRule) -> DVec3 {
    let before = spans.get(i.wrapping_sub(1)).copied();
    let after = spans.get(i).copied();
    let Some(near) = after.or(before) else { return DVec3::ZERO };
    let helix = match rule {
        TangentRule::Helix => helix_derivative(points, i),
        _ => None,
    };
    if let Some(by_index) = helix {
        return by_index * 2.0 / (before.unwrap_or(near) + after.unwrap_or(near));
    }
    let slope = catmull_rom_derivative(points, i, rule.knot_exponent());
    let other = if i + 1 < points.len() { i + 1 } else { i - 1 };
    let chord = (points[other] - points[i]) / near;
    if slope.is_finite() && 1e-9 * chord.length() < slope.length() {
        return slope;
    }
    chord.any_orthonormal_vector() * chord.length()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULES: [TangentRule; 4] =
        [TangentRule::Uniform, TangentRule::Centripetal, TangentRule::Circle, TangentRule::Helix];

    #[test]
    fn it_passes_through_its_points_and_moves_by_arc_length() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::new(1.5, 1.0, 0.3), DVec3::new(0.0, 3.0, 1.0)];
        for rule in RULES {
            let spline = Spline::through(&points, rule);
            for (point, &s) in points.iter().zip(spline.arc_lengths()) {
                assert!(spline.at(s).0.distance(*point) < 1e-12);
            }
            let n = 1000;
            let at = |i: usize| spline.at(spline.length() * i as f64 / f64::from(n)).0;
            let walked: f64 = (0..n as usize).map(|i| at(i).distance(at(i + 1))).sum();
            assert!((walked / spline.length() - 1.0).abs() < 1e-4, "{rule:?}");
        }
    }

    #[test]
    fn circle_tangents_are_exact_on_unevenly_sampled_circles() {
        let angles = [0.0, 0.3, 1.0, 1.1, 2.0_f64];
        let points: Vec<_> = angles.iter().map(|a| DVec3::new(a.cos(), a.sin(), 0.0)).collect();
        let spline = Spline::through(&points, TangentRule::Circle);
        for (i, tangent) in spline.tangents().enumerate().skip(1).take(3) {
            assert!(tangent.dot(points[i]).abs() < 1e-14);
        }
    }

    #[test]
    fn doubling_back_gives_a_tangent_across() {
        for rule in RULES {
            let spline = Spline::through(&[DVec3::ZERO, DVec3::X, DVec3::ZERO], rule);
            let tangent = spline.tangents().nth(1).expect("three tangents");
            assert!(tangent.x.abs() < 1e-15 && (tangent.length() - 1.0).abs() < 1e-15);
            assert!(spline.length().is_finite());
        }
    }
}
