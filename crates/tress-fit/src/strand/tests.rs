use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tress_geometry::polyline::Defect;

use super::*;
use crate::{Floating, Refine, Tolerance, deviation};

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
    let wanted = [
        Elements::PerSegment,
        Elements::Count(1),
        Elements::Count(25),
        Elements::Tolerance(Tolerance::OfRadius(0.05)),
    ];
    for (name, points) in troublesome() {
        let size = points.iter().map(|p| p.distance(points[0])).fold(0.0, f64::max);
        for (elements, floating) in wanted.iter().flat_map(|e| BOTH.map(|f| (*e, f))) {
            for refine in [None, Some(Refine::default())] {
                let options = FitOptions { refine, ..direct(elements, floating) };
                let fit = fit_strand(&points, &options).expect(name);
                assert_eq!(fit.arc_lengths.len(), points.len(), "{name}");
                assert!(fit.arc_lengths.windows(2).all(|s| s[0] <= s[1]), "{name}");
                let tip = fit.super_helix().tip();
                assert!(tip.position.is_finite() && tip.axes.is_finite(), "{name} {options:?}");
                assert!(tip.orthonormality_error() < 1e-9, "{name}");
                let off = tip.position.distance(points[points.len() - 1]);
                if elements != Elements::Count(1) {
                    assert!(off <= 3.0 * size, "{name} {options:?}: {off}");
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

fn refined(elements: Elements) -> FitOptions {
    FitOptions { elements, ..FitOptions::default() }
}

#[test]
fn exact_helices_are_recovered_from_five_points_a_turn() {
    for pitch in [0.0, 0.05, 0.4, -1.0, 6.0] {
        let points = helix(0.5, pitch, 5.0, 61);
        let exact = Element::coil(0.5, pitch);
        for elements in [Elements::PerSegment, Elements::Count(1), Elements::Count(90)] {
            let fit = fit_strand(&points, &refined(elements)).expect("a coil");
            for element in &fit.elements {
                let size = exact.curvature.length();
                assert!((element.twist() - exact.twist()).abs() < 1e-6 * size, "{pitch}");
                assert!((element.bending() - exact.bending()).abs() < 1e-6 * size, "{pitch}");
            }
        }
        for tolerance in [Tolerance::Length(1e-6), Tolerance::OfRadius(1e-6)] {
            let options = refined(Elements::Tolerance(tolerance));
            let fit = fit_strand(&points, &options).expect("a coil");
            assert_eq!(fit.elements.len(), 1, "{pitch} {tolerance:?}");
        }
    }
}

/// Points of the strand of length 8 whose material curvatures at arc length `x` are `q(x)`,
/// `density` points a unit of length.
fn integrated(density: usize, q: impl Fn(f64) -> DVec3) -> Vec<DVec3> {
    let fine = 400;
    let length = 1.0 / f64::from(fine);
    let elements: Vec<Element> = (0..8 * fine)
        .map(|i| Element { curvature: q((f64::from(i) + 0.5) * length), length })
        .collect();
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    let n = 8 * density;
    let along = (0..=n).map(|i| 8.0 * i as f64 / n as f64);
    strand.frames_at(along).map(|frame| frame.position).collect()
}

/// A coil of 8 turns whose axis bends, whose radius varies and whose hand changes midway.
fn wild_coil(per_turn: usize) -> Vec<DVec3> {
    integrated(per_turn, |x| {
        let hand = ((x - 4.0) / 0.8).tanh();
        let bend = 0.1 * (std::f64::consts::TAU * x).cos();
        6.0 * (1.0 + 0.15 * (0.7 * x).sin()) * DVec3::new(0.3 * hand, 0.0, 1.0 + bend)
    })
}

#[test]
fn twice_the_elements_are_four_times_as_near() {
    let points = wild_coil(80);
    let rms = |n: usize| {
        let options = FitOptions {
            elements: Elements::Count(n),
            refine: Some(Refine { prior: 1e-6, ..Refine::default() }),
            ..FitOptions::default()
        };
        let fit = fit_strand(&points, &options).expect("a coil");
        deviation(&fit.super_helix(), &points, &fit.arc_lengths).rms
    };
    let errors = [20, 40, 80, 160].map(rms);
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.3 * pair[0], "{errors:?}");
    }
}

#[test]
fn tolerances_are_kept_with_fewer_elements_where_curvature_is_even() {
    let points = wild_coil(10);
    let mut before = usize::MAX;
    for tolerance in [1e-3, 1e-2, 5e-2] {
        let options = refined(Elements::Tolerance(Tolerance::Length(tolerance)));
        let fit = fit_strand(&points, &options).expect("a coil");
        let apart = deviation(&fit.super_helix(), &points, &fit.arc_lengths);
        assert!(apart.greatest <= tolerance, "{tolerance}: {apart:?}");
        assert!(fit.elements.len() <= before, "{tolerance}: {} {before}", fit.elements.len());
        before = fit.elements.len();
    }
}

#[test]
fn elements_are_short_where_curvature_changes() {
    // Half a helix, whose curvature then falls to nothing.
    let points = integrated(9, |x| {
        let wound = 1.0 - ((x - 6.0) / 0.5).tanh();
        DVec3::new(1.0, 0.0, 3.0 * wound)
    });
    let options = refined(Elements::Tolerance(Tolerance::Length(2e-3)));
    let fit = fit_strand(&points, &options).expect("a strand");
    let longest = fit.elements.iter().map(|element| element.length).fold(0.0, f64::max);
    let shortest = fit.elements.iter().map(|element| element.length).fold(f64::MAX, f64::min);
    assert!(3.0 * shortest < longest, "{shortest} {longest}");
    assert!(fit.elements.len() < 60, "{}", fit.elements.len());
}

/// A strand of `n` random helices that meet with one tangent, 14 points a unit of length.
fn pieces(n: usize, random: &mut Pcg64Mcg) -> Vec<DVec3> {
    let mut curvature = || {
        let direction = DVec3::from([(); 3].map(|()| random.random_range(-1.0..1.0)));
        direction.normalize_or(DVec3::Z) * random.random_range(1.5..4.0)
    };
    let elements: Vec<Element> = (0..n)
        .map(|i| Element { curvature: curvature(), length: 1.0 + 0.37 * (i % 3) as f64 })
        .collect();
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    let steps = (14.0 * strand.length()).floor();
    let along = (0..).map(f64::from).take_while(|i| *i <= steps);
    strand.frames_at(along.map(|i| strand.length() * i / steps)).map(|f| f.position).collect()
}

#[test]
fn helices_that_a_strand_is_made_of_are_found() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut found, mut truth) = (0, 0);
    for i in 0..12 {
        let n = 1 + i % 6;
        let points = pieces(n, &mut random);
        let options = refined(Elements::Tolerance(Tolerance::Length(1e-3)));
        let fit = fit_strand(&points, &options).expect("a strand");
        let apart = deviation(&fit.super_helix(), &points, &fit.arc_lengths);
        assert!(apart.greatest <= 1e-3, "{i}: {apart:?}");
        assert!(fit.elements.len() <= n + 2, "{i}: {} for {n}", fit.elements.len());
        found += fit.elements.len();
        truth += n;
    }
    assert!(10 * found <= 11 * truth, "{found} for {truth}");
}

