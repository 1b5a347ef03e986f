use glam::DVec3;
use tress_geometry::polyline::Defect;

use super::*;
use crate::Floating;

fn helix(radius: f64, pitch: f64, per_turn: f64, n: usize) -> Vec<DVec3> {
    let angle = |i: usize| i as f64 * std::f64::consts::TAU / per_turn;
    let point =
        |a: f64| DVec3::new(radius * a.cos(), radius * a.sin(), pitch * a / std::f64::consts::TAU);
    (0..n).map(|i| point(angle(i))).collect()
}

fn direct(elements: Elements, floating: Floating) -> FitOptions {
    FitOptions { elements, floating, refine: None, ..FitOptions::default() }
}

const BOTH: [Floating; 2] = [Floating::Points, Floating::Tangents];

#[test]
fn floating_tangents_pass_through_every_point() {
    let points = helix(0.5, 0.4, 7.0, 60);
    let fit =
        fit_strand(&points, &direct(Elements::PerSegment, Floating::Tangents)).expect("a coil");
    let joints = fit.super_helix();
    for (joint, point) in joints.joints().zip(&points) {
        assert!(joint.position.distance(*point) < 1e-12);
    }
}

#[test]
fn every_strand_gets_the_elements_asked_for() {
    let points = helix(0.5, 0.4, 5.0, 40);
    for floating in BOTH {
        for n in [1, 2, 7, 39, 200, 1000] {
            let fit = fit_strand(&points, &direct(Elements::Count(n), floating)).expect("a coil");
            assert_eq!(fit.elements.len(), n);
            assert!(fit.super_helix().tip().position.is_finite());
        }
    }
}

#[test]
fn two_points_become_straight_elements() {
    let points = [DVec3::ONE, DVec3::new(1.0, 1.0, 4.0)];
    for elements in [Elements::PerSegment, Elements::Count(3)] {
        let fit = fit_strand(&points, &direct(elements, Floating::Points)).expect("a segment");
        assert!(fit.elements.iter().all(|e| e.curvature == DVec3::ZERO));
        assert!(fit.super_helix().tip().position.distance(points[1]) < 1e-15);
    }
}

#[test]
fn nothing_to_fit_is_kept_with_its_reason() {
    let options = FitOptions::default();
    let reason = |points: &[DVec3]| fit_strand(points, &options).unwrap_err();
    assert_eq!(reason(&[]), KeptReason::Defect(Defect::Empty));
    assert_eq!(reason(&[DVec3::X]), KeptReason::Defect(Defect::SinglePoint));
    assert_eq!(reason(&[DVec3::X; 5]), KeptReason::Defect(Defect::ZeroLength));
    assert_eq!(reason(&[DVec3::X, DVec3::NAN]), KeptReason::Defect(Defect::NotFinite));
}

/// Strands that break a careless fit, each with a name.
fn troublesome() -> Vec<(&'static str, Vec<DVec3>)> {
    let line = |n: i32| (0..n).map(|i| DVec3::new(f64::from(i), 0.0, 0.0));
    let coil = helix(0.5, 0.4, 5.0, 30);
    let mut repeated = coil.clone();
    repeated.extend([coil[29]; 4]);
    repeated.splice(10..10, [coil[10]; 3]);
    let mut huge_segment = coil.clone();
    huge_segment.extend(coil.iter().map(|p| *p + 1e6 * DVec3::X));
    let folded: Vec<_> = line(6).chain(line(5).collect::<Vec<_>>().into_iter().rev()).collect();
    let jagged = (0..20).map(|i| DVec3::new(f64::from(i % 2), 0.0, 1e-9 * f64::from(i))).collect();
    let tiny = coil.iter().map(|p| *p * 1e-50).collect();
    let big = coil.iter().map(|p| *p * 1e50).collect();
    let far = coil.iter().map(|p| *p + DVec3::splat(1e8)).collect();
    let rounding = (0..9).map(|i| DVec3::splat(1e9) + DVec3::X * 1e-7 * f64::from(i % 3)).collect();
    vec![
        ("collinear", line(12).collect()),
        ("three points", coil[..3].to_vec()),
        ("there and back", vec![DVec3::ZERO, DVec3::X, DVec3::ZERO]),
        ("repeated", repeated),
        ("huge segment", huge_segment),
        ("folded", folded),
        ("jagged", jagged),
        ("tiny", tiny),
        ("big", big),
        ("far", far),
        ("rounding", rounding),
        ("right angles", vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::ONE]),
    ]
}

#[test]
fn troublesome_strands_stay_finite_and_near() {
    for (name, points) in troublesome() {
        let first = points[0];
        let size = points.iter().map(|p| p.distance(first)).fold(0.0, f64::max);
        for floating in BOTH {
            for elements in [Elements::PerSegment, Elements::Count(1), Elements::Count(25)] {
                let fit = fit_strand(&points, &direct(elements, floating)).expect(name);
                let strand = fit.super_helix();
                assert_eq!(fit.arc_lengths.len(), points.len(), "{name}");
                assert!(fit.arc_lengths.windows(2).all(|s| s[0] <= s[1]), "{name}");
                let tip = strand.tip();
                assert!(tip.position.is_finite() && tip.axes.is_finite(), "{name}");
                assert!(tip.orthonormality_error() < 1e-9, "{name}");
                let off = tip.position.distance(points[points.len() - 1]);
                if elements != Elements::Count(1) {
                    assert!(off <= 3.0 * size, "{name} {floating:?} {elements:?}: {off}");
                }
            }
        }
    }
}

#[test]
fn sizes_beyond_all_measure_are_kept() {
    for size in [1e-150, 1e-61, 1e61, 1e150] {
        let points: Vec<_> = helix(0.5, 0.4, 5.0, 30).iter().map(|p| *p * size).collect();
        assert_eq!(fit_strand(&points, &FitOptions::default()), Err(KeptReason::Size));
    }
}

#[test]
fn size_and_place_do_not_matter() {
    let points = helix(0.5, 0.4, 5.0, 30);
    let options = direct(Elements::Count(40), Floating::Points);
    let fit = fit_strand(&points, &options).expect("a coil");
    let moved: Vec<_> = points.iter().map(|p| 1024.0 * *p + 4096.0 * DVec3::Y).collect();
    let other = fit_strand(&moved, &options).expect("a coil");
    for (a, b) in fit.elements.iter().zip(&other.elements) {
        assert!((a.curvature - b.curvature * 1024.0).length() < 1e-9 * a.curvature.length());
    }
}
