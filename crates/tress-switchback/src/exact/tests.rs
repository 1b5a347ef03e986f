use super::*;
use crate::profile::material_curvature;
use crate::rod::{derivative, invariants};
use proptest::prelude::*;

fn switchback(v: f64, poisson_ratio: f64) -> Switchback {
    let material = Material { poisson_ratio, rest_twist: 0.0 };
    Switchback::new(v, &material).expect("within the range that is solved")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn equations_hold_everywhere(v in 0.05..0.95_f64, nu in 0.0..0.5_f64, left in any::<bool>()) {
        let switchback = switchback(if left { -v } else { v }, nu);
        let end = 20.0 / switchback.coil().turning().min(v);
        let before = invariants(&switchback.material, &switchback.coil.state());
        let h = 1e-4;
        for i in -40..=40 {
            let s = end * f64::from(i) / 40.0 + 1e-3;
            let rate = derivative(&switchback.material, &switchback.state(s));
            let (up, down) = (switchback.state(s + h), switchback.state(s - h));
            for k in 0..6 {
                let change = (up[k] - down[k]) / (2.0 * h);
                prop_assert!((rate[k] - change).abs() < 2e-7, "{s} {k}: {} {change}", rate[k]);
            }
            let here = invariants(&switchback.material, &switchback.state(s));
            for (a, b) in before.iter().zip(here) {
                prop_assert!((a - b).abs() < 1e-8, "{s}: {before:?} {here:?}");
            }
        }
    }

    #[test]
    fn a_neighbour_leads_to_the_same_solution(v in 0.1..0.9_f64, step in -0.03..0.03_f64) {
        let cold = switchback(v, 0.4);
        let warm = switchback(v + step, 0.4).near(v).expect("near enough");
        for i in -20..=20 {
            let s = f64::from(i);
            prop_assert!(warm.curvature(s).distance(cold.curvature(s)) < 1e-8);
        }
    }
}

#[test]
fn the_two_hands_are_mirror_images() {
    let (right, left) = (switchback(0.4, 0.4), switchback(-0.4, 0.4));
    for i in -10..=10 {
        let s = 1.7 * f64::from(i);
        let (r, l) =
            (material_curvature(right.curvature(s)), material_curvature(left.curvature(s)));
        assert!(r.distance(l * DVec3::new(-1.0, -1.0, 1.0)) < 1e-14);
        assert!((right.force(s).length() - right.coil().pull()).abs() < 1e-9);
    }
}

#[test]
fn the_room_shrinks_with_the_pull_and_grows_with_care() {
    let loose = switchback(0.2, 0.4);
    let tight = switchback(0.8, 0.4);
    assert!(tight.half_width(0.05) < loose.half_width(0.05));
    assert!(loose.half_width(0.05) < loose.half_width(0.01));
    for share in [0.5, 0.1, 1e-3, 1e-9] {
        let (end, coil) = (loose.half_width(share), loose.coil().other_hand().curvature);
        let off = |s: f64| loose.curvature(s).distance(coil) / coil.length();
        for i in 0..200 {
            assert!(off(end + 0.3 * f64::from(i)) < 1.02 * share);
        }
    }
}

#[test]
fn no_more_room_is_taken_than_the_share_asks_for() {
    for v in [0.2, 0.5, 0.9] {
        let switchback = switchback(v, 0.4);
        let coil = switchback.coil().other_hand().curvature;
        for share in [0.2, 0.05, 1e-3] {
            let end = switchback.half_width(share);
            let off = |s: f64| switchback.curvature(s).distance(coil) / coil.length();
            let before = (0..100).map(|i| off(end - 0.01 * f64::from(i))).fold(0.0, f64::max);
            assert!(share <= before, "{v} {share}: {before}");
        }
    }
}

#[test]
fn wherever_it_is_promised_it_is_found() {
    for i in 0..=47 {
        for nu in [0.0, 0.1, 0.25, 0.4, 0.5] {
            let v = if i == 0 { 0.005 } else { 0.01 + 0.02 * f64::from(i) };
            let material = Material { poisson_ratio: nu, rest_twist: 0.0 };
            assert!(Switchback::new(v, &material).is_ok(), "{v} {nu}");
        }
    }
}
