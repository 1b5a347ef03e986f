use std::f64::consts::TAU;

use tress_fit::Spectra;
use tress_geometry::polyline;

use super::*;
use crate::{Curve, JointReport, Skip, SkipUnit, joint_report};

/// A guide of so many turns of radius 0.5 from `root`, hanging down and swaying aside.
fn guide(root: DVec3, turns: f64, per_turn: f64, sway: f64) -> Vec<DVec3> {
    let n = (turns * per_turn).ceil();
    let mut points = Vec::new();
    let mut i = 0.0;
    while i <= n {
        let t = i / n;
        let (sine, cosine) = (t * turns * TAU).sin_cos();
        let aside = DVec3::new(sway * t * t, -0.6 * turns * t, 0.3 * sway * t);
        points.push(root + aside + 0.5 * DVec3::new(cosine - 1.0, 0.0, sine));
        i += 1.0;
    }
    points
}

fn guides(sway: f64) -> Strands<DVec3> {
    let mut guides = Strands::default();
    for i in 0..6_u32 {
        let root = DVec3::new(f64::from(i % 3), 0.0, f64::from(i / 3));
        let turns = 10.0 + 2.3 * f64::from(i);
        guides.push(guide(root, turns, 5.0 + 0.3 * f64::from(i), sway)).expect("few points");
    }
    guides
}

fn roots(n: u32) -> Vec<DVec3> {
    let at = |i: u32| (f64::from(i) * 78.233).sin().abs().fract();
    (0..n).map(|i| DVec3::new(2.0 * at(i), 0.0, at(i + 991))).collect()
}

fn shipped() -> Coils {
    Coils::shipped().expect("a whole file")
}

fn planned(options: &GrowOptions, seed: u64) -> (Strands<DVec3>, Vec<DVec3>, Plan) {
    let (guides, roots) = (guides(2.0), roots(300));
    let firsts: Vec<_> = guides.iter().map(|g| g[0]).collect();
    let assigned = assign(&roots, &firsts, options.assignment, seed).expect("guides");
    let plan = Plan::new(&guides, &roots, &assigned, shipped(), options, seed);
    (guides, roots, plan.expect("sound options"))
}

#[test]
fn hairs_begin_at_their_roots_and_end_in_their_wisps() {
    let (guides, roots, plan) = planned(&GrowOptions::default(), 3);
    let groom = plan.grow(&guides, &roots).expect("as planned");
    assert_eq!(groom.strands().len(), 300);
    for ((hair, root), name) in groom.strands().iter().zip(&roots).zip(plan.guides()) {
        assert_eq!(hair[0], *root);
        let (guide, tip) = (guides.strand(name as usize), hair[hair.len() - 1]);
        let near = guide.iter().map(|p| p.distance(tip)).fold(f64::INFINITY, f64::min);
        assert!(near < 0.6 * 0.5 + 1e-9, "{near}");
        assert!(polyline::defect(hair).is_none());
    }
    let report = plan.report(&guides, &roots);
    assert_eq!((report.hairs, report.guides, report.bare_roots, report.far_roots), (300, 6, 0, 0));
}

#[test]
fn joints_are_no_sharper_than_the_coil() {
    for seed in 0..4 {
        let (guides, roots, plan) = planned(&GrowOptions::default(), seed);
        let groom = plan.grow(&guides, &roots).expect("as planned");
        let JointReport { joints, mean_turning, mean_turning_elsewhere, greatest_ratio, .. } =
            joint_report(groom.strands(), plan.joints());
        assert!(joints > 290);
        assert!(mean_turning < 1.15 * mean_turning_elsewhere, "{mean_turning}");
        assert!(greatest_ratio < 1.4, "{greatest_ratio}");
    }
}

#[test]
fn the_seed_and_not_the_threads_decides() {
    let options = GrowOptions {
        skip: Skip { probability: 0.3, each: SkipUnit::Turns },
        ..GrowOptions::default()
    };
    let (guides, roots) = (guides(1.0), roots(700));
    let on = |threads: usize, seed| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| grow(&guides, &roots, shipped(), &options, seed).expect("sound"))
    };
    assert_eq!(on(1, 5), on(4, 5));
    assert_ne!(on(1, 5), on(1, 6));
}

