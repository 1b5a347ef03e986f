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
use crate::report::Report;

/// Guides and operators to strands, and strands to guides and operators
///
/// A procedural groom is a .ron file that people edit, with a .safetensors file beside it that
/// holds guides, roots and random numbers.
#[derive(Args, Debug)]
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
