//! Generalized helicoids: filling a head, fitting strands, and what comes back of a groom from a
//! tenth of its strands.

use std::time::Instant;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tress::fit::{Spline, TangentRule};
use tress::geometry::glam::{DMat3, DVec3};
use tress::geometry::{Frame, Groom, Strands};
use tress::helicoid::{
    FillOptions, FitOptions, Helicoid, HelicoidGroom, Method, PHelicoid, Piece, Pieces, Roll,
    Roots, Tracing, fill, fit, fit_strand, sample, shepard,
};

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures, say};

use super::best_of;

pub(crate) const NAMES: &[&str] = &[
    "helicoid_fill_90k_seconds",
    "helicoid_trace_90k_seconds",
    "helicoid_fit_per_second",
    "helicoid_fit_simplex_per_second",
    "helicoid_fit_not_worse",
    "helicoid_fit_coils_per_second",
    "helicoid_fit_coils_not_worse",
    "helicoid_round_trip",
    "helicoid_round_trip_within",
    "helicoid_round_trip_chains",
    "helicoid_euler_error",
    "helicoid_coils10_position",
    "helicoid_coils10_curvature",
    "helicoid_coils10_mean_curvature",
    "helicoid_coils10_distribution",
    "helicoid_coils50_position",
    "helicoid_coils50_curvature",
    "helicoid_coils50_mean_curvature",
    "helicoid_coils50_distribution",
    "helicoid_straight10_position",
    "helicoid_straight10_curvature",
    "helicoid_straight10_mean_curvature",
    "helicoid_straight10_distribution",
    "helicoid_straight50_position",
    "helicoid_straight50_curvature",
    "helicoid_straight50_mean_curvature",
    "helicoid_straight50_distribution",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    filling(figures)?;
    fitting(figures)?;
    round_trip(figures)?;
    reconstruction(figures, "coils", "digitalsalon_harolongo.data", 20, 21)?;
    reconstruction(figures, "straight", "yuksel_straight.hair", 8, 16)
}

/// 90,000 p-helicoids from nine guides of four pieces.
fn filling(figures: &mut Figures) -> Outcome {
    let place = |i: i32| DVec3::new(f64::from(i % 3), f64::from(i / 3), 0.0);
    let upright = DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y);
    let root = |i| Frame {
        position: place(i),
        axes: DMat3::from_rotation_x(0.1 * f64::from(i)) * upright,
    };
    let piece = |i: i32| Piece {
        k: Helicoid::new(1.0 + 0.1 * f64::from(i % 7), -0.1, 0.2, 0.3 * f64::from(i % 5) - 0.5),
        length: 0.5,
    };
    let pieces = Strands::from_counts([4; 9], (0..36).map(piece).collect())?;
    let guides = HelicoidGroom::new((0..9).map(root).collect(), pieces)?;
    let at = |i: i32| DVec3::new(f64::from(i % 300), f64::from(i / 300), 0.0) / 150.0;
    let roots: Vec<DVec3> = (0..90_000).map(at).collect();
    let options = FillOptions { neighbors: 0, ..FillOptions::default() };
    let filled = || fill(&guides, Roots::Points(&roots), &options);
    let seconds = best_of(3, filled)?;
    figures.add("helicoid_fill_90k_seconds", seconds, "s", Bar::AtMost(1.0));
    let hairs = filled()?.hairs;
    let seconds = best_of(3, || sample(&hairs, 30, Tracing::Controlled(1e-5)))?;
    figures.add("helicoid_trace_90k_seconds", seconds, "s", Bar::None);
    Ok(())
}

/// Some strands of a groom, at equal arc lengths.
pub(crate) fn resampled(groom: &Groom, take: usize, points: usize) -> Outcome<Groom> {
    let strands = groom.strands();
    let step = (strands.len() / take).max(1);
    let mut out = Strands::default();
    for i in (0..strands.len()).step_by(step) {
        let curve = Spline::through(strands.strand(i), TangentRule::Helix);
        let last = (points - 1) as f64;
        out.push((0..points).map(|j| curve.at(curve.length() * j as f64 / last).0))?;
    }
    Ok(Groom::new(out))
}