#[test]
fn every_loose_fraction_length_and_probability_grows() {
    for loose in [0.0, 0.01, 0.5, 1.0] {
        for shorter in [0.0, 1.0] {
            for probability in [0.0, 1.0] {
                for each in [SkipUnit::Points, SkipUnit::Turns] {
                    let options = GrowOptions {
                        loose: (loose, loose),
                        shorter,
                        skip: Skip { probability, each },
                        ..GrowOptions::default()
                    };
                    let (guides, roots, plan) = planned(&options, 1);
                    let groom = plan.grow(&guides, &roots).expect("as planned");
                    for (hair, root) in groom.strands().iter().zip(&roots) {
                        assert!(hair.len() >= 2 && hair[0] == *root);
                        assert!(hair.iter().all(|p| p.is_finite() && p.length() < 100.0));
                    }
                }
            }
        }
    }
}

#[test]
fn short_guides_are_duplicated_and_hairs_go_over_smoothly() {
    // 0.5 to 6 turns: at 0.5 a hair is its guide moved to its root.
    let mut step = 0.0;
    let mut before: Option<Vec<DVec3>> = None;
    while step <= 55.0 {
        let mut one = Strands::default();
        one.push(guide(DVec3::ZERO, 0.5 + 0.1 * step, 12.0, 0.0)).expect("few points");
        let root = DVec3::new(0.4, 0.0, 0.2);
        let options = GrowOptions { loose: (0.3, 0.3), shorter: 0.0, ..GrowOptions::default() };
        let hair = grow(&one, &[root], shipped(), &options, 9).expect("sound");
        let hair = hair.strands().strand(0).to_vec();
        if step <= 4.0 {
            let moved = one.strand(0).iter().map(|p| *p + root);
            assert!(hair.iter().zip(moved).all(|(p, q)| p.distance(q) < 1e-12));
        }
        if let Some(before) = &before {
            let apart = hair[hair.len() - 1].distance(before[before.len() - 1]);
            assert!(apart < 0.45, "{step}: {apart}");
        }
        before = Some(hair);
        step += 1.0;
    }
}

#[test]
fn what_is_no_guide_or_root_leaves_a_bare_root() {
    let mut odd = Strands::default();
    odd.push(guide(DVec3::ZERO, 8.0, 6.0, 0.0)).expect("few");
    odd.push([DVec3::X; 5]).expect("few");
    odd.push([DVec3::Y]).expect("few");
    odd.push([]).expect("few");
    odd.push([DVec3::ZERO, DVec3::NAN]).expect("few");
    odd.push([DVec3::ZERO, DVec3::NEG_Y]).expect("few");
    let roots = [DVec3::ONE; 7];
    let assigned = [0, 1, 2, 3, 4, 5, 0];
    let mut roots = roots.to_vec();
    roots[6] = DVec3::INFINITY;
    let plan = Plan::new(&odd, &roots, &assigned, shipped(), &GrowOptions::default(), 1);
    let plan = plan.expect("guides are there");
    let groom = plan.grow(&odd, &roots).expect("as planned");
    let counts: Vec<_> = groom.strands().counts().collect();
    assert!(counts[0] > 40 && counts[5] == 2);
    assert_eq!([counts[1], counts[2], counts[3], counts[4], counts[6]], [1; 5]);
    assert_eq!(plan.report(&odd, &roots).bare_roots, 5);
}

#[test]
fn far_and_repeated_roots_grow() {
    let guides = guides(0.0);
    let roots = [DVec3::splat(1e3), DVec3::ZERO, DVec3::ZERO, guides.strand(0)[7]];
    let options =
        GrowOptions { assignment: crate::Assignment::Noisy(50), ..GrowOptions::default() };
    let groom = grow(&guides, &roots, shipped(), &options, 1).expect("sound");
    assert!(groom.strands().iter().all(|hair| hair.iter().all(|p| p.is_finite())));
    assert_ne!(groom.strands().strand(1), groom.strands().strand(2));
    assert!(groom.strands().strand(0).len() < 6 * 110);
}

