//! `tress convert`: from one format to another.

use std::path::PathBuf;

use clap::Args;
use tress::fit::FitOptions;
use tress::geometry::{Groom, HelixGroom, UpAxis};
use tress::io::{Format, Model};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{FormatArgs, SamplingArgs, SpaceArgs};
use crate::progress::Progress;
use crate::report::Report;
use crate::source::{self, Curved};
use crate::target;

/// Convert between formats, and say what the target cannot carry
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress convert groom.usdc groom.hair
  tress convert captured.data captured.tfx --points 32
  tress convert scan.obj scan.usda --unit cm --up y --usd-curves catmull-rom
  tress convert groom.usdc groom.abc --target unreal")]
pub(crate) struct ConvertArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// How strands are made of super-helices
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// What the groom's numbers mean
    #[command(flatten)]
    pub(crate) space: SpaceArgs,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

pub(crate) fn run(args: &ConvertArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let format = target::check(&[&args.input], &args.output, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let curved = match source::read(&args.input, &progress)? {
        Model::Polylines(groom) => {
            let groom = in_space(source::share(groom, everywhere), &args.space);
            if format != Format::Tress && !args.sampling.is_given() {
                target::write(&args.output, &groom, &args.format, &progress, &mut report)?;
                return Ok(report);
            }
            Curved::fit(&groom, &FitOptions::default(), &progress)?
        }
        Model::Helices(helices) => {
            let helices = helices_in_space(helices, &args.space)?;
            Curved { helices, counts: None, fit: None }.share(everywhere)
        }
    };
    let sampling = &args.sampling;
    target::write_curved(&args.output, &curved, sampling, &args.format, &progress, &mut report)?;
    Ok(report)
}

/// The groom, said to be in the unit and with the axis up that were given, then turned.
pub(crate) fn in_space(groom: Groom, space: &SpaceArgs) -> Groom {
    let (unit, up) = (space.unit.or(groom.unit), space.up.or(groom.up));
    let groom = groom.in_space(unit, up);
    match space.turn_up {
        Some(up) => groom.with_up(up),
        None => groom,
    }
}

fn helices_in_space(helices: HelixGroom, space: &SpaceArgs) -> Result<HelixGroom, Failure> {
    let up: Option<UpAxis> = space.up.or(helices.up);
    if space.turn_up.is_some() && space.turn_up != up {
        let message = "--turn-up turns polylines: convert the .tress file to polylines first";
        return Err(Failure::Usage(message.into()));
    }
    let unit = space.unit.or(helices.unit);
    Ok(helices.in_space(unit, up))
}
