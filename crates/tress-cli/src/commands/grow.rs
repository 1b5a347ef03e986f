//! `tress grow`: from guides to a head of coils.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use tress::geometry::Strands;
use tress::geometry::glam::DVec3;
use tress::grow::{
    Assignment, Coils, GrowOptions, GrowReport, Plan, SkipUnit, assign, preset, preset_names,
    read_groups,
};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::{source, target};

use super::scatter::scattered;
use super::spectra;

/// Grow hairs on roots, coiled as their guides are
///
/// A hair leaves the scalp loosely and falls into its guide's coil (phase locking); it may leave
/// turns out (period skipping). On a sequence of guides (names as in guides.%04d.obj) every frame
/// grows the same hairs. See docs/grow.md.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress grow guides.obj hairs.hair --roots roots.obj --preset long-coils
  tress grow guides.obj hairs.usda --scalp head.ply --count 100000 --skip 0.5 --skip-each turns
  tress grow guides.%04d.obj hairs.%04d.hair --roots roots.obj --groups groups.csv
  tress grow guides.obj hairs.obj --roots roots.obj --spectra amplitudes.npz phases.npz")]
pub(crate) struct GrowArgs {
    /// The guides
    pub(crate) guides: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// Where hairs grow: the roots of this groom, or the vertices of an .obj without strands
    #[arg(long, value_name = "FILE", conflicts_with = "scalp")]
    pub(crate) roots: Option<PathBuf>,
    /// Or a mesh on which roots are scattered, .obj or .ply
    #[arg(long, value_name = "MESH", requires = "count")]
    pub(crate) scalp: Option<PathBuf>,
    /// How many roots are scattered
    #[arg(long, value_name = "N", requires = "scalp")]
    pub(crate) count: Option<usize>,
    /// Which roots follow which guide: a line for each guide, indices of roots between commas
    #[arg(long, value_name = "CSV", conflicts_with = "assign")]
    pub(crate) groups: Option<PathBuf>,
    /// The library of coils: one .tress-spectra file, or amplitudes and phases as .npz [default:
    /// the one that ships with tress]
    #[arg(long, value_name = "FILE", num_args = 1..=2)]
    pub(crate) spectra: Vec<PathBuf>,
    /// Options by name
    #[arg(long, value_name = "NAME", value_parser = preset_names().collect::<Vec<_>>())]
    pub(crate) preset: Option<String>,
    /// Options from a RON file
    #[arg(long, value_name = "RON", conflicts_with = "preset")]
    pub(crate) options: Option<PathBuf>,
    /// One option by itself
    #[command(flatten)]
    pub(crate) over: Over,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// Options that are said on the command line; they go before presets and files.
#[derive(Args, Debug)]
#[command(next_help_heading = "Growing")]
pub(crate) struct Over {
    /// How roots find guides: `nearest`, `noisy:N` or `distance:N` of the N nearest
    #[arg(long, value_name = "RULE", value_parser = parse_assignment)]
    pub(crate) assign: Option<Assignment>,
    /// Share of the guide that hairs follow loosely, from a range as in 0.1-0.4
    #[arg(long, value_name = "A-B", value_parser = parse_range)]
    pub(crate) loose: Option<(f64, f64)>,
    /// Greatest share of its length that a hair may lack
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    pub(crate) shorter: Option<f64>,
    /// Chance to be left out, of every point or turn beyond the loose part
    #[arg(long, value_name = "RHO", allow_negative_numbers = true)]
    pub(crate) skip: Option<f64>,
    /// What may be left out
    #[arg(long, value_name = "UNIT")]
    pub(crate) skip_each: Option<SkipEach>,
    /// Turns at which guides begin, and have ended, to go over from single hairs to wisps
    #[arg(long, value_name = "A-B", value_parser = parse_range)]
    pub(crate) fade: Option<(f64, f64)>,
}

/// What period skipping leaves out.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SkipEach {
    /// Points, as published
    Points,
    /// Whole turns
    Turns,
}

fn parse_assignment(text: &str) -> Result<Assignment, String> {
    let among = |n: &str| n.parse().ok().filter(|n| 0 < *n);
    let rule = match text.split_once(':') {
        None if text == "nearest" => Some(Assignment::Nearest),
        Some(("noisy", n)) => among(n).map(Assignment::Noisy),
        Some(("distance", n)) => among(n).map(Assignment::NoisyByDistance),
        _ => None,
    };
    rule.ok_or_else(|| "expected nearest, noisy:N or distance:N with N of 1 or more".into())
}

fn parse_range(text: &str) -> Result<(f64, f64), String> {
    let (a, b) = text.split_once('-').unwrap_or((text, text));
    match (a.trim().parse(), b.trim().parse()) {
        (Ok(a), Ok(b)) if a <= b => Ok((a, b)),
        _ => Err("expected a range as in 0.1-0.4".into()),
    }
}

