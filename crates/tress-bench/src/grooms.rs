//! What is measured on: real grooms where they are at hand, else grooms made from a seed.
//!
//! Real grooms lie in `../shared/grooms` beside the project; they are not part of it.

use std::path::{Path, PathBuf};

use tress::geometry::Groom;
use tress::io::{Model, WriteOptions};
use tress_fixtures::{PatchOptions, coily_patch};

use crate::Outcome;
use crate::metric::say;

/// The folder of the project.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A real groom's path, if it is there.
pub(crate) fn real(name: &str) -> Option<PathBuf> {
    let path = root().join("../shared/grooms").join(name);
    path.is_file().then_some(path)
}

/// A groom to measure on: the real one, or wisps of about as many strands; says which.
pub(crate) fn groom(name: &str, strands: usize, points: usize) -> Outcome<Groom> {
    match real(name) {
        Some(path) => polylines(&path),
        None => {
            say(&format!("# {name} is not there: measured on {strands} generated strands"));
            Ok(generated(strands, points))
        }
    }
}

/// A file of a head, 10,000 strands of 160 points: the real one, or one made in `folder`; says
/// which.
pub(crate) fn head(folder: &Path) -> Outcome<PathBuf> {
    if let Some(path) = real("blender/bl_coily_10k.usdc") {
        return Ok(path);
    }
    say("# bl_coily_10k.usdc is not there: measured on 10,000 generated strands");
    let path = folder.join("head.hair");
    tress::io::write(&path, &generated(10_000, 160), &WriteOptions::default())?;
    Ok(path)
}

/// Reads polylines.
pub(crate) fn polylines(path: &Path) -> Outcome<Groom> {
    match tress::io::read(path)? {
        Model::Polylines(groom) => Ok(groom),
        Model::Helices(_) => Err(format!("{} holds super-helices", path.display()).into()),
    }
}

/// Coily strands of about so many points.
pub(crate) fn generated(strands: usize, points: usize) -> Groom {
    let defaults = PatchOptions::default();
    let turns = defaults.length / defaults.pitch;
    let strands_per_wisp = defaults.strands_per_wisp.min(strands.max(1));
    let options = PatchOptions {
        wisps: strands.div_ceil(strands_per_wisp),
        strands_per_wisp,
        points_per_turn: points as f64 / turns,
        ..defaults
    };
    let groom = coily_patch(&options, 1);
    groom.select(&(0..strands).collect::<Vec<_>>())
}
