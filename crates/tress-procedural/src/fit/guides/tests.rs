//! The sweep against differences, and guides that find their way back.

use super::descent::{advance, sweep};
use super::*;
use crate::{Bend, Clump, Instancing};

fn grid() -> EvenStrands {
    let strand = |i: u32| {
        let root = DVec3::new(f64::from(i % 6), 0.0, f64::from(i / 6));
        (0..20).map(move |j| {
            let s = 0.2 * f64::from(j);
            root + DVec3::new(0.1 * s * s, -s, 0.3 * (0.7 * s + root.x).sin())
        })
    };
    EvenStrands::new(20, (0..36).flat_map(strand).collect()).expect("whole strands")
}

#[test]
fn the_sweep_agrees_with_differences() {
    let guide = grid().strand(7).to_vec();
    let weights: Vec<DVec3> =
        (0..20).map(f64::from).map(|x| DVec3::new(x.sin(), x.cos(), 0.3 * x)).collect();
    let loss =
        |guide: &[DVec3]| -> f64 { guide.iter().zip(&weights).map(|(x, w)| x.dot(*w)).sum() };
    let (mut turning, mut length) = (vec![DVec3::ZERO; 19], vec![DVec3::ZERO; 19]);
    sweep(&guide, &weights, &mut turning, &mut length);
    for k in 0..19 {
        for axis in DVec3::AXES {
            let moved = |h: f64| {
                let mut guide = guide.clone();
                let mut unit = vec![DVec3::ZERO; 19];
                unit[k] = axis;
                advance(&mut guide, &unit, &vec![DVec3::ZERO; 19], -h, 0.0);
                loss(&guide)
            };
            let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((difference - turning[k].dot(axis)).abs() < 1e-7, "turning at {k}");
        }
        let moved = |h: f64| {
            let mut guide = guide.clone();
            let mut unit = vec![DVec3::ZERO; 19];
            unit[k] = DVec3::X;
            advance(&mut guide, &vec![DVec3::ZERO; 19], &unit, 0.0, -h);
            loss(&guide)
        };
        let segment = guide[k].distance(guide[k + 1]);
        let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
        assert!((difference - segment * length[k].x).abs() < 1e-7, "length of {k}");
    }
}

/// Strands at the guides' roots, blended from guides that are bent and shortened.
fn bent() -> (ProceduralGroom, EvenStrands) {
    let truth = grid();
    let roots = Roots { positions: truth.roots(), uv: None };
    let mut groom = ProceduralGroom::new(truth, roots).expect("sound guides");
    groom.instancing = Instancing::Gaussian { neighbors: 4, sigma: 0.5 };
    let targets = groom.build().expect("a sound groom");
    let unit = vec![DVec3::X; 19];
    for i in 0..groom.guides.len() {
        advance(groom.guides.strand_mut(i), &unit, &unit, 0.02, 0.1);
    }
    (groom, targets)
}

#[test]
fn bent_guides_find_their_way_back() {
    let (mut groom, targets) = bent();
    let roots = groom.guides.roots();
    let sound: Vec<usize> = (0..36).collect();
    let mut losses = Vec::new();
    let options = GuideOptions::default();
    let mut watch = |loss| losses.push(loss);
    let last = refine_guides(&mut groom, &targets, &sound, &[], &options, &mut watch)
        .expect("finite losses");
    assert!(last < 0.02 * losses[0], "{last} from {}", losses[0]);
    assert_eq!(groom.guides.roots(), roots);
}

#[test]
fn lengths_are_kept_without_stretch() {
    let (mut groom, targets) = bent();
    let lengths = |guides: &EvenStrands| -> Vec<f64> {
        guides.iter().flat_map(segments).map(DVec3::length).collect()
    };
    let before = lengths(&groom.guides);
    let sound: Vec<usize> = (0..36).collect();
    let options = GuideOptions { stretch: 0.0, ..GuideOptions::default() };
    refine_guides(&mut groom, &targets, &sound, &[], &options, &mut |_| {}).expect("finite losses");
    let after = lengths(&groom.guides);
    assert!(before.iter().zip(&after).all(|(a, b)| (a - b).abs() < 1e-12));
}

#[test]
fn the_gradient_through_bends_and_clumps_agrees_with_differences() {
    let (groom, targets) = bent();
    let sound: Vec<usize> = (0..36).collect();
    let operators = [
        Operator::Clump(Clump { profile: 0.8 }),
        Operator::Bend(Bend { angle_degrees: 70.0, start: 0.4 }),
    ];
    let model = Expectation::new(&groom, &sound, &operators).expect("a sound groom");
    let loss = |guides: &EvenStrands| {
        let (_, _, strands) = model.strands(guides, 3).expect("a sound chain");
        0.5 * vertex_loss(&strands, &targets) * targets.points().len() as f64
    };
    let mut guides = groom.guides.clone();
    let (instanced, numbers, mut residuals) = model.strands(&guides, 3).expect("a sound chain");
    residuals.points_mut().iter_mut().zip(targets.points()).for_each(|(x, target)| *x -= *target);
    let exact = model.pull_back(&guides, &instanced, &numbers, &residuals).expect("a sound chain");
    for (guide, point) in [(0, 1), (7, 10), (20, 19)] {
        for axis in 0..3 {
            let mut at = |h: f64| {
                guides.strand_mut(guide)[point][axis] += h;
                let value = loss(&guides);
                guides.strand_mut(guide)[point][axis] -= h;
                value
            };
            let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
            let by_point = exact.strand(guide)[point][axis];
            assert!((difference - by_point).abs() < 1e-6, "{difference} against {by_point}");
        }
    }
}

#[test]
fn a_loss_that_is_not_a_number_is_said() {
    let (mut groom, mut targets) = bent();
    targets.strand_mut(3)[4].x = f64::NAN;
    let before = groom.guides.clone();
    let sound: Vec<usize> = (0..36).collect();
    let options = GuideOptions::default();
    let error = refine_guides(&mut groom, &targets, &sound, &[], &options, &mut |_| {});
    assert!(error.is_err_and(|error| error.to_string().contains("step 0")));
    assert_eq!(groom.guides, before);
}
