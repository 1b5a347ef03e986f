//! `tress helicoid trace`.

use std::path::PathBuf;

use clap::Args;
use tress::helicoid::{Tracing, sample, to_helices};
use tress::io::Format;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::{source, target};

use super::ron_file;

/// Trace helicoids to polylines, or to super-helices where the output is a .tress file
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress helicoid trace head.ron head.hair --points 60
  tress helicoid trace head.ron head.tress --elements 10
  tress helicoid trace head.ron published.obj --euler 20")]
pub(crate) struct TraceArgs {
    /// The .ron file of helicoids
    input: PathBuf,
    /// The file to write
    pub(super) output: PathBuf,
    /// Points a strand
    #[arg(long, value_name = "N", default_value_t = 40)]
    points: usize,
    /// Elements a piece, for a .tress file
    #[arg(long, value_name = "N", default_value_t = 8)]
    elements: usize,
    /// So many Euler steps a piece, as published [default: of order 5 with error control]
    #[arg(long, value_name = "N")]
    euler: Option<u32>,
    /// Choices of formats
    #[command(flatten)]
    pub(super) format: FormatArgs,
}

pub(super) fn run(args: &TraceArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let format = target::check(&[&args.input], &args.output, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let hairs = ron_file::read(&args.input, &progress)?;
    progress.stage("tracing");
    if format == Format::Tress {
        let helices = to_helices(&hairs, args.elements)?;
        let curved = source::Curved { helices, counts: None, fit: None }.share(everywhere);
        tress::io::write_helices(&args.output, &curved.helices)?;
        let elements = curved.helices.elements().points().len();
        report.set("output", &args.output);
        report.set("elements", elements);
        let file = args.output.display();
        report.say("wrote", format!("{file} ({} elements)", count(elements)));
        return Ok(report);
    }
    let tracing = args.euler.map_or(Tracing::default(), Tracing::Euler);
    let groom = source::share(sample(&hairs, args.points, tracing)?, everywhere);
    target::write(&args.output, &groom, &args.format, &progress, &mut report)?;
    Ok(report)
}
