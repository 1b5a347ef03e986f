//! Procedural grooms: operators forward, and grooms with known parameters recovered.
//!
//! The seven known grooms are fitted with a share of their strands, [`SHARE`] unless the
//! environment variable `TRESS_BENCH_FULL` is set: then with all, which takes many minutes, and
//! with the bars that are set for so many.

use std::time::Instant;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tress::geometry::Groom;
use tress::procedural::fit::{Fitter, Stage, StageOptions};
use tress::procedural::synthetic::{COUNT, Known, known};
use tress::procedural::{
    Bend, Bound, Chain, Clump, Curl, EvenStrands, Frizz, Operator, ProceduralGroom, Scale, draw,
};

use crate::Outcome;
use crate::metric::{Bar, Figures, say};
use crate::process::held;

pub(crate) const NAMES: &[&str] = &[
    "operators_100k_seconds",
    "inverse_7k_seconds",
    "inverse_14k_seconds",
    "inverse_28k_seconds",
    "inverse_30k_seconds",
    "inverse_peak_gigabytes",
    "inverse_worst_error",
    "inverse_worst_of_truth",
    "inverse_starts_apart",
];

/// The share of strands that is fitted in a quick run.
const SHARE: f64 = 0.15;

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    forward(figures)?;
    let full = std::env::var_os("TRESS_BENCH_FULL").is_some();
    recover_all(figures, if full { 1.0 } else { SHARE })?;
    if full {
        growth(figures)?;
        starts(figures)?;
    }
    Ok(())
}

/// 100,000 strands of 100 points through all five operators.
fn forward(figures: &mut Figures) -> Outcome {
    const POINTS: usize = 100;
    let guides = known(1, 0.01)?.groom.guides;
    let line = |i: usize| guides.strand(i % guides.len())[..POINTS].to_vec();
    let given = EvenStrands::new(POINTS, (0..100_000).flat_map(line).collect())?;
    let guides = EvenStrands::new(POINTS, (0..guides.len()).flat_map(line).collect())?;
    let operators = vec![
        Operator::Scale(Scale { random: 0.2 }),
        Operator::Clump(Clump { profile: 1.0 }),
        Operator::Bend(Bend { angle_degrees: 30.0, start: 0.4 }),
        Operator::Curl(Curl { radius: 0.9, frequency: 0.1, random_frequency: 0.01, start: 0.2 }),
        Operator::Frizz(Frizz { frequency: 1.0, amplitude: 0.2 }),
    ];
    let numbers = draw(&operators, given.len(), guides.len(), 1);
    let operator_of: Vec<u32> = (0..500).cycle().take(given.len()).collect();
    let bound = Bound { guides: &guides, operator_of: &operator_of, numbers: &numbers };
    let chain = Chain { operators, ..Chain::default() };
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let mut strands = given.clone();
        let started = Instant::now();
        chain.apply(&mut strands, &bound, 0)?;
        best = best.min(started.elapsed().as_secs_f64());
    }
    figures.add("operators_100k_seconds", best, "s", Bar::AtMost(0.5));
    Ok(())
}

/// The seven known grooms: the truth and what was found of every parameter.
fn recover_all(figures: &mut Figures, share: f64) -> Outcome {
    let (mut worst, mut worst_of_truth): (f64, f64) = (0.0, 0.0);
    let mut peak: f64 = 0.0;
    for style in 0..COUNT {
        let known = known(style, share)?;
        let ((groom, seconds), bytes) = held(|| fitted(&known, &known.start))?;
        peak = peak.max(bytes.unwrap_or(0.0));
        let (strands, distance) = (known.groom.roots.len(), known.guides_off(&groom));
        let what = known.name;
        say(&format!("# {what}: {strands} strands, {seconds:.0} s, guides {distance:.3} cm off"));
        let errors = table(&known, &groom);
        worst = worst.max(errors[0]);
        worst_of_truth = worst_of_truth.max(errors[1]);
        let bar = |most: f64| if share < 1.0 { Bar::None } else { Bar::AtMost(most) };
        match style {
            1 if share >= 1.0 => figures.add("inverse_14k_seconds", seconds, "s", bar(300.0)),
            2 if share >= 1.0 => figures.add("inverse_30k_seconds", seconds, "s", bar(720.0)),
            _ => {}
        }
    }
    figures.add("inverse_worst_error", worst, "%", Bar::AtMost(10.0));
    figures.add("inverse_worst_of_truth", worst_of_truth, "%", Bar::None);
    if 0.0 < peak {
        figures.add("inverse_peak_gigabytes", peak / 1e9, "GB", Bar::AtMost(4.0));
    }
    Ok(())
}

