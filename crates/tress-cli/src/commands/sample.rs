//! `tress sample`: super-helices to polylines.

use std::path::PathBuf;

use clap::Args;
use tress::fit::FitOptions;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{FormatArgs, SamplingArgs};
use crate::progress::Progress;
use crate::report::Report;
use crate::source::{self, Curved};
use crate::target;

/// Sample super-helices as polylines
#[derive(Args, Debug)]
#[command(
    name = "sample",
    after_help = "Examples:
  tress sample groom.tress groom.usda --points 128
  tress sample groom.tress groom.obj --spacing 0.05"
)]
pub(crate) struct SampleCommandArgs {
    /// The groom; polylines are fitted first, which resamples them along smooth curves
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// How many points
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

pub(crate) fn run(args: &SampleCommandArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_polylines(&[&args.input], &args.output, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let model = source::read(&args.input, &progress)?;
    let curved = Curved::new(model, &FitOptions::default(), &progress)?.share(everywhere);
    let sampling = &args.sampling;
    target::write_curved(&args.output, &curved, sampling, &args.format, &progress, &mut report)?;
    Ok(report)
}
