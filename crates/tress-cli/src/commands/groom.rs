//! `tress groom`: procedural grooms, begun, built, edited and found.

mod build;
mod curves;
mod edit;
mod fit;
mod new;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::report::Report;

/// Guides and operators to strands, and strands to guides and operators
///
/// A procedural groom is a .ron file that people edit, with a .safetensors file beside it that
/// holds guides, roots and random numbers.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress groom new guides.usdc groom.ron --scalp head.obj --count 30000
  tress groom fit captured.data groom.ron --operators scale,clump,curl,frizz --guides 300
  tress groom edit groom.ron tighter.ron --set curl.radius=0.4
  tress groom build tighter.ron strands.usdc")]
pub(crate) struct GroomArgs {
    #[command(subcommand)]
    command: GroomCommand,
}

impl GroomArgs {
    /// The files to write.
    pub(super) fn outputs(&self) -> Vec<&Path> {
        match &self.command {
            GroomCommand::New(args) => vec![&args.output],
            GroomCommand::Build(args) => vec![&args.output],
            GroomCommand::Edit(args) => vec![&args.output],
            GroomCommand::Fit(args) => {
                let others = [&args.checkpoint, &args.report].into_iter().flatten();
                std::iter::once(&args.output).chain(others).map(PathBuf::as_path).collect()
            }
        }
    }

    /// Whether it works on a share of the strands.
    pub(super) fn shares(&self) -> bool {
        matches!(self.command, GroomCommand::Build(_))
    }

    /// Choices of formats, where the command writes strands.
    pub(super) fn format(&self) -> Option<&FormatArgs> {
        match &self.command {
            GroomCommand::Build(args) => Some(&args.format),
            GroomCommand::New(_) | GroomCommand::Edit(_) | GroomCommand::Fit(_) => None,
        }
    }
}

#[derive(Debug, Subcommand)]
enum GroomCommand {
    New(new::NewArgs),
    Build(build::BuildArgs),
    Edit(edit::EditArgs),
    Fit(fit::GroomFitArgs),
}

pub(crate) fn run(args: &GroomArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    match &args.command {
        GroomCommand::New(args) => new::run(args, everywhere),
        GroomCommand::Build(args) => build::run(args, everywhere),
        GroomCommand::Edit(args) => edit::run(args, everywhere),
        GroomCommand::Fit(args) => fit::run(args, everywhere),
    }
}
