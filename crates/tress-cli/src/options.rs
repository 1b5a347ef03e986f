//! Options that several commands share.

use clap::{Args, ValueEnum};
use tress::edit::Grouping;
use tress::fit::{Elements, FitOptions, Tolerance};
use tress::geometry::UpAxis;

/// How a groom goes through curvature space: fitted on the way in, sampled on the way out.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct RoadArgs {
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
    /// What USD says lies between points: `linear` or `catmull-rom`
    #[arg(long, value_enum, value_name = "KIND")]
    pub(crate) usd_curves: Option<UsdCurvesArg>,
    /// The program that an .abc file is for: `unreal` scales to centimetres, turns Y up, names
    /// attributes as its groom schema does, and keeps strands within 255 points
    #[arg(long, value_enum, value_name = "PROGRAM")]
    pub(crate) target: Option<TargetArg>,
}

/// A program with demands of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TargetArg {
    /// Unreal Engine, groom schema 1.5
    Unreal,
}

/// What lies between points in USD.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UsdCurvesArg {
    /// Straight segments
    Linear,
    /// A Catmull-Rom spline
    CatmullRom,
}

pub(crate) fn parse_grouping(text: &str) -> Result<Grouping, String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_understood_or_refused() {
        assert_eq!(parse_tolerance("2%"), Ok(Tolerance::OfRadius(0.02)));
        assert_eq!(parse_tolerance("0.1"), Ok(Tolerance::Length(0.1)));
        for wrong in ["0", "-1", "x", "NaN", "inf", "0%", ""] {
            assert!(parse_tolerance(wrong).is_err(), "{wrong}");
        }
        assert_eq!(parse_grouping("clusters:40"), Ok(Grouping::Clusters(40)));
        assert_eq!(parse_grouping("wisp"), Ok(Grouping::Attribute("wisp".into())));
        assert_eq!(parse_unit("in"), Ok(0.0254));
        assert!(parse_unit("-1").is_err() && parse_axis("x").is_err());
    }
}
