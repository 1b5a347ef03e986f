//! A function of one variable, drawn by hand as a few points.
//!
//! Between the points it is a cubic that goes no higher and no lower than they do: Fritsch and
//! Carlson, "Monotone piecewise cubic interpolation", SIAM J. Numer. Anal. 17(2), 1980, with the
//! slopes of Fritsch and Butland (1984). Outside the points it keeps the nearest's value.

use serde::{Deserialize, Serialize};
use tress_geometry::curves::hermite;

/// Points `(t, value)` of a smooth function, in RON a list of pairs.
///
/// ```
/// use tress_grow::Curve;
///
/// let narrowing: Curve = ron::from_str("[(0.0, 0.5), (0.6, 0.2), (1.0, 0.2)]")?;
/// assert_eq!((narrowing.at(0.0), narrowing.at(0.8), narrowing.at(2.0)), (0.5, 0.2, 0.2));
/// assert!(0.2 < narrowing.at(0.3) && narrowing.at(0.3) < 0.5);
/// assert!(ron::from_str::<Curve>("[(1.0, 0.5), (0.0, 0.2)]").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<(f64, f64)>", into = "Vec<(f64, f64)>")]
pub struct Curve {
    // Invariant: one at least, ascending in `t`, all finite.
    knots: Vec<(f64, f64)>,
    slopes: Vec<f64>,
}

/// Points that are no function: none, not ascending, or not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a curve is one point (t, value) or more, finite and ascending in t; point {point} is not")]
pub struct CurveError {
    /// The first point that is not.
    pub point: usize,
}

impl Curve {
    /// The curve through points that ascend in `t`.
    ///
    /// # Errors
    ///
    /// If there is none, or if they do not ascend or are not finite.
    pub fn new(knots: Vec<(f64, f64)>) -> Result<Self, CurveError> {
        let broken = |i: usize| {
            let (t, value) = knots[i];
            !(t.is_finite() && value.is_finite()) || (0 < i && t <= knots[i - 1].0)
        };
        if knots.is_empty() {
            return Err(CurveError { point: 0 });
        }
        if let Some(point) = (0..knots.len()).find(|i| broken(*i)) {
            return Err(CurveError { point });
        }
        let secants: Vec<f64> =
            knots.windows(2).map(|k| (k[1].1 - k[0].1) / (k[1].0 - k[0].0)).collect();
        let slope = |i: usize| match (i.checked_sub(1).map(|j| secants[j]), secants.get(i)) {
            (Some(a), Some(&b)) if 0.0 < a * b => {
                let (h, k) = (knots[i].0 - knots[i - 1].0, knots[i + 1].0 - knots[i].0);
                let w = (h + 2.0 * k) / (3.0 * (h + k));
                a * b / (w * b + (1.0 - w) * a)
            }
            // Turning points and ends lie flat.
            _ => 0.0,
        };
        Ok(Self { slopes: (0..knots.len()).map(slope).collect(), knots })
    }

    /// The same value everywhere.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self { knots: vec![(0.0, value)], slopes: vec![0.0] }
    }

    /// Its value at `t`.
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        let i = self.knots.partition_point(|knot| knot.0 <= t);
        let Some(&(t0, a)) = i.checked_sub(1).and_then(|before| self.knots.get(before)) else {
            return self.knots[0].1;
        };
        let Some(&(t1, b)) = self.knots.get(i) else { return a };
        let (span, u) = (t1 - t0, (t - t0) / (t1 - t0));
        hermite([a, b], [span * self.slopes[i - 1], span * self.slopes[i]], u)
    }

    /// Its points.
    #[must_use]
    pub fn knots(&self) -> &[(f64, f64)] {
        &self.knots
    }
}

impl TryFrom<Vec<(f64, f64)>> for Curve {
    type Error = CurveError;
    fn try_from(knots: Vec<(f64, f64)>) -> Result<Self, CurveError> {
        Self::new(knots)
    }
}

impl From<Curve> for Vec<(f64, f64)> {
    fn from(curve: Curve) -> Self {
        curve.knots
    }
}

/// 0 below 0, 1 above 1, and between them a cubic with flat ends.
pub(crate) fn smoothstep(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_passes_through_its_points_and_never_beyond_them() {
        let knots = vec![(0.0, 1.0), (0.1, 0.2), (0.5, 0.21), (0.6, 3.0), (1.0, 0.0)];
        let curve = Curve::new(knots.clone()).expect("ascending");
        for pair in knots.windows(2) {
            assert!((curve.at(pair[0].0) - pair[0].1).abs() < 1e-15);
            let (low, high) = (pair[0].1.min(pair[1].1), pair[0].1.max(pair[1].1));
            for i in 0..=50 {
                let t = pair[0].0 + (pair[1].0 - pair[0].0) * f64::from(i) / 50.0;
                assert!((low - 1e-12..=high + 1e-12).contains(&curve.at(t)), "{t}");
            }
        }
    }

    #[test]
    fn broken_curves_are_refused() {
        assert_eq!(Curve::new(vec![]), Err(CurveError { point: 0 }));
        assert_eq!(Curve::new(vec![(0.0, 1.0), (0.0, 2.0)]), Err(CurveError { point: 1 }));
        assert_eq!(Curve::new(vec![(0.0, f64::NAN)]), Err(CurveError { point: 0 }));
    }
}
