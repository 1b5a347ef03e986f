//! One file a command.

mod analyze;
mod armature;
mod blend;
mod convert;
mod demo;
mod diff;
mod fit;
mod groom;
mod grow;
mod helicoid;
mod info;
mod merge;
mod recoil;
mod render;
mod ruffle;
mod sample;
mod scatter;
mod sculpt;
mod spectra;
mod switchback;

use std::path::{Path, PathBuf};

use clap::Subcommand;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::report::Report;
use crate::target;

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Demo(demo::DemoArgs),
    Info(info::InfoArgs),
    Analyze(analyze::AnalyzeArgs),
    Diff(diff::DiffArgs),
    Convert(convert::ConvertArgs),
    Fit(fit::FitCommandArgs),
    Sample(sample::SampleCommandArgs),
    Ruffle(ruffle::RuffleArgs),
    Blend(blend::BlendArgs),
    Recoil(recoil::RecoilArgs),
    Armature(armature::ArmatureArgs),
    Sculpt(sculpt::SculptArgs),
    Grow(grow::GrowArgs),
    Groom(groom::GroomArgs),
    Spectra(spectra::SpectraArgs),
    Scatter(scatter::ScatterArgs),
    Switchback(switchback::SwitchbackArgs),
    Helicoid(helicoid::HelicoidArgs),
    Render(render::RenderArgs),
    Merge(merge::MergeArgs),
}

impl Command {
    /// The files that a command writes, the groom or picture that it is there for first.
    pub(crate) fn outputs(&self) -> Vec<&Path> {
        match self {
            Self::Demo(args) => vec![&args.dir],
            Self::Info(_) => Vec::new(),
            Self::Analyze(args) => {
                let tables = [&args.csv, &args.csv_along, &args.csv_plots];
                given(&[tables.as_slice(), &[&args.plot, &args.png, &args.html]].concat())
            }
            Self::Diff(args) => given(&[&args.png, &args.html]),
            Self::Convert(args) => vec![&args.output],
            Self::Fit(args) => vec![&args.output],
            Self::Sample(args) => vec![&args.output],
            Self::Ruffle(args) => vec![&args.output],
            Self::Blend(args) => vec![&args.output],
            Self::Recoil(args) => vec![&args.output],
            Self::Armature(args) => vec![&args.output],
            Self::Sculpt(args) => vec![&args.output],
            Self::Grow(args) => vec![&args.output],
            Self::Groom(args) => args.outputs(),
            Self::Spectra(args) => args.files.last().map(PathBuf::as_path).into_iter().collect(),
            Self::Scatter(args) => vec![&args.output],
            Self::Switchback(args) => vec![args.output()],
            Self::Helicoid(args) => vec![args.output()],
            Self::Render(args) => vec![&args.output],
            Self::Merge(args) => args.files.last().map(PathBuf::as_path).into_iter().collect(),
        }
    }

    /// Whether it can work on a share of the strands. What others find needs all of them.
    fn shares(&self) -> bool {
        match self {
            Self::Demo(_) | Self::Armature(_) | Self::Spectra(_) | Self::Merge(_) => false,
            Self::Groom(args) => args.shares(),
            _ => true,
        }
    }

    /// What was chosen of what formats leave open, by commands that write grooms.
    pub(crate) fn format(&self) -> Option<&FormatArgs> {
        match self {
            Self::Convert(args) => Some(&args.format),
            Self::Sample(args) => Some(&args.format),
            Self::Ruffle(args) => Some(&args.road.format),
            Self::Blend(args) => Some(&args.road.format),
            Self::Recoil(args) => Some(&args.road.format),
            Self::Sculpt(args) => Some(&args.road.format),
            Self::Grow(args) => Some(&args.format),
            Self::Groom(args) => args.format(),
            Self::Switchback(args) => Some(args.format()),
            Self::Helicoid(args) => args.format(),
            _ => None,
        }
    }
}

/// The files that were named.
fn given<'a>(files: &[&'a Option<PathBuf>]) -> Vec<&'a Path> {
    files.iter().filter_map(|file| file.as_deref()).collect()
}

/// Runs a command.
pub(crate) fn run(command: &Command, everywhere: &Everywhere) -> Result<Report, Failure> {
    if let (Some(output), Some(format)) = (command.outputs().first(), command.format()) {
        target::check_program(output, format)?;
    }
    if everywhere.shard.is_some() && !command.shares() {
        let message = "--shard: this command needs all strands; run it without";
        return Err(Failure::Usage(message.into()));
    }
    match command {
        Command::Demo(args) => demo::run(args, everywhere),
        Command::Recoil(args) => recoil::run(args, everywhere),
        Command::Armature(args) => armature::run(args, everywhere),
        Command::Sculpt(args) => sculpt::run(args, everywhere),
        Command::Grow(args) => grow::run(args, everywhere),
        Command::Groom(args) => groom::run(args, everywhere),
        Command::Spectra(args) => spectra::run(args, everywhere),
        Command::Scatter(args) => scatter::run(args, everywhere),
        Command::Switchback(args) => switchback::run(args, everywhere),
        Command::Helicoid(args) => helicoid::run(args, everywhere),
        Command::Render(args) => render::run(args, everywhere),
        Command::Info(args) => info::run(args, everywhere),
        Command::Analyze(args) => analyze::run(args, everywhere),
        Command::Diff(args) => diff::run(args, everywhere),
        Command::Convert(args) => convert::run(args, everywhere),
        Command::Fit(args) => fit::run(args, everywhere),
        Command::Sample(args) => sample::run(args, everywhere),
        Command::Ruffle(args) => ruffle::run(args, everywhere),
        Command::Blend(args) => blend::run(args, everywhere),
        Command::Merge(args) => merge::run(args, everywhere),
    }
}
