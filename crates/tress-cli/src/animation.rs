//! Animated files: one command over all frames that an Alembic or USD file holds.
//!
//! The frames are laid out as files of a [sequence](crate::sequence), which is worked on as any
//! other, and what comes out is gathered into one file again.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use tress::io::{Animation, Format, Frames, Model, WriteOptions, read, write, write_animation};

use crate::args::Cli;
use crate::failure::Failure;
use crate::report::{Report, count};
use crate::sequence::Sequence;

/// Runs a command on every frame of the animated files among its arguments.
pub(crate) fn run(mut arguments: Vec<OsString>, asked: &Cli) -> Result<Report, Failure> {
    let folder = tempfile::tempdir()?;
    let output = asked.command.output().filter(|output| holds_frames(output));
    let gathered = output
        .and_then(|output| arguments.iter().rposition(|argument| Path::new(argument) == output));
    let mut frames = None;
    for (i, argument) in arguments.iter_mut().enumerate().skip(1) {
        if Some(i) == gathered {
            *argument = folder.path().join("out.%04d.abc").into();
        } else if let Some(animation) = animated(Path::new(argument))? {
            *argument = lay_out(&animation, folder.path(), i)?.into();
            frames.get_or_insert(animation.frames());
        }
    }
    let Some(frames) = frames else {
        return Err(Failure::Usage("--animated: no file given holds more than one frame".into()));
    };
    let sequence = Sequence::of(arguments)
        .ok_or_else(|| Failure::Failed("the frames could not be laid out".into()))?;
    let mut report = sequence.run(asked)?;
    if let Some(output) = output.filter(|_| gathered.is_some()) {
        let gathered = gather(folder.path(), output, frames)?;
        report.set("output", output);
        report.say("gathered", format!("{} frames in {}", count(gathered), output.display()));
    }
    Ok(report)
}

/// The animation that a file holds, if it is one.
fn animated(path: &Path) -> Result<Option<Animation>, Failure> {
    if !holds_frames(path) || !path.is_file() {
        return Ok(None);
    }
    let animation = Animation::open(path)?;
    Ok((1 < animation.len()).then_some(animation))
}

/// Whether files with this extension may hold more than one frame.
fn holds_frames(path: &Path) -> bool {
    let format = Format::from_path(path);
    matches!(format, Ok(Format::Abc | Format::Usda | Format::Usdc | Format::Usd))
}

/// Writes each frame to a file of its own, by the frame's number; returns the pattern of their
/// names.
fn lay_out(animation: &Animation, folder: &Path, argument: usize) -> Result<PathBuf, Failure> {
    let first = first_number(animation.frames());
    (0..animation.len()).into_par_iter().try_for_each(|i| -> Result<(), Failure> {
        let name = format!("in{argument}.{:04}.abc", first + i as u64);
        write(folder.join(name), &animation.read(i)?, &WriteOptions::default())?;
        Ok(())
    })?;
    Ok(folder.join(format!("in{argument}.%04d.abc")))
}

/// Frames are numbered by whole numbers in names of files.
#[expect(clippy::cast_possible_truncation, reason = "numbers of frames")]
#[expect(clippy::cast_sign_loss, reason = "not below 0")]
fn first_number(frames: Frames) -> u64 {
    frames.start.round().clamp(0.0, 1e6) as u64
}

/// Writes the frames that came out to one file.
fn gather(folder: &Path, output: &Path, frames: Frames) -> Result<usize, Failure> {
    let number = |path: &Path| -> Option<u32> {
        path.file_name()?.to_str()?.strip_prefix("out.")?.strip_suffix(".abc")?.parse().ok()
    };
    let mut files: Vec<(u32, PathBuf)> = std::fs::read_dir(folder)?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter_map(|path| Some((number(&path)?, path)))
        .collect();
    files.sort();
    let start = files.first().map_or(frames.start, |(number, _)| f64::from(*number));
    let grooms = files.iter().map(|(_, file)| match read(file)? {
        Model::Polylines(groom) => Ok(groom),
        Model::Helices(_) => Err(Failure::Failed("a frame holds super-helices".into())),
    });
    write_animation(output, Frames { start, ..frames }, &WriteOptions::default(), grooms)?;
    Ok(files.len())
}
