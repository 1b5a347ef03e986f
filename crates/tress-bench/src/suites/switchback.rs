//! Switchbacks: the exact equilibrium against collocation, its time, and that of the published
//! approximation.

use serde::Deserialize;
use tress::geometry::glam::DVec3;
use tress::switchback::{
    Material, Profile, Ritz, RitzOptions, Switchback, SwitchbackError, greatest_distance,
};

use crate::Outcome;
use crate::grooms::root;
use crate::metric::{Bar, Figures, say};

use super::best_of;

pub(crate) const NAMES: &[&str] = &[
    "switchback_error",
    "switchback_cold_ms",
    "switchback_warm_ms",
    "switchback_ritz_ms",
    "switchback_ritz_distance",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    let error = greatest_error()?;
    say(&format!("# greatest error of the exact switchback: {error:.2e}"));
    figures.add("switchback_error", error, "rest curvatures", Bar::AtMost(1e-7));

    // The whole range of coils; what takes longest counts.
    let (mut cold, mut warm): (f64, f64) = (0.0, 0.0);
    for poisson_ratio in [0.0, 0.25, 0.5] {
        let material = Material { poisson_ratio, rest_twist: 0.0 };
        for i in 1..=19 {
            let v = 0.05 * f64::from(i);
            cold = cold.max(best_of(20, || Switchback::new(v, &material))?);
            let neighbour = Switchback::new(v - 0.01, &material)?;
            warm = warm.max(best_of(20, || neighbour.near(v))?);
        }
    }
    figures.add("switchback_cold_ms", 1e3 * cold, "ms", Bar::AtMost(5.0));
    figures.add("switchback_warm_ms", 1e3 * warm, "ms", Bar::AtMost(1.0));

    let (material, options) = (Material::default(), RitzOptions::default());
    let (mut time, mut distance): (f64, f64) = (0.0, 0.0);
    for v in [0.2, 0.4, 0.6, 0.8] {
        time = time.max(best_of(3, || Ritz::new(v, &material, &options))?);
        let (ritz, exact) = approximations(v, &material, &options)?;
        let off = greatest_distance(&ritz, &exact, exact.half_width(0.01));
        say(&format!("# Rayleigh-Ritz at v = {v}: {off:.3} rest curvatures from equilibrium"));
        distance = distance.max(off);
    }
    figures.add("switchback_ritz_ms", 1e3 * time, "ms", Bar::AtMost(100.0));
    figures.add("switchback_ritz_distance", distance, "rest curvatures", Bar::None);
    Ok(())
}

fn approximations(
    v: f64,
    material: &Material,
    options: &RitzOptions,
) -> Result<(Ritz, Switchback), SwitchbackError> {
    Ok((Ritz::new(v, material, options)?, Switchback::new(v, material)?))
}

#[derive(Deserialize)]
struct Golden {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    v: f64,
    poisson_ratio: f64,
    s: Vec<f64>,
    kappa1: Vec<f64>,
    kappa2: Vec<f64>,
    kappa3: Vec<f64>,
}

/// Against solutions by collocation, made elsewhere.
fn greatest_error() -> Outcome<f64> {
    let path = root().join("fixtures/golden/switchback.json");
    let golden: Golden = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let mut worst: f64 = 0.0;
    for case in golden.cases {
        let material = Material { poisson_ratio: case.poisson_ratio, rest_twist: 0.0 };
        let switchback = Switchback::new(case.v, &material)?;
        let bent = case.kappa1.iter().zip(&case.kappa2).zip(&case.kappa3);
        for (s, ((k1, k2), k3)) in case.s.iter().zip(bent) {
            let off = switchback.curvature(*s).distance(DVec3::new(*k1, *k2, *k3));
            worst = worst.max(off);
        }
    }
    Ok(worst)
}
