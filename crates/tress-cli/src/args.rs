//! The command line.

use std::ops::Range;
use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, Parser, Subcommand, ValueEnum};
use tress::edit::Grouping;
use tress::fit::{Elements, FitOptions, Tolerance};
use tress::geometry::UpAxis;

/// Edit coiled hair in curvature space.
///
/// A groom is read from any format that tress knows, by its extension: .obj .hair .data .bin .ply
/// .tfx .npy .npz .usda .usdc .usd .abc, and .tress for super-helices. Commands fit polylines on
/// the way in and sample them on the way out.
#[derive(Debug, Parser)]
#[command(name = "tress", version, max_term_width = 100, propagate_version = true)]
#[command(after_help = "Start with `tress demo`, or with `tress info` on a groom of your own.")]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// What every command understands.
    #[command(flatten)]
    pub(crate) everywhere: Everywhere,
}

/// Options that every command understands.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Everywhere")]
pub(crate) struct Everywhere {
    /// Print one JSON report on standard output, and nothing else there
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Seed of all random choices; the same seed gives the same bytes
    #[arg(long, global = true, default_value_t = 0, value_name = "N")]
    pub(crate) seed: u64,
    /// Threads to work with [default: one a core]
    #[arg(long, global = true, value_name = "N", value_parser = parse_threads)]
    pub(crate) threads: Option<usize>,
    /// Say nothing but errors
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Write only the I-th of N shares of the strands; `tress merge` joins them
    #[arg(long, global = true, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    /// Allow the output to be the input file
    #[arg(long, global = true)]
    pub(crate) in_place: bool,
}

fn parse_threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads) if 0 < threads && threads <= 1024 => Ok(threads),
        _ => Err("expected a whole number from 1 to 1024".into()),
    }
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Demo(DemoArgs),
    Info(InfoArgs),
    Convert(ConvertArgs),
    Fit(FitCommandArgs),
    Sample(SampleCommandArgs),
    Ruffle(RuffleArgs),
    Blend(BlendArgs),
    Recoil(RecoilArgs),
    Armature(ArmatureArgs),
    Sculpt(SculptArgs),
    Render(RenderArgs),
    Merge(MergeArgs),
}

/// The tour: a bundled groom read, fitted, ruffled, written and pictured
///
/// Leaves in DIR: the groom (patch.hair), its super-helices (patch.tress), the ruffled groom
/// (ruffled.usda, ruffled.hair), pictures (before.png, after.png, before-after.png, radius.png) and
/// a report (report.md).
#[derive(Args, Debug)]
pub(crate) struct DemoArgs {
    /// Folder to leave everything in; made if it is not there
    #[arg(default_value = "tress-demo")]
    pub(crate) dir: PathBuf,
}

/// Counts, lengths, turns, coil radius, handedness, unit and problems of a groom
#[derive(Args, Debug)]
#[command(after_help = "Example: tress info groom.usdc --json")]
pub(crate) struct InfoArgs {
    /// The groom
    pub(crate) input: PathBuf,
}

/// Convert between formats, and say what the target cannot carry
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress convert groom.usdc groom.hair
  tress convert captured.data captured.tfx --points 32
  tress convert scan.obj scan.usda --unit cm --up y --usd-curves catmull-rom")]
pub(crate) struct ConvertArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// How strands are made of super-helices
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// What the groom's numbers mean
    #[command(flatten)]
    pub(crate) space: SpaceArgs,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// Fit super-helices to polylines; report how near they are
#[derive(Args, Debug)]
#[command(
    name = "fit",
    after_help = "Examples:
  tress fit guides.obj guides.tress --elements 90
  tress fit head.usdc head.tress --tolerance 2%"
)]
pub(crate) struct FitCommandArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The .tress file to write
    pub(crate) output: PathBuf,
    /// How polylines are fitted
    #[command(flatten)]
    pub(crate) fit: FitArgs,
}

