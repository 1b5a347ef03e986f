use std::f64::consts::{PI, TAU};

use super::*;

/// A coil of radius 1 and pitch 0.3.
fn coil(turns: usize, per_turn: usize) -> Vec<DVec3> {
    let point = |i: usize| {
        let angle = i as f64 * TAU / per_turn as f64;
        DVec3::new(angle.cos(), 0.3 * angle / TAU, angle.sin())
    };
    (0..=turns * per_turn).map(point).collect()
}

#[test]
fn a_coil_is_missed_by_half_of_what_chords_on_it_miss() {
    let coil = coil(60, 40);
    let per_turn = 254.0 / 60.0;
    let chord = 1.0 - (PI / per_turn).cos();
    let uniform = fewer(&coil, 255, Placement::Uniform);
    let ours = fewer(&coil, 255, Placement::Curvature);
    assert_eq!((uniform.points.len(), ours.points.len()), (255, 255));
    assert!((uniform.error - chord).abs() < 0.02 * chord, "{} {chord}", uniform.error);
    assert!(ours.error < 0.55 * chord, "{} {chord}", ours.error);
    assert_eq!((ours.points[0], ours.points[254]), (coil[0], coil[2400]));
}

#[test]
fn a_straight_stretch_leaves_its_points_to_the_coil_behind_it() {
    let coil = coil(10, 40);
    let straight = (0..400).map(|i| coil[0] + DVec3::new(0.0, 0.0, 0.05) * f64::from(i - 400));
    let strand: Vec<DVec3> = straight.chain(coil.iter().copied()).collect();
    let ours = fewer(&strand, 80, Placement::Curvature);
    let uniform = fewer(&strand, 80, Placement::Uniform);
    assert!(ours.error < 0.45 * uniform.error, "{} {}", ours.error, uniform.error);
    assert!(ours.rows.windows(2).all(|rows| rows[0] < rows[1]), "rows ascend");
}

#[test]
fn a_straight_strand_is_not_missed_at_all() {
    let straight: Vec<DVec3> = (0..300).map(|i| DVec3::X * f64::from(i)).collect();
    let ours = fewer(&straight, 255, Placement::Curvature);
    assert!(ours.error < 1e-12 && ours.points.iter().all(|p| p.is_finite()), "{}", ours.error);
}

#[test]
fn what_is_no_curve_keeps_some_of_its_points() {
    let mut broken = coil(10, 40);
    broken[7] = DVec3::NAN;
    let kept = fewer(&broken, 30, Placement::Curvature);
    assert_eq!((kept.points.len(), kept.points[29]), (30, broken[400]));
    let heap = fewer(&[DVec3::ONE; 300], 255, Placement::Curvature);
    assert_eq!(heap.points, [DVec3::ONE; 255]);
}

#[test]
fn every_count_of_points_gives_ascending_rows() {
    let coil = coil(4, 16);
    for count in 2..65 {
        for placement in [Placement::Curvature, Placement::Uniform] {
            let placed = fewer(&coil, count, placement);
            assert_eq!(placed.rows.len(), count);
            assert!(placed.rows.windows(2).all(|rows| rows[0] < rows[1]), "{count} points");
            assert_eq!((placed.rows[0], placed.rows[count - 1]), ((0, 0.0), (64, 0.0)));
        }
    }
}
