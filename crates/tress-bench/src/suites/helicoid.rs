//! Generalized helicoids: filling a head, fitting strands, and what comes back of a groom from a
//! tenth of its strands.

use std::time::Instant;

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
    "helicoid_euler_error",
    "helicoid_coils10_position",
    "helicoid_coils10_curvature",
    "helicoid_coils50_position",
    "helicoid_coils50_curvature",
    "helicoid_straight10_position",
    "helicoid_straight10_curvature",
    "helicoid_straight50_position",
    "helicoid_straight50_curvature",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    filling(figures)?;
    fitting(figures)?;
    round_trip(figures)?;
    reconstruction(figures, "coils", "digitalsalon_harolongo.data", 12)?;
    reconstruction(figures, "straight", "yuksel_straight.hair", 4)
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
    let options = FillOptions { neighbours: 0, ..FillOptions::default() };
    let filled = || fill(&guides, Roots::Points(&roots), &options);
    let seconds = best_of(3, filled)?;
    figures.add("helicoid_fill_90k_seconds", seconds, "s", Bar::AtMost(1.0));
    let hairs = filled()?.hairs;
    let seconds = best_of(3, || sample(&hairs, 30, Tracing::Controlled(1e-5)))?;
    figures.add("helicoid_trace_90k_seconds", seconds, "s", Bar::None);
    Ok(())
}

/// Some strands of a groom, at equal arc lengths.
fn resampled(groom: &Groom, take: usize, points: usize) -> Outcome<Groom> {
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

/// Known helicoids are found again: greatest distance over length. And what Euler's method makes of
/// them with 30 steps.
fn round_trip(figures: &mut Figures) -> Outcome {
    let (mut worst, mut euler): (f64, f64) = (0.0, 0.0);
    let options = FitOptions { pieces: Pieces::UpTo(1), ..FitOptions::default() };
    for i in 0..40_i32 {
        let part = |n: i32| f64::from((i * n) % 11) / 5.0 - 1.0;
        let k = Helicoid::new(0.2 + 0.6 * (1.0 + part(3)), 0.15 * part(5), 0.2 * part(7), part(4));
        let pieces = [Piece { k, length: 4.0 }];
        let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
        let mut points = vec![DVec3::ZERO; 60];
        hair.sample_evenly(Tracing::Controlled(1e-10), &mut points)?;
        let fit =
            fit_strand(&points, &options).map_err(tress::geometry::polyline::Defect::describe)?;
        let found = PHelicoid { root: fit.root, pieces: &fit.pieces };
        let mut again = points.clone();
        found.sample_evenly(Tracing::Controlled(1e-10), &mut again)?;
        worst = worst.max(greatest(&points, &again) / 4.0);
        hair.sample_evenly(Tracing::Euler(30), &mut again)?;
        euler = euler.max(greatest(&points, &again) / 4.0);
    }
    figures.add("helicoid_round_trip", worst, "lengths", Bar::AtMost(1e-4));
    figures.add("helicoid_euler_error", euler, "lengths", Bar::None);
    Ok(())
}

fn greatest(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// A part of the strands as guides, the others filled in: errors over those of the weighted mean of
/// the same guides' points.
fn reconstruction(figures: &mut Figures, kind: &str, file: &str, pieces: usize) -> Outcome {
    let points = 41;
    let groom = resampled(&grooms::groom(file, 2000, 21)?, 2000, points)?;
    let strands = groom.strands();
    let (fit_options, fill_options) = (
        FitOptions { pieces: Pieces::Equal(pieces), roll: Roll::Steady, ..FitOptions::default() },
        FillOptions { hold: 2 * pieces, ..FillOptions::default() },
    );
    for (share, every) in [(10, 10), (50, 2)] {
        let (guides, rest): (Vec<usize>, Vec<usize>) =
            (0..strands.len()).partition(|i| i % every == 0);
        let fitted = fit(&groom.select(&guides), &fit_options)?;
        let roots: Vec<DVec3> = rest.iter().map(|&i| strands.strand(i)[0]).collect();
        let filled = fill(&fitted.hairs, Roots::Points(&roots), &fill_options)?;
        let ours = sample(&filled.hairs, points, Tracing::default())?;
        let at: Vec<DVec3> = guides.iter().map(|&i| strands.strand(i)[0]).collect();
        let mut weights = Vec::new();
        let mut plain = Strands::default();
        for &root in &roots {
            shepard(root, &at, &fill_options, &mut weights);
            let mean = |j: usize| -> DVec3 {
                let moved = |&(g, w): &(usize, f64)| w * (strands.strand(guides[g])[j] - at[g]);
                root + weights.iter().map(moved).sum::<DVec3>()
            };
            plain.push((0..points).map(mean))?;
        }
        let truth = strands.select(rest.iter().copied());
        let (p, c) = errors(&truth, ours.strands());
        let (q, d) = errors(&truth, &plain);
        say(&format!(
            "# {file} at {share} %: position {p:.4} against {q:.4}, curvature {c:.4} against {d:.4}"
        ));
        let name = format!("helicoid_{kind}{share}");
        let (position, curvature) =
            if share == 10 { (Bar::AtMost(1.1), Bar::AtMost(1.0)) } else { (Bar::None, Bar::None) };
        figures.add(&format!("{name}_position"), p / q, "", position);
        figures.add(&format!("{name}_curvature"), c / d, "", curvature);
    }
    Ok(())
}

/// Root mean square errors of positions and of curvatures (the magnitude at every inner point).
fn errors(truth: &Strands<DVec3>, other: &Strands<DVec3>) -> (f64, f64) {
    let square: f64 =
        truth.points().iter().zip(other.points()).map(|(a, b)| a.distance_squared(*b)).sum();
    let curvatures = |strands: &Strands<DVec3>| -> Vec<f64> {
        strands.iter().flat_map(|points| points.windows(3).map(bend)).collect()
    };
    let (a, b) = (curvatures(truth), curvatures(other));
    let off: f64 = a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b)).sum();
    ((square / truth.points().len() as f64).sqrt(), (off / a.len() as f64).sqrt())
}

/// Angle between two segments over their mean length.
fn bend(points: &[DVec3]) -> f64 {
    let (a, b) = (points[1] - points[0], points[2] - points[1]);
    let length = 0.5 * (a.length() + b.length());
    if length == 0.0 { 0.0 } else { a.angle_between(b) / length }
}
