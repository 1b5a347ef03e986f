//! `tress blend`: a groom between two grooms.

use tress::edit::{BlendSpace, blend, blend_positions};
use tress::fit::{Elements, FitOptions};
use tress::io::Model;

use crate::args::{BlendArgs, Everywhere, Space};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::Report;
use crate::source::{self, Curved};
use crate::target;

pub(crate) fn run(args: &BlendArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check(&[&args.from, &args.to], &args.output, everywhere)?;
    let progress = Progress::new(6, everywhere);
    let mut report = Report::default();
    report.set("from", &args.from);
    report.set("to", &args.to);
    report.set("amount", args.amount);
    let from = source::read(&args.from, &progress)?;
    let to = source::read(&args.to, &progress)?;
    let space = match args.space {
        Space::Curvature => BlendSpace::Curvature,
        Space::Darboux => BlendSpace::Darboux,
        Space::Position => {
            let (Model::Polylines(from), Model::Polylines(to)) = (from, to) else {
                let message = "--space position mixes points: name two files of polylines";
                return Err(Failure::Usage(message.into()));
            };
            let middle = source::share(blend_positions(&from, &to, args.amount)?, everywhere);
            target::write(&args.output, &middle, &args.format, &progress, &mut report)?;
            return Ok(report);
        }
    };
    let options = corresponding(args, &from, &to);
    let mut from = Curved::new(from, &options, &progress)?;
    let to = Curved::new(to, &options, &progress)?;
    progress.stage("blending");
    from.helices = blend(&from.helices, &to.helices, args.amount, space)?;
    let middle = from.share(everywhere);
    let sampling = &args.sampling;
    target::write_curved(&args.output, &middle, sampling, &args.format, &progress, &mut report)?;
    Ok(report)
}

/// The fit asked for; without one, as many elements a strand as make the two grooms correspond:
/// one a segment where their points do, or what a given `.tress` file has.
fn corresponding(args: &BlendArgs, from: &Model, to: &Model) -> FitOptions {
    let elements_of = |model: &Model| match model {
        Model::Helices(helices) => helices.elements().counts().max(),
        Model::Polylines(_) => None,
    };
    let asked = args.fit.elements.is_some() || args.fit.tolerance.is_some();
    match elements_of(from).or_else(|| elements_of(to)) {
        Some(n) if !asked => FitOptions { elements: Elements::Count(n), ..FitOptions::default() },
        _ => args.fit.options(),
    }
}
