//! Polylines to super-helices.

use std::f64::consts::TAU;
use std::time::Instant;

use tress::fit::{Elements, FitOptions, Fitted, Refine, Tolerance, fit};
use tress::geometry::glam::DVec3;
use tress::geometry::{Attributes, Element, Frame, Groom, Strands, SuperHelix};

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures};
use crate::process;

pub(crate) const NAMES: &[&str] = &[
    "fit_guides_rms_n40",
    "fit_guides_rms_n90",
    "fit_guides_rms_n108",
    "fit_guides_greatest_n90",
    "fit_guides_length_n90",
    "fit_guides_direct_rms_n90",
    "fit_guides_f70_rms_n40",
    "fit_swatch_rms_n90",
    "fit_swatch_length_n90",
    "fit_swatch_seconds",
    "fit_tolerance_excess",
    "fit_helix_error",
    "fit_doubling_n80",
    "fit_doubling_ratio_n160",
    "fit_10k_seconds",
    "fit_10k_direct_seconds",
    "fit_10k_read_seconds",
    "fit_10k_direct_times",
    "fit_10k_rms",
    "fit_strand_us_1k",
    "fit_strand_us_10k",
    "fit_strand_us_100k",
    "fit_point_us_x1",
    "fit_point_us_x2",
    "fit_point_us_x4",
    "memory_peak_ratio_fit",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    guides(figures)?;
    swatch(figures)?;
    helices(figures)?;
    pieces(figures)?;
    doubling(figures)?;
    head(figures)?;
    linear(figures)?;
    dense(figures)
}

fn fitted(groom: &Groom, n: usize, refine: Option<Refine>) -> Outcome<Fitted> {
    let elements = Elements::Count(n);
    Ok(fit(groom, &FitOptions { elements, refine, ..FitOptions::default() })?)
}

/// The 98 coily guides: how near, and how length changes.
fn guides(figures: &mut Figures) -> Outcome {
    let guides = grooms::groom("curlycue/curlycue_guides_f00.obj", 98, 108)?;
    for (n, bar) in [(40, 0.058), (90, 0.0153), (108, 0.012)] {
        let deviation = fitted(&guides, n, Some(Refine::default()))?.report.deviation;
        let name = format!("fit_guides_rms_n{n}");
        figures.add(&name, deviation.rms, "unit", Bar::AtMost(bar));
        if n == 90 {
            let percent = 100.0 * deviation.length_change;
            figures.add("fit_guides_greatest_n90", deviation.greatest, "unit", Bar::None);
            figures.add("fit_guides_length_n90", percent, "%", Bar::AtMost(0.1));
        }
    }
    let direct = fitted(&guides, 90, None)?.report.deviation;
    figures.add("fit_guides_direct_rms_n90", direct.rms, "unit", Bar::None);
    // The prior was chosen on the first frame: here is the last.
    let last = grooms::groom("curlycue/curlycue_guides_f70.obj", 98, 108)?;
    let deviation = fitted(&last, 40, Some(Refine::default()))?.report.deviation;
    figures.add("fit_guides_f70_rms_n40", deviation.rms, "unit", Bar::AtMost(0.058));
    Ok(())
}

/// Frizz: strands that turn by a right angle and more at many of their points.
fn swatch(figures: &mut Figures) -> Outcome {
    let swatch = grooms::groom("curlycue/curlycue_swatch70_seed1337.obj", 3176, 73)?;
    let started = Instant::now();
    let deviation = fitted(&swatch, 90, Some(Refine::default()))?.report.deviation;
    figures.add("fit_swatch_seconds", started.elapsed().as_secs_f64(), "s", Bar::None);
    figures.add("fit_swatch_rms_n90", deviation.rms, "unit", Bar::None);
    figures.add("fit_swatch_length_n90", 100.0 * deviation.length_change, "%", Bar::None);
    Ok(())
}

