//! `tress helicoid`: hairs as chains of generalized helicoids.

mod fill;
mod fit;
mod ron_file;
mod trace;
mod wisp;

use std::path::Path;

use clap::{Args, Subcommand};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::report::Report;

/// Hairs as chains of helicoids: fitted, traced, spread to wisps, filled in between
///
/// A .ron file holds the helicoids, a few numbers a piece. See docs/helicoid.md.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress helicoid fit head.hair guides.ron --pieces 8
  tress helicoid fill guides.ron full.usda --roots head.hair --keep 0.1
  tress helicoid wisp guides.ron wisps.obj --hairs 50 --radius 0.2
  tress helicoid trace guides.ron guides.tress")]
pub(crate) struct HelicoidArgs {
    #[command(subcommand)]
    command: HelicoidCommand,
}

impl HelicoidArgs {
    /// The file to write.
    pub(super) fn output(&self) -> &Path {
        match &self.command {
            HelicoidCommand::Fit(args) => &args.output,
            HelicoidCommand::Trace(args) => &args.output,
            HelicoidCommand::Wisp(args) => &args.output,
            HelicoidCommand::Fill(args) => &args.output,
        }
    }

    /// Choices of formats, where the command writes a groom.
    pub(super) fn format(&self) -> Option<&FormatArgs> {
        match &self.command {
            HelicoidCommand::Fit(_) => None,
            HelicoidCommand::Trace(args) => Some(&args.format),
            HelicoidCommand::Wisp(args) => Some(&args.format),
            HelicoidCommand::Fill(args) => Some(&args.format),
        }
    }
}

#[derive(Debug, Subcommand)]
enum HelicoidCommand {
    Fit(fit::HelicoidFitArgs),
    Trace(trace::TraceArgs),
    Wisp(wisp::WispArgs),
    Fill(fill::FillArgs),
}

pub(crate) fn run(args: &HelicoidArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    match &args.command {
        HelicoidCommand::Fit(args) => fit::run(args, everywhere),
        HelicoidCommand::Trace(args) => trace::run(args, everywhere),
        HelicoidCommand::Wisp(args) => wisp::run(args, everywhere),
        HelicoidCommand::Fill(args) => fill::run(args, everywhere),
    }
}
