use std::f64::consts::PI;

use glam::DMat3;
use proptest::prelude::*;

use super::*;
use crate::Helicoid;

fn at(x: f64, y: f64, axes: DMat3) -> Frame {
    Frame { position: DVec3::new(x, y, 0.0), axes }
}

fn piece(kt: f64, alpha: f64, length: f64) -> Piece {
    Piece { k: Helicoid::new(kt, -0.1, 0.3, alpha), length }
}

fn groom(hairs: Vec<(Frame, Vec<Piece>)>) -> HelicoidGroom {
    let mut pieces = Strands::default();
    let mut roots = Vec::new();
    for (root, chain) in hairs {
        roots.push(root);
        pieces.push(chain).expect("few pieces");
    }
    HelicoidGroom::new(roots, pieces).expect("parts match")
}

fn rotation() -> impl Strategy<Value = DQuat> {
    (-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64)
        .prop_map(|(x, y, z)| DQuat::from_scaled_axis(DVec3::new(x, y, z)))
}

proptest! {
    #[test]
    fn mean_rotations_move_with_what_is_meant(
        a in rotation(), b in rotation(), c in rotation(), by in rotation(), w in 0.1..0.5_f64,
    ) {
        let mean = |a, b, c| mean_rotation([(a, w), (b, 0.5), (c, 0.5 - w)].into_iter());
        let there = by * mean(a, b, c);
        prop_assert!(there.dot(mean(by * a, by * b, by * c)).abs() > 1.0 - 1e-12);
        let right = mean(a, b, c) * by;
        prop_assert!(right.dot(mean(a * by, b * by, c * by)).abs() > 1.0 - 1e-12);
        prop_assert!(mean(a, -b, c).dot(mean(a, b, c)).abs() > 1.0 - 1e-12);
    }

    #[test]
    fn of_two_rotations_the_mean_is_between(a in rotation(), b in rotation(), t in 0.0..1.0_f64) {
        let mean = mean_rotation([(a, 1.0 - t), (b, t)].into_iter());
        prop_assert!(mean.dot(a.slerp(b, t)).abs() > 1.0 - 1e-12);
    }
}

#[test]
fn at_its_root_a_guide_is_itself() {
    let turned = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 2.0) / 3.0, 0.7);
    let guides = groom(vec![
        (at(0.0, 0.0, DMat3::IDENTITY), vec![piece(1.0, 0.5, 1.0), piece(-2.0, 1.0, 0.5)]),
        (at(1.0, 0.0, turned), vec![piece(-0.5, 2.0, 2.0), piece(0.3, 0.1, 1.0)]),
    ]);
    for mixing in [Mixing::Bends, Mixing::Parameters] {
        let options = FillOptions { mixing, ..FillOptions::default() };
        let roots: Vec<DVec3> = guides.roots().iter().map(|root| root.position).collect();
        let filled = fill(&guides, Roots::Points(&roots), &options).expect("guides");
        for i in 0..2 {
            let (hair, guide) = (filled.hairs.hair(i), guides.hair(i));
            assert!((hair.length() - guide.length()).abs() < 1e-12);
            if mixing == Mixing::Bends {
                let tip = |hair: PHelicoid<'_>| hair.tip(Tracing::default()).expect("clear");
                assert!(tip(hair).position.distance(tip(guide).position) < 1e-9);
            }
        }
    }
}

