use std::f64::consts::TAU;

use super::*;

const ROOT: Place = Place { position: DVec3::ZERO, theta: 0.0 };

fn ends(k: &Helicoid, length: f64, steps: Steps) -> Result<Place, Singular> {
    walk(k, ROOT, length, steps, &[], &mut |_, _| ())
}

#[test]
fn kt_alone_is_a_circle() {
    let circle = Helicoid::new(0.5, 0.0, 0.0, 0.0);
    let end = ends(&circle, 3.25 * 2.0 * TAU, Steps::Within(1e-9)).expect("no singular line");
    assert!(end.position.distance(DVec3::new(2.0, 2.0, 0.0)) < 1e-6);
    assert!((end.theta - 3.25 * TAU).abs() < 1e-6, "cycles are counted: {}", end.theta);
}

#[test]
fn kt_and_kn_are_a_logarithmic_spiral() {
    // |U| = 1 + kN s and theta = kT / kN ln |U|.
    let (kt, kn, length) = (1.3, 0.4, 9.0);
    let end = ends(&Helicoid::new(kt, kn, 0.0, 0.0), length, Steps::Within(1e-10));
    let end = end.expect("it runs away from its singular line");
    let theta = kt / kn * (kn * length).ln_1p();
    assert!((end.theta - theta).abs() < 1e-8);
    let clearance = Helicoid::new(kt, kn, 0.0, 0.0).clearance(end.position);
    assert!((clearance - 1.0 - kn * length).abs() < 1e-8);
}

#[test]
fn errors_fall_with_the_tolerance_and_with_euler_steps_as_their_order_says() {
    let k = Helicoid::new(2.0, 0.3, 0.8, 0.6);
    let truth = ends(&k, 3.0, Steps::Within(1e-13)).expect("clear").position;
    let euler = |n| truth.distance(ends(&k, 3.0, Steps::Even(n)).expect("clear").position);
    let order = (euler(400) / euler(800)).log2();
    assert!((order - 1.0).abs() < 0.1, "Euler is of order {order}");
    for error in [1e-4, 1e-6, 1e-8, 1e-10] {
        let end = ends(&k, 3.0, Steps::Within(error)).expect("clear");
        assert!(truth.distance(end.position) < 100.0 * error);
    }
    assert!(1e-3 < euler(100), "a hundred Euler steps end {} away", euler(100));
}

#[test]
fn stops_between_steps_are_on_the_line() {
    let k = Helicoid::new(1.0, -0.1, 0.6, 0.4);
    let stops: Vec<f64> = (0..=40).map(|i| f64::from(i) * 0.1).collect();
    let mut positions = vec![DVec3::NAN; stops.len()];
    let mut visit = |i: usize, place: Place| positions[i] = place.position;
    walk(&k, ROOT, 4.0, Steps::Within(1e-9), &stops, &mut visit).expect("clear");
    for (&stop, &position) in stops.iter().zip(&positions) {
        let end = ends(&k, stop, Steps::Within(1e-12)).expect("clear");
        assert!(end.position.distance(position) < 2e-7, "at {stop}");
    }
}

#[test]
fn euler_visits_points_on_its_own_polygon() {
    let k = Helicoid::new(1.0, 0.0, 0.0, 0.0);
    let mut seen = Vec::new();
    let stops = [0.0, 0.5, 1.0, 2.0];
    walk(&k, ROOT, 2.0, Steps::Even(2), &stops, &mut |_, place| seen.push(place.position))
        .expect("clear");
    let corner = DVec3::X + k.direction(k.theta(DVec3::X));
    assert_eq!(seen, [DVec3::ZERO, DVec3::new(0.5, 0.0, 0.0), DVec3::X, corner]);
}

#[test]
fn running_into_the_singular_line_is_an_error_for_both() {
    for (kt, kn) in [(0.0, -1.0), (0.2, -1.0), (1e-9, -1.0)] {
        let sink = Helicoid::new(kt, kn, 0.0, 0.0);
        let Singular(at) = ends(&sink, 2.0, Steps::Within(1e-8)).expect_err("a sink");
        assert!((at - 1.0).abs() < 1e-3, "stopped at {at}");
    }
    let sink = Helicoid::new(0.0, -1.0, 0.0, 0.0);
    assert_eq!(ends(&sink, 2.0, Steps::Even(8)), Err(Singular(1.0)));
    assert!(ends(&sink, 0.9, Steps::Within(1e-8)).is_ok());
}

#[test]
fn no_length_is_no_step() {
    let k = Helicoid::new(1.0, 2.0, 3.0, 4.0);
    for steps in [Steps::Even(3), Steps::Within(0.0)] {
        let mut seen = 0;
        let end = walk(&k, ROOT, 0.0, steps, &[0.0], &mut |_, _| seen += 1).expect("clear");
        assert_eq!((end, seen), (ROOT, 1));
    }
}