/// Ten thousand strands of 160 points to 90 elements, as a whole process and in memory.
fn head(figures: &mut Figures) -> Outcome {
    let folder = tempfile::tempdir()?;
    let input = grooms::head(folder.path())?;
    let output = folder.path().join("head.tress");
    let (from, to) = (input.to_string_lossy(), output.to_string_lossy());
    let program = process::program()?;
    let taken = process::best(&program, &["fit", &from, &to, "--elements", "90"], 2)?;
    figures.add("fit_10k_seconds", taken.seconds, "s", Bar::AtMost(5.0));
    if let Some(peak) = taken.peak {
        let bytes = in_memory(&grooms::polylines(&input)?, 90);
        figures.add("memory_peak_ratio_fit", peak / bytes as f64, "", Bar::AtMost(3.0));
    }
    let groom = grooms::polylines(&input)?;
    let deviation = fitted(&groom, 90, Some(Refine::default()))?.report.deviation;
    figures.add("fit_10k_rms", deviation.rms, "unit", Bar::None);
    let read = super::best_of(3, || grooms::polylines(&input))?;
    figures.add("fit_10k_read_seconds", read, "s", Bar::None);
    let elements = Elements::Count(90);
    let refined = FitOptions { elements, measure: false, ..FitOptions::default() };
    let unrefined = FitOptions { refine: None, ..refined };
    let direct = super::best_of(3, || fit(&groom, &unrefined))?;
    figures.add("fit_10k_direct_seconds", read + direct, "s", Bar::AtMost(0.5));
    let slow = super::best_of(2, || fit(&groom, &refined))?;
    figures.add("fit_10k_direct_times", slow / direct, "", Bar::AtLeast(10.0));
    Ok(())
}

/// Bytes of a groom's points and columns and of its fit, with a root, elements and joints a strand.
fn in_memory(groom: &Groom, elements: usize) -> usize {
    let (strands, points) = (groom.strands().len(), groom.strands().points().len());
    let columns = |attributes: &Attributes| -> usize {
        attributes.iter().map(|(_, column)| 8 * column.components()).sum()
    };
    let (a_point, a_strand) =
        (columns(groom.point_attributes()), columns(groom.strand_attributes()));
    let input = points * (24 + a_point) + strands * a_strand;
    input + strands * (96 + a_strand + 32 * elements + (elements + 1) * a_point)
}

/// A coil whose axis bends and whose hand flips half way, fitted with twice as many elements each
/// time: an error that falls to a quarter is of second order.
fn doubling(figures: &mut Figures) -> Outcome {
    let coil = flipped_coil()?;
    let mut before: Option<f64> = None;
    for n in [80, 160, 320, 640] {
        // The prior is for noise, and there is none.
        let refine = Refine { prior: 1e-6, ..Refine::default() };
        let deviation = fitted(&coil, n, Some(refine))?.report.deviation;
        figures.add(&format!("fit_doubling_n{n}"), deviation.rms, "unit", Bar::None);
        if let Some(before) = before {
            let name = format!("fit_doubling_ratio_n{n}");
            figures.add(&name, deviation.rms / before, "", Bar::AtMost(0.3));
        }
        before = Some(deviation.rms);
    }
    Ok(())
}

/// A coil known everywhere: its curvature swells and its twist changes sign half way, over some
/// turns; 19 turns, 40 points each.
fn flipped_coil() -> Outcome<Groom> {
    let n_elements = 7600;
    let length = 20.0 / f64::from(n_elements);
    let element = |i: i32| {
        let s = (f64::from(i) + 0.5) * length;
        let swell = 6.0 * (1.0 + 0.15 * (0.7 * s).sin());
        let hand = -(s - 10.0).tanh();
        let curvature = swell * DVec3::new(0.3 * hand, 0.0, 1.0 + 0.05 * (1.3 * s).cos());
        Element { curvature, length }
    };
    let elements: Vec<Element> = (0..n_elements).map(element).collect();
    let coil = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    let points: Vec<DVec3> = coil.joints().step_by(10).map(|frame| frame.position).collect();
    let mut strands = Strands::default();
    strands.push(points)?;
    Ok(Groom::new(strands))
}

