//! `tress scatter`: roots on a scalp.

use std::path::{Path, PathBuf};

use clap::Args;
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, Strands};
use tress::grow::{Density, scatter};
use tress::io::mesh::Scalp;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::{source, target};

/// Scatter hair roots evenly over a scalp mesh
///
/// Roots keep their distance from each other (blue noise). Where the mesh is a .ply file whose
/// vertices or faces have a property `density`, they stand as densely as it says.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress scatter scalp.obj roots.obj --count 100000
  tress scatter painted.ply roots.hair --count 5000 --seed 3")]
pub(crate) struct ScatterArgs {
    /// The mesh, .obj or .ply
    pub(crate) mesh: PathBuf,
    /// The file of roots to write: strands of a single point
    pub(crate) output: PathBuf,
    /// How many roots
    #[arg(long, value_name = "N")]
    pub(crate) count: usize,
}

pub(crate) fn run(args: &ScatterArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_polylines(&[&args.mesh], &args.output, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.mesh);
    let roots = scattered(&args.mesh, args.count, everywhere.seed, &progress)?;
    report.say("scattered", format!("{} roots", count(roots.len())));
    let strands = Strands::from_counts(vec![1; roots.len()], roots)?;
    let groom = source::share(Groom::new(strands), everywhere);
    target::write(&args.output, &groom, &FormatArgs::default(), &progress, &mut report)?;
    Ok(report)
}

/// So many roots on a mesh, as dense as the file says.
pub(crate) fn scattered(
    mesh: &Path,
    count: usize,
    seed: u64,
    progress: &Progress,
) -> Result<Vec<DVec3>, Failure> {
    progress.stage(format!("reading {}", mesh.display()));
    let Scalp { mesh: scalp, vertex_density, face_density } = tress::io::mesh::read(mesh)?;
    let density = match (&face_density, &vertex_density) {
        (Some(faces), _) => Density::Faces(faces),
        (None, Some(vertices)) => Density::Vertices(vertices),
        (None, None) => Density::Even,
    };
    progress.stage("scattering roots");
    let failed = |error| Failure::Failed(format!("{}: {error}", mesh.display()));
    scatter(&scalp, count, density, seed).map_err(failed)
}
