//! Period skipping, [CC 3.4]: a hair through only some of its points.
//!
//! The points left are joined by the uniform Catmull-Rom spline of [CC 3.1.1], with its ends'
//! weighted slopes, and every point left out is put on that spline, so that a hair has as many
//! points as before. The first two and the last are always left: the first two carry the hair's
//! tangent over from the loosely guided region.

use glam::DVec3;
use rand::{Rng, RngExt};
use tress_geometry::curves::hermite;

use crate::{Skip, SkipUnit};

/// Work space of [`skip_periods`], kept from hair to hair.
#[derive(Clone, Debug, Default)]
pub struct SkipScratch {
    kept: Vec<usize>,
    points: Vec<DVec3>,
}

/// Moves the points that `skip` leaves out onto the spline through the others; the first two and
/// the last stay. A turn of the hair takes `points_per_turn` points, 1 or more. A probability above
/// 1 counts as 1, one that is no number as 0.
pub fn skip_periods(
    hair: &mut [DVec3],
    skip: &Skip,
    points_per_turn: f64,
    rng: &mut impl Rng,
    scratch: &mut SkipScratch,
) {
    let n = hair.len();
    if skip.probability.is_nan() || skip.probability <= 0.0 || n < 4 {
        return;
    }
    let probability = skip.probability.min(1.0);
    scratch.kept.clear();
    scratch.kept.extend([0, 1]);
    match skip.each {
        SkipUnit::Points => {
            scratch.kept.extend((2..n - 1).filter(|_| !rng.random_bool(probability)));
        }
        SkipUnit::Turns => {
            // Hairs of a wisp begin their turns at different places.
            let start = rng.random::<f64>() * points_per_turn;
            let mut turn = -1;
            let mut skipped = false;
            for i in 2..n - 1 {
                let here = whole((i as f64 + start) / points_per_turn);
                if here != turn {
                    (turn, skipped) = (here, rng.random_bool(probability));
                }
                if !skipped {
                    scratch.kept.push(i);
                }
            }
        }
    }
    scratch.kept.push(n - 1);
    scratch.points.clear();
    scratch.points.extend(scratch.kept.iter().map(|i| hair[*i]));
    for (k, ends) in scratch.kept.windows(2).enumerate() {
        let gap = ends[1] - ends[0];
        if gap < 2 {
            continue;
        }
        let spline = [scratch.points[k], scratch.points[k + 1]];
        let slopes = [slope(&scratch.points, k), slope(&scratch.points, k + 1)];
        for (i, place) in hair[ends[0] + 1..ends[1]].iter_mut().enumerate() {
            *place = hermite(spline, slopes, (i + 1) as f64 / gap as f64);
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "at most the points of a hair")]
fn whole(turns: f64) -> i64 {
    turns as i64
}

/// The derivative of [CC 3.1.1] at point `k` of three or more.
fn slope(p: &[DVec3], k: usize) -> DVec3 {
    let last = p.len() - 1;
    let middle = |k: usize| 0.5 * (p[k + 1] - p[k - 1]);
    match k {
        0 if last > 2 => 2.0 * middle(1) - middle(2),
        k if k == last && last > 2 => 2.0 * middle(last - 1) - middle(last - 2),
        0 => p[1] - p[0],
        k if k == last => p[last] - p[last - 1],
        k => middle(k),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use tress_edit::strand_rng;

    use super::*;

    fn coil(n: u32) -> Vec<DVec3> {
        let at = |i| {
            let (sine, cosine) = (f64::from(i) * TAU / 5.0).sin_cos();
            DVec3::new(0.1 * f64::from(i), cosine, sine)
        };
        (0..n).map(at).collect()
    }

    fn skipped(probability: f64, each: SkipUnit, hair: &[DVec3], seed: u64) -> Vec<DVec3> {
        let mut hair = hair.to_vec();
        let mut scratch = SkipScratch::default();
        let skip = Skip { probability, each };
        skip_periods(&mut hair, &skip, 5.0, &mut strand_rng(seed, 0), &mut scratch);
        hair
    }

    #[test]
    fn nothing_skipped_is_nothing_changed() {
        for each in [SkipUnit::Points, SkipUnit::Turns] {
            for nothing in [0.0, -1.0, f64::NAN] {
                assert_eq!(skipped(nothing, each, &coil(60), 1), coil(60));
            }
            assert_eq!(skipped(7.0, each, &coil(60), 1), skipped(1.0, each, &coil(60), 1));
        }
        for n in 0..4 {
            assert_eq!(skipped(1.0, SkipUnit::Points, &coil(n), 1), coil(n));
        }
    }

    #[test]
    fn everything_skipped_leaves_the_ends() {
        let hair = coil(60);
        let out = skipped(1.0, SkipUnit::Points, &hair, 1);
        assert_eq!((out[0], out[1], out[59]), (hair[0], hair[1], hair[59]));
        let n_same = out.iter().zip(&hair).filter(|(a, b)| a == b).count();
        assert_eq!(n_same, 3);
        assert_eq!(skipped(1.0, SkipUnit::Turns, &hair, 1), out);
    }

    #[test]
    fn points_are_left_out_as_often_as_said() {
        let hair = coil(10_000);
        for (probability, each) in
            [(0.25, SkipUnit::Points), (0.75, SkipUnit::Points), (0.5, SkipUnit::Turns)]
        {
            let out = skipped(probability, each, &hair, 3);
            let moved = out.iter().zip(&hair).filter(|(a, b)| a != b).count();
            let share = moved as f64 / 10_000.0;
            assert!((share - probability).abs() < 0.03, "{probability} {each:?}: {share}");
        }
    }

    #[test]
    fn a_skipped_turn_runs_along_the_coil() {
        let hair = coil(200);
        let out = skipped(0.4, SkipUnit::Turns, &hair, 2);
        // Runs of points that moved are whole turns.
        let moved: Vec<bool> = out.iter().zip(&hair).map(|(a, b)| a != b).collect();
        let runs: Vec<usize> = moved.split(|m| !m).map(<[bool]>::len).filter(|n| *n > 0).collect();
        assert!(runs[1..runs.len() - 1].iter().all(|n| n % 5 == 0), "{runs:?}");
        let length = tress_geometry::polyline::length;
        assert!(length(&out) < 0.8 * length(&hair));
        assert!(out.iter().all(|p| p.y.hypot(p.z) < 1.2));
    }
}