/// Strands of 30 points a second, by both methods, and how the two compare.
fn fitting(figures: &mut Figures) -> Outcome {
    for (kind, file) in
        [("fit", "yuksel_straight.hair"), ("fit_coils", "digitalsalon_harolongo.data")]
    {
        let groom = resampled(&grooms::groom(file, 1000, 30)?, 400, 30)?;
        let strands = groom.strands().len() as f64;
        let newton = FitOptions::default();
        let simplex = FitOptions { method: Method::Simplex, ..newton };
        let seconds = best_of(2, || fit(&groom, &newton))?;
        let bar = if kind == "fit" { Bar::AtLeast(2000.0) } else { Bar::None };
        figures.add(&format!("helicoid_{kind}_per_second"), strands / seconds, "1/s", bar);
        let started = Instant::now();
        let published = fit(&groom, &simplex)?;
        let rate = strands / started.elapsed().as_secs_f64();
        if kind == "fit" {
            figures.add("helicoid_fit_simplex_per_second", rate, "1/s", Bar::AtLeast(200.0));
        }
        let ours = fit(&groom, &newton)?;
        let pieces = |pieces: &[usize]| pieces.iter().sum::<usize>() as f64 / strands;
        let (n, m) = (pieces(&ours.report.pieces), pieces(&published.report.pieces));
        say(&format!(
            "# {file}: {n:.1} pieces a strand, {m:.1} by the simplex, {rate:.0} a second"
        ));
        let pairs = ours.report.frechet.iter().zip(&published.report.frechet);
        let not_worse = pairs.filter(|(a, b)| **a <= 1.05 * **b).count() as f64 / strands;
        let name = format!("helicoid_{kind}_not_worse");
        figures.add(&name, 100.0 * not_worse, "%", Bar::AtLeast(95.0));
    }
    Ok(())
}

/// Known helicoids, drawn at random, are found again: the greatest distance at equal arc lengths
/// over the length, how many are within 1e-4, and the same for chains of three of them. And what
/// Euler's method makes of them with 30 steps.
fn round_trip(figures: &mut Figures) -> Outcome {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let one = FitOptions { pieces: Pieces::UpTo(1), ..FitOptions::default() };
    let (mut worst, mut euler): (f64, f64) = (0.0, 0.0);
    let (mut hairs, mut within) = (0_u32, 0_u32);
    for _ in 0..400 {
        let known = drawn(&mut rng, 4.0);
        let Some(apart) = found_again(&[known], &one)? else { continue };
        worst = worst.max(apart);
        hairs += 1;
        within += u32::from(apart <= 1e-4);
        let hair = PHelicoid { root: Frame::IDENTITY, pieces: &[known] };
        let [mut points, mut again] = [[DVec3::ZERO; 60]; 2];
        hair.sample_evenly(Tracing::Controlled(1e-10), &mut points)?;
        hair.sample_evenly(Tracing::Euler(30), &mut again)?;
        euler = euler.max(greatest(&points, &again) / 4.0);
    }
    let within = 100.0 * f64::from(within) / f64::from(hairs);
    figures.add("helicoid_round_trip", worst, "lengths", Bar::AtMost(1e-4));
    figures.add("helicoid_round_trip_within", within, "%", Bar::None);
    let fine = FitOptions { tolerance: 1e-4, ..FitOptions::default() };
    let mut worst: f64 = 0.0;
    for _ in 0..100 {
        let known: Vec<Piece> = (0..3).map(|_| drawn(&mut rng, 2.0)).collect();
        worst = worst.max(found_again(&known, &fine)?.unwrap_or(0.0));
    }
    figures.add("helicoid_round_trip_chains", worst, "lengths", Bar::None);
    figures.add("helicoid_euler_error", euler, "lengths", Bar::None);
    Ok(())
}

/// A helicoid that bends by up to 11 radians in a length of 4.
fn drawn(rng: &mut Pcg64Mcg, length: f64) -> Piece {
    let kt = rng.random_range(-1.5..1.5);
    let (kn, kb) = (rng.random_range(-0.15..0.3), rng.random_range(-0.3..0.3));
    Piece { k: Helicoid::new(kt, kn, kb, rng.random_range(-1.5..1.5)), length }
}

/// How far the fit to 60 points of a hair is from it, over its length; `None` where the hair runs
/// into a singular line.
fn found_again(known: &[Piece], options: &FitOptions) -> Outcome<Option<f64>> {
    let hair = PHelicoid { root: Frame::IDENTITY, pieces: known };
    let [mut points, mut again] = [[DVec3::ZERO; 60]; 2];
    if hair.sample_evenly(Tracing::Controlled(1e-10), &mut points).is_err() {
        return Ok(None);
    }
    let fit = fit_strand(&points, options).map_err(tress::geometry::polyline::Defect::describe)?;
    let found = PHelicoid { root: fit.root, pieces: &fit.pieces };
    found.sample_evenly(Tracing::Controlled(1e-10), &mut again)?;
    Ok(Some(greatest(&points, &again) / hair.length()))
}

