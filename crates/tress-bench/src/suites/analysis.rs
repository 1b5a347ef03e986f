//! Seeing a groom: time of an analysis and of its report, and switchbacks found against switchbacks
//! that were put in.

use tress::analysis::Analysis;
use tress::geometry::glam::{DMat3, DQuat, DVec3};
use tress::geometry::{Element, Frame, Groom, Strands, SuperHelix};
use tress::io::WriteOptions;
use tress::switchback::{InsertOptions, insert_at};

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures, say};
use crate::process;

pub(crate) const NAMES: &[&str] = &[
    "analyze_10k_seconds",
    "analyze_report_10k_seconds",
    "switchback_recall",
    "switchback_precision",
    "switchback_place_turns",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    times(figures)?;
    detection(figures)
}

/// A head of 1.6 million points: numbers alone, and the report with pictures and plots.
fn times(figures: &mut Figures) -> Outcome {
    let folder = tempfile::tempdir()?;
    let input = match grooms::real("blender/bl_coily_10k.usdc") {
        Some(path) => path,
        None => {
            say("# bl_coily_10k.usdc is not there: measured on 10,000 generated strands");
            let path = folder.path().join("head.hair");
            tress::io::write(&path, &grooms::generated(10_000, 160), &WriteOptions::default())?;
            path
        }
    };
    let html = folder.path().join("report.html");
    let (input, html) = (input.to_string_lossy(), html.to_string_lossy());
    let program = process::program()?;
    let numbers = process::best(&program, &["analyze", &input], 3)?;
    figures.add("analyze_10k_seconds", numbers.seconds, "s", Bar::AtMost(4.0));
    let report = process::best(&program, &["analyze", &input, "--html", &html], 2)?;
    figures.add("analyze_report_10k_seconds", report.seconds, "s", Bar::AtMost(10.0));
    Ok(())
}

/// What a strand of the test set is, and where its switchback lies if it has one.
struct Case {
    points: Vec<DVec3>,
    truth: Option<f64>,
}

/// Coils of several radii and pitches, with and without a switchback, some with a period skipped;
/// planar waves; each with several samplings and amounts of noise.
fn cases() -> Outcome<Vec<Case>> {
    let mut cases = Vec::new();
    let mut draw = Draw(1);
    for radius in [0.3, 0.57, 1.0] {
        for pitch in [0.35, 0.6, 1.2] {
            for share in [0.3, 0.5, 0.65] {
                for per_turn in [6.0, 9.0, 16.0] {
                    for noise in [0.0, 0.03, 0.08] {
                        let coil = Element::coil(radius, pitch * radius / 0.57);
                        let turn = std::f64::consts::TAU / coil.curvature.length();
                        let elements = vec![Element { length: turn / 24.0, ..coil }; 18 * 24];
                        let strand = placed(&elements);
                        let at = share * strand.length();
                        let (changed, there) = insert_at(&strand, at, &InsertOptions::default())?;
                        let spacing = turn / per_turn;
                        let mut add = |strand: &SuperHelix<'_>, truth: Option<f64>| {
                            let points = sampled(strand, spacing, noise * radius, &mut draw);
                            cases.push(Case { points, truth });
                        };
                        add(&placed(&changed), Some(there.arc_length));
                        add(&strand, None);
                        add(&placed(&skipped(&elements, at, turn)), None);
                        add(&placed(&wave(radius, turn)), None);
                    }
                }
            }
        }
    }
    Ok(cases)
}

fn placed(elements: &[Element]) -> SuperHelix<'_> {
    // Its axis points down rather than its tangent.
    let turn = DQuat::from_rotation_arc(DVec3::X, DVec3::NEG_Y);
    let root = Frame { position: DVec3::ZERO, axes: DMat3::from_quat(turn) };
    SuperHelix { root, elements }
}

/// The coil straight for a period, and on as before.
fn skipped(elements: &[Element], at: f64, turn: f64) -> Vec<Element> {
    let mut s = 0.0;
    let mut skipped = elements.to_vec();
    for element in &mut skipped {
        if (at..at + turn).contains(&s) {
            element.curvature = DVec3::ZERO;
        }
        s += element.length;
    }
    skipped
}

/// A wave in a plane: its bend goes to and fro.
fn wave(radius: f64, turn: f64) -> Vec<Element> {
    let bend = |i: usize| {
        let phase = std::f64::consts::TAU * (i % 24) as f64 / 24.0;
        DVec3::new(0.0, 0.0, 0.9 * phase.sin() / radius)
    };
    (0..16 * 24).map(|i| Element { curvature: bend(i), length: turn / 24.0 }).collect()
}

fn sampled(strand: &SuperHelix<'_>, spacing: f64, noise: f64, draw: &mut Draw) -> Vec<DVec3> {
    let length = strand.length();
    let mut arc_lengths = Vec::new();
    let mut s = 0.0;
    while s <= length {
        arc_lengths.push(s);
        s += spacing;
    }
    let frames = strand.frames_at(arc_lengths);
    frames.map(|frame| frame.position + noise * draw.vector()).collect()
}

/// Numbers of mean 0 and variance 1 from a linear congruence (Knuth's): a test set needs no more.
struct Draw(u64);

impl Draw {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 12_f64.sqrt()
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}

/// Switchbacks found and put in are matched within a turn.
fn detection(figures: &mut Figures) -> Outcome {
    let cases = cases()?;
    let mut strands = Strands::default();
    for case in &cases {
        strands.push(case.points.iter().copied())?;
    }
    let analysis = Analysis::of(&Groom::new(strands));
    let (mut right, mut found, mut there, mut off) = (0.0, 0.0, 0.0, 0.0);
    for (i, case) in cases.iter().enumerate() {
        let of_strand: Vec<_> = analysis.switchbacks.iter().filter(|s| s.strand == i).collect();
        found += of_strand.len() as f64;
        there += f64::from(u8::from(case.truth.is_some()));
        let measures = analysis.strands[i].ok_or("a strand is no curve")?;
        let turn = measures.length / measures.turns.max(1.0);
        let distance = of_strand
            .iter()
            .filter_map(|s| Some((s.arc_length - case.truth?).abs() / turn))
            .fold(f64::INFINITY, f64::min);
        if distance < 1.0 {
            right += 1.0;
            off += distance;
        }
    }
    say(&format!("# {} strands, {there} of them with a switchback", cases.len()));
    figures.add("switchback_recall", right / there, "", Bar::AtLeast(0.95));
    figures.add("switchback_precision", right / found, "", Bar::AtLeast(0.95));
    figures.add("switchback_place_turns", off / right, "turns", Bar::None);
    Ok(())
}
