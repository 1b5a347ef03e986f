//! `tress sculpt`: strands moved to where a pose puts them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;
use tress::optimize::{
    Adam, Pose, SculptOptions, Sculpted, Solver, Stiffness, Stop, apply_pose, sculpt,
};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::RoadArgs;
use crate::progress::Progress;
use crate::report::{Report, count, short};
use crate::source::{self, Curved};
use crate::target;

/// Move strands to where a pose puts them, changing their curvatures as little as possible
///
/// Lengths of strands do not change.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress armature groom.obj pose.ron
  tress sculpt groom.obj posed.obj --pose pose.ron --stiffness 0.001")]
pub(crate) struct SculptArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// The pose, as `tress armature` writes it
    #[arg(long, value_name = "POSE.ron")]
    pub(crate) pose: PathBuf,
    /// What bending costs, whatever the unit: 0 meets every anchor, 1 hardly bends
    #[arg(long, value_name = "C", conflicts_with = "c", allow_negative_numbers = true)]
    pub(crate) stiffness: Option<f64>,
    /// What bending costs as the published c, in the fourth power of the groom's unit
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    pub(crate) c: Option<f64>,
    /// How the least energy is found
    #[arg(long, value_enum, default_value_t = SolverArg::Lm)]
    pub(crate) solver: SolverArg,
    /// How polylines come and go
    #[command(flatten)]
    pub(crate) road: RoadArgs,
}

/// How the least energy is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SolverArg {
    /// Levenberg-Marquardt: tens of steps
    Lm,
    /// Adam as published: thousands of steps, for comparison
    Adam,
}

pub(crate) fn run(args: &SculptArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_edited(&args.input, &args.output, &args.road, everywhere)?;
    let pose: Pose = source::ron(&args.pose)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("pose", &args.pose);
    let mut curved = Curved::read(&args.input, &args.road.fit, &progress, &mut report)?;
    progress.stage("posing");
    let controls = apply_pose(&curved.helices, &pose)
        .map_err(|error| Failure::Failed(format!("{}: {error}", args.pose.display())))?;
    progress.stage(format!("sculpting {} strands", count(curved.helices.len())));
    let sculpted = sculpt(&mut curved.helices, &controls, &options(args))?;
    say_sculpted(&sculpted, &mut report);
    target::write_edited(&args.output, curved, &args.road, everywhere, &progress, &mut report)?;
    Ok(report)
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
