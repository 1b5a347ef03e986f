//! Switchbacks: the exact equilibrium against collocation, its time, and that of the published
//! approximation.

use serde::Deserialize;
use tress::fit::{Elements, FitOptions, Sampling, fit, sample};
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, HelixGroom};
use tress::switchback::{
    InsertOptions, Material, Placing, Profile, Ritz, RitzOptions, Switchback, SwitchbackError,
    greatest_distance, insert,
};
use tress_fixtures::{PatchOptions, coily_patch};

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
    "switchback_wisp_spread",
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
    wisps(figures)
}

/// Strands in a wisp of the measurement below.
const WISP: usize = 22;

/// Whether wisps stay wisps: how far strands are from their neighbours in the wisp, behind a
/// switchback in the middle, over how far they were before it was put in.
fn wisps(figures: &mut Figures) -> Outcome {
    let options = PatchOptions { wisps: 24, strands_per_wisp: WISP, ..PatchOptions::default() };
    let elements = Elements::Count(150);
    let fitted = fit(&coily_patch(&options, 3), &FitOptions { elements, ..FitOptions::default() })?;
    let groups: Vec<u32> = (0..24).flat_map(|wisp| [wisp; WISP]).collect();
    let middle = Placing::Shares(vec![0.5]);
    let inserting = InsertOptions::default();
    let (changed, report) = insert(&fitted.helices, &groups, &middle, &inserting, 1)?;
    say(&format!("# {} of {} strands got a switchback", report.strands, report.asked));
    let points = |helices: &HelixGroom| sample(helices, &Sampling::PerTurn(16.0));
    let (before, after) = (points(&fitted.helices)?, points(&changed)?);
    // Wisps that have one on every strand.
    let mut whole = [0; 24];
    report.placed.iter().for_each(|(strand, _)| whole[*strand as usize / WISP] += 1);
    let whole = |wisp: &usize| whole[*wisp] == WISP;
    let apart = |groom: &Groom| (0..24).filter(whole).map(|i| apart(groom, i)).sum::<f64>();
    figures.add("switchback_wisp_spread", apart(&after) / apart(&before), "times", Bar::None);
    Ok(())
}

/// Mean distance from points in the further half of a wisp's strands to the nearest of the others.
fn apart(groom: &Groom, wisp: usize) -> f64 {
    let strands = wisp * WISP..(wisp + 1) * WISP;
    let (mut sum, mut n) = (0.0, 0.0);
    for i in strands.clone() {
        let points = groom.strands().strand(i);
        for here in points[points.len() / 2..].iter().step_by(5) {
            let others = strands.clone().filter(|other| *other != i);
            let others = others.flat_map(|other| groom.strands().strand(other));
            let nearest = others.map(|p| p.distance_squared(*here)).fold(f64::INFINITY, f64::min);
            sum += nearest.sqrt();
            n += 1.0;
        }
    }
    sum / n
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
