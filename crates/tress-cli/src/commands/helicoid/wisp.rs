//! `tress helicoid wisp`.

use std::path::PathBuf;

use clap::Args;
use tress::helicoid::{Tracing, Waviness, WispOptions, wisps};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FormatArgs;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::{source, target};

use super::ron_file;

/// Spread every hair to a wisp of the hairs that its field knows beside it
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress helicoid wisp guides.ron wisps.hair --hairs 50 --radius 0.2
  tress helicoid wisp guides.ron pointed.obj --profile 1,1.5,0
  tress helicoid wisp guides.ron wavy.obj --wave 0.05 --wave-frequency 12 --frizz 0.02")]
pub(crate) struct WispArgs {
    /// The .ron file of helicoids
    input: PathBuf,
    /// The file to write
    pub(super) output: PathBuf,
    /// Hairs of a wisp, the guide first
    #[arg(long, value_name = "N", default_value_t = 256)]
    hairs: usize,
    /// Radius of a wisp at its root
    #[arg(long, value_name = "R", default_value_t = 0.05, allow_negative_numbers = true)]
    radius: f64,
    /// How far hairs turn about their roots, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    fanning: f64,
    /// How far segments turn, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true)]
    frizz: f64,
    /// Factors of the distance from the guide, from root to tip
    #[arg(long, value_name = "F,F,...", value_delimiter = ',')]
    profile: Vec<f64>,
    /// Radius of waves about every hair
    #[arg(long, value_name = "A", default_value_t = 0.0, allow_negative_numbers = true)]
    wave: f64,
    /// Radians of the waves in a unit of length
    #[arg(long, value_name = "B", default_value_t = 0.0, allow_negative_numbers = true)]
    wave_frequency: f64,
    /// Points a hair
    #[arg(long, value_name = "N", default_value_t = 40)]
    points: usize,
    /// Choices of formats
    #[command(flatten)]
    pub(super) format: FormatArgs,
}

pub(super) fn run(args: &WispArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_polylines(&[&args.input], &args.output, everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let hairs = ron_file::read(&args.input, &progress)?;
    progress.stage("tracing");
    let options = WispOptions {
        hairs: args.hairs,
        radius: args.radius,
        fanning: args.fanning.to_radians(),
        frizz: args.frizz.to_radians(),
        profile: args.profile.clone(),
        waviness: Waviness { amplitude: args.wave, frequency: args.wave_frequency, fade_in: 0.0 },
        points: args.points,
    };
    let groom = wisps(&hairs, &options, Tracing::default(), everywhere.seed)?;
    report.set("wisps", hairs.len() - hairs.kept().len());
    report.say("spread", format!("{} wisps", count(hairs.len() - hairs.kept().len())));
    let groom = source::share(groom, everywhere);
    target::write(&args.output, &groom, &args.format, &progress, &mut report)?;
    Ok(report)
}