/// Seconds of the first groom at a quarter and at all of its strands.
fn growth(figures: &mut Figures) -> Outcome {
    for (share, name) in [(0.25, "inverse_7k_seconds"), (1.0, "inverse_28k_seconds")] {
        let known = known(0, share)?;
        let (_, seconds) = fitted(&known, &known.start)?;
        figures.add(name, seconds, "s", Bar::None);
    }
    Ok(())
}

/// How far parameters are apart that were found from starts drawn at random, waves and curls.
fn starts(figures: &mut Figures) -> Outcome {
    let mut worst: f64 = 0.0;
    for style in [0, 1] {
        let known = known(style, SHARE)?;
        let (given, _) = fitted(&known, &known.start)?;
        for seed in 1..=3 {
            let (found, _) = fitted(&known, &anywhere(&known.groom.chain, seed))?;
            let pairs = given.chain.operators.iter().zip(&found.chain.operators);
            let values = pairs.flat_map(|(a, b)| a.values().into_iter().zip(b.values()));
            let apart = values.map(|(a, b)| 100.0 * (a - b).abs() / a).fold(0.0, f64::max);
            say(&format!("# {}, start {seed}: parameters {apart:.2} % apart", known.name));
            worst = worst.max(apart);
        }
    }
    figures.add("inverse_starts_apart", worst, "%", Bar::None);
    Ok(())
}

/// Where a search may begin: sizes and frequencies up to eight times too great or too small, all
/// else anywhere in its range.
fn anywhere(truth: &Chain, seed: u64) -> Chain {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut chain = truth.clone();
    for operator in &mut chain.operators {
        for (parameter, value) in operator.parameters().iter().zip(operator.values_mut()) {
            *value = if parameter.greatest.is_finite() {
                rng.random_range(parameter.least..2.0 * parameter.typical)
            } else {
                *value * 8_f64.powf(rng.random_range(-1.0..1.0))
            };
        }
    }
    chain
}

/// The groom found from its strands alone, and the seconds of all stages.
fn fitted(known: &Known, start: &Chain) -> Outcome<(ProceduralGroom, f64)> {
    let target: Groom = known.groom.build_groom()?;
    let options = StageOptions { own_weights: false, ..StageOptions::default() };
    let started = Instant::now();
    let mut fitter = Fitter::new(&target, start.clone(), options)?;
    while fitter.advance(&mut |_| {})? != Stage::Done {}
    let seconds = started.elapsed().as_secs_f64();
    let groom = fitter.groom().ok_or("nothing was found")?;
    Ok((groom.clone(), seconds))
}

/// Says truth, found and error of each parameter; gives the worst error of range or truth,
/// whichever is the less, and the worst of the truth.
fn table(known: &Known, groom: &ProceduralGroom) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for (truth, found) in known.groom.chain.operators.iter().zip(&groom.chain.operators) {
        let values = truth.values().into_iter().zip(found.values());
        for (parameter, (a, b)) in truth.parameters().iter().zip(values) {
            let name = format!("{} {}", truth.name(), parameter.name);
            let of_truth = 100.0 * (a - b).abs() / a;
            let error = range(&name).map_or(of_truth, |r| of_truth.min(100.0 * (a - b).abs() / r));
            worst[0] = worst[0].max(error);
            worst[1] = worst[1].max(of_truth);
            let line = format!("#   {name:<24}{a:>10.4}{b:>10.4}{of_truth:>8.1} %{error:>8.1} %");
            say(&line);
        }
    }
    worst
}

/// The range of parameters that have one of their own.
fn range(name: &str) -> Option<f64> {
    match name {
        "scale random" | "bend start" | "curl start" => Some(1.0),
        "bend angle_degrees" => Some(180.0),
        _ => None,
    }
}