fn greatest(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// A part of the strands as guides, the others filled in: errors over those of the weighted mean of
/// the same guides' points. All strands have as many points as the file's, at equal arc lengths.
fn reconstruction(
    figures: &mut Figures,
    kind: &str,
    file: &str,
    pieces: usize,
    points: usize,
) -> Outcome {
    let groom = grooms::groom(file, 2000, points)?;
    let groom = resampled(&groom, groom.strands().len(), points)?;
    let strands = groom.strands();
    let (fit_options, fill_options) = (
        FitOptions { pieces: Pieces::Equal(pieces), roll: Roll::Steady, ..FitOptions::default() },
        FillOptions { hold: 4, ..FillOptions::default() },
    );
    for (share, every) in [(10, 10), (50, 2)] {
        let (guides, rest): (Vec<usize>, Vec<usize>) =
            (0..strands.len()).partition(|i| i % every == 0);
        let fitted = fit(&groom.select(&guides), &fit_options)?;
        let roots: Vec<DVec3> = rest.iter().map(|&i| strands.strand(i)[0]).collect();
        let filled = fill(&fitted.hairs, Roots::Points(&roots), &fill_options)?;
        let ours = sample(&filled.hairs, points, Tracing::default())?;
        let plain = mean_of_points(&groom.select(&guides), &roots, &fill_options)?;
        let truth = strands.select(rest.iter().copied());
        let (a, b) = (Errors::new(&truth, ours.strands()), Errors::new(&truth, &plain));
        say(&format!("# {file} at {share} %: {a:?}, mean of points {b:?}"));
        let bars = if share == 10 {
            [Bar::AtMost(1.1), Bar::AtMost(1.0), Bar::None, Bar::None]
        } else {
            [Bar::None; 4]
        };
        let ratios = [
            ("position", a.position / b.position),
            ("curvature", a.curvature / b.curvature),
            ("mean_curvature", a.mean_curvature / b.mean_curvature),
            ("distribution", a.distribution / b.distribution),
        ];
        for ((what, ratio), bar) in ratios.into_iter().zip(bars) {
            figures.add(&format!("helicoid_{kind}{share}_{what}"), ratio, "", bar);
        }
    }
    Ok(())
}

/// Interpolation point by point: from each root the weighted mean of the guides' own points.
pub(crate) fn mean_of_points(
    guides: &Groom,
    roots: &[DVec3],
    options: &FillOptions,
) -> Outcome<Strands<DVec3>> {
    let guides = guides.strands();
    let at: Vec<DVec3> = guides.iter().map(|points| points[0]).collect();
    let mut weights = Vec::new();
    let mut hairs = Strands::default();
    for &root in roots {
        shepard(root, &at, options, &mut weights);
        let mean = |j: usize| -> DVec3 {
            let moved = |&(g, w): &(usize, f64)| w * (guides.strand(g)[j] - at[g]);
            root + weights.iter().map(moved).sum::<DVec3>()
        };
        hairs.push((0..guides.strand(0).len()).map(mean))?;
    }
    Ok(hairs)
}

/// How far hairs are from others. A curvature is the angle between two segments over their mean
/// length.
#[derive(Debug)]
struct Errors {
    /// Root mean square distance of points at equal arc lengths.
    position: f64,
    /// Root mean square difference of curvature at equal arc lengths.
    curvature: f64,
    /// Root mean square difference of the hairs' mean curvatures.
    mean_curvature: f64,
    /// Wasserstein distance of the curvatures of all points: mean difference of equal quantiles.
    distribution: f64,
}

impl Errors {
    fn new(truth: &Strands<DVec3>, other: &Strands<DVec3>) -> Self {
        let off = truth.points().iter().zip(other.points()).map(|(a, b)| a.distance(*b));
        let [mut a, mut b] = [truth, other].map(|strands| -> Vec<f64> {
            strands.iter().flat_map(|points| points.windows(3).map(bend)).collect()
        });
        let [c, d] = [truth, other].map(|strands| strands.iter().map(mean_bend));
        let means = c.zip(d).map(|(c, d)| c - d);
        let (position, mean_curvature) = (rms(off), rms(means));
        let curvature = rms(a.iter().zip(&b).map(|(a, b)| a - b));
        a.sort_unstable_by(f64::total_cmp);
        b.sort_unstable_by(f64::total_cmp);
        let apart: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum();
        Self { position, curvature, mean_curvature, distribution: apart / a.len() as f64 }
    }
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = values.fold((0.0, 0.0), |(sum, n), value| (sum + value * value, n + 1.0));
    (sum / n).sqrt()
}

/// Angle between two segments over their mean length.
fn bend(points: &[DVec3]) -> f64 {
    let (a, b) = (points[1] - points[0], points[2] - points[1]);
    let length = 0.5 * (a.length() + b.length());
    if length == 0.0 { 0.0 } else { a.angle_between(b) / length }
}

fn mean_bend(points: &[DVec3]) -> f64 {
    points.windows(3).map(bend).sum::<f64>() / (points.len() - 2) as f64
}
