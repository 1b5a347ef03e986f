//! Seeing a groom: time of an analysis and of its report; switchbacks, planar waves and wisps found
//! against those that were put in.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tress::analysis::{Analysis, Wisps, adjusted_rand};
use tress::geometry::glam::{DMat3, DQuat, DVec3};
use tress::geometry::{Column, Element, Frame, Groom, Strands, SuperHelix, names};
use tress::grow::{Coils, Density, GUIDE, grow, preset, scatter};
use tress::switchback::{InsertOptions, insert_at};
use tress_fixtures::{PatchOptions, coily_patch, scalp};

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
    "wave_recall",
    "wave_precision",
    "wisps_fixture_agreement",
    "wisps_grown_agreement",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    times(figures)?;
    detection(figures)?;
    wisps(figures)
}

/// A head of 1.6 million points: numbers alone, and the report with pictures and plots.
fn times(figures: &mut Figures) -> Outcome {
    let folder = tempfile::tempdir()?;
    let input = grooms::head(folder.path())?;
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
    switchback: Option<f64>,
    wave: bool,
}

/// Coils of several radii and pitches, with and without a switchback, some with a period skipped;
/// planar waves; each with several samplings and amounts of noise.
fn cases() -> Outcome<Vec<Case>> {
    let mut cases = Vec::new();
    let mut rng = Pcg64Mcg::seed_from_u64(1);
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
                        let mut add = |elements: &[Element], switchback, wave| {
                            let strand = placed(elements);
                            let points = sampled(&strand, spacing, noise * radius, &mut rng);
                            cases.push(Case { points, switchback, wave });
                        };
                        add(&changed, Some(there.arc_length), false);
                        add(&elements, None, false);
                        add(&skipped(&elements, at, turn), None, false);
                        add(&wave(radius, turn), None, true);
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

fn sampled(strand: &SuperHelix<'_>, spacing: f64, noise: f64, rng: &mut Pcg64Mcg) -> Vec<DVec3> {
    let length = strand.length();
    let mut arc_lengths = Vec::new();
    let mut s = 0.0;
    while s <= length {
        arc_lengths.push(s);
        s += spacing;
    }
    let frames = strand.frames_at(arc_lengths);
    frames.map(|frame| frame.position + noise * stray(rng)).collect()
}

/// Three even numbers of mean 0 and variance 1.
fn stray(rng: &mut Pcg64Mcg) -> DVec3 {
    let mut number = || (rng.random::<f64>() - 0.5) * 12_f64.sqrt();
    DVec3::new(number(), number(), number())
}

/// Switchbacks found and put in are matched within a turn; waves are matched by strand.
fn detection(figures: &mut Figures) -> Outcome {
    let cases = cases()?;
    let mut strands = Strands::default();
    for case in &cases {
        strands.push(case.points.iter().copied())?;
    }
    let analysis = Analysis::of(&Groom::new(strands));
    let (mut right, mut found, mut there, mut off) = (0.0, 0.0, 0.0, 0.0);
    let (mut waves_right, mut waves_found, mut waves_there) = (0.0, 0.0, 0.0);
    let one = |is: bool| f64::from(u8::from(is));
    for (i, case) in cases.iter().enumerate() {
        let of_strand: Vec<_> = analysis.switchbacks.iter().filter(|s| s.strand == i).collect();
        found += of_strand.len() as f64;
        there += one(case.switchback.is_some());
        let measures = analysis.strands[i].ok_or("a strand is no curve")?;
        waves_right += one(case.wave && measures.is_wave());
        waves_found += one(measures.is_wave());
        waves_there += one(case.wave);
        let turn = measures.length / measures.turns.max(1.0);
        let distance = of_strand
            .iter()
            .filter_map(|s| Some((s.arc_length - case.switchback?).abs() / turn))
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
    figures.add("wave_recall", waves_right / waves_there, "", Bar::AtLeast(0.95));
    figures.add("wave_precision", waves_right / waves_found, "", Bar::AtLeast(0.95));
    Ok(())
}

/// Wisps found against those that a groom was made in.
fn wisps(figures: &mut Figures) -> Outcome {
    let patch = coily_patch(&PatchOptions::default(), 7);
    figures.add("wisps_fixture_agreement", agreement(&patch, names::GROUP)?, "", Bar::None);
    let alone = PatchOptions {
        wisps: 110,
        strands_per_wisp: 1,
        patch_angle: 0.5,
        length: 9.0,
        ..PatchOptions::default()
    };
    let guides = coily_patch(&alone, 2);
    let roots = scatter(&scalp(&alone), 2000, Density::Even, 1)?;
    let options = preset("long-coils").unwrap_or_default();
    let grown = grow(guides.strands(), &roots, Coils::shipped()?, &options, 1)?;
    figures.add("wisps_grown_agreement", agreement(&grown, GUIDE)?, "", Bar::None);
    Ok(())
}

/// How well wisps found agree with those that an attribute tells.
fn agreement(groom: &Groom, attribute: &str) -> Outcome<f64> {
    let found = Wisps::of(groom, &Analysis::of(groom)).wisp;
    match groom.strand_attributes().get(attribute) {
        Some(Column::Int(known)) => Ok(adjusted_rand(known, &found)),
        _ => Err(format!("the groom has no attribute {attribute}").into()),
    }
}