#[test]
fn mirror_guides_do_not_make_a_straight_hair_between() {
    // The same hair twice, once written with a negative kT in a frame turned by half a turn.
    let (mut root, mut pieces) = (at(2.0, 0.0, DMat3::IDENTITY), vec![piece(-1.0, 1.0, 2.0)]);
    positive_tangential(&mut root, &mut pieces);
    let written = (at(0.0, 0.0, DMat3::IDENTITY), vec![piece(-1.0, 1.0, 2.0)]);
    let guides = groom(vec![written, (root, pieces)]);
    for mixing in [Mixing::Bends, Mixing::Parameters] {
        let options = FillOptions { mixing, ..FillOptions::default() };
        let filled = fill(&guides, Roots::Points(&[DVec3::X]), &options).expect("guides");
        let tip = |hair: PHelicoid<'_>| {
            hair.tip(Tracing::default()).expect("clear").position - hair.root.position
        };
        let apart = tip(filled.hairs.hair(0)).distance(tip(guides.hair(0)));
        assert!(apart < 1e-6, "{mixing:?}: {apart}");
        assert!((filled.hairs.hair(0).pieces[0].k.kt.abs() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn copies_turned_by_half_a_turn_fan_out_between_as_published() {
    // [GH Fig. 6]: two guides, one turned by half a turn about its tangent.
    let k = Piece { k: Helicoid::new(1.0, -0.1, 0.3, 1.0), length: 1.0 };
    let half = DMat3::from_axis_angle(DVec3::X, PI - 1e-6);
    let guides =
        groom(vec![(at(0.0, 0.0, DMat3::IDENTITY), vec![k]), (at(0.0, 4.0, half), vec![k])]);
    let options = FillOptions { mixing: Mixing::Parameters, ..FillOptions::default() };
    let roots: Vec<DVec3> = (0..=8).map(|i| DVec3::new(0.0, 0.5 * f64::from(i), 0.0)).collect();
    let filled = fill(&guides, Roots::Points(&roots), &options).expect("guides");
    for hair in filled.hairs.iter() {
        assert!((hair.pieces[0].k.kt - 1.0).abs() < 1e-12, "as curved as the guides");
    }
}

#[test]
fn a_surface_carries_frames_with_its_normals() {
    // Guides stand on a cylinder about y; half way the hair stands on its normal too.
    let stand = |angle: f64| {
        let turn = DMat3::from_rotation_y(angle);
        let normal = turn * DVec3::Z;
        let axes = turn * DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y);
        (Frame { position: normal, axes }, normal)
    };
    let (first, n0) = stand(-1.2);
    let (second, n1) = stand(1.2);
    let guides =
        groom(vec![(first, vec![piece(0.4, 0.0, 1.0)]), (second, vec![piece(0.4, 0.0, 1.0)])]);
    let (middle, normal) = stand(0.3);
    let roots =
        Roots::Surface { positions: &[middle.position], normals: &[normal], at_guides: &[n0, n1] };
    for mixing in [Mixing::Bends, Mixing::Parameters] {
        let options = FillOptions { mixing, ..FillOptions::default() };
        let filled = fill(&guides, roots, &options).expect("guides");
        assert!(filled.hairs.roots()[0].tangent().distance(normal) < 1e-9);
    }
}

#[test]
fn pieces_are_counted_by_weight() {
    let chain = |n| vec![piece(0.5, 0.2, 1.0 / n as f64); n];
    let guides = groom(vec![
        (at(0.0, 0.0, DMat3::IDENTITY), chain(1)),
        (at(1.0, 0.0, DMat3::IDENTITY), chain(5)),
    ]);
    let roots: Vec<DVec3> = [0.1, 0.5, 0.9].map(|x| DVec3::new(x, 0.0, 0.0)).to_vec();
    for mixing in [Mixing::Bends, Mixing::Parameters] {
        let options = FillOptions { mixing, ..FillOptions::default() };
        let filled = fill(&guides, Roots::Points(&roots), &options).expect("guides");
        assert_eq!(filled.hairs.pieces().counts().collect::<Vec<_>>(), [1, 3, 5]);
        for hair in filled.hairs.iter() {
            assert!((hair.length() - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn guides_in_one_place_or_on_a_line_are_no_trouble() {
    let hair = |x: f64, kt| (at(x, 0.0, DMat3::IDENTITY), vec![piece(kt, 0.0, 1.0)]);
    let one_place = groom(vec![hair(0.0, 1.0), hair(0.0, 3.0)]);
    let roots = [DVec3::ZERO, DVec3::new(5.0, 1.0, 0.0)];
    let filled = fill(&one_place, Roots::Points(&roots), &FillOptions::default()).expect("guides");
    for hair in filled.hairs.iter() {
        assert!((hair.pieces[0].k.kt - 2.0).abs() < 1e-3, "{:?}", hair.pieces);
    }
    let line = groom((0..5).map(|i| hair(f64::from(i), f64::from(i))).collect());
    let filled = fill(&line, Roots::Points(&roots), &FillOptions::default()).expect("guides");
    assert!(filled.hairs.iter().all(|hair| hair.pieces[0].k.is_finite()));
}

#[test]
fn exponent_0_makes_all_hairs_alike() {
    let hair = |x: f64, kt| (at(x, 0.0, DMat3::IDENTITY), vec![piece(kt, 0.0, 1.0)]);
    let guides = groom(vec![hair(0.0, 1.0), hair(1.0, 2.0)]);
    let options = FillOptions { exponent: 0.0, ..FillOptions::default() };
    let roots = [DVec3::new(0.1, 0.0, 0.0), DVec3::new(0.9, 3.0, 0.0)];
    let filled = fill(&guides, Roots::Points(&roots), &options).expect("guides");
    let [first, second] = [0, 1].map(|i| filled.hairs.hair(i).pieces);
    assert_eq!(first, second);
    assert!((bends(first) / 1.5 - bends(guides.hair(0).pieces)).abs() < 0.01);
}

/// Mean curvature of the first piece.
fn bends(pieces: &[Piece]) -> f64 {
    mean_curvature(&pieces[0].k, pieces[0].length).expect("clear")
}

#[test]
fn curls_out_of_step_are_mixed_to_curls() {
    // Four guides around a root, each turned by a quarter of a turn about its tangent: their bends
    // cancel, but not how much they bend, nor how that grows.
    let k = Helicoid::new(1.5, -0.4, 0.3, 0.8);
    let guide = |i: i32| {
        let angle = f64::from(i) * 0.5 * PI;
        let axes = DMat3::from_rotation_x(angle + 0.2);
        (at(angle.cos(), angle.sin(), axes), vec![Piece { k, length: 0.7 }; 3])
    };
    let guides = groom((0..4).map(guide).collect());
    let roots = [DVec3::new(0.1, 0.2, 0.0)];
    let filled = fill(&guides, Roots::Points(&roots), &FillOptions::default()).expect("guides");
    let hair = filled.hairs.hair(0);
    let mixed = hair.pieces[0].k;
    let ratio = bends(hair.pieces) / bends(guides.hair(0).pieces);
    assert!((ratio - 1.0).abs() < 0.1, "{ratio} times as curved");
    let growth = |k: Helicoid| k.alpha * k.kb - k.kn;
    assert!((growth(mixed) - growth(k)).abs() < 1e-9);
    let tip = hair.tip(Tracing::default()).expect("clear").position;
    assert!(tip.distance(hair.root.position) < 0.9 * hair.length(), "it is nearly straight");
}

#[test]
fn growth_is_that_of_the_curvature_at_the_root() {
    // What the mixture takes for it, against the curvatures along the line itself.
    for k in [Helicoid::new(1.5, -0.4, 0.3, 0.8), Helicoid::new(-0.7, 0.2, -0.5, 1.3)] {
        let h = 1e-4;
        let near = mean_curvature(&k, 2.0 * h).expect("clear");
        let at_root = mean_curvature(&k, 0.0).expect("clear");
        let growth = (near / at_root - 1.0) / h;
        assert!((growth - (k.alpha * k.kb - k.kn)).abs() < 1e-3, "{growth}");
    }
}

/// Where a hair goes from its root, in steps of a 24th of a stretch of the test below.
fn line(hair: PHelicoid<'_>) -> [DVec3; 97] {
    let mut points = [DVec3::ZERO; 97];
    hair.sample_evenly(Tracing::default(), &mut points).expect("clear");
    points.map(|point| point - hair.root.position)
}

#[test]
fn held_hairs_follow_the_course_of_the_mean_and_keep_their_curls() {
    // Coils of six turns, half a turn out of step with each other, whose mean is nearly straight.
    let coil = |phase: f64| {
        let k = Helicoid::new(8.0, 0.0, 0.5, 0.7);
        let axes = DMat3::from_rotation_x(phase);
        (at(phase, 0.0, axes), vec![Piece { k, length: 0.5 }; 8])
    };
    let guides = groom(vec![coil(0.0), coil(PI)]);
    let roots = [DVec3::new(1.5, 0.0, 0.0)];
    let made = |hold| {
        let options = FillOptions { hold, ..FillOptions::default() };
        fill(&guides, Roots::Points(&roots), &options).expect("guides").hairs
    };
    let mut weights = Vec::new();
    shepard(roots[0], &[DVec3::ZERO, PI * DVec3::X], &FillOptions::default(), &mut weights);
    let lines = [0, 1].map(|i| line(guides.hair(i)));
    let mean: Vec<DVec3> =
        (0..97).map(|j| weights.iter().map(|&(i, w)| w * lines[i][j]).sum()).collect();
    // How far the averages of the four stretches are off, at most.
    let off_course = |hairs: &HelicoidGroom| {
        let off: Vec<DVec3> =
            line(hairs.hair(0)).iter().zip(&mean).skip(1).map(|(p, q)| p - q).collect();
        let averages = off.chunks_exact(24).map(|stretch| stretch.iter().sum::<DVec3>() / 24.0);
        averages.map(DVec3::length).fold(0.0, f64::max)
    };
    let (free, held) = (made(0), made(4));
    // Held by each of its points it would be twice as far off.
    let (before, after) = (off_course(&free), off_course(&held));
    assert!(after < 0.11 * before, "{after} is not much nearer than {before}");
    // Without a price on curvature it would turn more than twice as far.
    let turning = |hairs: &HelicoidGroom| {
        let mean = |p: &Piece| mean_curvature(&p.k, p.length).expect("clear") * p.length;
        hairs.hair(0).pieces.iter().map(mean).sum::<f64>()
    };
    let ratio = turning(&held) / turning(&free);
    assert!((ratio - 1.0).abs() < 0.15, "{ratio} times the turning");
}

#[test]
fn hairs_mixed_to_singular_ones_get_their_nearest_guide() {
    let hair = |x: f64, kn, length| {
        let k = Helicoid::new(0.01, kn, 0.0, 0.0);
        (at(x, 0.0, DMat3::IDENTITY), vec![Piece { k, length }])
    };
    // Each is clear, half way is not: 1 - 0.5 * 2.25 is below 0.
    let guides = groom(vec![hair(0.0, -1.0, 0.5), hair(1.0, 0.0, 4.0)]);
    let roots = [DVec3::new(0.499, 0.0, 0.0)];
    let filled = fill(&guides, Roots::Points(&roots), &FillOptions::default()).expect("guides");
    assert_eq!(filled.replaced, [0]);
    assert_eq!(filled.hairs.hair(0).pieces, guides.hair(0).pieces);
    assert!(crate::sample(&filled.hairs, 5, Tracing::default()).is_ok());
}

#[test]
fn what_cannot_be_filled_is_refused() {
    let good = groom(vec![(at(0.0, 0.0, DMat3::IDENTITY), vec![piece(1.0, 0.0, 1.0)])]);
    let options = FillOptions::default();
    let points = Roots::Points(&[DVec3::ZERO]);
    for exponent in [-1.0, f64::NAN, f64::INFINITY] {
        let error = fill(&good, points, &FillOptions { exponent, ..options });
        assert!(matches!(error, Err(FillError::Exponent(_))));
    }
    let short = groom(vec![(at(0.0, 0.0, DMat3::IDENTITY), vec![piece(1.0, 0.0, 0.0)])]);
    assert_eq!(fill(&short, points, &options), Err(FillError::NoGuide));
    let sink = Piece { k: Helicoid::new(0.0, -2.0, 0.0, 0.0), length: 1.0 };
    let sink = groom(vec![(at(0.0, 0.0, DMat3::IDENTITY), vec![sink])]);
    assert!(matches!(fill(&sink, points, &options), Err(FillError::Guide { guide: 0, .. })));
    let nowhere = Roots::Points(&[DVec3::NAN]);
    assert_eq!(fill(&good, nowhere, &options), Err(FillError::Root(0)));
    let surface =
        |normals, at_guides| Roots::Surface { positions: &[DVec3::ZERO], normals, at_guides };
    let error = fill(&good, surface(&[], &[DVec3::Z]), &options);
    assert_eq!(error, Err(FillError::Normals { normals: 0, roots: 1 }));
    let error = fill(&good, surface(&[DVec3::Z], &[DVec3::ZERO]), &options);
    assert_eq!(error, Err(FillError::Root(1)));
}

#[test]
fn threads_do_not_change_the_result() {
    let hair = |i: i32| {
        let x = f64::from(i);
        (at(x, x * x, DMat3::from_rotation_x(x)), vec![piece(0.1 * x, 0.3 * x, 1.0); 3])
    };
    let guides = groom((0..7).map(hair).collect());
    let roots: Vec<DVec3> = (0..500).map(|i| DVec3::new(f64::from(i) * 0.01, 2.0, 0.0)).collect();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let options = FillOptions::default();
        pool.install(|| fill(&guides, Roots::Points(&roots), &options).expect("guides"))
    };
    assert_eq!(on(1), on(4));
}
