//! `tress fit`: polylines to super-helices.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};
use tress::fit::FitReport;
use tress::io::{Format, Model};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FitArgs;
use crate::progress::Progress;
use crate::report::{Report, count, short};
use crate::source::{self, Curved};
use crate::target;

/// Fit super-helices to polylines; report how near they are
#[derive(Args, Debug)]
#[command(
    name = "fit",
    after_help = "Examples:
  tress fit guides.obj guides.tress --elements 90
  tress fit head.usdc head.tress --tolerance 2%"
)]
pub(crate) struct FitCommandArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The .tress file to write
    pub(crate) output: PathBuf,
    /// How polylines are fitted
    #[command(flatten)]
    pub(crate) fit: FitArgs,
}

pub(crate) fn run(args: &FitCommandArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    if target::check(&[&args.input], &args.output, everywhere)? != Format::Tress {
        let file = args.output.display();
        let message = format!(
            "{file}: super-helices go to a .tress file; `tress convert` and `tress sample` write polylines"
        );
        return Err(Failure::Usage(message));
    }
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let Model::Polylines(groom) = source::read(&args.input, &progress)? else {
        let file = args.input.display();
        return Err(Failure::Failed(format!("{file} holds super-helices already")));
    };
    let groom = source::share(groom, everywhere);
    let curved = Curved::fit(&groom, &args.fit.options(), &progress)?;
    say_fit(&curved, &mut report);
    let (sampling, format) = Default::default();
    target::write_curved(&args.output, &curved, &sampling, &format, &progress, &mut report)?;
    Ok(report)
}

/// A fit's report for programs.
pub(crate) fn as_json(fit: &FitReport) -> Value {
    let d = fit.deviation;
    let kept = fit.kept.iter().map(|(reason, n)| (reason.describe().to_owned(), json!(n)));
    json!({
        "strands": fit.strands,
        "elements": fit.elements,
        "rms": d.rms,
        "greatest": d.greatest,
        "rms_fit_to_input": d.rms_back,
        "greatest_fit_to_input": d.greatest_back,
        "rms_of_coil_radius": d.rms_of_radius,
        "greatest_of_coil_radius": d.greatest_of_radius,
        "length_change": d.length_change,
        "arc_excess": d.arc_excess,
        "greatest_curvature_jump": d.curvature_jump,
        "kept": kept.collect::<serde_json::Map<_, _>>(),
    })
}

/// Says how near a fit is, and which strands it passed by.
pub(crate) fn say_fit(curved: &Curved, report: &mut Report) {
    let Some(fit) = &curved.fit else { return };
    report.set("fit", as_json(fit));
    let deviation = fit.deviation;
    let (rms, greatest) = (short(deviation.rms), short(deviation.greatest));
    report.say("fitted", format!("{} strands", count(fit.strands)));
    let of_radius = short(100.0 * deviation.rms_of_radius);
    let coiled = if 0.0 < deviation.rms_of_radius {
        format!("; {of_radius} % of the coil radius")
    } else {
        String::new()
    };
    report.say("distance", format!("rms {rms}{coiled}, greatest {greatest}"));
    let percent = short(100.0 * deviation.length_change);
    report.say("length change", format!("{percent} % at most"));
    for (reason, n) in &fit.kept {
        let n = count(*n);
        report.say("kept", format!("{n} strands {} as they are", reason.describe()));
    }
}
