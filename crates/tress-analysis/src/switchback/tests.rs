use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::*;

/// A coil about x that turns by `rate(turn)` (1 or -1 as a rule) where it has gone `turn` turns,
/// its radius times `swell(turn)`: 16 turns of 10 points.
fn coil(rate: impl Fn(f64) -> f64, swell: impl Fn(f64) -> f64, noise: f64) -> Vec<DVec3> {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let mut stray = || (rng.random::<f64>() - 0.5) * 2.0 * noise * 0.5;
    let mut phase = 0.0;
    let fine = 40;
    let mut points = Vec::new();
    for i in 0..=16 * fine {
        let turn = f64::from(i) / f64::from(fine);
        phase += TAU * rate(turn) / f64::from(fine);
        if i % 4 == 0 {
            let radius = 0.5 * swell(turn);
            let (sine, cosine) = phase.sin_cos();
            let stray = DVec3::new(stray(), stray(), stray());
            points.push(DVec3::new(0.6 * turn, radius * cosine, radius * sine) + stray);
        }
    }
    points
}

fn found(points: &[DVec3]) -> Vec<Switchback> {
    Winding::of_polyline(points).map_or(vec![], |w| switchbacks(&w, 7))
}

#[test]
fn changes_of_hand_are_found_where_they_are() {
    for noise in [0.0, 0.05, 0.1] {
        for at in [3.0, 8.0, 12.5] {
            let points = coil(|turn| if turn < at { 1.0 } else { -1.0 }, |_| 1.0, noise);
            let found = found(&points);
            let [one] = found[..] else { panic!("{at} {noise}: {found:?}") };
            assert_eq!((one.strand, one.before, one.behind), (7, Hand::Right, Hand::Left));
            assert!(0.8 < one.confidence);
            let turns = one.arc_length / (TAU * 0.5).hypot(0.6);
            assert!((turns - at).abs() < 0.5, "{at} {noise}: {turns}");
        }
    }
}

#[test]
fn two_changes_are_two() {
    let hand = |turn: f64| if (5.0..9.0).contains(&turn) { -1.0 } else { 1.0 };
    let found = found(&coil(hand, |_| 1.0, 0.05));
    let hands: Vec<Hand> = found.iter().map(|s| s.behind).collect();
    assert_eq!(hands, [Hand::Left, Hand::Right]);
}

#[test]
fn skipped_periods_waves_and_frizz_are_no_switchbacks() {
    let skipped = |turn: f64| if (7.0..8.0).contains(&turn) { 0.0 } else { 1.0 };
    let straight = |turn: f64| 1.0 - 0.98 * (-(turn - 8.0) * (turn - 8.0)).exp();
    let wave: Vec<DVec3> = (0..160)
        .map(|i| 0.1 * f64::from(i))
        .map(|turn| DVec3::new(1.5 * turn, 0.4 * (TAU * turn).sin(), 0.02 * turn.sin()))
        .collect();
    for noise in [0.0, 0.1] {
        assert_eq!(found(&coil(skipped, |_| 1.0, noise)), []);
        assert_eq!(found(&coil(|_| 1.0, straight, noise)), []);
        assert_eq!(found(&coil(|_| -1.0, |_| 1.0, noise)), []);
    }
    assert_eq!(found(&wave), []);
}
