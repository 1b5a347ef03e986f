//! `tress groom fit`: a procedural groom found for strands that have none.

use std::path::{Path, PathBuf};

use clap::Args;
use tress::geometry::Groom;
use tress::procedural::fit::{Fitter, Stage, StageOptions};
use tress::procedural::{
    Bend, Chain, Clump, Convention, Curl, Frizz, Operator, ProceduralGroom, Scale,
};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count, short};
use crate::{source, target};

/// Find a procedural groom for strands
///
/// Guides, operator parameters and random numbers are found stage by stage. A checkpoint folder
/// keeps what each stage found: the same command with --resume goes on where it was stopped.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress groom fit captured.data groom.ron --operators scale,clump,curl,frizz --guides 300
  tress groom fit strands.usdc groom.ron --operators bend,frizz --report report.html
  tress groom fit strands.usdc groom.ron --checkpoint work --resume")]
pub(crate) struct GroomFitArgs {
    /// The strands
    pub(crate) target: PathBuf,
    /// The procedural groom to write, .ron
    pub(crate) output: PathBuf,
    /// Operators of the chain, first to last
    #[arg(long, value_delimiter = ',', default_value = "scale,clump,curl,frizz")]
    #[arg(value_name = "NAMES", value_parser = parse_operator)]
    pub(crate) operators: Vec<Operator>,
    /// Guides [default: 500]
    #[arg(long, value_name = "N")]
    pub(crate) guides: Option<usize>,
    /// Operator guides, the number of curls or clumps [default: as many as guides]
    #[arg(long, value_name = "N")]
    pub(crate) operator_guides: Option<usize>,
    /// Points a strand [default: the most that the strands have, 16 to 160]
    #[arg(long, value_name = "N")]
    pub(crate) points: Option<usize>,
    /// Blend strands from guides by the distance of roots alone, as grooms made by hand are
    #[arg(long)]
    pub(crate) by_distance: bool,
    /// All other choices, a .ron file
    #[arg(long, value_name = "FILE")]
    pub(crate) options: Option<PathBuf>,
    /// Follow the formulas of the authors' published program where they differ from the paper
    #[arg(long)]
    pub(crate) published_program: bool,
    /// The head that hair grows on, .obj or .ply in the strands' unit: no strand is given to an
    /// operator guide across a parting that would draw it through the head
    #[arg(long, value_name = "FILE")]
    pub(crate) head: Option<PathBuf>,
    /// Keep what each stage finds in this folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// Go on from the checkpoint
    #[arg(long, requires = "checkpoint")]
    pub(crate) resume: bool,
    /// Write losses, parameters and pictures, .html
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
}

fn parse_operator(name: &str) -> Result<Operator, String> {
    match name.trim() {
        "scale" => Ok(Operator::Scale(Scale { random: 0.1 })),
        "clump" => Ok(Operator::Clump(Clump { profile: 1.0 })),
        "bend" => Ok(Operator::Bend(Bend { angle_degrees: 30.0, start: 0.3 })),
        // Lengths depend on the groom: they are looked for over all that can be.
        "curl" => Ok(Operator::Curl(Curl { start: 0.1, ..Curl::default() })),
        "frizz" => Ok(Operator::Frizz(Frizz::default())),
        other => Err(format!("{other:?} is none of scale, clump, bend, curl, frizz")),
    }
}