/// Sample super-helices as polylines
#[derive(Args, Debug)]
#[command(
    name = "sample",
    after_help = "Examples:
  tress sample groom.tress groom.usda --points 128
  tress sample groom.tress groom.obj --spacing 0.05"
)]
pub(crate) struct SampleCommandArgs {
    /// The groom; polylines are fitted first, which resamples them along smooth curves
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// How many points
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// Exchange elements between strands of a group: frizz made of the groom's own curls
///
/// Beyond the elements kept at the root, each element of a strand is replaced, with the given
/// probability, by the element of the same index of a random strand of its group.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress ruffle guides.obj ruffled.obj --elements 90 --probability 0.05 --keep 30
  tress ruffle head.usdc head.usda --groups clusters:40 --blend 0.5")]
pub(crate) struct RuffleArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// Chance of an element to be replaced, 0 to 1
    #[arg(long, value_name = "P", default_value_t = 0.05, allow_negative_numbers = true)]
    pub(crate) probability: f64,
    /// Elements at the root that stay: a number, or a share of the strand as in 33%
    #[arg(long, value_name = "N", default_value = "33%")]
    pub(crate) keep: Keep,
    /// From the groom as it is (0) to the ruffled groom (1)
    #[arg(long, value_name = "T", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) blend: f64,
    /// Who exchanges with whom: `whole`, the name of a strand attribute, or `clusters:K`
    #[arg(long, value_name = "G", default_value = "whole", value_parser = parse_grouping)]
    pub(crate) groups: Grouping,
    /// How polylines are fitted
    #[command(flatten)]
    pub(crate) fit: FitArgs,
    /// How many points come out
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// A groom between two grooms, strand by strand
///
/// In curvature space coils open and close; in world Darboux or position space opposite bends
/// cancel and the coils flatten half way.
#[derive(Args, Debug)]
#[command(after_help = "Example: tress blend before.obj after.obj half.obj --amount 0.5")]
pub(crate) struct BlendArgs {
    /// The groom at amount 0
    pub(crate) from: PathBuf,
    /// The groom at amount 1
    pub(crate) to: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// Where between them
    #[arg(long, value_name = "T", default_value_t = 0.5, allow_negative_numbers = true)]
    pub(crate) amount: f64,
    /// What is mixed
    #[arg(long, value_enum, default_value_t = Space::Curvature)]
    pub(crate) space: Space,
    /// How polylines are fitted; both grooms get the same number of elements a strand
    #[command(flatten)]
    pub(crate) fit: FitArgs,
    /// How many points come out
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// The space of a blend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Space {
    /// Material curvatures
    Curvature,
    /// World Darboux vectors
    Darboux,
    /// Points
    Position,
}

/// Tighter or looser, wider or narrower coils
///
/// Radius and frequency (turns in a length of axis) are multiplied. They cannot change alone: say
/// what stays.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress recoil groom.usdc looser.usda --radius 1.5
  tress recoil groom.usdc tighter.usda --radius 0.7 --frequency 1.4 --keep turns")]
pub(crate) struct RecoilArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// Factor of the coil radius
    #[arg(long, value_name = "X", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) radius: f64,
    /// Factor of the spatial frequency
    #[arg(long, value_name = "Y", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) frequency: f64,
    /// What stays
    #[arg(long, value_enum, default_value_t = KeepArg::Length)]
    pub(crate) keep: KeepArg,
    /// How polylines are fitted
    #[command(flatten)]
    pub(crate) fit: FitArgs,
    /// How many points come out
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// What stays when coils change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum KeepArg {
    /// The arc length of every strand; turns follow
    Length,
    /// The turns of every strand; its length follows
    Turns,
    /// The line that every strand winds about; length and turns follow
    Centerline,
}

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

/// Move strands to where a pose puts them, changing their curvatures as little as possible
///
/// Lengths of strands do not change.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress armature groom.obj pose.ron
  tress sculpt groom.obj posed.obj --pose pose.ron --stiffness 0.001")]
pub(crate) struct SculptArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The file to write
    pub(crate) output: PathBuf,
    /// The pose, as `tress armature` writes it
    #[arg(long, value_name = "POSE.ron")]
    pub(crate) pose: PathBuf,
    /// What bending costs, whatever the unit: 0 meets every anchor, 1 hardly bends
    #[arg(long, value_name = "C", conflicts_with = "c", allow_negative_numbers = true)]
    pub(crate) stiffness: Option<f64>,
    /// What bending costs as the published c, in the fourth power of the groom's unit
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    pub(crate) c: Option<f64>,
    /// How the least energy is found
    #[arg(long, value_enum, default_value_t = SolverArg::Lm)]
    pub(crate) solver: SolverArg,
    /// How polylines are fitted
    #[command(flatten)]
    pub(crate) fit: FitArgs,
    /// How many points come out
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Choices of formats
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}

/// How the least energy is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SolverArg {
    /// Levenberg-Marquardt: tens of steps
    Lm,
    /// Adam as published: thousands of steps, for comparison
    Adam,
}

/// Draw a picture of a groom
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  tress render head.usdc head.png --view three-quarter
  tress render guides.obj radius.png --color-by radius --size 1200x1600")]