#[test]
fn libraries_longer_shorter_and_empty_are_laid_along() {
    let (guides, roots) = (guides(1.0), roots(40));
    let library = |turns: f64| {
        let mut one = Strands::default();
        one.push(guide(DVec3::ZERO, turns, 8.0, 0.0)).expect("few points");
        Coils::new(&Spectra::of(&one))
    };
    for coils in [library(2.0), library(60.0), Coils::new(&Spectra::default())] {
        let groom = grow(&guides, &roots, coils, &GrowOptions::default(), 2).expect("sound");
        for hair in groom.strands().iter() {
            let steps = hair.windows(2).map(|e| e[0].distance(e[1]));
            assert!(steps.fold(0.0, f64::max) < 2.5);
        }
    }
}

#[test]
fn moving_guides_take_their_hairs_along_without_popping() {
    let (first, roots, mut plan) = planned(&GrowOptions::default(), 4);
    let mut before = plan.grow(&first, &roots).expect("as planned");
    let counts: Vec<_> = before.strands().counts().collect();
    let mut guides_before = first;
    for frame in 1..=20 {
        let moved = guides(2.0 + 0.1 * f64::from(frame));
        plan = plan.moved(&moved).expect("as many points");
        let groom = plan.grow(&moved, &roots).expect("as planned");
        assert!(groom.strands().counts().eq(counts.iter().copied()));
        let most = |a: &[DVec3], b: &[DVec3]| {
            a.iter().zip(b).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
        };
        let guide_change = most(guides_before.points(), moved.points());
        let change = most(before.strands().points(), groom.strands().points());
        assert!(change < 2.0 * guide_change, "{frame}: {change} for {guide_change}");
        (before, guides_before) = (groom, moved);
    }
}

#[test]
fn plans_refuse_what_they_were_not_made_for() {
    let (guides, roots, plan) = planned(&GrowOptions::default(), 4);
    let fewer = plan.grow(&guides, &roots[1..]);
    assert_eq!(fewer, Err(GrowError::Frame { of: "roots", found: 299, expected: 300 }));
    let other = plan.grow(&guides.select([0, 1]), &roots);
    assert_eq!(other, Err(GrowError::Frame { of: "guides", found: 2, expected: 6 }));
    let points = plan.grow(&guides.select([5, 1, 2, 3, 4, 0]), &roots);
    assert!(matches!(points, Err(GrowError::Frame { of: "points in one guide", .. })));
    let options = GrowOptions { shorter: 2.0, ..GrowOptions::default() };
    let none = Plan::new(&guides, &roots, &[0; 300], shipped(), &options, 1);
    assert!(matches!(none, Err(GrowError::Options(_))));
    let options = GrowOptions::default();
    let absent = Plan::new(&guides, &roots, &[9; 300], shipped(), &options, 1).err();
    assert_eq!(absent, Some(GrowError::NoGuide { root: 0, guide: 9, guides: 6 }));
    let short = Plan::new(&guides, &roots, &[0], shipped(), &options, 1).err();
    assert_eq!(short, Some(GrowError::Assigned { assigned: 1, roots: 300 }));
}

#[test]
fn a_narrow_wisp_is_its_guide() {
    let options = GrowOptions {
        wisp: Curve::constant(0.0),
        loose: (0.2, 0.2),
        shorter: 0.0,
        ..GrowOptions::default()
    };
    let (guides, roots, plan) = planned(&options, 1);
    let groom = plan.grow(&guides, &roots).expect("as planned");
    for ((hair, joint), name) in groom.strands().iter().zip(plan.joints()).zip(plan.guides()) {
        let guide = guides.strand(name as usize);
        let same = hair[joint..].iter().zip(&guide[guide.len() - (hair.len() - joint)..]);
        assert!(same.into_iter().all(|(p, q)| p.distance(*q) < 1e-9));
    }
}
