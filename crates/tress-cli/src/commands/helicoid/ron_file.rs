//! Helicoids in RON files.

use std::path::Path;

use tress::helicoid::HelicoidGroom;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::source;

pub(super) fn read(path: &Path, progress: &Progress) -> Result<HelicoidGroom, Failure> {
    progress.stage(format!("reading {}", path.display()));
    source::ron(path)
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
