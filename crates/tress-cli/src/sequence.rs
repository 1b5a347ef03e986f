//! Sequences: one command over the frames of an animation.
//!
//! An argument with the frame's number left open, as in `frames/groom.%04d.abc`, names a file a
//! frame. The frames are those whose files are there; the command runs once for each, side by
//! side, with the frame's number put into every argument. Random choices depend on the seed and on
//! the strand, so that they are the same on every frame; what is chosen by where strands lie
//! (clusters) is chosen on the first frame, see [`Frame::first`].

use std::ffi::{OsStr, OsString};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Parser;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;
use serde_json::json;

use crate::args::Cli;
use crate::commands::{self, Command};
use crate::failure::Failure;
use crate::report::{Report, count};

/// A name with the frame's number left open: `%d`, or `%04d` for at least four digits.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Pattern {
    before: String,
    digits: usize,
    after: String,
}

impl Pattern {
    /// The pattern that an argument is, if it is one.
    fn of(argument: &OsStr) -> Option<Self> {
        let text = argument.to_str()?;
        let (before, rest) = text.split_once('%')?;
        let (digits, after) = rest.split_once('d')?;
        if after.starts_with(char::is_alphanumeric) {
            return None;
        }
        let digits = match digits {
            "" => 1,
            _ => digits.strip_prefix('0')?.parse().ok().filter(|n| (1..=9).contains(n))?,
        };
        Some(Self { before: before.into(), digits, after: after.into() })
    }

    fn name(&self, frame: u32) -> OsString {
        format!("{}{frame:0digits$}{}", self.before, self.after, digits = self.digits).into()
    }

    /// The numbers of the frames whose files are there, in order.
    fn frames(&self) -> Vec<u32> {
        let folder = match Path::new(&self.before).parent() {
            Some(folder) if !folder.as_os_str().is_empty() && !self.before.ends_with('/') => folder,
            _ if self.before.ends_with('/') => Path::new(&self.before),
            _ => Path::new("."),
        };
        let begin = match self.before.rsplit_once(std::path::is_separator) {
            Some((_, begin)) => begin,
            None => &self.before,
        };
        let number = |name: OsString| -> Option<u32> {
            let digits = name.to_str()?.strip_prefix(begin)?.strip_suffix(self.after.as_str())?;
            let frame = digits.parse().ok()?;
            // The name of another sequence may begin and end alike.
            (self.name(frame) == OsString::from(format!("{}{digits}{}", self.before, self.after)))
                .then_some(frame)
        };
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let mut frames: Vec<u32> = entries.filter_map(|entry| number(entry.file_name())).collect();
        frames.sort_unstable();
        frames
    }
}

/// Frames from one to another, as in `10-48`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Frames(RangeInclusive<u32>);

impl FromStr for Frames {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once('-').unwrap_or((text, text));
        match (ends.0.parse(), ends.1.parse()) {
            (Ok(first), Ok(last)) if first <= last => Ok(Self(first..=last)),
            _ => Err("expected frames from first to last, as in 10-48".into()),
        }
    }
}

/// The frame whose command line shows what is asked of every frame.
const SEEN: u32 = 0;

/// What a command knows of the sequence that it is a part of.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frame {
    /// Names on this frame, and on the first.
    names: Vec<(PathBuf, PathBuf)>,
}

impl Frame {
    /// What this file is on the first frame of the sequence, where that is another file.
    pub(crate) fn first(&self, file: &Path) -> Option<&Path> {
        let (_, first) = self.names.iter().find(|(name, _)| name == file)?;
        (first != file).then_some(first)
    }
}

/// A command line with frames left open.
pub(crate) struct Sequence {
    arguments: Vec<OsString>,
    patterns: Vec<(usize, Pattern)>,
}

impl Sequence {
    /// The sequence that a command line asks for, if it does.
    pub(crate) fn of(arguments: Vec<OsString>) -> Option<Self> {
        let named = arguments.iter().enumerate().skip(1);
        let patterns: Vec<_> =
            named.filter_map(|(i, argument)| Some((i, Pattern::of(argument)?))).collect();
        (!patterns.is_empty()).then_some(Self { arguments, patterns })
    }

    /// The command line of one frame, which is parsed as any other.
    fn command_line(&self, frame: u32) -> Vec<OsString> {
        let mut arguments = self.arguments.clone();
        for (i, pattern) in &self.patterns {
            arguments[*i] = pattern.name(frame);
        }
        arguments
    }

    /// A command line by which to see what is asked of every frame.
    pub(crate) fn parse(&self) -> Cli {
        Cli::parse_from(self.command_line(SEEN))
    }

