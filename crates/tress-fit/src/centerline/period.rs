//! How many points a turn of a coil takes.
//!
//! The steps `x_i = p_(i+m) - p_i` of a coil come back after a turn, whatever the direction of
//! its axis. The lag `k` at which they differ least is found as the pitch of a voice is, by de
//! Cheveigne and Kawahara, "YIN, a fundamental frequency estimator", JASA 111(4), 2002: with
//! `d(k)` the mean of `|x_(i+k) - x_i|^2`, the normalised `d'(k) = d(k) / mean of d over 1..=k`
//! dips at every whole number of turns, and the first dip that is about as deep as the deepest
//! is one turn. Steps over a quarter of a turn, `m`, stand out of noise best.

use glam::DVec3;

/// Longer strands are thinned to about so many steps, which bounds the time; 40 turns are then
/// still 10 steps each.
const MOST_STEPS: usize = 400;

/// Lags up to this share of the strand are looked at: a coil has 1.25 turns at least.
const GREATEST_LAG: f64 = 0.8;

/// A dip less deep than this is none: the steps do not come back.
const COIL: f64 = 0.5;

/// A first dip may be so much less deep than the deepest. Less, and two turns are taken for one
/// where the coil changes; more, and half a turn is, where it is flat.
const NEAR_DEEPEST: f64 = 0.15;

/// Points in one turn of the coil, a fraction counted; `None` where there is no coil.
pub(super) fn coil_period(points: &[DVec3]) -> Option<f64> {
    let stride = points.len().div_ceil(MOST_STEPS);
    let first = stride as f64 * step_period(points, stride, stride)?;
    // A turn of which a quarter is less than two points has nothing to be gained.
    let quarter = whole(first / 4.0);
    if quarter <= stride {
        return Some(first);
    }
    step_period(points, stride, quarter).map_or(Some(first), |period| Some(stride as f64 * period))
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "less than the points")]
fn whole(points: f64) -> usize {
    points as usize
}

/// The first dip of `d'`, in strides, of steps over `span` points taken every `stride`.
fn step_period(points: &[DVec3], stride: usize, span: usize) -> Option<f64> {
    let ends = points.iter().skip(span).step_by(stride);
    let x: Vec<DVec3> = points.iter().step_by(stride).zip(ends).map(|(a, b)| *b - *a).collect();
    let greatest = whole(x.len() as f64 * GREATEST_LAG);
    if greatest < 3 {
        return None;
    }
    let mut dips = vec![1.0];
    let mut sum = 0.0;
    for k in 1..=greatest {
        let squares = x[k..].iter().zip(&x).map(|(a, b)| a.distance_squared(*b));
        let d = squares.sum::<f64>() / (x.len() - k) as f64;
        sum += d;
        dips.push(if sum > 0.0 { d * k as f64 / sum } else { 1.0 });
    }
    let deepest = dips.iter().copied().fold(f64::INFINITY, f64::min);
    if COIL < deepest {
        return None;
    }
    let is_dip = |&k: &usize| dips[k] <= deepest + NEAR_DEEPEST && dips[k] <= dips[k + 1];
    let Some(k) = (2..greatest).find(is_dip) else { return Some(greatest as f64) };
    // The vertex of the parabola through the dip and its neighbours.
    let (a, b, c) = (dips[k - 1], dips[k], dips[k + 1]);
    let bend = a - 2.0 * b + c;
    let beyond = if 0.0 < bend { (0.5 * (a - c) / bend).clamp(-0.5, 0.5) } else { 0.0 };
    Some(k as f64 + beyond)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coil(n: usize, period: f64, noise: f64) -> Vec<DVec3> {
        let at = |i: usize| {
            let (sine, cosine) = (std::f64::consts::TAU * i as f64 / period).sin_cos();
            // Neither regular nor random: no period of its own.
            let rough = (i as f64 * i as f64 * 0.7311).sin() * noise;
            DVec3::new(cosine + rough, 2.0 * i as f64 / period - rough, sine + rough)
        };
        (0..n).map(at).collect()
    }

    #[test]
    fn periods_are_found_at_every_density_and_through_noise() {
        for period in [4.2, 5.0, 8.37, 31.4] {
            for turns in [2.0, 4.5, 20.37] {
                for noise in [0.0, f64::min(0.02 * turns, 0.2)] {
                    let points = coil(whole(period * turns) + 1, period, noise);
                    let found = coil_period(&points).expect("a coil");
                    assert!((found / period - 1.0).abs() < 0.15, "{period} {turns}: {found}");
                }
            }
        }
    }

    #[test]
    fn thinned_strands_keep_their_period() {
        let found = coil_period(&coil(5000, 150.0, 0.0)).expect("a coil");
        assert!((found / 150.0 - 1.0).abs() < 0.02, "{found}");
    }

    #[test]
    fn lines_bows_and_short_strands_are_no_coils() {
        let line: Vec<_> = (0..50).map(|i| DVec3::X * f64::from(i)).collect();
        assert_eq!(coil_period(&line), None);
        let bow = coil(50, 90.0, 0.0);
        assert_eq!(coil_period(&bow), None);
        for n in 1..4 {
            assert_eq!(coil_period(&coil(n, 3.0, 0.0)), None);
        }
    }
}
