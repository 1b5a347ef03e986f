//! `tress ruffle`: frizz made of the groom's own curls.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use tress::analysis::Quantiles;
use tress::edit::{Grouping, RuffleOptions, ruffle};
use tress::geometry::HelixGroom;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{RoadArgs, parse_grouping};
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::source::Curved;
use crate::target;

/// Exchange elements between strands of a group: frizz made of the groom's own curls
///
/// Beyond the elements kept at the root, each element of a strand is replaced, with the given
/// probability, by the element of the same index of a random strand of its group.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress ruffle guides.obj ruffled.obj --elements 90 --probability 0.05 --keep 30
  tress ruffle head.usdc head.usda --groups clusters:40 --blend 0.5")]
pub(crate) struct RuffleArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// Chance of an element to be replaced, 0 to 1
    #[arg(long, value_name = "P", default_value_t = 0.05, allow_negative_numbers = true)]
    pub(crate) probability: f64,
    /// Elements at the root that stay: a number, or a share of the strand as in 33%
    #[arg(long, value_name = "N", default_value = "33%")]
    pub(crate) keep: Keep,
    /// From the groom as it is (0) to the ruffled groom (1)
    #[arg(long, value_name = "T", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) blend: f64,
    /// Who exchanges with whom: `whole`, the name of a strand attribute, or `clusters:K`
    #[arg(long, value_name = "G", default_value = "whole", value_parser = parse_grouping)]
    pub(crate) groups: Grouping,
    /// How polylines come and go
    #[command(flatten)]
    pub(crate) road: RoadArgs,
}

/// Elements at the root that stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Keep {
    /// So many.
    Count(usize),
    /// This share of the elements of a typical strand.
    Share(f64),
}

impl FromStr for Keep {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let keep = match text.strip_suffix('%') {
            Some(percent) => percent.parse().ok().map(|p: f64| Self::Share(p / 100.0)),
            None => text.parse().ok().map(Self::Count),
        };
        match keep {
            Some(Self::Share(share)) if !(0.0..=1.0).contains(&share) => None,
            other => other,
        }
        .ok_or_else(|| "expected a number of elements, or a share from 0% to 100%".into())
    }
}

pub(crate) fn run(args: &RuffleArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_edited(&args.input, &args.output, &args.road, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    let mut curved = Curved::read(&args.input, &args.road.fit, &progress, &mut report)?;
    progress.stage("ruffling");
    let groups = curved.groups(&args.groups, &args.input, &args.road.fit, everywhere, &progress)?;
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
    target::write_edited(&args.output, curved, &args.road, everywhere, &progress, &mut report)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_a_number_or_a_share() {
        assert_eq!("33%".parse::<Keep>(), Ok(Keep::Share(0.33)));
        assert_eq!("30".parse::<Keep>(), Ok(Keep::Count(30)));
        assert!("101%".parse::<Keep>().is_err() && "-3".parse::<Keep>().is_err());
    }
}
