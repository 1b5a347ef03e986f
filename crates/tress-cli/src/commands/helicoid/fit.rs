//! `tress helicoid fit`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use tress::analysis::Quantiles;
use tress::helicoid::{FitOptions, FitReport, Method, Pieces, Roll, fit_with};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count, spread};
use crate::{source, target};

use super::ron_file;

/// Fit chains of helicoids to the strands of a groom
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress helicoid fit head.hair head.ron
  tress helicoid fit head.hair guides.ron --pieces 8
  tress helicoid fit head.hair published.ron --method simplex --tolerance 0.02")]
pub(crate) struct HelicoidFitArgs {
    /// The groom
    input: PathBuf,
    /// The .ron file to write
    pub(super) output: PathBuf,
    /// What finds the parameters
    #[arg(long, value_enum, default_value_t = MethodArg::Newton)]
    method: MethodArg,
    /// Greatest distance from the strand (Frechet), as a share of its length
    #[arg(long, value_name = "D", default_value_t = 0.01, allow_negative_numbers = true)]
    tolerance: f64,
    /// So many pieces a strand, equally long and with neighbours' frames alike: for `fill`
    /// [default: as few as the tolerance takes]
    #[arg(long, value_name = "N")]
    pieces: Option<usize>,
    /// Pieces a strand at most, where their number is left open
    #[arg(long, value_name = "N", default_value_t = 16, conflicts_with = "pieces")]
    most: usize,
    /// Least length of a piece, as a share of the strand's
    #[arg(long, value_name = "L", default_value_t = 0.05, allow_negative_numbers = true)]
    shortest: f64,
}

/// What finds the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MethodArg {
    /// Gauss-Newton from local curvature, all pieces together in the end
    Newton,
    /// Nelder and Mead's simplex piece by piece, as published
    Simplex,
}

impl HelicoidFitArgs {
    fn options(&self) -> FitOptions {
        let method = match self.method {
            MethodArg::Newton => Method::Newton,
            MethodArg::Simplex => Method::Simplex,
        };
        let (pieces, roll) = match self.pieces {
            Some(n) => (Pieces::Equal(n), Roll::Steady),
            None => (Pieces::UpTo(self.most), Roll::Bend),
        };
        let (tolerance, shortest) = (self.tolerance, self.shortest);
        FitOptions { method, pieces, roll, tolerance, shortest, ..FitOptions::default() }
    }
}

pub(super) fn run(args: &HelicoidFitArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let what = ("helicoids are", "ron");
    target::check_kind(&[&args.input], &args.output, what, everywhere)?;
    let options = args.options();
    options.validate()?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let groom = source::polylines(&args.input, &progress)?;
    let groom = source::share(groom, everywhere);
    let strands = groom.strands().len();
    progress.stage_of(format!("fitting {} strands", count(strands)), strands);
    let fitted = fit_with(&groom, &options, |more| progress.add(more))?;
    say(&mut report, &fitted.report);
    // The share was taken before the fit.
    let whole = Everywhere { shard: None, ..everywhere.clone() };
    ron_file::write(&args.output, &fitted.hairs, &whole, &progress, &mut report)?;
    Ok(report)
}

fn say(report: &mut Report, fit: &FitReport) {
    let frechet = Quantiles::of(fit.frechet.iter().copied());
    let rms = Quantiles::of(fit.rms.iter().copied());
    let pieces = Quantiles::of(fit.pieces.iter().map(|&n| n as f64));
    report.set("frechet", frechet);
    report.set("rms", rms);
    report.set("pieces_each", pieces);
    report.set("above_tolerance", fit.above_tolerance);
    report.set("kept", fit.kept.len());
    report.say("frechet", spread(frechet, ""));
    report.say("rms", spread(rms, ""));
    report.say("pieces", spread(pieces, " a strand"));
    if 0 < fit.above_tolerance {
        report.say("above", format!("{} strands exceed the tolerance", count(fit.above_tolerance)));
    }
    let mut reasons: Vec<&str> = fit.kept.iter().map(|(_, defect)| defect.describe()).collect();
    reasons.sort_unstable();
    for group in reasons.chunk_by(|a, b| a == b) {
        report.say("kept", format!("{} strands {}", count(group.len()), group[0]));
    }
}