/// A strand of unit segments that turn by up to 2.6 radians at each point.
fn frizz(n: usize, random: &mut Pcg64Mcg) -> Vec<DVec3> {
    let mut points = vec![DVec3::ZERO];
    let mut heading = DVec3::X;
    for _ in 1..n {
        let across = heading.any_orthonormal_vector();
        let about = glam::DQuat::from_axis_angle(heading, random.random_range(0.0..6.3)) * across;
        heading = glam::DQuat::from_axis_angle(about, random.random_range(0.2..2.6)) * heading;
        heading = heading.normalize();
        points.push(points[points.len() - 1] + heading);
    }
    points
}

#[test]
fn strands_that_turn_sharply_are_followed() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    for i in 0..12 {
        let points = frizz(60, &mut random);
        for elements in [Elements::PerSegment, Elements::Count(90)] {
            let fit = fit_strand(&points, &refined(elements)).expect("a strand");
            let apart = deviation(&fit.super_helix(), &points, &fit.arc_lengths);
            assert!(apart.rms < 0.1, "{i} {elements:?}: {apart:?}");
            assert!(apart.length_change < 0.05, "{i} {elements:?}: {apart:?}");
            assert!(fit.super_helix().length() < 3.0 * 59.0, "{i}: it winds up");
        }
        let within = Elements::Tolerance(Tolerance::Length(0.05));
        let fit = fit_strand(&points, &refined(within)).expect("a strand");
        let apart = deviation(&fit.super_helix(), &points, &fit.arc_lengths);
        assert!(apart.greatest <= 0.05, "{i}: {apart:?}");
    }
}

