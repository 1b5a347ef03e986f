//! The exact switchback against solutions by collocation, made elsewhere.

use glam::DVec3;
use serde::Deserialize;
use tress_switchback::{Coil, Material, Profile, Switchback};

#[derive(Deserialize)]
struct Golden {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    v: f64,
    poisson_ratio: f64,
    kappa1_h: f64,
    kappa3_h: f64,
    force: f64,
    s: Vec<f64>,
    kappa1: Vec<f64>,
    kappa2: Vec<f64>,
    kappa3: Vec<f64>,
    force_body: Vec<[f64; 3]>,
}

fn cases() -> Vec<Case> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/golden/switchback.json");
    let text = std::fs::read_to_string(path).expect("the golden file is part of the project");
    let golden: Golden = serde_json::from_str(&text).expect("the golden file is well-formed");
    assert_eq!(golden.cases.len(), 16);
    golden.cases
}

#[test]
fn curvatures_and_forces_are_right_to_1e_8() {
    let mut worst: f64 = 0.0;
    for case in cases() {
        let material = Material { poisson_ratio: case.poisson_ratio, rest_twist: 0.0 };
        let switchback = Switchback::new(case.v, &material).expect("a switchback");
        for (i, &s) in case.s.iter().enumerate() {
            let kappa = DVec3::new(case.kappa1[i], case.kappa2[i], case.kappa3[i]);
            worst = worst.max(switchback.curvature(s).distance(kappa));
            worst = worst.max(switchback.force(s).distance(case.force_body[i].into()));
        }
    }
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn coils_are_right_to_1e_13() {
    for case in cases() {
        let material = Material { poisson_ratio: case.poisson_ratio, rest_twist: 0.0 };
        let coil = Coil::new(case.v, &material).expect("a coil");
        assert!((coil.curvature.x - case.kappa1_h).abs() < 1e-13);
        assert!((coil.curvature.z - case.kappa3_h).abs() < 1e-13);
        assert!((coil.pull() - case.force).abs() < 1e-13);
    }
}