pub(crate) struct RenderArgs {
    /// The groom
    pub(crate) input: PathBuf,
    /// The .png file to write
    pub(crate) output: PathBuf,
    /// Where the camera stands
    #[arg(long, value_enum, default_value_t = ViewArg::Front)]
    pub(crate) view: ViewArg,
    /// Pixels, as one number or as in 1200x1600
    #[arg(long, default_value = "1600", value_name = "PIXELS", value_parser = parse_size)]
    pub(crate) size: (u32, u32),
    /// Colour strands by a quantity: radius, turns, length, handedness, curvature, twist, or the
    /// name of an attribute
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) color_by: Option<String>,
    /// Hair diameter, in the groom's unit [default: the groom's own, or one that suits its size]
    #[arg(long, value_name = "D")]
    pub(crate) width: Option<f64>,
    /// What the groom's numbers mean
    #[command(flatten)]
    pub(crate) space: SpaceArgs,
}

/// The views of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ViewArg {
    /// From the front
    Front,
    /// From the side
    Side,
    /// From the back
    Back,
    /// From above
    Top,
    /// From the front, a little aside and above
    ThreeQuarter,
}

/// Join the shares that `--shard` made, in order
#[derive(Args, Debug)]
#[command(after_help = "Example: tress merge part1.hair part2.hair whole.hair")]
pub(crate) struct MergeArgs {
    /// The parts, first to last, and then the file to write
    #[arg(required = true, num_args = 2.., value_name = "PART... OUTPUT")]
    pub(crate) files: Vec<PathBuf>,
}

/// How polylines become super-helices.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Fit")]
pub(crate) struct FitArgs {
    /// Elements a strand [default: one a segment]
    #[arg(long, value_name = "N", conflicts_with = "tolerance")]
    pub(crate) elements: Option<usize>,
    /// As few elements as keep every point this near: a length, or a share of the coil radius as
    /// in 2%
    #[arg(long, value_name = "D", value_parser = parse_tolerance, allow_negative_numbers = true)]
    pub(crate) tolerance: Option<Tolerance>,
}

impl FitArgs {
    pub(crate) fn options(&self) -> FitOptions {
        let elements = match (self.elements, self.tolerance) {
            (Some(n), _) => Elements::Count(n),
            (None, Some(tolerance)) => Elements::Tolerance(tolerance),
            (None, None) => Elements::PerSegment,
        };
        FitOptions { elements, ..FitOptions::default() }
    }
}

/// How many points come out.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Points out")]
pub(crate) struct SamplingArgs {
    /// Points a strand [default: as many as came in; 16 a turn from .tress]
    #[arg(long, value_name = "N", conflicts_with = "spacing")]
    pub(crate) points: Option<usize>,
    /// Distance of points along the strand, in the groom's unit
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    pub(crate) spacing: Option<f64>,
}

impl SamplingArgs {
    pub(crate) fn is_given(&self) -> bool {
        self.points.is_some() || self.spacing.is_some()
    }
}

/// What the groom's numbers mean, where its format does not say.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Unit and axes")]
pub(crate) struct SpaceArgs {
    /// The unit that the groom is in: mm, cm, m, in, ft, or metres as a number
    #[arg(long, value_name = "U", value_parser = parse_unit)]
    pub(crate) unit: Option<f64>,
    /// The axis that is up in the groom: y or z
    #[arg(long, value_name = "AXIS", value_parser = parse_axis)]
    pub(crate) up: Option<UpAxis>,
    /// Turn the groom so that this axis is up
    #[arg(long, value_name = "AXIS", value_parser = parse_axis)]
    pub(crate) turn_up: Option<UpAxis>,
}

/// Choices that formats leave open.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Formats")]
pub(crate) struct FormatArgs {
    /// What .usda says lies between points: `linear` or `catmull-rom`
    #[arg(long, value_enum, value_name = "KIND")]
    pub(crate) usd_curves: Option<UsdCurvesArg>,
}

/// What lies between points in .usda.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UsdCurvesArg {
    /// Straight segments
    Linear,
    /// A Catmull-Rom spline
    CatmullRom,
}

/// A share of the strands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    index: usize,
    of: usize,
}

impl Shard {
    /// The strands of this share, of `strands` in all.
    pub(crate) fn range(self, strands: usize) -> Range<usize> {
        let end = |i: usize| (strands as u128 * i as u128 / self.of as u128) as usize;
        end(self.index - 1)..end(self.index)
    }
}

