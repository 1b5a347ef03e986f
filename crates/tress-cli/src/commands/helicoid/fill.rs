//! `tress helicoid fill`.

use std::path::PathBuf;

use clap::Args;
use tress::geometry::glam::DVec3;
use tress::helicoid::{
    FillOptions, Filled, HelicoidGroom, Mixing, Roots, Tracing, fill, normals_at, sample,
};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::{source, target};

use super::super::scatter::scattered;
use super::ron_file;

/// Fill in hairs between guides
///
/// Curvatures are mixed, not points, by the inverse of the distance to a power. Guides should have
/// been fitted with the same number of pieces.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress helicoid fill guides.ron head.usda --roots head.hair --keep 0.1
  tress helicoid fill guides.ron head.hair --scalp scalp.obj --count 90000
  tress helicoid fill guides.ron head.hair --roots roots.obj --published")]
pub(crate) struct FillArgs {
    /// The .ron file of guides
    guides: PathBuf,
    /// The file to write: polylines, or a .ron file of helicoids
    pub(super) output: PathBuf,
    /// Where hairs begin: the roots of this groom
    #[arg(long, value_name = "FILE", conflicts_with = "scalp")]
    roots: Option<PathBuf>,
    /// Or a mesh on which roots are scattered, .obj or .ply; frames then follow its normals
    #[arg(long, value_name = "MESH", requires = "count")]
    scalp: Option<PathBuf>,
    /// How many roots are scattered
    #[arg(long, value_name = "N", requires = "scalp")]
    count: Option<usize>,
    /// Use this share of the guides only, evenly picked
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, allow_negative_numbers = true)]
    keep: f64,
    /// The power of the inverse distance: more makes clumps, 0 makes all alike
    #[arg(long, value_name = "P", default_value_t = 3.0, allow_negative_numbers = true)]
    exponent: f64,
    /// Nearest guides that count; 0 for all
    #[arg(long, value_name = "N", default_value_t = 8)]
    neighbors: usize,
    /// Hold every hair in so many stretches to the mean of the guides' points: no more than a coil
    /// has turns
    #[arg(long, value_name = "N", default_value_t = 0)]
    hold: usize,
    /// Mix (kT, kN, kB, alpha) as they are, pieces equally long, all guides counting
    #[arg(long, conflicts_with_all = ["neighbors", "hold"])]
    published: bool,
    /// Points a strand
    #[arg(long, value_name = "N", default_value_t = 40)]
    points: usize,
    /// Choices of formats
    #[command(flatten)]
    pub(super) format: FormatArgs,
}

impl FillArgs {
    fn options(&self) -> FillOptions {
        let exponent = self.exponent;
        if self.published {
            return FillOptions { mixing: Mixing::Parameters, exponent, neighbors: 0, hold: 0 };
        }
        let (neighbors, hold) = (self.neighbors, self.hold);
        FillOptions { mixing: Mixing::Bends, exponent, neighbors, hold }
    }
}

pub(super) fn run(args: &FillArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let inputs = [Some(&args.guides), args.roots.as_ref(), args.scalp.as_ref()];
    let inputs: Vec<_> = inputs.into_iter().flatten().map(PathBuf::as_path).collect();
    if target::has_extension(&args.output, "ron") {
        target::check_place(&inputs, &args.output, everywhere)?;
    } else {
        target::check_polylines(&inputs, &args.output, everywhere)?;
    }
    if !(0.0 < args.keep && args.keep <= 1.0) {
        let message = format!("--keep is {}, expected above 0, at most 1", args.keep);
        return Err(Failure::Usage(message));
    }
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("guides", &args.guides);
    let guides = kept(ron_file::read(&args.guides, &progress)?, args.keep);
    let filled = filled(args, &guides, everywhere, &progress)?;
    report.set("guides_used", guides.len());
    report.set("replaced", filled.replaced.len());
    let (hairs, used) = (count(filled.hairs.len()), count(guides.len()));
    report.say("filled", format!("{hairs} hairs from {used} guides"));
    if !filled.replaced.is_empty() {
        let line = format!("{} hairs like their nearest guide", count(filled.replaced.len()));
        report.say("replaced", line + ": what was mixed was singular on their path");
    }
    if target::has_extension(&args.output, "ron") {
        ron_file::write(&args.output, &filled.hairs, everywhere, &progress, &mut report)?;
        return Ok(report);
    }
    progress.stage("tracing");
    let groom = sample(&filled.hairs, args.points, Tracing::default())?;
    let groom = source::share(groom, everywhere);
    target::write(&args.output, &groom, &args.format, &progress, &mut report)?;
    Ok(report)
}

/// A share of the guides, evenly picked; at least one.
fn kept(guides: HelicoidGroom, share: f64) -> HelicoidGroom {
    if share >= 1.0 {
        return guides;
    }
    let whole = |i: usize| (i as f64 * share).floor();
    let picked: Vec<usize> =
        (0..guides.len()).filter(|&i| i == 0 || whole(i) > whole(i - 1)).collect();
    guides.select(&picked)
}

fn filled(
    args: &FillArgs,
    guides: &HelicoidGroom,
    everywhere: &Everywhere,
    progress: &Progress,
) -> Result<Filled, Failure> {
    let options = args.options();
    match (&args.roots, &args.scalp, args.count) {
        (Some(file), _, _) => {
            let roots = source::roots(file, progress)?;
            progress.stage("filling");
            Ok(fill(guides, Roots::Points(&roots), &options)?)
        }
        (None, Some(path), Some(count)) => {
            let positions = scattered(path, count, everywhere.seed, progress)?;
            let mesh = tress::io::mesh::read(path)?.mesh;
            progress.stage("filling");
            let normals = normals_at(&mesh, &positions);
            let at: Vec<DVec3> = guides.roots().iter().map(|root| root.position).collect();
            let at_guides = normals_at(&mesh, &at);
            let roots =
                Roots::Surface { positions: &positions, normals: &normals, at_guides: &at_guides };
            Ok(fill(guides, roots, &options)?)
        }
        _ => {
            let message = "say where hairs begin: --roots FILE, or --scalp and --count";
            Err(Failure::Usage(message.into()))
        }
    }
}
