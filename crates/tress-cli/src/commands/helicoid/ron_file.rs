//! Helicoids in RON files.

use std::fs;
use std::path::Path;

use tress::helicoid::HelicoidGroom;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::target;

/// Whether a path names a file of helicoids.
pub(super) fn is_ron(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("ron"))
}

/// Says no before any work is done: to another extension, and to an input itself.
pub(super) fn check(
    inputs: &[&Path],
    output: &Path,
    everywhere: &Everywhere,
) -> Result<(), Failure> {
    if !is_ron(output) {
        let message = format!("{}: helicoids are written to a .ron file", output.display());
        return Err(Failure::Usage(message));
    }
    target::check_in_place(inputs, output, everywhere)
}

pub(super) fn read(path: &Path, progress: &Progress) -> Result<HelicoidGroom, Failure> {
    progress.stage(format!("reading {}", path.display()));
    let failed = |why: String| Failure::Failed(format!("{}: {why}", path.display()));
    let text = fs::read_to_string(path).map_err(|error| failed(error.to_string()))?;
    ron::from_str(&text).map_err(|error| failed(error.to_string()))
}

pub(super) fn write(
    path: &Path,
    hairs: &HelicoidGroom,
    everywhere: &Everywhere,
    progress: &Progress,
    report: &mut Report,
) -> Result<(), Failure> {
    progress.stage(format!("writing {}", path.display()));
    let share = everywhere.shard.map(|shard| shard.range(hairs.len()).collect::<Vec<_>>());
    let part = share.map(|strands| hairs.select(&strands));
    let hairs = part.as_ref().unwrap_or(hairs);
    let text = ron::to_string(hairs)?;
    tress::io::write_bytes(path, text.as_bytes())?;
    let pieces = hairs.pieces().points().len();
    report.set("output", path);
    report.set("strands", hairs.len());
    report.set("pieces", pieces);
    let (strands, pieces) = (count(hairs.len()), count(pieces));
    report.say("wrote", format!("{} ({strands} strands, {pieces} pieces)", path.display()));
    Ok(())
}
