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

use std::path::Path;

use clap::Subcommand;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::report::Report;

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
    /// The file that a command writes, if it is one.
    pub(crate) fn output(&self) -> Option<&Path> {
        match self {
            Self::Convert(args) => Some(&args.output),
            Self::Fit(args) => Some(&args.output),
            Self::Sample(args) => Some(&args.output),
            Self::Ruffle(args) => Some(&args.output),
            Self::Blend(args) => Some(&args.output),
            Self::Recoil(args) => Some(&args.output),
            Self::Armature(args) => Some(&args.output),
            Self::Sculpt(args) => Some(&args.output),
            Self::Grow(args) => Some(&args.output),
            Self::Render(args) => Some(&args.output),
            _ => None,
        }
    }
}

/// Runs a command.
pub(crate) fn run(command: &Command, everywhere: &Everywhere) -> Result<Report, Failure> {
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
