//! `tress blend`: a groom between two grooms.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use tress::edit::{BlendSpace, blend, blend_positions};
use tress::fit::{Elements, FitOptions};
use tress::io::Model;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::RoadArgs;
use crate::progress::Progress;
use crate::report::Report;
use crate::source::{self, Curved};
use crate::target;

/// A groom between two grooms, strand by strand
///
/// In curvature space coils open and close; in world Darboux or position space opposite bends
/// cancel and the coils flatten half way.
#[derive(Args, Debug)]
#[command(after_help = "Example: tress blend before.obj after.obj half.obj --amount 0.5")]
pub(crate) struct BlendArgs {
    /// The groom at amount 0
    pub(crate) from: PathBuf,
    /// The groom at amount 1
    pub(crate) to: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// Where between them
    #[arg(long, value_name = "T", default_value_t = 0.5, allow_negative_numbers = true)]
    pub(crate) amount: f64,
    /// What is mixed
    #[arg(long, value_enum, default_value_t = Space::Curvature)]
    pub(crate) space: Space,
    /// How polylines come and go
    #[command(flatten)]
    pub(crate) road: RoadArgs,
}

/// The space of a blend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Space {
    /// Material curvatures
    Curvature,
    /// World Darboux vectors
    Darboux,
    /// Points
    Position,
}

pub(crate) fn run(args: &BlendArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check(&[&args.from, &args.to], &args.output, everywhere)?;
    let progress = Progress::new(everywhere);
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
            target::write(&args.output, &middle, &args.road.format, &progress, &mut report)?;
            return Ok(report);
        }
    };
    let options = corresponding(args, &from, &to);
    let mut from = Curved::new(from, &options, &progress)?;
    let to = Curved::new(to, &options, &progress)?;
    progress.stage("blending");
    from.helices = blend(&from.helices, &to.helices, args.amount, space)?;
    target::write_edited(&args.output, from, &args.road, everywhere, &progress, &mut report)?;
    Ok(report)
}

/// The fit asked for; without one, as many elements a strand as make the two grooms correspond:
/// one a segment where their points do, or what a given `.tress` file has.
fn corresponding(args: &BlendArgs, from: &Model, to: &Model) -> FitOptions {
    let elements_of = |model: &Model| match model {
        Model::Helices(helices) => helices.elements().counts().max(),
        Model::Polylines(_) => None,
    };
    let asked = args.road.fit.elements.is_some() || args.road.fit.tolerance.is_some();
    match elements_of(from).or_else(|| elements_of(to)) {
        Some(n) if !asked => FitOptions { elements: Elements::Count(n), ..FitOptions::default() },
        _ => args.road.fit.options(),
    }
}
