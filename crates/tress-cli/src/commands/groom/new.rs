//! `tress groom new`: a procedural groom begun from guides and roots.

use std::path::PathBuf;

use clap::Args;
use tress::geometry::{Column, Groom, names};
use tress::procedural::{EvenStrands, ProceduralGroom, Roots, Surface};

use crate::args::Everywhere;
use crate::commands::scatter::scattered;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::{source, target};

/// Begin a procedural groom from guides
///
/// Strands are blended from the guides about them: by texture coordinates where guides and roots
/// have them, else over the scalp where it is given, else by distance in space. The groom has no
/// operators yet: add them in the .ron file.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress groom new guides.usdc groom.ron --scalp head.obj --count 30000
  tress groom new guides.abc groom.ron --roots hair.usdc --points 60")]
pub(crate) struct NewArgs {
    /// The guides
    pub(crate) guides: PathBuf,
    /// The procedural groom to write, .ron
    pub(crate) output: PathBuf,
    /// Strands grow where those of this file do
    #[arg(long, value_name = "FILE", required_unless_present = "scalp")]
    pub(crate) roots: Option<PathBuf>,
    /// A mesh on which distances are measured, .obj or .ply; roots are scattered on it where no
    /// file gives them
    #[arg(long, value_name = "MESH")]
    pub(crate) scalp: Option<PathBuf>,
    /// How many roots are scattered
    #[arg(long, value_name = "N", required_unless_present = "roots", conflicts_with = "roots")]
    pub(crate) count: Option<usize>,
    /// Points a strand; guides that have others are resampled [default: what all guides have]
    #[arg(long, value_name = "N")]
    pub(crate) points: Option<usize>,
    /// Guides a strand is blended from
    #[arg(long, value_name = "N", default_value_t = 4)]
    pub(crate) neighbors: usize,
}

pub(super) fn run(args: &NewArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let what = ("procedural grooms are", "ron");
    target::check_kind(&[&args.guides], &args.output, what, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.guides);
    let given = source::polylines(&args.guides, &progress)?;
    if given.strands().is_empty() {
        return Err(Failure::Failed(format!("{}: no strand is a guide", args.guides.display())));
    }
    let (guides, kept) = even(args, &given)?;
    let roots = roots(args, everywhere, &progress)?;
    if roots.len() < guides.len() {
        let (roots, guides) = (count(roots.len()), count(guides.len()));
        return Err(Failure::Failed(format!("{roots} roots are fewer than {guides} guides")));
    }
    let mut groom = ProceduralGroom::new(guides, roots)?;
    groom.seed = everywhere.seed;
    (groom.unit, groom.up) = (given.unit, given.up);
    groom.take_widths(&given);
    groom.guide_uv = uv(&given.select(&kept));
    instance(args, &mut groom)?;
    groom.check()?;
    groom.write(&args.output)?;
    report.set("guides", groom.guides.len());
    report.set("strands", groom.roots.len());
    report.set("left_out", given.strands().len() - kept.len());
    report.set("output", &args.output);
    report.say("guides", count(groom.guides.len()));
    report.say("strands", count(groom.roots.len()));
    if kept.len() < given.strands().len() {
        let left_out = count(given.strands().len() - kept.len());
        report.say("left out", format!("{left_out} guides with defects"));
    }
    report.say("wrote", args.output.display());
    Ok(report)
}

/// The guides with as many points each, and which of the file they are.
fn even(args: &NewArgs, given: &Groom) -> Result<(EvenStrands, Vec<usize>), Failure> {
    let file = args.guides.display();
    match args.points {
        Some(points) => Ok(EvenStrands::resampled(given, points)?),
        None => {
            let guides = EvenStrands::try_from(given.strands()).map_err(|error| {
                Failure::Failed(format!("{file}: {error} (--points N resamples them)"))
            })?;
            Ok((guides, (0..given.strands().len()).collect()))
        }
    }
}

fn roots(args: &NewArgs, everywhere: &Everywhere, progress: &Progress) -> Result<Roots, Failure> {
    match (&args.roots, &args.scalp, args.count) {
        (None, Some(mesh), Some(count)) => {
            let positions = scattered(mesh, count, everywhere.seed, progress)?;
            Ok(Roots { positions, uv: None })
        }
        (Some(file), ..) => {
            let groom = source::polylines(file, progress)?;
            Ok(Roots { positions: source::first_points(groom.strands()), uv: uv(&groom) })
        }
        _ => Err(Failure::Usage("say where hair grows: --roots, or --scalp and --count".into())),
    }
}

/// Texture coordinates of the roots, where a groom has them.
fn uv(groom: &Groom) -> Option<Vec<[f64; 2]>> {
    match groom.strand_attributes().get(names::ROOT_UV)? {
        Column::Float { components: 2, values } => {
            Some(values.chunks_exact(2).map(|uv| [uv[0], uv[1]]).collect())
        }
        _ => None,
    }
}

/// Says how strands are blended, and assigns them to their operator guides.
fn instance(args: &NewArgs, groom: &mut ProceduralGroom) -> Result<(), Failure> {
    let by_texture = groom.guide_uv.is_some() && groom.roots.uv.is_some();
    match &args.scalp {
        Some(mesh) if !by_texture => over(mesh, groom, args.neighbors, None),
        _ => {
            groom.instance_by_distance(args.neighbors);
            Ok(())
        }
    }
}

/// Blends strands from the guides nearest over a mesh.
pub(super) fn over(
    mesh: &std::path::Path,
    groom: &mut ProceduralGroom,
    neighbors: usize,
    sigma: Option<f64>,
) -> Result<(), Failure> {
    let failed = |error| Failure::Failed(format!("{}: {error}", mesh.display()));
    let scalp = Surface::new(&tress::io::mesh::read(mesh)?.mesh).map_err(failed)?;
    groom.instance_over(&scalp, neighbors, sigma.unwrap_or(groom.guide_spacing()))?;
    Ok(())
}
