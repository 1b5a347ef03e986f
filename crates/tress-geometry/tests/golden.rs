//! The chain and its derivatives against values computed elsewhere in 50-digit arithmetic.

use glam::{DMat3, DVec3};
use serde::Deserialize;
use tress_geometry::{ChainScratch, Element, Frame, SuperHelix, jacobian};

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
    arc_lengths: Vec<f64>,
    positions: Vec<[f64; 3]>,
    frame_rows: Vec<[[f64; 3]; 3]>,
    #[serde(default)]
    jacobian_arc_lengths: Vec<f64>,
    #[serde(default)]
    jacobians: Vec<[Vec<f64>; 3]>,
}

fn from_rows(rows: [[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(&rows).transpose()
}

impl Case {
    fn elements(&self) -> Vec<Element> {
        let pairs = self.q.iter().zip(&self.lengths);
        pairs.map(|(&q, &length)| Element { curvature: q.into(), length }).collect()
    }

    fn root(&self) -> Frame {
        Frame { position: self.root.into(), axes: from_rows(self.root_frame_rows) }
    }
}

fn cases() -> Vec<Case> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/golden/superhelix.json");
    let text = std::fs::read_to_string(path).expect("the golden file is part of the project");
    let golden: Golden = serde_json::from_str(&text).expect("the golden file is well-formed");
    assert_eq!(golden.cases.len(), 9);
    golden.cases
}

#[test]
fn positions_and_frames_are_right_to_1e_12() {
    for case in cases() {
        let elements = case.elements();
        let strand = SuperHelix { root: case.root(), elements: &elements };
        let frames = strand.frames_at(case.arc_lengths.iter().copied());
        for ((frame, position), rows) in frames.zip(&case.positions).zip(&case.frame_rows) {
            let position = DVec3::from(*position);
            let error = frame.position.distance(position);
            assert!(error < 1e-12 * position.length().max(1.0), "{}: {error:e}", case.name);
            let off = frame.axes - from_rows(*rows);
            assert!(off.to_cols_array().iter().all(|e| e.abs() < 1e-12), "{}: {off}", case.name);
        }
    }
}

#[test]
fn jacobians_are_right_to_1e_12() {
    let mut checked = 0;
    for case in cases() {
        let elements = case.elements();
        let strand = SuperHelix { root: case.root(), elements: &elements };
        let n = elements.len();
        let s = &case.jacobian_arc_lengths;
        let mut blocks = vec![DMat3::ZERO; n * s.len()];
        jacobian(&strand, s, &mut ChainScratch::default(), &mut blocks);
        for (k, rows) in case.jacobians.iter().enumerate() {
            let largest = rows.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (row, values) in rows.iter().enumerate() {
                for (column, value) in values.iter().enumerate() {
                    let ours = blocks[k * n + column / 3].col(column % 3)[row];
                    let error = (ours - value).abs();
                    assert!(error < 1e-12 * largest, "{} {row} {column}: {error:e}", case.name);
                    checked += 1;
                }
            }
        }
    }
    assert_eq!(checked, 468, "entries of Jacobians compared");
}