#[test]
fn tolerances_that_are_no_lengths_are_refused() {
    for value in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY] {
        for tolerance in [Tolerance::Length(value), Tolerance::OfRadius(value)] {
            assert!(refined(Elements::Tolerance(tolerance)).validate().is_err(), "{tolerance:?}");
        }
    }
    for count in [0, FitOptions::MOST_ELEMENTS + 1, usize::MAX] {
        assert!(refined(Elements::Count(count)).validate().is_err(), "{count}");
    }
    for prior in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refine = Some(Refine { prior, ..Refine::default() });
        assert!(FitOptions { refine, ..FitOptions::default() }.validate().is_err(), "{prior}");
    }
}

#[test]
fn between_the_points_the_fit_follows_the_coil_it_was_taken_from() {
    // Twenty points a turn are known, every fourth is given.
    let fine = wild_coil(20);
    let given: Vec<_> = fine.iter().step_by(4).copied().collect();
    let fit = fit_strand(&given, &refined(Elements::PerSegment)).expect("a coil");
    let length = fit.super_helix().length();
    let along: Vec<f64> =
        (0..fine.len()).map(|i| length * i as f64 / (fine.len() - 1) as f64).collect();
    let apart = deviation(&fit.super_helix(), &fine, &along);
    // The coil's radius is 0.15; its curvature changes by a fifth within a turn.
    assert!(apart.rms < 1e-3, "{apart:?}");
    let curve_length = wild_coil(400).windows(2).map(|p| p[0].distance(p[1])).sum::<f64>();
    assert!((length / curve_length - 1.0).abs() < 1e-3);
}

#[test]
fn noise_on_a_nearly_straight_strand_is_not_wound_up() {
    let noisy = |i: i32| {
        let wobble = 1e-4 * f64::from((i * 7919) % 13 - 6);
        DVec3::new(f64::from(i), wobble, 1e-4 * f64::from((i * 104_729) % 11 - 5))
    };
    let points: Vec<_> = (0..50).map(noisy).collect();
    let fit = fit_strand(&points, &FitOptions::default()).expect("a strand");
    assert!(fit.super_helix().turns() < 0.5, "{}", fit.super_helix().turns());
}

#[test]
fn an_element_may_turn_more_than_once() {
    let points = helix(0.5, 0.4, 8.0, 81);
    let fit = fit_strand(&points, &refined(Elements::Count(3))).expect("a coil");
    assert!((fit.super_helix().turns() - 10.0).abs() < 1e-6);
    assert!(2.0 < fit.elements[1].turns());
}

#[test]
fn more_elements_than_points_say_anything_about_are_made() {
    for points in [helix(0.5, 0.4, 5.0, 30), helix(0.5, 0.4, 5.0, 3), helix(0.5, 0.4, 5.0, 2)] {
        let fit = fit_strand(&points, &refined(Elements::Count(300))).expect("a strand");
        assert_eq!(fit.elements.len(), 300);
        let apart = deviation(&fit.super_helix(), &points, &fit.arc_lengths);
        assert!(apart.greatest < 1e-3, "{} points: {apart:?}", points.len());
    }
}

#[test]
fn curvatures_do_not_change_when_a_strand_is_moved_and_turned() {
    let points: Vec<DVec3> = (0..60)
        .map(|i| 0.9 * f64::from(i))
        .map(|a| DVec3::new(a.cos() + 0.1 * (0.3 * a).sin(), 0.2 * a, a.sin() * (1.0 + 0.02 * a)))
        .collect();
    let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 2.1, -1.3);
    let moved: Vec<DVec3> = points.iter().map(|p| turn * *p + DVec3::new(3.0, -1.0, 2.0)).collect();
    let options = FitOptions { elements: Elements::Count(40), ..FitOptions::default() };
    let fits = [&points, &moved].map(|points| fit_strand(points, &options).expect("a coil"));
    for (a, b) in fits[0].elements.iter().zip(&fits[1].elements) {
        let difference = a.curvature.distance(b.curvature);
        assert!(
            difference < 1e-6 * (1.0 + a.curvature.length()),
            "{} {}",
            a.curvature,
            b.curvature
        );
    }
}
