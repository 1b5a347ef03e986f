//! `tress fit`: polylines to super-helices.

use std::path::PathBuf;

use clap::Args;
use tress::io::{Format, Model};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FitArgs;
use crate::progress::Progress;
use crate::report::Report;
use crate::source::{self, Curved};
use crate::target;

/// Fit super-helices to polylines; report how near they are
#[derive(Args, Debug)]
#[command(
    name = "fit",
    after_help = "Examples:
  tress fit guides.obj guides.tress --elements 90
  tress fit head.usdc head.tress --tolerance 2%"
)]
pub(crate) struct FitCommandArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The .tress file to write
    pub(crate) output: PathBuf,
    /// How polylines are fitted
    #[command(flatten)]
    pub(crate) fit: FitArgs,
}

pub(crate) fn run(args: &FitCommandArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    if target::check(&[&args.input], &args.output, everywhere)? != Format::Tress {
        let file = args.output.display();
        let message = format!(
            "{file}: super-helices go to a .tress file; `tress convert` and `tress sample` write polylines"
        );
        return Err(Failure::Usage(message));
    }
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let Model::Polylines(groom) = source::read(&args.input, &progress)? else {
        let file = args.input.display();
        return Err(Failure::Failed(format!("{file} holds super-helices already")));
    };
    let groom = source::share(groom, everywhere);
    let curved = Curved::fit(&groom, &args.fit.options(), &progress)?;
    curved.say_fit(&mut report);
    let (sampling, format) = Default::default();
    target::write_curved(&args.output, &curved, &sampling, &format, &progress, &mut report)?;
    Ok(report)
}
