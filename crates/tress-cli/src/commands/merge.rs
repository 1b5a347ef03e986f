//! `tress merge`: the shares of `--shard` joined.

use std::path::{Path, PathBuf};

use clap::Args;
use tress::io::Model;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{FormatArgs, SamplingArgs};
use crate::progress::Progress;
use crate::report::Report;
use crate::source::{self, Curved};
use crate::target;

/// Join the shares that `--shard` made, in order
#[derive(Args, Debug)]
#[command(after_help = "Example: tress merge part1.hair part2.hair whole.hair")]
pub(crate) struct MergeArgs {
    /// The parts, first to last, and then the file to write
    #[arg(required = true, num_args = 2.., value_name = "PART... OUTPUT")]
    pub(crate) files: Vec<PathBuf>,
}

pub(crate) fn run(args: &MergeArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let Some((output, parts)) = args.files.split_last() else {
        return Err(Failure::Usage("name the parts and the file to write".into()));
    };
    let inputs: Vec<&Path> = parts.iter().map(PathBuf::as_path).collect();
    target::check(&inputs, output, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("inputs", parts);
    let Some((first, rest)) = parts.split_first() else {
        return Err(Failure::Usage("name at least one part and the file to write".into()));
    };
    let mut whole = source::read(first, &progress)?;
    for part in rest {
        let next = source::read(part, &progress)?;
        let failed = |why: String| Failure::Failed(format!("{}: {why}", part.display()));
        match (&mut whole, &next) {
            (Model::Polylines(whole), Model::Polylines(next)) => {
                whole.append(next).map_err(|error| failed(error.to_string()))?;
            }
            (Model::Helices(whole), Model::Helices(next)) => {
                whole.append(next).map_err(|error| failed(error.to_string()))?;
            }
            _ => return Err(failed("polylines and super-helices do not join".into())),
        }
    }
    let format = FormatArgs::default();
    match whole {
        Model::Polylines(groom) => {
            target::write(output, &groom, &format, &progress, &mut report)?;
        }
        Model::Helices(helices) => {
            let curved = Curved { helices, counts: None, fit: None };
            let sampling = SamplingArgs::default();
            target::write_curved(output, &curved, &sampling, &format, &progress, &mut report)?;
        }
    }
    Ok(report)
}