/// Exact helices of five points a turn come back: the worst relative error of curvature and twist.
fn helices(figures: &mut Figures) -> Outcome {
    let mut worst: f64 = 0.0;
    for pitch in [-3.0, -0.5, 0.1, 0.5, 1.0, 4.0] {
        let radius = 0.57;
        let points = (0..=50).map(|i| {
            let angle = f64::from(i) * TAU / 5.0;
            DVec3::new(radius * angle.cos(), radius * angle.sin(), pitch * angle / TAU)
        });
        let mut strands = Strands::default();
        strands.push(points)?;
        let fit = fit(&Groom::new(strands), &FitOptions::default())?;
        let truth = Element::coil(radius, pitch);
        for element in fit.helices.strand(0).elements {
            let error =
                (element.bending() - truth.bending()).hypot(element.twist() - truth.twist());
            worst = worst.max(error / truth.curvature.length());
        }
    }
    figures.add("fit_helix_error", worst, "", Bar::AtMost(1e-6));
    Ok(())
}

/// Time a strand does not grow with the number of strands.
fn linear(figures: &mut Figures) -> Outcome {
    for (name, strands) in [("1k", 1_000), ("10k", 10_000), ("100k", 100_000)] {
        let groom = grooms::generated(strands, 60);
        let started = Instant::now();
        fitted(&groom, 40, Some(Refine::default()))?;
        let each = 1e6 * started.elapsed().as_secs_f64() / strands as f64;
        figures.add(&format!("fit_strand_us_{name}"), each, "us", Bar::None);
    }
    Ok(())
}

/// Time a point does not grow with how densely one and the same strand is sampled.
fn dense(figures: &mut Figures) -> Outcome {
    for (name, per_turn) in [("x1", 8.0), ("x2", 16.0), ("x4", 32.0)] {
        let points = (0..).map(|i| f64::from(i) * TAU / per_turn).map(|angle| {
            let radius = 0.5 + 0.05 * (0.17 * angle).sin();
            DVec3::new(radius * angle.cos() + 2e-3 * angle * angle, radius * angle.sin(), angle)
        });
        let mut strands = Strands::default();
        for _ in 0..500 {
            strands.push(points.clone().take_while(|p| p.z <= 18.0 * TAU))?;
        }
        let groom = Groom::new(strands);
        let seconds = super::best_of(3, || fitted(&groom, 40, Some(Refine::default())))?;
        let each = 1e6 * seconds / groom.strands().points().len() as f64;
        figures.add(&format!("fit_point_us_{name}"), each, "us", Bar::None);
    }
    Ok(())
}

/// Strands made of helices, whose number is known: how many times as many a tolerance finds.
fn pieces(figures: &mut Figures) -> Outcome {
    let mut strands = Strands::default();
    let mut truth = 0;
    for n in (0..60).map(|i| 1 + i % 12) {
        let element = |i: usize| {
            // Directions and sizes that lie evenly, by ratios that no small number divides.
            let along = |ratio: f64| ((truth + i) as f64 * ratio).fract();
            let (z, angle) = (2.0 * along(0.618034) - 1.0, TAU * along(0.414214));
            let across = (1.0 - z * z).sqrt();
            let direction = DVec3::new(across * angle.cos(), across * angle.sin(), z);
            let length = 1.0 + 0.37 * (i % 3) as f64;
            Element { curvature: (1.5 + 2.5 * along(0.259921)) * direction, length }
        };
        let elements: Vec<Element> = (0..n).map(element).collect();
        let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
        let mut points = vec![DVec3::ZERO; 19 * n];
        strand.sample_evenly(&mut points);
        strands.push(points)?;
        truth += n;
    }
    let elements = Elements::Tolerance(Tolerance::Length(1e-3));
    let options = FitOptions { elements, ..FitOptions::default() };
    let found = fit(&Groom::new(strands), &options)?.report.elements;
    let excess = found as f64 / truth as f64;
    figures.add("fit_tolerance_excess", excess, "", Bar::AtMost(1.1));
    Ok(())
}
