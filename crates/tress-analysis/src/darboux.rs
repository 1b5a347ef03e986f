//! The Darboux vector of a strand and how it stands to the centerline: beta [CSE 14].
//!
//! `beta = c' . W / |W|` with `W = tau t + kappa b` the Darboux vector and `c'` the unit tangent of
//! the centerline. Taken point by point it beats with the sampling and jumps with frizz. Here
//! positions are first averaged over an eighth of a turn, twice, torsion over a quarter, and beta
//! over the turn as `<c' . W> / <|W|>`: 1 on a right-handed coil whatever its pitch, -1 on a
//! left-handed one, 0 on a wave in a plane, whose binormal flips.

use glam::DVec3;

use crate::Winding;
use crate::winding::{half_window, turn_means};

/// Beta at the stations of a winding, and the curvature there where the strand does not wind.
pub(crate) fn beta(positions: &[DVec3], winding: &Winding) -> Vec<f64> {
    let periods = winding.periods();
    let vectors = darboux(positions, &periods, winding.spacing);
    let products: Vec<DVec3> = vectors
        .iter()
        .zip(&winding.direction)
        .map(|(w, t)| DVec3::new(w.dot(*t), w.length(), 0.0))
        .collect();
    let share = |mean: DVec3| if 0.0 < mean.y { (mean.x / mean.y).clamp(-1.0, 1.0) } else { 0.0 };
    turn_means(&products, &periods).into_iter().map(share).collect()
}

/// Curvature of a strand that does not wind: the mean bend over a window of stations.
pub(crate) fn bend(positions: &[DVec3], spacing: f64, window: f64) -> Vec<f64> {
    let periods = vec![window; positions.len()];
    let bend = |k: usize| derivatives(positions, k, 1).map_or(DVec3::ZERO, binormal);
    let bends: Vec<DVec3> = (0..positions.len()).map(bend).collect();
    turn_means(&bends, &periods).into_iter().map(|b| b.length() / spacing).collect()
}

/// The Darboux vector at each station, in one over length.
fn darboux(positions: &[DVec3], periods: &[f64], spacing: f64) -> Vec<DVec3> {
    let share = |part: f64| -> Vec<f64> { periods.iter().map(|p| part * p).collect() };
    let eighth = share(0.125);
    let smooth = turn_means(&turn_means(positions, &eighth), &eighth);
    let at = |k: usize| {
        let step = half_window(eighth[k]);
        derivatives(&smooth, k, step).unwrap_or([DVec3::ZERO; 3])
    };
    let all: Vec<[DVec3; 3]> = (0..positions.len()).map(at).collect();
    // Torsion is det(r', r'', r''') over |r' x r''|^2, each averaged: it does not blow up where
    // the strand is straight for a moment.
    let torsion: Vec<DVec3> = all
        .iter()
        .map(|[d1, d2, d3]| {
            let cross = d1.cross(*d2);
            DVec3::new(cross.dot(*d3), cross.length_squared(), 0.0)
        })
        .collect();
    let torsion = turn_means(&torsion, &share(0.25));
    all.iter()
        .zip(torsion)
        .map(|(d, mean)| {
            let torsion = if 0.0 < mean.y { mean.x / mean.y } else { 0.0 };
            // By the station; positions stand `spacing` apart.
            let speed = d[0].length();
            let tangent = d[0].normalize_or_zero();
            (tangent * (torsion * speed) + binormal(*d) * speed) / spacing
        })
        .collect()
}

/// Curvature times binormal, by the length that the derivatives are taken along.
fn binormal([d1, d2, _]: [DVec3; 3]) -> DVec3 {
    let speed = d1.length();
    if 0.0 < speed { d1.cross(d2) / (speed * speed * speed) } else { DVec3::ZERO }
}

/// The first three derivatives by the station, over `step` stations; as near the ends as they can
/// be taken, `None` where there are fewer than five stations.
fn derivatives(p: &[DVec3], k: usize, step: usize) -> Option<[DVec3; 3]> {
    let a = step.min(p.len().checked_sub(1)? / 4);
    if a == 0 {
        return None;
    }
    let k = k.clamp(2 * a, p.len() - 1 - 2 * a);
    let h = a as f64;
    let first = (p[k + a] - p[k - a]) / (2.0 * h);
    let second = (p[k + a] - 2.0 * p[k] + p[k - a]) / (h * h);
    let third = (p[k + 2 * a] - 2.0 * p[k + a] + 2.0 * p[k - a] - p[k - 2 * a]) / (2.0 * h * h * h);
    Some([first, second, third])
}
