//! `tress diff`: how far two grooms are apart.

mod sheet;

use std::path::PathBuf;

use clap::Args;
use tress::analysis::{Comparison, Distances, compare};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::SpaceArgs;
use crate::progress::Progress;
use crate::report::{Report, count, short};
use crate::target::{self, has_extension};

use super::analyze::study::Study;
use super::render::{ViewArg, view};

/// How far two grooms are apart: places, lengths, coils, spectra
///
/// Distances to the nearest place of the other groom, and between strands of the same index;
/// Wasserstein distances of radii, pitches, turns, lengths and spectra. All in the grooms' unit.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress diff before.usdc after.usdc
  tress diff before.obj after.obj --png sheet.png --html diff.html --json")]
pub(crate) struct DiffArgs {
    /// The one groom
    pub(crate) a: PathBuf,
    /// The other
    pub(crate) b: PathBuf,
    /// Write both side by side, with their distributions, .png
    #[arg(long, value_name = "FILE")]
    pub(crate) png: Option<PathBuf>,
    /// Write a report, .html: one file that needs no other
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// Where the camera stands
    #[arg(long, value_enum, default_value_t = ViewArg::ThreeQuarter)]
    pub(crate) view: ViewArg,
    /// What the grooms' numbers mean
    #[command(flatten)]
    pub(crate) space: SpaceArgs,
}

pub(crate) fn run(args: &DiffArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    for (file, extension) in [(&args.png, "png"), (&args.html, "html")] {
        let Some(file) = file else { continue };
        if !has_extension(file, extension) {
            let file = file.display();
            return Err(Failure::Usage(format!("{file}: this is written as .{extension}")));
        }
        target::check_place(&[&args.a, &args.b], file, everywhere)?;
    }
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("inputs", [&args.a, &args.b]);
    let a = Study::read(&args.a, &args.space, everywhere, &progress)?;
    let b = Study::read(&args.b, &args.space, everywhere, &progress)?;
    if a.groom.unit != b.groom.unit {
        report.say("units", "differ, or are not known for both: numbers are compared as they are");
    }
    report.set("same_unit", a.groom.unit == b.groom.unit);
    progress.stage("comparing");
    let apart = compare([&a.groom, &b.groom], [&a.analysis, &b.analysis]);
    report.set("comparison", &apart);
    report.set("summaries", [&a.summary, &b.summary]);
    say(&apart, &a.units.behind_numbers(), &mut report);
    let from = view(args.view);
    if let Some(file) = &args.png {
        progress.stage(format!("drawing {}", file.display()));
        tress::io::write_bytes(file, &sheet::png_of(&a, &b, from)?)?;
        report.say("wrote", file.display());
    }
    if let Some(file) = &args.html {
        progress.stage(format!("drawing {}", file.display()));
        let names = [&args.a, &args.b].map(|path| {
            path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned())
        });
        let lines = lines(&apart, &a.units.behind_numbers());
        tress::io::write_bytes(file, sheet::page_of(&a, &b, &names, &lines, from)?.as_bytes())?;
        report.say("wrote", file.display());
    }
    Ok(report)
}

fn say(apart: &Comparison, unit: &str, report: &mut Report) {
    let [a, b] = apart.strands.map(count);
    report.say("strands", format!("{a} and {b}"));
    for (name, what) in lines(apart, unit) {
        report.say(&name, what);
    }
}

/// What is to be said of a comparison.
fn lines(apart: &Comparison, unit: &str) -> Vec<(String, String)> {
    let distances = |d: Distances, unit: &str| {
        let (rms, greatest) = (short(d.rms), short(d.greatest));
        format!("rms {rms}, greatest {greatest}{unit}")
    };
    let own = format!(" {unit}");
    let mut lines = Vec::new();
    let mut add = |name: &str, what: String| lines.push((name.to_owned(), what));
    if let Some(nearest) = apart.nearest {
        add("nearest", distances(nearest, &own));
    }
    match apart.by_index {
        Some(pairs) => {
            add("by index", distances(pairs.distances, &own));
            add("Frechet", distances(pairs.frechet, &own));
            let change = pairs.length_change;
            let (mean, most) = (short(100.0 * change.mean), short(100.0 * change.greatest));
            add("length", format!("changed by {mean} % in the mean, {most} % at most"));
        }
        None => add("by index", "no strand of the same index in both".into()),
    }
    let d = apart.distributions;
    let rows = [
        ("lengths", d.length, own.as_str()),
        ("turns", d.turns, ""),
        ("coil radii", d.coil_radius, own.as_str()),
        ("pitches", d.pitch, own.as_str()),
        ("hands", d.hand_balance, ""),
        ("spectra", d.spectrum, " octaves"),
    ];
    for (name, distance, unit) in rows {
        let what = distance.map_or("not in both".into(), |d| format!("{}{unit} apart", short(d)));
        add(name, what);
    }
    lines
}
