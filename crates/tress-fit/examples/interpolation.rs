//! What is between the points of a coil? Prints, as Markdown, how near each way of fitting comes
//! to coils that are known everywhere and given to the fit only at a few points a turn.
//!
//! `cargo run --release -p tress-fit --example interpolation`

use std::f64::consts::TAU;

use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tress_fit::{FitOptions, Floating, Refine, StrandFit, TangentRule, fit_strand};
use tress_geometry::{Element, Frame, SuperHelix};

/// A coil given by its curvature and torsion along the strand; its turns are `turns`.
struct Truth {
    name: &'static str,
    elements: Vec<Element>,
    turns: f64,
    radius: f64,
}

/// Elements that stand for one turn of the truth: enough that what they leave out is rounding
/// against what is measured.
const FINE: usize = 2000;

impl Truth {
    /// A strand of `turns` turns, about 1 per unit of `x`, whose material curvatures at `x` in 0
    /// to `turns` are `q(x)`, with `|q|` about `TAU`.
    fn new(name: &'static str, turns: usize, q: impl Fn(f64) -> DVec3) -> Self {
        let n = FINE * turns;
        let length = 1.0 / FINE as f64;
        let elements: Vec<Element> =
            (0..n).map(|i| Element { curvature: q((i as f64 + 0.5) * length), length }).collect();
        let turns = elements.iter().map(Element::turns).sum();
        let radius = elements.iter().map(Element::radius).sum::<f64>() / n as f64;
        Self { name, elements, turns, radius }
    }

    fn curve(&self) -> SuperHelix<'_> {
        SuperHelix { root: Frame::IDENTITY, elements: &self.elements }
    }

    /// As many points a turn, each moved by up to `noise` radii.
    fn thinned(&self, per_turn: f64, noise: f64) -> Vec<DVec3> {
        let length = self.curve().length();
        let n = (self.turns * per_turn).round();
        let mut rng = Pcg64Mcg::seed_from_u64(7);
        let mut jitter = || self.radius * noise * rng.random_range(-1.0..1.0);
        let at = |i: u32| length * (f64::from(i) / n);
        let curve = self.curve();
        let frames = curve.frames_at((0..).map(at).take_while(|s| *s <= length + 1e-9));
        frames.map(|f| f.position + DVec3::new(jitter(), jitter(), jitter())).collect()
    }
}

fn truths() -> Vec<Truth> {
    let coil = |slope: f64| TAU * DVec3::new(slope, 0.0, 1.0) / slope.hypot(1.0);
    let bent = |x: f64| {
        let size = 1.0 + 0.15 * (TAU * x / 9.0).sin();
        size * (coil(0.25) + TAU * DVec3::new(0.0, 0.0, 0.12 * (TAU * x).cos()))
    };
    let flip = |x: f64| {
        let hand = ((x - 6.0) / 0.6).tanh();
        TAU * DVec3::new(0.3 * hand, 0.0, 0.95)
    };
    vec![
        Truth::new("helix, flat", 10, |_| coil(0.1)),
        Truth::new("helix, steep", 10, |_| coil(0.7)),
        Truth::new("curled centerline", 12, bent),
        Truth::new("handedness flip", 12, flip),
    ]
}

fn methods() -> Vec<(String, FitOptions)> {
    let mut methods = Vec::new();
    for floating in [Floating::Points, Floating::Tangents] {
        for tangents in [
            TangentRule::Uniform,
            TangentRule::Centripetal,
            TangentRule::Circle,
            TangentRule::Helix,
        ] {
            let name = format!("{tangents:?}, floating {floating:?}").to_lowercase();
            let options = FitOptions { tangents, floating, refine: None, ..FitOptions::default() };
            methods.push((name, options));
        }
    }
    for prior in [1e-1, 1e-2, 1e-3, 1e-4] {
        let refine = Some(Refine { prior, ..Refine::default() });
        let options = FitOptions { refine, ..FitOptions::default() };
        methods.push((format!("helices through the points, prior {prior:.0e}"), options));
    }
    methods
}

/// Errors of a fit: distance, curvature, twist and turns.
#[derive(Default)]
struct Errors {
    distance: f64,
    bending: f64,
    twist: f64,
    turns: f64,
    length: f64,
}

/// Distances are rms over the coil radius, curvature and twist rms over the mean `|q|`.
fn errors(truth: &Truth, fit: &StrandFit) -> Errors {
    const SAMPLES: usize = 4000;
    let (given, fitted) = (truth.curve(), fit.super_helix());
    let (length, own) = (given.length(), fitted.length());
    // Places of the fit are those of the truth as far along; they then slide to the nearest.
    let along = |l: f64| (0..=SAMPLES).map(move |i| l * i as f64 / SAMPLES as f64);
    let positions: Vec<DVec3> = given.frames_at(along(length)).map(|f| f.position).collect();
    let apart = tress_fit::deviation(&fitted, &positions, &along(own).collect::<Vec<_>>());
    let size = TAU * truth.turns / length;
    let mut errors = Errors { distance: apart.rms / truth.radius, ..Errors::default() };
    let (mut s, mut i) = (0.0, 0);
    for (k, x) in along(own).enumerate().skip(1).take(SAMPLES - 1) {
        while s + fit.elements[i].length < x && i + 1 < fit.elements.len() {
            s += fit.elements[i].length;
            i += 1;
        }
        let there = &truth.elements[k * truth.elements.len() / SAMPLES];
        let here = &fit.elements[i];
        errors.bending += ((here.bending() - there.bending()) / size).powi(2);
        errors.twist += ((here.twist() - there.twist()) / size).powi(2);
    }
    errors.bending = (errors.bending / SAMPLES as f64).sqrt();
    errors.twist = (errors.twist / SAMPLES as f64).sqrt();
    errors.turns = fitted.turns() / truth.turns - 1.0;
    errors.length = own / length - 1.0;
    errors
}

#[expect(clippy::print_stdout, reason = "the table is what the program is for")]
fn main() {
    let truths = truths();
    for noise in [0.0, 1e-4] {
        for truth in &truths {
            println!("\n### {}, noise {noise:.0e} R\n", truth.name);
            println!("| fit | points a turn | distance / R | curvature | twist | turns | length |");
            println!("|---|---|---|---|---|---|---|");
            for per_turn in [4.0, 5.0, 8.0, 16.0] {
                let points = truth.thinned(per_turn, noise);
                for (name, options) in methods() {
                    let fit = fit_strand(&points, &options).expect("a strand of points");
                    let e = errors(truth, &fit);
                    println!(
                        "| {name} | {per_turn} | {:.1e} | {:.1e} | {:.1e} | {:+.1e} | {:+.1e} |",
                        e.distance, e.bending, e.twist, e.turns, e.length
                    );
                }
            }
        }
    }
}
