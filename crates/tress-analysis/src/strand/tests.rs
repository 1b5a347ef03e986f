use glam::DVec3;
use tress_geometry::{Element, Frame, Groom, Strands};

use super::*;
use crate::Analysis;

fn strand(elements: &[Element]) -> StrandMeasures {
    measure(&SuperHelix { root: Frame::IDENTITY, elements })
}

fn coil(pitch: f64, length: f64) -> Element {
    Element { length, ..Element::coil(0.5, pitch) }
}

#[test]
fn a_straight_strand_has_no_radius_and_no_hand() {
    let straight = strand(&[Element { length: 3.0, ..Element::default() }]);
    assert_eq!((straight.coil_radius, straight.hand), (None, Hand::Neither));
    assert_eq!((straight.length, straight.reach, straight.turns), (3.0, 3.0, 0.0));
    assert_eq!(strand(&[]).hand, Hand::Neither);
}

#[test]
fn a_circle_and_a_change_of_hand_have_no_hand() {
    let circle = strand(&[coil(0.0, 10.0)]);
    assert_eq!(circle.hand, Hand::Neither);
    assert!((circle.coil_radius.expect("it goes round") - 0.5).abs() < 1e-3);
    let switchback = strand(&[coil(1.0, 20.0), coil(-1.0, 19.0)]);
    assert_eq!((switchback.hand, switchback.switchbacks), (Hand::Neither, 1));
    assert_eq!(strand(&[coil(1.0, 10.0), coil(-1.0, 2.0)]).hand, Hand::Right);
}

#[test]
fn straight_stretches_have_no_say_in_the_radius() {
    let straight = Element { length: 20.0, ..Element::default() };
    let radius = strand(&[straight, coil(1.0, 30.0), straight]).coil_radius;
    assert!((radius.expect("it turns") - 0.5).abs() < 5e-3, "{radius:?}");
}

/// A polyline of so many turns about x, nine points a turn, at `at(turn)`.
fn polyline(turns: f64, at: impl Fn(f64) -> DVec3) -> Vec<DVec3> {
    let mut points = Vec::new();
    let mut turn = 0.0;
    while turn <= turns {
        points.push(at(turn));
        turn += 1.0 / 9.0;
    }
    points
}

fn measured(points: Vec<DVec3>) -> StrandMeasures {
    let n = points.len();
    let groom = Groom::new(Strands::from_counts([n], points).expect("one strand"));
    Analysis::of(&groom).strands[0].expect("a curve")
}

#[test]
fn waves_are_flat_and_coils_that_skip_points_or_change_hand_are_not() {
    let wave = |turn: f64| DVec3::new(0.9 * turn, 0.3 * (TAU * turn).sin(), 0.04 * turn.sin());
    let wave = measured(polyline(7.0, wave));
    assert!(wave.is_wave() && wave.roundness < 0.15, "{wave:?}");
    let round = |turn: f64, hand: f64| {
        let (sine, cosine) = (TAU * turn).sin_cos();
        DVec3::new(0.3 * turn, 0.5 * cosine, hand * 0.5 * sine)
    };
    // Every third point is left out, and the rest closes up.
    let coil = polyline(16.0, |turn| round(turn, 1.0));
    let mut cut = vec![coil[0]];
    for (i, step) in coil.windows(2).enumerate() {
        if i % 7 < 5 {
            cut.push(cut[cut.len() - 1] + step[1] - step[0]);
        }
    }
    let cut = measured(cut);
    assert!(!cut.is_wave() && 0.8 < cut.roundness, "{cut:?}");
    let to_and_fro = polyline(16.0, |turn| round(turn, if turn % 4.0 < 2.0 { 1.0 } else { -1.0 }));
    let to_and_fro = measured(to_and_fro);
    assert!(!to_and_fro.is_wave() && to_and_fro.hand == Hand::Neither, "{to_and_fro:?}");
}

#[test]
fn bows_and_sags_of_straight_hair_are_no_waves() {
    // Out of the scalp, down, and a curl at the tip: a bow and a half.
    let sag = |turn: f64| {
        let t = turn / 3.0;
        DVec3::new(2.0 * t, 0.5 * (4.0 * t).sin() - 3.0 * t * t, 0.1 * (3.0 * t).cos())
    };
    let sag = measured(polyline(3.0, sag));
    assert_eq!((sag.turns, sag.is_wave()), (0.0, false), "{sag:?}");
    let bent = |turn: f64| DVec3::new(turn, 0.12 * (TAU * turn / 2.0).sin(), 0.0);
    assert_eq!(measured(polyline(4.0, bent)).coil_radius, None);
}

#[test]
fn a_loose_coil_is_found_on_a_strand_that_bends_over_a_head() {
    let over = |turn: f64| {
        let angle = 0.45 * turn;
        let out = DVec3::new(angle.sin(), angle.cos(), 0.0);
        let (sine, cosine) = (TAU * turn).sin_cos();
        9.0 * out + 0.4 * (out * cosine - DVec3::Z * sine)
    };
    let coil = measured(polyline(4.3, over));
    assert!((coil.turns - 4.3).abs() < 0.2, "{coil:?}");
    assert_eq!(coil.hand, Hand::Left);
}
