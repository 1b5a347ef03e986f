//! `tress switchback`: coils that change hands, made and put into strands.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, ValueEnum};
use serde::Serialize;
use tress::edit::Grouping;
use tress::geometry::{Element, Frame, HelixGroom, Strands};
use tress::switchback::{
    Coil, DoubleSwitchback, InsertOptions, InsertReport, Material, Placing, Profile, Ritz,
    RitzOptions, Switchback, greatest_distance, insert, strand,
};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{FormatArgs, RoadArgs, SamplingArgs, parse_grouping};
use crate::progress::Progress;
use crate::report::{Report, count, short};
use crate::source::Curved;
use crate::target;

/// Switchbacks: places where a coil changes hands
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress switchback make switchback.obj --frequency 0.3 --radius 0.5
  tress switchback insert wisp.usdc changed.usda --at 0.5
  tress switchback insert head.hair changed.hair --density 0.02 --groups clusters:200 --seed 7")]
pub(crate) struct SwitchbackArgs {
    #[command(subcommand)]
    command: SwitchbackCommand,
}

impl SwitchbackArgs {
    /// The file to write.
    pub(super) fn output(&self) -> &Path {
        match &self.command {
            SwitchbackCommand::Make(args) => &args.output,
            SwitchbackCommand::Insert(args) => &args.output,
        }
    }

    /// Choices of formats.
    pub(super) fn format(&self) -> &FormatArgs {
        match &self.command {
            SwitchbackCommand::Make(args) => &args.format,
            SwitchbackCommand::Insert(args) => &args.road.format,
        }
    }
}

#[derive(Debug, Subcommand)]
enum SwitchbackCommand {
    Make(MakeArgs),
    Insert(InsertArgs),
}

/// One strand with one switchback in its middle
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress switchback make switchback.obj --frequency 0.3 --radius 0.5
  tress switchback make left-first.tress --frequency -0.6 --turns 8
  tress switchback make s-shape.obj --frequency 0.6 --rest-twist 0.2 --method double
  tress switchback make published.obj --method ritz")]
struct MakeArgs {
    /// The file to write
    output: PathBuf,
    /// Coil frequency: over 0 (rings) to below 1 (pulled straight); negative is left-handed first
    #[arg(long, value_name = "V", default_value_t = 0.3, allow_negative_numbers = true)]
    frequency: f64,
    /// Coil radius, in the unit of the file
    #[arg(long, value_name = "R", default_value_t = 1.0, allow_negative_numbers = true)]
    radius: f64,
    /// Turns on either side
    #[arg(long, value_name = "N", default_value_t = 10.0, allow_negative_numbers = true)]
    turns: f64,
    /// Poisson's ratio of the hair, 0 to 0.5
    #[arg(long, value_name = "MU", default_value_t = 0.4, allow_negative_numbers = true)]
    poisson_ratio: f64,
    /// Twist at rest over curvature at rest; hair that rests twisted changes hands in pairs only
    #[arg(long, value_name = "T", default_value_t = 0.0, allow_negative_numbers = true)]
    rest_twist: f64,
    /// What is made, and how it is found
    #[arg(long, value_enum, default_value_t = Method::Exact)]
    method: Method,
    /// How many points come out
    #[command(flatten)]
    sampling: SamplingArgs,
    /// Choices of formats
    #[command(flatten)]
    format: FormatArgs,
}

impl MakeArgs {
    fn material(&self) -> Material {
        Material { poisson_ratio: self.poisson_ratio, rest_twist: self.rest_twist }
    }
}

/// How a switchback is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Method {
    /// The equilibrium, solved
    Exact,
    /// The equilibrium of two at once, an S that gives the first hand back
    Double,
    /// The published approximation of eleven parameters
    Ritz,
}

/// Switchbacks put into the strands of a groom
///
/// All strands of a wisp get theirs at the same arc lengths, so that the wisp stays one. Each
/// strand keeps its length, its root and the line it winds about, and everything before the
/// switchback; behind it, it winds the other way. A strand without room for one is left as it is
/// and counted.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress switchback insert wisp.usdc changed.usda --at 0.5
  tress switchback insert wisp.usdc changed.usda --at 0.5,0.85
  tress switchback insert head.hair changed.hair --density 0.02 --groups clusters:200 --seed 7")]
struct InsertArgs {
    /// The groom
    input: PathBuf,
    /// The file to write
    output: PathBuf,
    /// Places, as shares from 0 (root) to 1 (tip) of the median length of a wisp
    #[arg(long, value_name = "T,..", value_delimiter = ',', allow_negative_numbers = true)]
    #[arg(required_unless_present_any = ["at_length", "density"])]
    at: Vec<f64>,
    /// Places, as arc lengths from the root
    #[arg(long, value_name = "S,..", value_delimiter = ',', allow_negative_numbers = true)]
    #[arg(conflicts_with = "at")]
    at_length: Vec<f64>,
    /// Switchbacks in a unit of arc length, on average, at random places
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    #[arg(conflicts_with_all = ["at", "at_length"])]
    density: Option<f64>,
    /// What a wisp is: `whole`, the name of a strand attribute, or `clusters:K`
    #[arg(long, value_name = "G", default_value = "whole", value_parser = parse_grouping)]
    groups: Grouping,
    /// Poisson's ratio of the hair, 0 to 0.5
    #[arg(long, value_name = "MU", default_value_t = InsertOptions::default().poisson_ratio)]
    #[arg(allow_negative_numbers = true)]
    poisson_ratio: f64,
    /// Share of the coil's curvature that may be left at the ends of its room, over 0 to 0.5:
    /// smaller is smoother and takes more room
    #[arg(long, value_name = "X", default_value_t = InsertOptions::default().share)]
    #[arg(allow_negative_numbers = true)]
    share: f64,
    /// How polylines come and go
    #[command(flatten)]
    road: RoadArgs,
}

