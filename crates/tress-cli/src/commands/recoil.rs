//! `tress recoil`: coils made wider, narrower, tighter or looser.

use tress::analysis::summarize;
use tress::edit::{RecoilKeep, RecoilOptions, recoil};
use tress::optimize::hold_centerlines;

use crate::args::{Everywhere, KeepArg, RecoilArgs};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count, spread};
use crate::source::{self, Curved};
use crate::target;

pub(crate) fn run(args: &RecoilArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check(&[&args.input], &args.output, everywhere)?;
    let progress = Progress::new(5, everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let model = source::read(&args.input, &progress)?;
    let mut curved = Curved::new(model, &args.fit.options(), &progress)?;
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
    let curved = curved.share(everywhere);
    let sampling = &args.sampling;
    target::write_curved(&args.output, &curved, sampling, &args.format, &progress, &mut report)?;
    Ok(report)
}
