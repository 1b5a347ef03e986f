//! `tress recoil`: coils made wider, narrower, tighter or looser.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use tress::analysis::summarize;
use tress::edit::{RecoilKeep, RecoilOptions, recoil};
use tress::optimize::hold_centerlines;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::RoadArgs;
use crate::progress::Progress;
use crate::report::{Report, count, spread};
use crate::source::Curved;
use crate::target;

/// Tighter or looser, wider or narrower coils
///
/// Radius and frequency (turns in a length of axis) are multiplied. They cannot change alone: say
/// what stays.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress recoil groom.usdc looser.usda --radius 1.5
  tress recoil groom.usdc tighter.usda --radius 0.7 --frequency 1.4 --keep turns")]
pub(crate) struct RecoilArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// Factor of the coil radius
    #[arg(long, value_name = "X", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) radius: f64,
    /// Factor of the spatial frequency
    #[arg(long, value_name = "Y", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) frequency: f64,
    /// What stays
    #[arg(long, value_enum, default_value_t = KeepArg::Length)]
    pub(crate) keep: KeepArg,
    /// How polylines come and go
    #[command(flatten)]
    pub(crate) road: RoadArgs,
}

/// What stays when coils change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum KeepArg {
    /// The arc length of every strand; turns follow
    Length,
    /// The turns of every strand; its length follows
    Turns,
    /// The line that every strand winds about; length and turns follow
    Centerline,
}

pub(crate) fn run(args: &RecoilArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_edited(&args.input, &args.output, &args.road, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    let mut curved = Curved::read(&args.input, &args.road.fit, &progress, &mut report)?;
    progress.stage("recoiling");
    let keep = match args.keep {
        KeepArg::Length => RecoilKeep::Length,
        KeepArg::Turns => RecoilKeep::Turns,
        KeepArg::Centerline => RecoilKeep::Advance,
    };
    let options = RecoilOptions { radius: args.radius, frequency: args.frequency, keep };
    let mut changed = recoil(&curved.helices, &options)?;
    if args.keep == KeepArg::Centerline {
        progress.stage("holding centerlines");
        let held = hold_centerlines(&curved.helices, &mut changed)?;
        report.set("held", held);
        report.say("held", format!("the centerlines of {} strands", count(held)));
    }
    let (before, after) = (summarize(&curved.helices), summarize(&changed));
    curved.helices = changed;
    report.set("before", before);
    report.set("after", after);
    report.say("coil radius", spread(before.coil_radius, "") + " before");
    report.say("", spread(after.coil_radius, "") + " after");
    report.say("turns", spread(before.turns, "") + " before");
    report.say("", spread(after.turns, "") + " after");
    report.say("length", spread(before.length, "") + " before");
    report.say("", spread(after.length, "") + " after");
    target::write_edited(&args.output, curved, &args.road, everywhere, &progress, &mut report)?;
    Ok(report)
}
