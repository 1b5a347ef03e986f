//! `tress analyze`: what a groom is like, in numbers, plots, pictures and a report.

mod page;
pub(crate) mod pictures;
pub(crate) mod plots;
pub(crate) mod study;
mod tables;
pub(crate) mod units;

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use tress::analysis::Quantity;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::SpaceArgs;
use crate::progress::Progress;
use crate::report::{Report, count, short, spread};
use crate::target::{self, has_extension};

use super::info::{say_defects, say_measures};
use super::render::{ViewArg, view};
use study::Study;

/// What a groom is like: numbers, plots, pictures, a report
///
/// Coil radius, turns, pitch, frequency, hand, beta, curvature and twist are those of the coil, in
/// the groom's unit, whatever the sampling. Switchbacks (changes of hand) and wisps are found.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress analyze head.usdc --html head.html
  tress analyze guides.obj --unit cm --csv guides.csv --plot beta.svg --quantity beta
  tress analyze guides.obj --png hands.png --quantity handedness --json")]
pub(crate) struct AnalyzeArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// Write a table with a row for each strand, .csv
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Write a table with a row for each point, .csv
    #[arg(long, value_name = "FILE")]
    pub(crate) csv_along: Option<PathBuf>,
    /// Write the numbers of every plot, .csv
    #[arg(long, value_name = "FILE")]
    pub(crate) csv_plots: Option<PathBuf>,
    /// Write plots, .svg or .png
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Write pictures coloured by the quantities, .png
    #[arg(long, value_name = "FILE")]
    pub(crate) png: Option<PathBuf>,
    /// Write a report with everything, .html: one file that needs no other
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// What is plotted and pictured: radius, turns, length, handedness, curvature, twist,
    /// frequency, pitch, beta, beta-fourier
    #[arg(
        long,
        value_name = "QUANTITIES",
        value_delimiter = ',',
        value_parser = parse_quantity,
        default_value = "radius,frequency,beta,beta-fourier,curvature,twist,handedness"
    )]
    pub(crate) quantity: Vec<Quantity>,
    /// Where the camera stands
    #[arg(long, value_enum, default_value_t = ViewArg::ThreeQuarter)]
    pub(crate) view: ViewArg,
    /// What the groom's numbers mean
    #[command(flatten)]
    pub(crate) space: SpaceArgs,
}

fn parse_quantity(text: &str) -> Result<Quantity, String> {
    text.parse::<Quantity>().map_err(|error| error.to_string())
}

pub(crate) fn run(args: &AnalyzeArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    check(args, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let study = Study::read(&args.input, &args.space, everywhere, &progress)?;
    say(&study, &mut report);
    let from = view(args.view);
    let wants_plots = [&args.plot, &args.csv_plots, &args.html].iter().any(|file| file.is_some());
    let plots = if wants_plots {
        progress.stage("plotting");
        plots::all(&study, &args.quantity)
    } else {
        vec![]
    };
    let mut write = |file: &Path, bytes: &[u8]| -> Result<(), Failure> {
        progress.stage(format!("writing {}", file.display()));
        tress::io::write_bytes(file, bytes)?;
        report.say("wrote", file.display());
        Ok(())
    };
    if let Some(file) = &args.csv {
        write(file, tables::strands(&study).as_bytes())?;
    }
    if let Some(file) = &args.csv_along {
        write(file, tables::along(&study).as_bytes())?;
    }
    if let Some(file) = &args.csv_plots {
        write(file, tables::plots(&plots).as_bytes())?;
    }
    if let Some(file) = &args.plot {
        write(file, &plots::sheet(&plots, has_extension(file, "svg"))?)?;
    }
    if let Some(file) = &args.png {
        write(file, &pictures::sheet_by(&study, &args.quantity, from)?)?;
    }
    if let Some(file) = &args.html {
        let html = page::page(&args.input, &study, &plots, &args.quantity, from)?;
        write(file, html.as_bytes())?;
    }
    Ok(report)
}

/// Says no before any work is done.
fn check(args: &AnalyzeArgs, everywhere: &Everywhere) -> Result<(), Failure> {
    let files: [(&Option<PathBuf>, &[&str]); 6] = [
        (&args.csv, &["csv"]),
        (&args.csv_along, &["csv"]),
        (&args.csv_plots, &["csv"]),
        (&args.plot, &["svg", "png"]),
        (&args.png, &["png"]),
        (&args.html, &["html", "htm"]),
    ];
    for (file, extensions) in files {
        let Some(file) = file else { continue };
        if !extensions.iter().any(|extension| has_extension(file, extension)) {
            let (file, wanted) = (file.display(), extensions.join(" or ."));
            return Err(Failure::Usage(format!("{file}: this is written as .{wanted}")));
        }
        target::check_place(&[&args.input], file, everywhere)?;
    }
    Ok(())
}

fn say(study: &Study, report: &mut Report) {
    let (summary, units) = (&study.summary, &study.units);
    report.set("strands", study.groom.strands().len());
    report.set("points", study.groom.strands().points().len());
    report.set("metres_per_unit", study.groom.unit);
    report.say("strands", count(study.groom.strands().len()));
    say_defects(&study.defects, report);
    say_measures(summary, study.groom.unit, report);
    let line = |q: Option<_>, unit: &str| spread(q, &format!(" {unit}"));
    report.say("pitch", line(summary.pitch, &units.behind_numbers()));
    report.say("frequency", line(summary.frequency, &format!("turns/{} of axis", units.own())));
    report.say("curl index", spread(summary.curl_index, ""));
    report.say("circularity", spread(summary.circularity, ""));
    report.say("frizz", spread(summary.frizz, ""));
    let wisps = &study.wisps;
    report.set(
        "wisps",
        json!({
            "strands_in_wisps": wisps.in_company(),
            "wisps": wisps.sizes.iter().filter(|&&size| 1 < size).count(),
            "size": wisps.size(),
            "phase_locked": study.locked(),
        }),
    );
    let locked = study.locked().map_or(0.0, |q| 100.0 * q.median);
    let in_wisps = count(wisps.in_company());
    let sizes = spread(wisps.size(), " strands");
    let locked = short(locked);
    report.say("wisps", format!("{in_wisps} strands in wisps of {sizes}; {locked} % phase-locked"));
    report.set("switchbacks", &study.analysis.switchbacks);
    let spectrum = study.analysis.spectrum.shares();
    report.set(
        "spectrum",
        json!({
            "frequency": spectrum.iter().map(|s| s.0).collect::<Vec<_>>(),
            "share": spectrum.iter().map(|s| s.1).collect::<Vec<_>>(),
        }),
    );
}