impl FromStr for Shard {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let parts =
            text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((index, of)) if 0 < index && index <= of => Ok(Self { index, of }),
            _ => Err("expected I/N with I from 1 to N, as in 2/8".into()),
        }
    }
}

/// Elements at the root that stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Keep {
    /// So many.
    Count(usize),
    /// This share of the elements of a typical strand.
    Share(f64),
}

impl FromStr for Keep {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let keep = match text.strip_suffix('%') {
            Some(percent) => percent.parse().ok().map(|p: f64| Self::Share(p / 100.0)),
            None => text.parse().ok().map(Self::Count),
        };
        match keep {
            Some(Self::Share(share)) if !(0.0..=1.0).contains(&share) => None,
            other => other,
        }
        .ok_or_else(|| "expected a number of elements, or a share from 0% to 100%".into())
    }
}

fn parse_joints(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(joints) if (1..=64).contains(&joints) => Ok(joints),
        _ => Err("expected a whole number from 1 to 64".into()),
    }
}

fn parse_grouping(text: &str) -> Result<Grouping, String> {
    match text.split_once(':') {
        None if text == "whole" => Ok(Grouping::Whole),
        Some(("clusters", k)) => match k.parse() {
            Ok(k) => Ok(Grouping::Clusters(k)),
            Err(_) => Err(format!("expected a number of clusters, found {k:?}")),
        },
        _ => Ok(Grouping::Attribute(text.into())),
    }
}

fn parse_tolerance(text: &str) -> Result<Tolerance, String> {
    let (number, of_radius) = match text.strip_suffix('%') {
        Some(percent) => (percent.parse().map(|p: f64| p / 100.0), true),
        None => (text.parse(), false),
    };
    match number {
        Ok(d) if 0.0 < d && d.is_finite() && of_radius => Ok(Tolerance::OfRadius(d)),
        Ok(d) if 0.0 < d && d.is_finite() => Ok(Tolerance::Length(d)),
        _ => Err("expected a positive length, or a share of the coil radius as in 2%".into()),
    }
}

fn parse_unit(text: &str) -> Result<f64, String> {
    match text {
        "mm" => Ok(0.001),
        "cm" => Ok(0.01),
        "m" => Ok(1.0),
        "in" => Ok(0.0254),
        "ft" => Ok(0.3048),
        _ => match text.parse() {
            Ok(metres) if 0.0 < metres && f64::is_finite(metres) => Ok(metres),
            _ => Err("expected mm, cm, m, in, ft, or a positive number of metres".into()),
        },
    }
}

fn parse_axis(text: &str) -> Result<UpAxis, String> {
    match text {
        "y" | "Y" => Ok(UpAxis::Y),
        "z" | "Z" => Ok(UpAxis::Z),
        _ => Err("expected y or z".into()),
    }
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let (width, height) = text.split_once('x').unwrap_or((text, text));
    match (width.parse(), height.parse()) {
        (Ok(w), Ok(h)) if (1..=16384).contains(&w) && (1..=16384).contains(&h) => Ok((w, h)),
        _ => Err("expected pixels from 1 to 16384, as in 1600 or 1200x1600".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }

    #[test]
    fn shards_share_all_strands_out() {
        for (strands, of) in [(10, 3), (2, 5), (0, 2), (1_000_003, 7)] {
            let mut next = 0;
            for index in 1..=of {
                let range = Shard { index, of }.range(strands);
                assert_eq!(range.start, next);
                next = range.end;
            }
            assert_eq!(next, strands);
        }
        for wrong in ["0/2", "3/2", "1", "a/b", "1/0", "-1/2"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn values_are_understood_or_refused() {
        assert_eq!(parse_tolerance("2%"), Ok(Tolerance::OfRadius(0.02)));
        assert_eq!(parse_tolerance("0.1"), Ok(Tolerance::Length(0.1)));
        for wrong in ["0", "-1", "x", "NaN", "inf", "0%", ""] {
            assert!(parse_tolerance(wrong).is_err(), "{wrong}");
        }
        assert_eq!("33%".parse::<Keep>(), Ok(Keep::Share(0.33)));
        assert!("101%".parse::<Keep>().is_err() && "-3".parse::<Keep>().is_err());
        assert_eq!(parse_grouping("clusters:40"), Ok(Grouping::Clusters(40)));
        assert_eq!(parse_grouping("wisp"), Ok(Grouping::Attribute("wisp".into())));
        assert_eq!(parse_size("1200x1600"), Ok((1200, 1600)));
        assert!(parse_size("0").is_err() && parse_unit("-1").is_err());
    }
}