    /// Runs the command on every frame.
    pub(crate) fn run(&self, asked: &Cli) -> Result<Report, Failure> {
        let frames = self.frames(asked)?;
        // Not what was `asked`, which may name one file that frames are gathered in later.
        check_outputs(&self.parse().command, |output| self.names(output))?;
        let first = frames[0];
        let bar = progress(frames.len(), asked);
        let done: Vec<Result<Report, Failure>> = frames
            .par_iter()
            .map(|&frame| {
                let mut cli = Cli::parse_from(self.command_line(frame));
                cli.everywhere.quiet = true;
                let names = self.patterns.iter();
                let names = names.map(|(_, p)| (p.name(frame).into(), p.name(first).into()));
                cli.everywhere.frame = Frame { names: names.collect() };
                let report = commands::run(&cli.command, &cli.everywhere);
                bar.inc(1);
                report
            })
            .collect();
        bar.finish_and_clear();
        summary(&frames, done)
    }

    /// Whether a file of the command line by which it is [seen](Self::parse) is one a frame.
    pub(crate) fn names(&self, file: &Path) -> bool {
        self.patterns.iter().any(|(_, pattern)| Path::new(&pattern.name(SEEN)) == file)
    }

    fn frames(&self, asked: &Cli) -> Result<Vec<u32>, Failure> {
        let (_, inputs) = &self.patterns[0];
        let mut frames = inputs.frames();
        if let Some(Frames(range)) = &asked.everywhere.frames {
            frames.retain(|frame| range.contains(frame));
        }
        if frames.is_empty() {
            let name = format!("{}%0{}d{}", inputs.before, inputs.digits, inputs.after);
            return Err(Failure::Failed(format!("{name}: there is no file of this sequence")));
        }
        Ok(frames)
    }
}

/// An error unless every file that a command writes is one that `has_frames`: of frames that are
/// written to the same file only the last one would stay.
pub(crate) fn check_outputs(
    command: &Command,
    has_frames: impl Fn(&Path) -> bool,
) -> Result<(), Failure> {
    let Some(output) = command.outputs().into_iter().find(|output| !has_frames(output)) else {
        return Ok(());
    };
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let end = match output.extension() {
        Some(extension) => format!(".{}", extension.to_string_lossy()),
        None => String::new(),
    };
    Err(Failure::Usage(format!(
        "{}: every frame would write this; name one a frame, as in {stem}.%04d{end}",
        output.display()
    )))
}

fn progress(frames: usize, asked: &Cli) -> ProgressBar {
    let bar = ProgressBar::new(frames as u64);
    if asked.everywhere.quiet {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    let style = "{bar:24} {pos} of {len} frames [{elapsed}, {eta} to go]";
    bar.set_style(
        ProgressStyle::with_template(style).unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    bar
}

/// All frames' reports for programs, the first one's lines for people.
fn summary(frames: &[u32], done: Vec<Result<Report, Failure>>) -> Result<Report, Failure> {
    let mut reports = Vec::new();
    let mut lines = None;
    for (&frame, done) in frames.iter().zip(done) {
        let report = done.map_err(|failure| failure.on_frame(frame))?;
        reports.push(json!({ "frame": frame, "report": report.json() }));
        lines.get_or_insert(report);
    }
    let mut summary = lines.unwrap_or_default();
    summary.say("frames", format!("{}, of which {} is shown here", count(frames.len()), frames[0]));
    summary.replace_json("frames", reports);
    Ok(summary)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_names_frames() {
        let pattern = |text: &str| Pattern::of(OsStr::new(text));
        let four = pattern("frames/groom.%04d.abc").expect("a pattern");
        assert_eq!(four.name(7), "frames/groom.0007.abc");
        assert_eq!(four.name(12345), "frames/groom.12345.abc");
        assert_eq!(pattern("g%d.obj").expect("a pattern").name(7), "g7.obj");
        for plain in ["2%", "groom.obj", "%x.obj", "100%done", "%12d.obj"] {
            assert_eq!(pattern(plain), None, "{plain}");
        }
    }

    #[test]
    fn frames_are_the_files_that_are_there() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["g.0002.obj", "g.0010.obj", "g.3.obj", "g.x.obj", "g.10000.obj", "h.0004.obj"]
        {
            std::fs::write(folder.path().join(name), "").expect("an empty file");
        }
        let name = folder.path().join("g.%04d.obj");
        let pattern = Pattern::of(name.as_os_str()).expect("a pattern");
        assert_eq!(pattern.frames(), [2, 10, 10000]);
    }

    #[test]
    fn ranges_of_frames_have_two_ends() {
        assert_eq!("10-48".parse(), Ok(Frames(10..=48)));
        assert_eq!("7".parse(), Ok(Frames(7..=7)));
        for wrong in ["", "9-3", "a-b", "1-", "-3"] {
            assert!(wrong.parse::<Frames>().is_err(), "{wrong}");
        }
    }
}
