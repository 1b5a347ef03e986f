//! `tress ruffle`: frizz made of the groom's own curls.

use tress::analysis::Quantiles;
use tress::edit::{RuffleOptions, groups, ruffle};
use tress::geometry::HelixGroom;

use crate::args::{Everywhere, Keep, RuffleArgs};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::source::{self, Curved};
use crate::target;

use super::fit::say_fit;

pub(crate) fn run(args: &RuffleArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check(&[&args.input], &args.output, everywhere)?;
    let progress = Progress::new(5, everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let model = source::read(&args.input, &progress)?;
    let mut curved = Curved::new(model, &args.fit.options(), &progress)?;
    say_fit(&curved, &mut report);

    progress.stage("ruffling");
    let groups = groups(&curved.helices, &args.groups, everywhere.seed)?;
    let keep = elements_kept(&curved.helices, args.keep);
    let options = RuffleOptions { probability: args.probability, keep, blend: args.blend };
    let (ruffled, done) = ruffle(&curved.helices, &groups, &options, everywhere.seed)?;
    curved.helices = ruffled;
    report.set("keep", keep);
    report.set("ruffle", done);
    let (replaced, candidates) = (count(done.replaced), count(done.candidates));
    let within = if done.groups == 1 { "one group" } else { "groups" };
    let groups = if done.groups == 1 { String::new() } else { count(done.groups) + " " };
    report.say(
        "ruffled",
        format!("{replaced} of {candidates} elements beyond the first {keep}, in {groups}{within}"),
    );
    if 0 < done.untouched {
        let n = count(done.untouched);
        report.say("untouched", format!("{n} strands with no element beyond the first {keep}"));
    }
    if 0 < done.alone {
        report.say("alone", format!("{} strands, each the only one of its group", done.alone));
    }
    if done.unequal {
        report.say("unequal", "strands differ in elements; each draws from those as long");
    }
    let curved = curved.share(everywhere);
    let sampling = &args.sampling;
    target::write_curved(&args.output, &curved, sampling, &args.format, &progress, &mut report)?;
    Ok(report)
}

/// Elements at the root that stay; a share is of the median strand's elements.
fn elements_kept(helices: &HelixGroom, keep: Keep) -> usize {
    match keep {
        Keep::Count(n) => n,
        Keep::Share(share) => {
            let counts = helices.elements().counts().filter(|&n| 0 < n).map(|n| n as f64);
            let median = Quantiles::of(counts).map_or(0.0, |q| q.median);
            #[expect(clippy::cast_possible_truncation, reason = "a share of a count")]
            #[expect(clippy::cast_sign_loss, reason = "a share of a count")]
            let n = (share * median).round() as usize;
            n
        }
    }
}
