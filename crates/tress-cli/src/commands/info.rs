//! `tress info`: a groom in numbers.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;
use tress::analysis::{Analysis, Defects, GroomSummary, Quantiles, defects, summarize};
use tress::geometry::{Attributes, Column, Groom, HelixGroom, UpAxis};
use tress::io::{Format, Model};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count, short, spread};
use crate::source;

/// Counts, lengths, turns, coil radius, handedness, unit and problems of a groom
#[derive(Args, Debug)]
#[command(after_help = "Example: tress info groom.usdc --json")]
pub(crate) struct InfoArgs {
    /// The groom
    pub(crate) input: PathBuf,
}

pub(crate) fn run(args: &InfoArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    let model = source::share_of(source::read(&args.input, &progress)?, everywhere);
    let format = Format::from_path(&args.input)?;
    report.set("input", &args.input);
    report.set("format", format.description());
    report.line(format!("{} ({})", args.input.display(), format.description()));
    progress.stage("measuring");
    match model {
        Model::Polylines(groom) => {
            say_polylines(&groom, &mut report);
            say_space(groom.unit, groom.up, &mut report);
            say_measures(&Analysis::of(&groom).summary(), groom.unit, &mut report);
        }
        Model::Helices(helices) => {
            say_helices(&helices, &mut report);
            say_space(helices.unit, helices.up, &mut report);
            say_measures(&summarize(&helices), helices.unit, &mut report);
        }
    }
    Ok(report)
}

fn say_polylines(groom: &Groom, report: &mut Report) {
    let strands = groom.strands();
    let per_strand = Quantiles::of(strands.counts().map(|n| n as f64));
    report.set("strands", strands.len());
    report.set("points", strands.points().len());
    report.set("points_per_strand", per_strand);
    report.say("strands", count(strands.len()));
    let points = count(strands.points().len());
    report.say("points", format!("{points}; {} a strand", spread(per_strand, "")));
    say_attributes("point", groom.point_attributes(), report);
    say_attributes("strand", groom.strand_attributes(), report);
    say_defects(&defects(groom), report);
}

fn say_helices(helices: &HelixGroom, report: &mut Report) {
    let per_strand = Quantiles::of(helices.elements().counts().map(|n| n as f64));
    let elements = helices.elements().points().len();
    report.set("strands", helices.len());
    report.set("elements", elements);
    report.set("elements_per_strand", per_strand);
    report.set("kept_polylines", helices.kept().strands.len());
    report.say("strands", count(helices.len()));
    report.say("elements", format!("{}; {} a strand", count(elements), spread(per_strand, "")));
    if !helices.kept().strands.is_empty() {
        report.say("kept", format!("{} strands as polylines", helices.kept().strands.len()));
    }
    say_attributes("joint", helices.joint_attributes(), report);
    say_attributes("strand", helices.strand_attributes(), report);
}

fn say_attributes(of: &str, attributes: &Attributes, report: &mut Report) {
    let kind = |column: &Column| match column {
        Column::Int(_) => "whole number".to_owned(),
        Column::Float { components: 1, .. } => "number".to_owned(),
        Column::Float { components, .. } => format!("{components} numbers"),
    };
    let list: Vec<_> = attributes
        .iter()
        .map(|(name, column)| json!({ "name": name, "components": column.components() }))
        .collect();
    report.set(&format!("{of}_attributes"), list);
    for (name, column) in attributes.iter() {
        let values = Quantiles::of(column.first_components());
        let range = if column.components() == 1 { spread(values, "") } else { String::new() };
        report.say("attribute", format!("{name}, {} a {of}  {range}", kind(column)).trim_end());
    }
}

fn say_space(unit: Option<f64>, up: Option<UpAxis>, report: &mut Report) {
    report.set("metres_per_unit", unit);
    report.set("up", up);
    let unit = unit.map_or("unknown".into(), |metres| match metres {
        1.0 => "metre".into(),
        0.01 => "centimetre".into(),
        0.001 => "millimetre".into(),
        metres => format!("{metres} m"),
    });
    report.say("unit", unit);
    let up = up.map_or("unknown", |up| match up {
        UpAxis::Y => "y",
        UpAxis::Z => "z",
    });
    report.say("up", up);
}

pub(crate) fn say_measures(summary: &GroomSummary, unit: Option<f64>, report: &mut Report) {
    report.set("summary", summary);
    report.say("length", spread(summary.length, ""));
    report.say("turns", spread(summary.turns, " a strand"));
    let millimetres = match (summary.coil_radius, unit) {
        (Some(radius), Some(metres)) => {
            report.set("coil_diameter_mm", 2e3 * metres * radius.median);
            format!("; coils are {} mm across", short(2e3 * metres * radius.median))
        }
        _ => String::new(),
    };
    report.say("coil radius", spread(summary.coil_radius, "") + &millimetres);
    let (left, right) = (summary.left_handed, summary.right_handed);
    let neither = summary.strands - left - right;
    let (left, right, neither) = (count(left), count(right), count(neither));
    report.say("handedness", format!("{left} left, {right} right, {neither} neither"));
    if 0 < summary.waves {
        report.say("waves", format!("{} strands wave in a plane", count(summary.waves)));
    }
    if 0 < summary.switchbacks {
        report.say("switchbacks", format!("{} changes of hand", count(summary.switchbacks)));
    }
}

pub(crate) fn say_defects(defects: &Defects, report: &mut Report) {
    report.set("problems", defects);
    if defects.is_empty() {
        report.say("problems", "none found");
    }
    for (what, (n, first)) in &defects.strands {
        let n = count(*n);
        report.say("problem", format!("{n} strands {what}, the first is {first}"));
    }
    if 0 < defects.repeated_points {
        let n = count(defects.repeated_points);
        report.say("problem", format!("{n} points stand where the point before them does"));
    }
    if let Some(first) = defects.first_long_segment {
        let n = count(defects.long_segments);
        let jump = "with a segment ten times as long as the others";
        report.say("problem", format!("{n} strands {jump}, the first is {first}"));
    }
}
