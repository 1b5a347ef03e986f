//! Sculpting: one strand, a dragged joint, a whole head.

use std::time::Instant;

use tress::geometry::glam::DVec3;
use tress::geometry::{Element, Frame, HelixGroom, Strands, SuperHelix};
use tress::optimize::{Control, GroomObjective, Objective, SculptOptions, Sculptor, Stop, sculpt};

use crate::Outcome;
use crate::metric::{Bar, Figures, say};
use crate::process;

pub(crate) const NAMES: &[&str] = &[
    "gradient_us",
    "gradient_batched_us",
    "gradient_vs_autodiff",
    "drag_p50_ms",
    "drag_p99_ms",
    "sculpt_head_seconds",
    "sculpt_head_unfinished",
    "sculpt_head_memory",
    "sculpt_strand_us_n45",
    "sculpt_strand_us_n90",
    "sculpt_strand_us_n180",
    "sculpt_strands_us_10k",
    "sculpt_strands_us_30k",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    gradient(figures)?;
    drag(figures)?;
    head(figures)?;
    linear(figures)
}

/// A coil that differs from strand to strand, 77 units long in 23 turns, as the real guides are.
fn coil(strand: usize, n_elements: usize) -> Vec<Element> {
    let vary = |seed: usize| ((strand * 7919 + seed * 104_729) % 1000) as f64 / 1000.0 - 0.5;
    let base = Element::coil(0.57 * (1.0 + 0.3 * vary(1)), 0.5 * (1.0 + 0.4 * vary(2)));
    (0..n_elements)
        .map(|i| {
            let wave = (i as f64 * 0.37 + vary(3) * 9.0).sin();
            let curvature = base.curvature * (1.0 + 0.1 * wave) + DVec3::Y * (0.1 * wave);
            Element { curvature, length: 77.0 / n_elements as f64 }
        })
        .collect()
}

fn groom(strands: usize, n_elements: usize) -> Outcome<HelixGroom> {
    let elements = (0..strands).flat_map(|i| coil(i, n_elements)).collect();
    let elements = Strands::from_counts(std::iter::repeat_n(n_elements, strands), elements)?;
    Ok(HelixGroom::new(vec![Frame::IDENTITY; strands], elements)?)
}

/// Controls evenly along a strand, each to be moved by `by` times its share of the length.
fn controls(strand: &SuperHelix<'_>, n: usize, by: DVec3) -> Vec<Control> {
    let places = (1..=n).map(|k| strand.length() * k as f64 / n as f64);
    let share = |s: f64| s / strand.length();
    places.map(|s| Control::new(s, strand.position_at(s) + by * share(s))).collect()
}

fn controls_of(groom: &HelixGroom, n: usize, by: DVec3) -> Outcome<Strands<Control>> {
    let all = groom.iter().flat_map(|strand| controls(&strand, n, by)).collect();
    Ok(Strands::from_counts(std::iter::repeat_n(n, groom.len()), all)?)
}

/// Energy and gradient of one strand of 90 elements with three control points.
fn gradient(figures: &mut Figures) -> Outcome {
    let elements = coil(1, 90);
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    let controls = controls(&strand, 3, DVec3::splat(1.0));
    let mut objective = Objective::new(&strand, &controls, &SculptOptions::default())?;
    let mut gradient = vec![DVec3::ZERO; elements.len()];
    let mut best = f64::INFINITY;
    for _ in 0..200 {
        let started = Instant::now();
        for _ in 0..20 {
            std::hint::black_box(objective.evaluate(&elements, &mut gradient));
        }
        best = best.min(started.elapsed().as_secs_f64() / 20.0);
    }
    figures.add("gradient_us", 1e6 * best, "us", Bar::AtMost(10.0));
    against_autodiff(figures)
}

