//! `tress convert`: from one format to another.

use tress::fit::FitOptions;
use tress::geometry::{Groom, HelixGroom, UpAxis};
use tress::io::{Format, Model};

use crate::args::{ConvertArgs, Everywhere, SpaceArgs};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::Report;
use crate::source::{self, Curved};
use crate::target;

pub(crate) fn run(args: &ConvertArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let format = target::check(&[&args.input], &args.output, everywhere)?;
    let progress = Progress::new(4, everywhere);
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
