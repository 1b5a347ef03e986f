//! `tress sculpt`: strands moved to where a pose puts them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::json;
use tress::optimize::{
    Adam, Pose, SculptOptions, Sculpted, Solver, Stiffness, Stop, apply_pose, sculpt,
};

use crate::args::{Everywhere, SculptArgs, SolverArg};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count, short};
use crate::source::{self, Curved};
use crate::target;

pub(crate) fn run(args: &SculptArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check(&[&args.input], &args.output, everywhere)?;
    let pose = read_pose(&args.pose)?;
    let progress = Progress::new(6, everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    report.set("pose", &args.pose);
    let model = source::read(&args.input, &progress)?;
    let mut curved = Curved::new(model, &args.fit.options(), &progress)?;
    progress.stage("posing");
    let controls = apply_pose(&curved.helices, &pose)
        .map_err(|error| Failure::Failed(format!("{}: {error}", args.pose.display())))?;
    progress.stage(format!("sculpting {} strands", count(curved.helices.len())));
    let sculpted = sculpt(&mut curved.helices, &controls, &options(args))?;
    say_sculpted(&sculpted, &mut report);
    let curved = curved.share(everywhere);
    let sampling = &args.sampling;
    target::write_curved(&args.output, &curved, sampling, &args.format, &progress, &mut report)?;
    Ok(report)
}

fn read_pose(path: &Path) -> Result<Pose, Failure> {
    let file = path.display();
    let text =
        fs::read_to_string(path).map_err(|error| Failure::Failed(format!("{file}: {error}")))?;
    ron::from_str(&text).map_err(|error| {
        let (line, column) = (error.span.start.line, error.span.start.col);
        Failure::Failed(format!("{file}: line {line}, column {column}: {}", error.code))
    })
}

fn options(args: &SculptArgs) -> SculptOptions {
    let defaults = SculptOptions::default();
    let stiffness = match (args.stiffness, args.c) {
        (Some(stiffness), _) => Stiffness::Relative(stiffness),
        (None, Some(c)) => Stiffness::Raw(c),
        (None, None) => defaults.stiffness,
    };
    let solver = match args.solver {
        SolverArg::Lm => Solver::LevenbergMarquardt,
        SolverArg::Adam => Solver::Adam(Adam::default()),
    };
    SculptOptions { stiffness, solver, ..defaults }
}

/// What became of the strands.
fn say_sculpted(sculpted: &Sculpted, report: &mut Report) {
    let reports = || sculpted.reports.iter().flatten();
    let moved = reports().count();
    let worst = reports().map(|r| r.anchor_distance).fold(0.0, f64::max);
    let iterations: f64 = reports().map(|r| f64::from(r.iterations)).sum();
    let unreachable: u32 = reports().map(|r| r.unreachable).sum();
    let mut stops = BTreeMap::new();
    for strand in reports() {
        *stops.entry(words(strand.stop)).or_insert(0_usize) += 1;
    }
    report.set(
        "sculpt",
        json!({
            "moved": moved,
            "free": sculpted.free,
            "kept": sculpted.kept,
            "not_finite": sculpted.not_finite,
            "greatest_anchor_distance": worst,
            "unreachable_anchors": unreachable,
            "mean_iterations": iterations / moved.max(1) as f64,
            "stops": stops,
        }),
    );
    let free = count(sculpted.free);
    report.say("moved", format!("{} strands; {free} have no joint", count(moved)));
    report.say("anchors", format!("missed by {} at most", short(worst)));
    for (stop, n) in stops {
        report.say("ended", format!("{} strands {stop}", count(n)));
    }
    if 0 < unreachable {
        let far = "lie farther from the root than the strand is long: it is stretched to them";
        report.say("unreachable", format!("{unreachable} anchors {far}"));
    }
    if 0 < sculpted.kept {
        report.say("kept", format!("{} strands that are no curves", count(sculpted.kept)));
    }
}

/// Why a solver stopped, in words that follow a number of strands.
fn words(stop: Stop) -> &'static str {
    match stop {
        Stop::Converged => "converged",
        Stop::LocalMinimum => "where no small change brings them nearer",
        Stop::NoDescent => "where rounding hides any further gain",
        Stop::MaxIterations => "with as many steps as were allowed",
        Stop::Residual => "below the residual",
        Stop::NoImprovement => "after steps without improvement",
    }
}
