use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::*;

/// A helix about x, of so many points a turn.
fn helix(radius: f64, pitch: f64, turns: f64, per_turn: f64) -> Vec<DVec3> {
    about_line(turns, per_turn, |turn| {
        let (sine, cosine) = (TAU * turn).sin_cos();
        DVec3::new(pitch * turn, radius * cosine, radius * sine)
    })
}

fn about_line(turns: f64, per_turn: f64, at: impl Fn(f64) -> DVec3) -> Vec<DVec3> {
    let n = (turns * per_turn).round();
    let mut points = Vec::new();
    let mut i = 0.0;
    while i <= n {
        points.push(at(i / per_turn));
        i += 1.0;
    }
    points
}

fn wind(points: &[DVec3]) -> Winding {
    Winding::of_polyline(points).expect("it winds")
}

/// The greatest relative difference to a value, over the stations.
fn worst(values: &[f64], expected: f64) -> f64 {
    values.iter().map(|v| (v / expected - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn helices_of_any_sampling_are_known_to_a_thousandth() {
    for per_turn in [4.0, 5.0, 8.0, 16.0, 32.0, 64.0] {
        for (pitch, turns) in [(0.5, 20.0), (-3.0, 8.0), (6.0, 9.0)] {
            let w = wind(&helix(0.5, pitch, turns, per_turn));
            let middle = w.rate.len() / 2;
            let turn = (TAU * 0.5).hypot(pitch);
            let advance = pitch.abs() / turn;
            let allowed = 1e-3;
            assert!((w.turns() / turns - 1.0).abs() < 1e-3, "{per_turn} {pitch}: {}", w.turns());
            assert!((w.radius[middle] / 0.5 - 1.0).abs() < allowed, "{per_turn} {pitch}");
            assert!((w.advance[middle] / advance - 1.0).abs() < allowed, "{per_turn} {pitch}");
            assert!(worst(&w.circularity, pitch.signum()) < 5e-3, "{per_turn} {pitch}");
        }
    }
}

#[test]
fn few_turns_are_counted_to_a_percent_or_two() {
    for (turns, allowed) in [(1.5, 0.03), (2.0, 0.02), (2.5, 0.02), (3.0, 0.01), (4.4, 0.01)] {
        let w = wind(&helix(0.5, 0.5, turns, 16.0));
        assert!((w.turns() / turns - 1.0).abs() < allowed, "{turns}: {}", w.turns());
    }
}

#[test]
fn a_circle_goes_round_but_neither_way() {
    let w = wind(&helix(0.5, 0.0, 3.0, 16.0));
    assert!((w.turns() - 3.0).abs() < 3e-3 && worst(&w.radius, 0.5) < 5e-3);
    assert!(w.circularity.iter().all(|c| c.abs() < 1e-9));
    assert!(w.advance.iter().all(|a| *a < 1e-2));
}

#[test]
fn a_planar_wave_turns_without_a_hand() {
    let wave = about_line(8.0, 20.0, |turn| DVec3::new(3.0 * turn, 0.3 * (TAU * turn).sin(), 0.0));
    let w = wind(&wave);
    assert!((w.turns() - 8.0).abs() < 0.8, "{}", w.turns());
    assert!(w.circularity.iter().all(|c| c.abs() < 0.05));
    let middle = w.radius[w.radius.len() / 2];
    assert!((middle - 0.3 / 2_f64.sqrt()).abs() < 0.01, "{middle}");
}

#[test]
fn frizz_does_not_count_as_turning() {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    for (share, allowed) in [(0.05, 2e-3), (0.1, 5e-3), (0.2, 1.5e-2)] {
        let mut noisy = helix(0.5, 0.5, 20.0, 12.0);
        // Of this share of the radius, root mean square.
        let mut stray = || (rng.random::<f64>() - 0.5) * 2.0 * share * 0.5;
        for point in &mut noisy {
            *point += DVec3::new(stray(), stray(), stray());
        }
        let w = wind(&noisy);
        assert!((w.turns() / 20.0 - 1.0).abs() < allowed, "{share}: {}", w.turns());
        assert!(w.circularity.iter().all(|c| 0.85 < *c), "{share}");
        let bending = Stations::through(&noisy).expect("a strand").0.bending / TAU;
        assert!(share < 0.2 || 24.0 < bending, "its bends alone amount to {bending} turns");
    }
}

#[test]
fn a_coil_is_found_where_it_begins_half_way() {
    let half = about_line(20.0, 12.0, |turn| {
        let radius = if turn < 10.0 { 0.0 } else { 0.5 * (1.0 - (2.0 * (10.0 - turn)).exp()) };
        let (sine, cosine) = (TAU * turn).sin_cos();
        DVec3::new(3.0 * turn, radius * cosine, radius * sine)
    });
    let w = wind(&half);
    assert!((w.turns() - 10.0).abs() < 0.8, "{}", w.turns());
    let at = |tenths: usize| tenths * (w.rate.len() - 1) / 10;
    assert_eq!((w.radius[at(2)], w.rate[at(2)]), (0.0, 0.0));
    assert!((w.radius[at(8)] - 0.5).abs() < 0.01 && 0.99 < w.circularity[at(8)]);
}

#[test]
fn coils_about_a_bent_line_keep_their_radius_and_turns() {
    let bent = |turns: f64| {
        about_line(turns, 12.0, move |turn| {
            let along = 3.0 * turn / turns;
            let out = DVec3::new(along.cos(), along.sin(), 0.0);
            let (sine, cosine) = (TAU * turn).sin_cos();
            4.0 * out + 0.5 * (out * cosine + DVec3::Z * sine)
        })
    };
    for (turns, allowed) in [(20.0, 2e-3), (8.0, 5e-3), (4.0, 2e-2)] {
        let w = wind(&bent(turns));
        let middle = w.radius[w.radius.len() / 2];
        assert!((w.turns() / turns - 1.0).abs() < allowed, "{turns}: {}", w.turns());
        assert!((middle / 0.5 - 1.0).abs() < 0.02, "{turns}: {middle}");
    }
}

#[test]
fn nothing_that_goes_round_less_than_once_winds() {
    let line = |n: u32| (0..n).map(|i| DVec3::X * f64::from(i)).collect::<Vec<_>>();
    let arc = about_line(0.6, 30.0, |t| DVec3::new((TAU * t).cos(), (TAU * t).sin(), 0.0));
    for points in [vec![], line(1), line(2), line(30), arc, vec![DVec3::ONE; 5]] {
        assert!(Winding::of_polyline(&points).is_none(), "{} points", points.len());
    }
    for odd in [[DVec3::NAN, DVec3::X], [DVec3::MAX, DVec3::MIN]] {
        assert!(Winding::of_polyline(&odd).is_none());
    }
}

proptest::proptest! {
    #[test]
    fn rigid_motion_and_scale_change_what_they_should(
        angle in -3.0..3.0, shift in -1e3..1e3, scale in 1e-3..1e3_f64,
    ) {
        let strand = helix(0.5, 0.7, 9.3, 9.0);
        let turn = glam::DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), angle);
        let moved: Vec<DVec3> =
            strand.iter().map(|p| turn * *p * scale + DVec3::splat(shift * scale)).collect();
        let (a, b) = (wind(&strand), wind(&moved));
        proptest::prop_assert!((a.turns() - b.turns()).abs() < 1e-6);
        for (x, y) in a.radius.iter().zip(&b.radius) {
            proptest::prop_assert!((x - y / scale).abs() < 1e-6);
        }
    }

    #[test]
    fn no_strand_gives_a_number_that_is_none(
        points in proptest::collection::vec(proptest::array::uniform3(-1.0..1.0_f64), 2..40),
    ) {
        let points: Vec<DVec3> = points.into_iter().map(DVec3::from_array).collect();
        if let Some(w) = Winding::of_polyline(&points) {
            let all = [&w.rate, &w.radius, &w.circularity, &w.advance];
            proptest::prop_assert!(all.iter().all(|c| c.iter().all(|x| x.is_finite())));
        }
    }
}
