//! Animated files: one command over all frames that an Alembic or USD file holds.
//!
//! The frames are laid out as files of a [sequence](crate::sequence), which is worked on as any
//! other, and what comes out is gathered into one file again. The files in between are `.npz`,
//! which holds a groom as it is.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use tress::io::{Animation, Format, Frames, Model, WriteOptions, read, write, write_animation};

use crate::args::Cli;
use crate::failure::Failure;
use crate::options::TargetArg;
use crate::report::{Report, count};
use crate::sequence::{Sequence, check_outputs};
use crate::target;

/// Runs a command on every frame of the animated files among its arguments.
pub(crate) fn run(mut arguments: Vec<OsString>, asked: &Cli) -> Result<Report, Failure> {
    check(&arguments, asked)?;
    let folder = tempfile::tempdir()?;
    let outputs = asked.command.outputs();
    let output = outputs.first().copied().filter(|output| takes_frames(output));
    let gathered = output
        .and_then(|output| arguments.iter().rposition(|argument| Path::new(argument) == output));
    let mut span = None;
    for (i, argument) in arguments.iter_mut().enumerate().skip(1) {
        if Some(i) == gathered {
            *argument = folder.path().join(format!("{OUT}%04d{END}")).into();
        } else if let Some(animation) = animated(Path::new(argument))? {
            let span = *span.get_or_insert(Span::of(&animation));
            *argument = span.lay_out(&animation, folder.path(), i)?.into();
        }
    }
    let Some(span) = span else {
        return Err(Failure::Usage("--animated: no file given holds more than one frame".into()));
    };
    let sequence = Sequence::of(arguments)
        .ok_or_else(|| Failure::Failed("the frames could not be laid out".into()))?;
    let mut report = sequence.run(asked)?;
    if let Some(output) = output.filter(|_| gathered.is_some()) {
        let options = asked.command.format().map(target::options).unwrap_or_default();
        let gathered = span.gather(folder.path(), output, &options)?;
        report.set("output", output);
        report.say("gathered", format!("{} frames in {}", count(gathered), output.display()));
    }
    Ok(report)
}

/// What the names of frames that come out begin with.
const OUT: &str = "out.";
/// What the names of all frames end with.
const END: &str = ".npz";

/// Says no before any work is done, to what would be said no to once all frames are there.
fn check(arguments: &[OsString], asked: &Cli) -> Result<(), Failure> {
    let sequence = Sequence::of(arguments.to_vec());
    let is_one_a_frame = |file: &Path| sequence.as_ref().is_some_and(|it| it.names(file));
    let outputs = asked.command.outputs();
    let Some(output) = outputs.first().copied().filter(|output| !is_one_a_frame(output)) else {
        return check_outputs(&asked.command, is_one_a_frame);
    };
    let file = output.display();
    if Format::from_path(output) == Ok(Format::Usda) {
        let message =
            format!("{file}: a .usda file holds one groom; a .usdc file holds all frames");
        return Err(Failure::Usage(message));
    }
    let target = asked.command.format().and_then(|format| format.target);
    if takes_frames(output) && target == Some(TargetArg::Unreal) {
        let message = format!("{file}: --target unreal writes one groom; name a file a frame");
        return Err(Failure::Usage(message));
    }
    check_outputs(&asked.command, |other| {
        is_one_a_frame(other) || other == output && takes_frames(output)
    })
}

/// The animation that a file holds, if it is one.
fn animated(path: &Path) -> Result<Option<Animation>, Failure> {
    let format = Format::from_path(path);
    let may_be = matches!(format, Ok(Format::Abc | Format::Usda | Format::Usdc | Format::Usd));
    if !may_be || !path.is_file() {
        return Ok(None);
    }
    let animation = Animation::open(path)?;
    Ok((1 < animation.len()).then_some(animation))
}

/// Whether files of this name are written with more than one frame.
fn takes_frames(path: &Path) -> bool {
    let format = Format::from_path(path);
    matches!(format, Ok(Format::Abc | Format::Usdc | Format::Usd))
}

/// The frames that are worked on: those of the first animated file.
#[derive(Clone, Copy)]
struct Span {
    frames: Frames,
    count: usize,
}

impl Span {
    fn of(animation: &Animation) -> Self {
        Self { frames: animation.frames(), count: animation.len() }
    }

    /// Writes each frame to a file of its own, by the frame's number; returns the pattern of their
    /// names. An animation that ends before stays as it is at its end.
    fn lay_out(
        &self,
        animation: &Animation,
        folder: &Path,
        argument: usize,
    ) -> Result<PathBuf, Failure> {
        let first = self.first_number();
        (0..self.count).into_par_iter().try_for_each(|i| -> Result<(), Failure> {
            let name = format!("in{argument}.{:04}{END}", first + i as u64);
            write(folder.join(name), &animation.read(i)?, &WriteOptions::default())?;
            Ok(())
        })?;
        Ok(folder.join(format!("in{argument}.%04d{END}")))
    }

    /// Frames are numbered by whole numbers in names of files.
    #[expect(clippy::cast_possible_truncation, reason = "numbers of frames")]
    #[expect(clippy::cast_sign_loss, reason = "not below 0")]
    fn first_number(&self) -> u64 {
        self.frames.start.round().clamp(0.0, 1e6) as u64
    }

    /// Writes the frames that came out to one file; returns how many there are.
    fn gather(
        &self,
        folder: &Path,
        output: &Path,
        options: &WriteOptions,
    ) -> Result<usize, Failure> {
        let number = |path: &Path| -> Option<u64> {
            path.file_name()?.to_str()?.strip_prefix(OUT)?.strip_suffix(END)?.parse().ok()
        };
        let mut files: Vec<(u64, PathBuf)> = std::fs::read_dir(folder)?
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter_map(|path| Some((number(&path)?, path)))
            .collect();
        files.sort();
        let left_out = files.first().map_or(0, |(number, _)| number - self.first_number());
        let frames = Frames { start: self.frames.start + left_out as f64, ..self.frames };
        let grooms = files.iter().map(|(_, file)| match read(file)? {
            Model::Polylines(groom) => Ok(groom),
            Model::Helices(_) => Err(Failure::Failed("a frame holds super-helices".into())),
        });
        write_animation(output, frames, options, grooms)?;
        Ok(files.len())
    }
}
