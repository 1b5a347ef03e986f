use std::f64::consts::TAU;

use glam::DVec3;
use tress_geometry::Strands;

use super::*;
use crate::Hand;

/// A strand whose radius, pitch and axis vary, of so many points a turn; 14 turns.
fn varied(per_turn: u32) -> Vec<DVec3> {
    let point = |i: u32| {
        let turn = f64::from(i) / f64::from(per_turn);
        let (sine, cosine) = (TAU * turn).sin_cos();
        let radius = 0.5 * (1.0 + 0.2 * (0.5 * turn).sin());
        let sway = DVec3::new(0.0, (0.2 * turn).sin(), 0.3 * (0.15 * turn).cos());
        DVec3::new(0.5 * turn + 0.2 * (0.4 * turn).sin(), radius * cosine, radius * sine) + sway
    };
    (0..=14 * per_turn).map(point).collect()
}

fn groom(strands: &[Vec<DVec3>]) -> Groom {
    let mut all = Strands::default();
    for strand in strands {
        all.push(strand.iter().copied()).expect("a few points");
    }
    Groom::new(all)
}

#[test]
fn values_do_not_depend_on_the_sampling() {
    let fine = Analysis::of(&groom(&[varied(32)]));
    for coarser in [8_u32, 16] {
        let coarse = Analysis::of(&groom(&[varied(coarser)]));
        let step = 32 / coarser as usize;
        for ((name, a), (_, b)) in fine.along.columns().into_iter().zip(coarse.along.columns()) {
            let size = a.iter().map(|x| x.abs()).fold(0.0, f64::max);
            // A turn at either end is told from one side only.
            let inner = coarser as usize..b.len() - coarser as usize;
            for i in inner {
                let off = (a[i * step] - b[i]).abs() / size;
                assert!(off < 0.02, "{name} at {i} of {coarser} a turn: {off}");
            }
        }
        let [a, b] = [&fine, &coarse].map(|x| x.strands[0].expect("a curve"));
        assert!((a.turns / b.turns - 1.0).abs() < 0.005, "{} {}", a.turns, b.turns);
        let radii = [a, b].map(|m| m.coil_radius.expect("a coil"));
        assert!((radii[0] / radii[1] - 1.0).abs() < 0.01, "{radii:?}");
    }
}

#[test]
fn a_helix_has_the_curvatures_of_its_closed_form() {
    let coil = tress_geometry::Element::coil(0.5, -0.6);
    let point = |i: u32| {
        let (sine, cosine) = (f64::from(i) * TAU / 16.0).sin_cos();
        DVec3::new(-0.5 * cosine, -0.5 * sine, -0.6 * f64::from(i) / 16.0)
    };
    let analysis = Analysis::of(&groom(&[(0..200).map(point).collect()]));
    let along = &analysis.along;
    for i in 0..200 {
        let near = |x: f64, y: f64| (x / y - 1.0).abs() < 0.03;
        assert!(near(along.curvature[i], coil.bending()), "{i}: {}", along.curvature[i]);
        assert!(near(along.radius[i], 0.5) && near(along.beta[i], -1.0), "{i}");
        let inner = (16..184).contains(&i);
        // Turns that are not whole bend the published centerline a little.
        assert!(
            !inner || (along.beta_fourier[i] + 1.0).abs() < 0.15,
            "{i}: {}",
            along.beta_fourier[i]
        );
        assert!(!inner || near(along.twist[i], coil.twist()), "{i}: {}", along.twist[i]);
        assert!(!inner || near(along.pitch[i], -0.6), "{i}: {}", along.pitch[i]);
        assert!(!inner || near(along.frequency[i], 1.0 / 0.6), "{i}");
    }
    assert_eq!(analysis.strands[0].expect("a curve").hand, Hand::Left);
}

#[test]
fn the_published_centerline_does_not_follow_a_bent_line_to_its_ends() {
    // Twenty turns about an arc of three radians.
    let point = |i: u32| {
        let turn = f64::from(i) / 12.0;
        let (along, (sine, cosine)) = (0.15 * turn, (TAU * turn).sin_cos());
        let out = DVec3::new(along.cos(), along.sin(), 0.0);
        4.0 * out + 0.5 * (out * cosine + DVec3::Z * sine)
    };
    let along = Analysis::of(&groom(&[(0..=240).map(point).collect()])).along;
    let worst = |beta: &[f64]| beta[12..228].iter().map(|b| b.abs()).fold(1.0, f64::min);
    let (own, published) = (worst(&along.beta), worst(&along.beta_fourier));
    assert!(0.95 < own && published < 0.9, "{own} {published}");
}

#[test]
fn straight_hair_is_zero_and_no_curve_is_nan() {
    let line: Vec<DVec3> = (0..9).map(|i| DVec3::X * f64::from(i)).collect();
    let analysis = Analysis::of(&groom(&[line, vec![DVec3::ONE], vec![DVec3::ZERO; 3]]));
    for (name, values) in analysis.along.columns() {
        assert!(values[..9].iter().all(|x| x.is_finite()), "{name}");
        assert!(name == "arc_length" || values[..9].iter().all(|x| x.abs() < 1e-9), "{name}");
        assert!(values[9..].len() == 4 && values[9..].iter().all(|x| x.is_nan()), "{name}");
    }
    let summary = analysis.summary();
    assert_eq!((summary.strands, summary.measured, summary.coiled), (3, 1, 0));
    assert_eq!(Analysis::of(&Groom::new(Strands::default())), Analysis::default());
}

#[test]
fn polylines_and_their_super_helices_are_analysed_alike() {
    let groom = groom(&[varied(12)]);
    let fitted = tress_fit::fit(&groom, &tress_fit::FitOptions::default()).expect("a curve");
    let (a, b) = (Analysis::of(&groom), Analysis::of_helices(&fitted.helices));
    let [a, b] = [&a, &b].map(|x| x.strands[0].expect("a curve"));
    assert!((a.turns / b.turns - 1.0).abs() < 2e-3, "{} {}", a.turns, b.turns);
    assert!((a.length / b.length - 1.0).abs() < 2e-3);
    let radii = [a, b].map(|m| m.coil_radius.expect("a coil"));
    assert!((radii[0] / radii[1] - 1.0).abs() < 5e-3, "{radii:?}");
}

#[test]
fn threads_do_not_change_a_bit() {
    let strands: Vec<Vec<DVec3>> = (0..70).map(|i| varied(6 + i % 5)).collect();
    let groom = groom(&strands);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| Analysis::of(&groom))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn a_summary_counts_coils_waves_and_what_is_neither() {
    let wave = (0..=90).map(|i| 0.1 * f64::from(i));
    let wave = wave.map(|t| DVec3::new(t, 0.3 * (TAU * t).sin(), 0.0)).collect();
    let line = (0..9).map(|i| DVec3::X * f64::from(i)).collect();
    let summary = Analysis::of(&groom(&[varied(12), wave, line])).summary();
    assert_eq!((summary.measured, summary.coiled, summary.waves), (3, 2, 1));
    assert_eq!((summary.right_handed, summary.left_handed, summary.switchbacks), (1, 0, 0));
}
