//! The Darboux vector of a strand and how it stands to the centerline: beta [CSE 14].
//!
//! `beta = c' . W / |W|` with `W = tau t + kappa b` the Darboux vector and `c'` the unit tangent of
//! the centerline. Taken point by point it beats with the sampling and jumps with frizz. Here
//! positions are first averaged over an eighth of a turn, twice, torsion over a quarter, and beta
//! over the turn as `<c' . W> / <|W|>`: 1 on a right-handed coil whatever its pitch, -1 on a
//! left-handed one, 0 on a wave in a plane, whose binormal flips.
//!
//! It is told twice: against the centerline of the [`Winding`], which follows the strand's bends
//! turn by turn, and against the published one [CC 3.2.1], a low-pass that has two cycles at most
//! from root to tip.

use glam::DVec3;
use tress_fit::fourier_centerline;

use crate::Winding;
use crate::winding::{half_window, turn_means};

/// Of so many stations one is enough for a line of two cycles: it leaves four a turn, so that the
/// coil is not mistaken for something slower.
const THINNED: usize = 8;

/// Beta at the stations of a winding: against its own centerline, and against the published one.
pub(crate) fn betas(positions: &[DVec3], winding: &Winding) -> [Vec<f64>; 2] {
    let periods = winding.periods();
    let vectors = darboux(positions, &periods, winding.spacing);
    let published = fourier_tangents(positions);
    let products: Vec<DVec3> = vectors
        .iter()
        .zip(winding.direction.iter().zip(&published))
        .map(|(w, (t, f))| DVec3::new(w.dot(*t), w.dot(*f), w.length()))
        .collect();
    let means = turn_means(&products, &periods);
    let beta = |along: fn(&DVec3) -> f64| {
        let share = |m: &DVec3| if 0.0 < m.z { (along(m) / m.z).clamp(-1.0, 1.0) } else { 0.0 };
        means.iter().map(share).collect()
    };
    [beta(|mean| mean.x), beta(|mean| mean.y)]
}

/// Unit tangents of the published centerline at the stations.
fn fourier_tangents(positions: &[DVec3]) -> Vec<DVec3> {
    let thinned: Vec<DVec3> = positions.iter().step_by(THINNED).copied().collect();
    // Stations are finite and not all in one place.
    let Ok(line) = fourier_centerline(&thinned) else { return vec![DVec3::ZERO; positions.len()] };
    let tangents: Vec<DVec3> = line.frames().iter().map(|frame| frame.tangent()).collect();
    let at = |k: usize| {
        let (i, rest) = (k / THINNED, k % THINNED);
        let next = tangents[(i + 1).min(tangents.len() - 1)];
        tangents[i].lerp(next, rest as f64 / THINNED as f64).normalize_or_zero()
    };
    (0..positions.len()).map(at).collect()
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
