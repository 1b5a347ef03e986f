//! `tress armature`: the rest pose of a groom.

use std::path::PathBuf;

use clap::Args;
use ron::ser::PrettyConfig;
use tress::optimize::{ArmatureOptions, Clustering, Pose, armature};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::FitArgs;
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::source::{self, Curved};
use crate::target;

/// Write the rest pose of a groom, to be changed and given to `tress sculpt`
///
/// Strands are clustered by root and tip; each cluster gets a chain of joints. Change `translate`,
/// `rotate` (degrees) and `scale` of a joint in the file.
#[derive(Args, Debug)]
#[command(after_help = "Example: tress armature groom.obj pose.ron --clusters 12 --joints 3")]
pub(crate) struct ArmatureArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The .ron file to write
    pub(crate) output: PathBuf,
    /// Clusters of strands
    #[arg(long, value_name = "K", default_value_t = 8)]
    pub(crate) clusters: usize,
    /// Joints of a cluster, evenly along its strands, the last at the tips
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = parse_joints)]
    pub(crate) joints: u32,
    /// How far strands are also moved by the clusters beside their own, 0 to 1
    #[arg(long, value_name = "B", default_value_t = 0.0)]
    pub(crate) blend: f64,
    /// How polylines are fitted
    #[command(flatten)]
    pub(crate) fit: FitArgs,
}

pub(crate) fn run(args: &ArmatureArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_kind(&[&args.input], &args.output, ("poses are", "ron"), everywhere)?;
    let progress = Progress::new(everywhere);
    let model = source::read(&args.input, &progress)?;
    let curved = Curved::new(model, &args.fit.options(), &progress)?;
    progress.stage("clustering");
    let n = f64::from(args.joints);
    let clusters = Clustering { count: args.clusters, seed: everywhere.seed, blend: args.blend };
    let lengths = (1..=args.joints).map(|k| f64::from(k) / n).collect();
    let pose = armature(&curved.helices, &ArmatureOptions { clusters, lengths })?;
    progress.stage(format!("writing {}", args.output.display()));
    let text = HEADER.to_owned() + &ron::ser::to_string_pretty(&pose, PrettyConfig::default())?;
    tress::io::write_bytes(&args.output, (text + "\n").as_bytes())?;
    Ok(said(args, &pose))
}

/// What a pose file says to whoever opens it.
const HEADER: &str = "\
// The rest pose of a groom. Move a joint by its `translate` (in the groom's unit), turn it by
// `rotate` (degrees about x, y, z), stretch it by `scale`; then give this file to `tress sculpt`
// as its `--pose`.
// `at` is the place along the strands, 0 at the root and 1 at the tip.
";

fn said(args: &ArmatureArgs, pose: &Pose) -> Report {
    let mut report = Report::default();
    let joints = pose.groups.iter().map(|group| group.joints.len()).sum();
    report.set("input", &args.input);
    report.set("output", &args.output);
    report.set("clusters", pose.groups.len());
    report.set("joints", joints);
    let (file, clusters) = (args.output.display(), count(pose.groups.len()));
    report.say("wrote", format!("{file} ({clusters} clusters, {} joints)", count(joints)));
    report
}

fn parse_joints(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(joints) if (1..=64).contains(&joints) => Ok(joints),
        _ => Err("expected a whole number from 1 to 64".into()),
    }
}