/// The same energy and gradient for 500 strands at once, and by JAX where Python has it.
fn against_autodiff(figures: &mut Figures) -> Outcome {
    let groom = groom(500, 90)?;
    let controls = controls_of(&groom, 3, DVec3::splat(1.0))?;
    let objective = GroomObjective::new(&groom, &controls, &SculptOptions::default())?;
    let mut gradients = groom.elements().with_points(vec![DVec3::ZERO; 500 * 90])?;
    let seconds = super::best_of(50, || {
        Ok::<_, Box<dyn std::error::Error>>(objective.evaluate(groom.elements(), &mut gradients))
    })?;
    let ours = 1e6 * seconds / 500.0;
    figures.add("gradient_batched_us", ours, "us", Bar::None);
    let script = crate::grooms::root().join("crates/tress-optimize/benches/autodiff_jax.py");
    let output = std::process::Command::new("python3").arg(script).output();
    let theirs = output.ok().filter(|output| output.status.success());
    let theirs = theirs
        .and_then(|output| String::from_utf8_lossy(&output.stdout).trim().parse::<f64>().ok());
    match theirs {
        Some(theirs) => {
            figures.add("gradient_autodiff_us", theirs, "us", Bar::None);
            figures.add("gradient_vs_autodiff", theirs / ours, "x", Bar::AtLeast(100.0));
        }
        None => say("# Python has no jax: the gradient is not compared with automatic derivatives"),
    }
    Ok(())
}

/// A hundred frames of a joint dragged on a circle: 2,025 strands of 45 elements.
fn drag(figures: &mut Figures) -> Outcome {
    let rest = groom(2025, 45)?;
    let mut sculptor = Sculptor::new(rest.clone(), SculptOptions::default())?;
    let mut milliseconds = Vec::new();
    for frame in 0..100 {
        let angle = f64::from(frame) * 0.06;
        let by = DVec3::new(angle.cos() - 1.0, angle.sin(), 0.3 * angle) * 2.0;
        let controls = controls_of(&rest, 1, by)?;
        let started = Instant::now();
        std::hint::black_box(sculptor.sculpt(&controls)?);
        milliseconds.push(1e3 * started.elapsed().as_secs_f64());
    }
    milliseconds.sort_by(f64::total_cmp);
    figures.add("drag_p50_ms", milliseconds[49], "ms", Bar::AtMost(20.0));
    figures.add("drag_p99_ms", milliseconds[98], "ms", Bar::AtMost(33.0));
    Ok(())
}

/// 90,314 strands of 90 elements with three control points each, from rest.
fn head(figures: &mut Figures) -> Outcome {
    let mut groom = groom(90_314, 90)?;
    let controls = controls_of(&groom, 3, DVec3::new(2.0, -1.0, 3.0))?;
    let ((seconds, sculpted), held) = process::held(|| {
        let started = Instant::now();
        let sculpted = sculpt(&mut groom, &controls, &SculptOptions::default())?;
        Ok((started.elapsed().as_secs_f64(), sculpted))
    })?;
    figures.add("sculpt_head_seconds", seconds, "s", Bar::AtMost(5.0));
    let reports = || sculpted.reports.iter().flatten();
    let unfinished = reports().filter(|report| report.stop != Stop::Converged).count();
    figures.add("sculpt_head_unfinished", unfinished as f64, "strands", Bar::AtMost(0.0));
    match held {
        Some(bytes) => {
            let each = bytes / 1e3 / groom.len() as f64;
            figures.add("sculpt_head_memory", each, "kB/strand", Bar::AtMost(1.5));
        }
        None => say("# this system does not tell how much memory is held"),
    }
    let worst = reports().map(|report| report.iterations).max().unwrap_or(0);
    say(&format!("# the slowest strand took {worst} steps"));
    Ok(())
}

/// Time a strand does not grow with the number of strands, and grows with elements at most as they
/// do.
fn linear(figures: &mut Figures) -> Outcome {
    let mut measure = |name: &str, strands: usize, n_elements: usize| -> Outcome {
        let mut groom = groom(strands, n_elements)?;
        let controls = controls_of(&groom, 3, DVec3::new(2.0, -1.0, 3.0))?;
        let started = Instant::now();
        sculpt(&mut groom, &controls, &SculptOptions::default())?;
        let each = 1e6 * started.elapsed().as_secs_f64() / strands as f64;
        figures.add(name, each, "us", Bar::None);
        Ok(())
    };
    measure("sculpt_strand_us_n45", 5_000, 45)?;
    measure("sculpt_strand_us_n90", 5_000, 90)?;
    measure("sculpt_strand_us_n180", 5_000, 180)?;
    measure("sculpt_strands_us_10k", 10_000, 90)?;
    measure("sculpt_strands_us_30k", 30_000, 90)
}