pub(super) fn run(args: &GroomFitArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let what = ("procedural grooms are", "ron");
    target::check_kind(&[&args.target], &args.output, what, everywhere)?;
    if let Some(report) = &args.report {
        target::check_kind(&[&args.target], report, ("reports are", "html"), everywhere)?;
    }
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.target);
    let target = source::polylines(&args.target, &progress)?;
    let options = options(args, everywhere)?;
    let convention =
        if args.published_program { Convention::PublishedProgram } else { Convention::Paper };
    let chain = Chain { convention, operators: args.operators.clone() };
    progress.stage("sorting strands out");
    let mut fitter = match &args.checkpoint {
        Some(folder) if args.resume => Fitter::resume(folder, &target, chain, options)?,
        _ => Fitter::new(&target, chain, options)?,
    };
    if let Some(head) = &args.head {
        fitter.set_head(tress::io::mesh::read(head)?.mesh)?;
    }
    let outcome = advance(&mut fitter, args.checkpoint.as_deref(), &progress);
    // Whatever a stage that failed had found is worth keeping.
    let Some(groom) = fitter.groom() else {
        outcome?;
        return Err(Failure::Failed("nothing was found".into()));
    };
    groom.write(&args.output)?;
    outcome?;
    describe(&mut report, &target, &fitter, groom)?;
    if let Some(path) = &args.report {
        progress.stage("drawing");
        let page = super::curves::page(&target, groom, fitter.history())?;
        tress::io::write_bytes(path, page.as_bytes())?;
        report.say("report", path.display());
    }
    report.set("output", &args.output);
    report.say("wrote", args.output.display());
    Ok(report)
}

fn options(args: &GroomFitArgs, everywhere: &Everywhere) -> Result<StageOptions, Failure> {
    let mut options = match &args.options {
        None => StageOptions::default(),
        Some(path) => source::ron(path)?,
    };
    options.guides = args.guides.unwrap_or(options.guides);
    options.operator_guides = args.operator_guides.or(options.operator_guides);
    options.points = args.points.or(options.points);
    options.own_weights &= !args.by_distance;
    options.seed = everywhere.seed;
    Ok(options)
}

/// Steps that a stage's bar shows.
const STEPS: usize = 1000;

/// Runs all stages that are left, saving after each.
fn advance(
    fitter: &mut Fitter,
    checkpoint: Option<&Path>,
    progress: &Progress,
) -> Result<(), Failure> {
    while fitter.stage() != Stage::Done {
        let mut shown = 0;
        let name = fitter.stage().describe();
        progress.stage_of(name, STEPS);
        let outcome = fitter.advance(&mut |step| {
            let done = (0..=STEPS).take_while(|&n| n as f64 <= step.done * STEPS as f64).count();
            progress.add(done.saturating_sub(1 + shown));
            shown = shown.max(done.saturating_sub(1));
            progress.say(format!("{name}, loss {}", short(step.loss)));
        });
        if let Some(folder) = checkpoint {
            fitter.save(folder)?;
        }
        outcome?;
    }
    Ok(())
}

fn describe(
    report: &mut Report,
    target: &Groom,
    fitter: &Fitter,
    groom: &ProceduralGroom,
) -> Result<(), Failure> {
    let flaws = fitter.flaws();
    let defects = target.strands().len() - fitter.kept().len();
    report.set("strands", groom.roots.len());
    report.set("guides", groom.guides.len());
    report.set("operator_guides", groom.operator_guides.len());
    report.set("left_out", defects);
    report.set("short", flaws.short.len());
    report.set("straight", flaws.straight.len());
    report.set("inner", flaws.inner.len());
    report.set("operators", &groom.chain.operators);
    report.set("history", fitter.history());
    report.say("strands", count(groom.roots.len()));
    report.say("guides", count(groom.guides.len()));
    if 0 < defects {
        report.say("left out", format!("{} strands with defects", count(defects)));
    }
    let [short_ones, straight, inner] =
        [&flaws.short, &flaws.straight, &flaws.inner].map(|strands| count(strands.len()));
    let line = format!("{short_ones} short, {straight} straight, {inner} inner strands");
    report.say("flawed", line);
    for operator in &groom.chain.operators {
        let values = operator.parameters().iter().zip(operator.values());
        let values: Vec<String> = values
            .map(|(parameter, value)| format!("{} {}", parameter.name, short(value)))
            .collect();
        report.say(operator.name(), values.join(", "));
    }
    Ok(())
}
