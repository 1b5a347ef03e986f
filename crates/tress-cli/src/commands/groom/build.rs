//! `tress groom build`: a procedural groom's strands.

use std::path::PathBuf;

use clap::Args;
use tress::procedural::ProceduralGroom;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::{source, target};

/// Build a procedural groom's strands
///
/// The same groom gives the same strands to the last bit.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress groom build groom.ron strands.usdc
  tress groom build groom.ron strands.hair --shard 1/4")]
pub(crate) struct BuildArgs {
    /// The procedural groom, .ron
    pub(crate) groom: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

pub(super) fn run(args: &BuildArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_polylines(&[&args.groom], &args.output, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.groom);
    progress.stage(format!("reading {}", args.groom.display()));
    let groom = ProceduralGroom::read(&args.groom)?;
    progress.stage(format!("building {} strands", count(groom.roots.len())));
    let strands = source::share(groom.build_groom()?, everywhere);
    let names: Vec<&str> = groom.chain.operators.iter().map(|o| o.name()).collect();
    report.set("guides", groom.guides.len());
    report.set("operators", &names);
    report.say("guides", count(groom.guides.len()));
    report.say("operators", if names.is_empty() { "none".into() } else { names.join(", ") });
    target::write(&args.output, &strands, &args.format, &progress, &mut report)?;
    Ok(report)
}