pub(crate) fn run(args: &GrowArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let inputs: Vec<&Path> = std::iter::once(&args.guides)
        .chain([&args.roots, &args.scalp].into_iter().flatten())
        .map(PathBuf::as_path)
        .collect();
    target::check_polylines(&inputs, &args.output, everywhere)?;
    let options = options(args)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("guides", &args.guides);
    let guides = source::polylines(&args.guides, &progress)?;
    let roots = roots(args, args.roots.as_deref(), everywhere, &progress)?;
    // On a sequence, hairs are planned on its first frame.
    let first_guides = match everywhere.frame.first(&args.guides) {
        Some(first) => Some(source::polylines(first, &progress)?),
        None => None,
    };
    let first_roots = match args.roots.as_deref().and_then(|r| everywhere.frame.first(r)) {
        Some(first) => Some(self::roots(args, Some(first), everywhere, &progress)?),
        None => None,
    };
    let planned_on = first_guides.as_ref().unwrap_or(&guides).strands();
    let planned_at = first_roots.as_deref().unwrap_or(&roots);
    progress.stage("choosing");
    let assigned = assigned(args, planned_on, planned_at, &options, everywhere.seed)?;
    let coils = coils(args, &progress)?;
    let seed = everywhere.seed;
    let mut plan = Plan::new(planned_on, planned_at, &assigned, coils, &options, seed)?;
    if first_guides.is_some() {
        plan = plan.moved(guides.strands())?;
    }
    progress.stage("growing");
    let grown = plan.grow(guides.strands(), &roots)?.in_space(guides.unit, guides.up);
    say(&mut report, &plan.report(guides.strands(), &roots));
    let grown = source::share(grown, everywhere);
    target::write(&args.output, &grown, &args.format, &progress, &mut report)?;
    Ok(report)
}

/// The preset, file or default, and what the command line says otherwise.
fn options(args: &GrowArgs) -> Result<GrowOptions, Failure> {
    let mut options = match (&args.preset, &args.options) {
        (Some(name), _) => preset(name).unwrap_or_default(),
        (None, Some(path)) => source::ron(path)?,
        (None, None) => GrowOptions::default(),
    };
    let over = &args.over;
    options.assignment = over.assign.unwrap_or(options.assignment);
    options.loose = over.loose.unwrap_or(options.loose);
    options.shorter = over.shorter.unwrap_or(options.shorter);
    options.skip.probability = over.skip.unwrap_or(options.skip.probability);
    options.fade = over.fade.unwrap_or(options.fade);
    options.skip.each = match over.skip_each {
        Some(SkipEach::Points) => SkipUnit::Points,
        Some(SkipEach::Turns) => SkipUnit::Turns,
        None => options.skip.each,
    };
    options.validate()?;
    Ok(options)
}

/// The roots of a file, or scattered ones.
fn roots(
    args: &GrowArgs,
    file: Option<&Path>,
    everywhere: &Everywhere,
    progress: &Progress,
) -> Result<Vec<DVec3>, Failure> {
    match (file, &args.scalp, args.count) {
        (Some(file), _, _) => source::roots(file, progress),
        (None, Some(mesh), Some(count)) => scattered(mesh, count, everywhere.seed, progress),
        _ => {
            Err(Failure::Usage("say where hairs grow: --roots FILE, or --scalp and --count".into()))
        }
    }
}

fn assigned(
    args: &GrowArgs,
    guides: &Strands<DVec3>,
    roots: &[DVec3],
    options: &GrowOptions,
    seed: u64,
) -> Result<Vec<u32>, Failure> {
    let Some(path) = &args.groups else {
        return Ok(assign(roots, &source::first_points(guides), options.assignment, seed)?);
    };
    read_groups(&source::text(path)?, guides.len(), roots.len())
        .map_err(|error| Failure::Failed(format!("{}: {error}", path.display())))
}

fn coils(args: &GrowArgs, progress: &Progress) -> Result<Coils, Failure> {
    if args.spectra.is_empty() {
        return Ok(Coils::shipped()?);
    }
    Ok(Coils::new(&spectra::read(&args.spectra, 0.0, progress)?))
}

fn say(report: &mut Report, grown: &GrowReport) {
    report.set("hairs", grown.hairs);
    report.set("guides_followed", grown.guides);
    report.set("straight_guides", grown.straight_guides);
    report.set("bare_roots", grown.bare_roots);
    report.set("far_roots", grown.far_roots);
    report.say("grew", format!("{} hairs on {} guides", count(grown.hairs), count(grown.guides)));
    let notes = [
        (grown.straight_guides, "guides without a coil: their hairs duplicate them"),
        (grown.bare_roots, "roots on no strand, or nowhere: single points"),
        (grown.far_roots, "roots farther from their guide than it is long"),
    ];
    for (n, what) in notes.into_iter().filter(|(n, _)| 0 < *n) {
        report.say("noted", format!("{} {what}", count(n)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_and_ranges_are_read() {
        assert_eq!(parse_assignment("noisy:3"), Ok(Assignment::Noisy(3)));
        assert_eq!(parse_assignment("nearest"), Ok(Assignment::Nearest));
        assert!(parse_assignment("noisy:0").is_err() && parse_assignment("far").is_err());
        assert_eq!(parse_range("0.1-0.4"), Ok((0.1, 0.4)));
        assert_eq!(parse_range("0.3"), Ok((0.3, 0.3)));
        assert!(parse_range("0.4-0.1").is_err());
    }
}