pub(crate) fn run(args: &SwitchbackArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    match &args.command {
        SwitchbackCommand::Make(args) => run_make(args, everywhere),
        SwitchbackCommand::Insert(args) => run_insert(args, everywhere),
    }
}

fn run_make(args: &MakeArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check(&[], &args.output, everywhere)?;
    let positive = |name: &str, x: f64| match x {
        x if 0.0 < x && x.is_finite() => Ok(()),
        x => Err(Failure::Usage(format!("{name} is {x}, expected a positive number"))),
    };
    positive("the radius", args.radius)?;
    positive("the number of turns", args.turns)?;
    if MOST_TURNS < args.turns {
        return Err(Failure::Usage(format!("more than {MOST_TURNS} turns on either side")));
    }
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    let (root, elements) = made(args, &mut report)?;
    let elements = Strands::from_counts([elements.len()], elements)?;
    let helices = HelixGroom::new(vec![root], elements)?;
    let curved = Curved { helices, counts: None, fit: None };
    target::write_curved(
        &args.output,
        &curved,
        &args.sampling,
        &args.format,
        &progress,
        &mut report,
    )?;
    Ok(report)
}

/// The strand, and what is to be said of it.
fn made(args: &MakeArgs, report: &mut Report) -> Result<(Frame, Vec<Element>), Failure> {
    let (v, material) = (args.frequency, args.material());
    match args.method {
        Method::Exact => shape(&Switchback::new(v, &material)?, args, report),
        Method::Double => shape(&DoubleSwitchback::new(v, &material)?, args, report),
        Method::Ritz => {
            let ritz = Ritz::new(v, &material, &RitzOptions::default())?;
            let exact = Switchback::new(v, &material)?;
            let off = greatest_distance(&ritz, &exact, exact.half_width(0.01));
            report.set("distance", off);
            let off = short(off);
            report.say("approximate", format!("off by {off} rest curvatures where it is worst"));
            shape(&ritz, args, report)
        }
    }
}

fn shape(
    profile: &impl Profile,
    args: &MakeArgs,
    report: &mut Report,
) -> Result<(Frame, Vec<Element>), Failure> {
    let coil = Coil::new(args.frequency, &args.material())?;
    // The made strand's coil has the radius asked for, the rod's is kappa1 / lambda^2.
    let unit = args.radius * coil.turning() * coil.turning() / coil.curvature.x;
    let room = 2.0 * profile.half_width(InsertOptions::default().share) * unit;
    report.set("room", room);
    report.set("pull", coil.pull());
    report.say("room", format!("{} long", short(room)));
    report.say("pull", format!("{} of stiffness times curvature squared", short(coil.pull())));
    Ok(strand(profile, args.radius, args.turns, ARCS_PER_TURN))
}

/// Arcs to a turn of a strand that is made.
const ARCS_PER_TURN: usize = 32;

/// No strand has as many turns.
const MOST_TURNS: f64 = 10_000.0;

fn run_insert(args: &InsertArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_edited(&args.input, &args.output, &args.road, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    let mut curved = Curved::read(&args.input, &args.road.fit, &progress, &mut report)?;
    progress.stage("putting switchbacks in");
    let groups = curved.groups(&args.groups, &args.input, &args.road.fit, everywhere, &progress)?;
    let placing = match args.density {
        Some(density) => Placing::Density(density),
        None if args.at.is_empty() => Placing::ArcLengths(args.at_length.clone()),
        None => Placing::Shares(args.at.clone()),
    };
    let options = InsertOptions {
        poisson_ratio: args.poisson_ratio,
        share: args.share,
        ..InsertOptions::default()
    };
    let (changed, done) = insert(&curved.helices, &groups, &placing, &options, everywhere.seed)?;
    curved.helices = changed;
    say_inserted(&done, curved.helices.len(), &mut report);
    target::write_edited(&args.output, curved, &args.road, everywhere, &progress, &mut report)?;
    Ok(report)
}

/// A switchback as programs see it.
#[derive(Serialize)]
struct Entry {
    strand: u32,
    #[serde(flatten)]
    placed: tress::switchback::Placed,
}

fn say_inserted(done: &InsertReport, strands: usize, report: &mut Report) {
    let entries = done.placed.iter().map(|&(strand, placed)| Entry { strand, placed });
    report.set("switchbacks", entries.collect::<Vec<_>>());
    report.set("no_room", done.no_room);
    report.set("no_coil", done.no_coil);
    let (placed, of) = (count(done.placed.len()), count(done.strands));
    report.say("switchbacks", format!("{placed} in {of} of {} strands", count(strands)));
    let widths = done.placed.iter().map(|(_, placed)| 2.0 * placed.half_width);
    let longest = widths.fold(0.0, f64::max);
    if 0.0 < longest {
        report.say("room", format!("{} at most", short(longest)));
    }
    if 0 < done.no_room {
        let needed = match done.most_needed {
            needed if 0.0 < needed => format!("; {} on either side is enough", short(needed)),
            _ => String::new(),
        };
        report.say("no room", format!("{} places{needed}", count(done.no_room)));
    }
    if 0 < done.no_coil {
        report.say("no coil", format!("{} places", count(done.no_coil)));
    }
}
