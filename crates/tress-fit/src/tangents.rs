//! Derivatives at the points of a polyline that was taken from a coil.
//!
//! A helix of radius `r` that climbs `h` a radian, sampled every `phi` radians, has at a point with
//! normal `n`, tangential direction `e` and axis `a` the central differences
//!
//! `c1 = p[1] - p[-1] = 2 (r sin phi e + h phi a)`,
//! `c2 = p[2] - p[-2] = 2 (r sin 2 phi e + 2 h phi a)`,
//! `s1 = p[1] - 2 p + p[-1] = -2 r (1 - cos phi) n`,
//! `s2 = p[2] - 2 p + p[-2] = 2 (1 + cos phi) s1`,
//!
//! so that the derivative by the index, `phi (r e + h a)`, is
//!
//! `c1 / 2 - f(phi) (c2 - 2 c1)`, `f = (phi - sin phi) / (4 sin phi (1 - cos phi))`,
//!
//! exactly. For small `phi` this is the five-point formula `(8 c1 - c2) / 12`. A Catmull-Rom
//! tangent is `c1 / 2`: it climbs `phi / sin phi` times too steeply, an error that the torsion of
//! the arcs does not outgrow however dense the points are.

use glam::{DQuat, DVec3};

/// Segments that differ more than so many times in length are not an even sampling.
const EVEN: f64 = 1.5;

/// Larger steps than this, in radians, are taken for it: beyond 2.5 points a turn they alias.
const GREATEST_STEP: f64 = 2.5;

/// The derivative by the index at point `i`, as if the points around it were an even sampling of
/// a helix; `None` where they are too few or too uneven for that.
pub(crate) fn helix_derivative(points: &[DVec3], i: usize) -> Option<DVec3> {
    let n = points.len();
    if 2 <= i && i + 2 < n {
        return central(points[i - 2..=i + 2].try_into().ok()?);
    }
    if n < 4 {
        return None;
    }
    if i < 2 {
        return near_end(points[..4].try_into().ok()?, i);
    }
    let mut last: [DVec3; 4] = points[n - 4..].try_into().ok()?;
    last.reverse();
    near_end(&last, n - 1 - i).map(|derivative| -derivative)
}

/// At the middle of five points.
fn central(p: &[DVec3; 5]) -> Option<DVec3> {
    even(p)?;
    let (c1, c2) = (p[3] - p[1], p[4] - p[0]);
    let (s1, s2) = (p[3] - 2.0 * p[2] + p[1], p[4] - 2.0 * p[2] + p[0]);
    let cosine = s1.dot(s2) / (2.0 * s1.length_squared()) - 1.0;
    Some(0.5 * c1 - factor(angle(cosine)) * (c2 - 2.0 * c1))
}

/// At the first or second of four points: the helix through all four.
fn near_end(p: &[DVec3; 4], i: usize) -> Option<DVec3> {
    even(p)?;
    let (s1, s2) = (p[2] - 2.0 * p[1] + p[0], p[3] - 2.0 * p[2] + p[1]);
    let axis = s1.cross(s2).try_normalize()?;
    let phi = angle(s1.dot(s2) / (s1.length() * s2.length()));
    // With r = |s1| / (2 (1 - cos phi)), what c1 / 2 lacks along e is (phi - sin phi) r.
    let lack = if phi < 1e-3 { phi / 6.0 } else { (phi - phi.sin()) / (2.0 * (1.0 - phi.cos())) };
    // The normal points away from the axis, along -s1.
    let e = s1.cross(axis).try_normalize()?;
    let second = 0.5 * (p[2] - p[0]) + lack * s1.length() * e;
    if i == 1 { Some(second) } else { Some(DQuat::from_axis_angle(axis, -phi) * second) }
}

/// The angle of a cosine, held where sampling does not alias.
fn angle(cosine: f64) -> f64 {
    if cosine.is_finite() { cosine.clamp(-1.0, 1.0).acos().min(GREATEST_STEP) } else { 0.0 }
}

/// `f(phi)`.
fn factor(phi: f64) -> f64 {
    if phi < 0.02 {
        let y = phi * phi;
        return (1.0 + y * (0.2 + y * (11.0 / 420.0))) / 12.0;
    }
    let (sine, cosine) = phi.sin_cos();
    (phi - sine) / (4.0 * sine * (1.0 - cosine))
}

fn even(p: &[DVec3]) -> Option<()> {
    let chords = p.windows(2).map(|ends| ends[0].distance_squared(ends[1]));
    let (least, most) =
        chords.fold((f64::INFINITY, 0.0), |(l, m), c| (f64::min(l, c), f64::max(m, c)));
    (most <= EVEN * EVEN * least).then_some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn helices_are_exact_at_every_point() {
        for (rise, step) in [(0.05, 1.3), (0.4, 0.7), (-2.0, 1.2), (0.3, 2.0), (0.1, 0.03)] {
            let at = |i: i32| {
                let a = 0.3 + step * f64::from(i);
                DVec3::new(a.cos(), a.sin(), rise * a)
            };
            let points: Vec<_> = (0..9).map(at).collect();
            for (i, p) in points.iter().enumerate() {
                let exact = step * DVec3::new(-p.y, p.x, rise);
                let found = helix_derivative(&points, i).expect("an even sampling");
                assert!(found.distance(exact) < 1e-10, "{rise} {step} {i}: {found} {exact}");
            }
        }
    }

    #[test]
    fn series_meets_closed_form() {
        let (below, above) = (factor(0.02 - 1e-15), factor(0.02));
        assert!((below - above).abs() < 1e-11, "{below} {above}");
    }

    #[test]
    fn bends_that_only_grow_stay_finite() {
        // Second differences along one line but for rounding: an angle of 0, and no axis.
        let at = |i: i32| {
            let x = 0.1 * f64::from(i);
            DVec3::new(x, 0.3 * (2.0 * x).sin(), 0.0)
        };
        let wave: Vec<_> = (0..40).map(at).collect();
        let along = |d: DVec3, x: f64| (d.y / d.x - 0.6 * (2.0 * x).cos()).abs() < 0.05;
        for i in 0..wave.len() {
            if let Some(d) = helix_derivative(&wave, i) {
                assert!(d.is_finite() && along(d, wave[i].x), "{i}: {d}");
            }
        }
    }

    #[test]
    fn straight_doubled_and_uneven_points_stay_finite() {
        let line: Vec<_> = (0..6).map(|i| DVec3::X * f64::from(i)).collect();
        for i in 0..6 {
            assert!(helix_derivative(&line, i).is_none_or(|d| d.distance(DVec3::X) < 1e-14));
        }
        let jagged: Vec<_> = (0..6).map(|i| DVec3::X * f64::from(i % 2)).collect();
        assert!((0..6).filter_map(|i| helix_derivative(&jagged, i)).all(DVec3::is_finite));
        let uneven = [0.0, 1.0, 2.0, 30.0, 31.0].map(|x| DVec3::X * x);
        assert_eq!(helix_derivative(&uneven, 2), None);
        assert_eq!(helix_derivative(&uneven[..3], 1), None);
    }
}
