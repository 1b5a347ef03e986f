use glam::DVec3;
use tress_geometry::Strands;

use super::*;

/// Coils of a radius, one unit apart, of so many points.
fn coils(radius: f64, points: u32, shift: f64) -> Groom {
    let mut strands = Strands::default();
    for i in 0..5 {
        let at = |k: u32| {
            let turn = 8.0 * f64::from(k) / f64::from(points - 1);
            let (sine, cosine) = (std::f64::consts::TAU * turn).sin_cos();
            DVec3::new(3.0 * f64::from(i) + radius * cosine, 0.8 * turn, shift + radius * sine)
        };
        strands.push((0..points).map(at)).expect("a few points");
    }
    Groom::new(strands)
}

fn apart(a: &Groom, b: &Groom) -> Comparison {
    compare([a, b], [&Analysis::of(a), &Analysis::of(b)])
}

#[test]
fn a_groom_is_not_apart_from_itself() {
    let groom = coils(0.5, 100, 0.0);
    let none = Distances { rms: 0.0, mean: 0.0, greatest: 0.0 };
    let same = apart(&groom, &groom);
    assert_eq!(same.nearest, Some(none));
    let by_index = same.by_index.expect("five strands");
    let all = [by_index.distances, by_index.frechet, by_index.length_change];
    assert_eq!((by_index.strands, all), (5, [none; 3]));
    let d = same.distributions;
    assert_eq!([d.length, d.turns, d.coil_radius, d.pitch, d.spectrum], [Some(0.0); 5]);
}

#[test]
fn a_shift_is_a_shift_by_index_and_no_more_than_one_to_the_nearest() {
    let (a, b) = (coils(0.5, 100, 0.0), coils(0.5, 100, 0.25));
    let shifted = apart(&a, &b);
    let by_index = shifted.by_index.expect("five strands");
    assert!((by_index.distances.rms - 0.25).abs() < 1e-12);
    assert!((by_index.distances.greatest - 0.25).abs() < 1e-12);
    assert!(by_index.frechet.greatest <= 0.25 + 1e-12 && by_index.length_change.greatest < 1e-12);
    let nearest = shifted.nearest.expect("points");
    assert!(0.05 < nearest.rms && nearest.greatest <= 0.25 + 1e-12);
}

#[test]
fn a_wider_coil_is_as_far_in_radius_as_it_is_wider() {
    let wider = apart(&coils(0.5, 120, 0.0), &coils(0.6, 120, 0.0));
    let d = wider.distributions;
    assert!((d.coil_radius.expect("coils") - 0.1).abs() < 2e-3, "{d:?}");
    assert!(d.turns.expect("coils") < 0.05 && d.pitch.expect("coils") < 0.02, "{d:?}");
    let (narrow, wide) =
        ((std::f64::consts::TAU * 0.5).hypot(0.8), (std::f64::consts::TAU * 0.6).hypot(0.8));
    let change = wider.by_index.expect("five strands").length_change;
    assert!((change.mean - (wide / narrow - 1.0)).abs() < 2e-3);
}

#[test]
fn other_samplings_of_one_shape_are_near() {
    let resampled = apart(&coils(0.5, 400, 0.0), &coils(0.5, 257, 0.0));
    let by_index = resampled.by_index.expect("five strands");
    assert!(by_index.distances.greatest < 0.02, "{by_index:?}");
    assert!(resampled.nearest.expect("points").greatest < 0.005);
    let d = resampled.distributions;
    assert!(d.coil_radius.expect("coils") < 1e-3 && d.spectrum.expect("power") < 0.02, "{d:?}");
}

#[test]
fn grooms_without_points_are_compared_too() {
    let none = Groom::new(Strands::default());
    let single = Groom::new(Strands::from_counts([1], vec![DVec3::NAN]).expect("a point"));
    for groom in [&none, &single] {
        let apart = apart(groom, &coils(0.5, 50, 0.0));
        assert_eq!((apart.nearest, apart.by_index, apart.distributions.length), (None, None, None));
    }
    let [none, one] = [discrete_frechet(&[], &[]), discrete_frechet(&[DVec3::X], &[])];
    assert!(none.abs() < 1e-300 && one.is_infinite());
}

#[test]
fn either_walker_may_wait_for_the_other() {
    let long = [0.0, 1.0, 2.0, 3.0].map(|x| DVec3::X * x);
    let short = [long[0], long[3]];
    for (a, b) in [(&long[..], &short[..]), (&short[..], &long[..])] {
        assert!((discrete_frechet(a, b) - 1.0).abs() < 1e-12);
    }
}
