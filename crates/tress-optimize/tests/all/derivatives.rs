//! Derivatives against 50-digit values, the published algorithms, and differences.

use glam::{DMat3, DVec3};
use proptest::prelude::*;
use serde::Deserialize;
use tress_geometry::{ChainScratch, Element, Frame, SuperHelix, jacobian};
use tress_optimize::{Control, Objective, SculptOptions, Stiffness};

use crate::common::{coil, targets};

#[path = "../../benches/sculpt/algorithms.rs"]
mod algorithms;

#[derive(Deserialize)]
struct Golden {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    root: [f64; 3],
    root_frame_rows: [[f64; 3]; 3],
    q: Vec<[f64; 3]>,
    lengths: Vec<f64>,
    #[serde(default)]
    jacobian_arc_lengths: Vec<f64>,
    #[serde(default)]
    jacobians: Vec<[Vec<f64>; 3]>,
}

fn cases() -> Vec<Case> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/golden/superhelix.json");
    let text = std::fs::read_to_string(path).expect("the golden file is part of the project");
    serde_json::from_str::<Golden>(&text).expect("the golden file is well-formed").cases
}

/// The gradient of the anchors' term is `2 J^T r`: with one control and a residual along an axis
/// it is a row of the Jacobian.
#[test]
fn gradients_are_those_of_the_golden_jacobians() {
    let mut checked = 0;
    for case in cases() {
        let pairs = case.q.iter().zip(&case.lengths);
        let elements: Vec<Element> =
            pairs.map(|(&q, &length)| Element { curvature: q.into(), length }).collect();
        let axes = DMat3::from_cols_array_2d(&case.root_frame_rows).transpose();
        let root = Frame { position: case.root.into(), axes };
        let strand = SuperHelix { root, elements: &elements };
        for (&lambda, rows) in case.jacobian_arc_lengths.iter().zip(&case.jacobians) {
            let largest = rows.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (axis, row) in DVec3::AXES.into_iter().zip(rows) {
                let step = 0.25 * strand.length();
                let position = strand.position_at(lambda);
                let inward = if 0.0 < (position - root.position).dot(axis) { -axis } else { axis };
                let control = [Control::new(lambda, position + step * inward)];
                let mut energy = Objective::new(&strand, &control, &SculptOptions::published(0.0))
                    .expect("a good control");
                let mut gradient = vec![DVec3::ZERO; elements.len()];
                energy.evaluate(&elements, &mut gradient);
                if 0 < energy.unreachable() {
                    continue;
                }
                let ours = gradient.iter().flat_map(|g| g.to_array());
                for (ours, value) in ours.zip(row) {
                    let ours = ours / (-2.0 * step * inward.dot(axis));
                    let error = (ours - value).abs();
                    assert!(error < 1e-10 * largest, "{} {axis}: {error:e}", case.name);
                    checked += 1;
                }
            }
        }
    }
    assert!(300 < checked, "{checked} entries of Jacobians compared");
}

#[test]
fn the_published_tables_agree() {
    for (seed, n_elements) in (0..20).zip(5..) {
        let (root, elements) = coil(seed, n_elements);
        let strand = SuperHelix { root, elements: &elements };
        let n = elements.len();
        let s = [0.2, 0.55, 1.0].map(|part| part * strand.length());
        let mut ours = vec![DMat3::ZERO; 3 * n];
        let mut theirs = ours.clone();
        jacobian(&strand, &s, &mut ChainScratch::default(), &mut ours);
        algorithms::jacobian(&strand, &s, &mut algorithms::Tables::default(), &mut theirs);
        for (a, b) in ours.iter().zip(&theirs) {
            let off = (*a - *b).to_cols_array().into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            assert!(off < 1e-10 * strand.length().powi(2), "seed {seed}: {off:e}");
        }
    }
}

/// Straight, twisted only, all but straight and tight elements.
fn degenerate() -> impl Strategy<Value = Vec<Element>> {
    let magnitude = prop_oneof![Just(0.0), Just(1e-13), Just(1e-8), Just(1.0), Just(30.0)];
    let element = (prop::array::uniform3(-1.0..1.0), magnitude, any::<bool>(), 0.02..0.3).prop_map(
        |(q, magnitude, twist_only, length)| {
            let q = DVec3::from_array(q) * magnitude;
            Element { curvature: if twist_only { q * DVec3::X } else { q }, length }
        },
    );
    prop::collection::vec(element, 1..8)
}

proptest! {
    #[test]
    fn gradients_agree_with_differences_at_degenerate_curvatures(
        elements in degenerate(),
        shift in prop::array::uniform3(-0.1..0.1),
        stiffness in prop_oneof![
            Just(Stiffness::Raw(0.0)), Just(Stiffness::Raw(0.3)), Just(Stiffness::Relative(0.3)),
        ],
    ) {
        let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
        let controls = targets(&strand, 2, 0.2, 4);
        let options = SculptOptions { stiffness, ..Default::default() };
        let mut energy = Objective::new(&strand, &controls, &options).expect("good controls");
        let mut at = elements.clone();
        for element in &mut at {
            element.curvature += DVec3::from_array(shift);
        }
        let mut gradient = vec![DVec3::ZERO; at.len()];
        let mut unused = gradient.clone();
        energy.evaluate(&at, &mut gradient);
        for j in 0..at.len() {
            for axis in 0..3 {
                let h = 1e-5 * (1.0 + at[j].curvature.length());
                let mut value = |by: f64| {
                    let mut moved = at.clone();
                    moved[j].curvature[axis] += by;
                    energy.evaluate(&moved, &mut unused).total()
                };
                let slope = (value(h) - value(-h)) / (2.0 * h);
                prop_assert!((slope - gradient[j][axis]).abs() < 1e-7, "{slope} {gradient:?}");
            }
        }
    }
}
