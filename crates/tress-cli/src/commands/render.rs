//! `tress render`: a picture of a groom.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use tress::analysis::{Quantity, QuantityValues, quantity};
use tress::fit::FitOptions;
use tress::geometry::{Column, Groom, HelixGroom};
use tress::io::Model;
use tress::view::{
    ColorMap, Coloring, RenderOptions, RgbImage, Scale, Size, StrandWidth, View, png, render,
};

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{SamplingArgs, SpaceArgs};
use crate::progress::Progress;
use crate::report::{Report, count};
use crate::source::{self, Curved};
use crate::target;

use super::analyze::pictures::scale_of;
use super::convert::in_space;

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
    /// Colour strands by a quantity: radius, turns, length, handedness, curvature, twist,
    /// frequency, pitch, beta, beta-fourier, or the name of an attribute
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

pub(crate) fn run(args: &RenderArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    target::check_kind(&[&args.input], &args.output, ("pictures are", "png"), everywhere)?;
    let progress = Progress::new(everywhere);
    let mut report = Report::default();
    report.set("input", &args.input);
    let subject = Subject::new(args, everywhere, &progress)?;
    progress.stage("drawing");
    let picture = subject.draw(args)?;
    progress.stage(format!("writing {}", args.output.display()));
    tress::io::write_bytes(&args.output, &png(&picture)?)?;

    let (width, height) = picture.dimensions();
    let strands = subject.groom.strands().len();
    report.set("output", &args.output);
    report.set("strands", strands);
    report.set("size", (width, height));
    let (file, strands) = (args.output.display(), count(strands));
    report.say("wrote", format!("{file} ({width} x {height} pixels, {strands} strands)"));
    if let Some((_, scale)) = &subject.values {
        report.set("scale", scale);
    }
    Ok(report)
}

/// What is drawn: polylines, and the numbers that colour them.
struct Subject {
    groom: Groom,
    values: Option<(Numbers, Scale)>,
}

/// Numbers that colour hair.
enum Numbers {
    Strands(Vec<f64>),
    Points(Vec<f64>),
}

impl Subject {
    fn new(
        args: &RenderArgs,
        everywhere: &Everywhere,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let model = match source::share_of(source::read(&args.input, progress)?, everywhere) {
            Model::Polylines(groom) => Model::Polylines(in_space(groom, &args.space)),
            helices @ Model::Helices(_) => helices,
        };
        match &args.color_by {
            None => Ok(Self { groom: source::into_polylines(model, progress)?, values: None }),
            Some(name) => match name.parse::<Quantity>() {
                Ok(quantity) => Self::by_quantity(model, quantity, progress),
                Err(unknown) => {
                    let groom = source::into_polylines(model, progress)?;
                    let Some(numbers) = attribute(&groom, name) else {
                        let message = format!("{unknown}, and no attribute of the groom is either");
                        return Err(Failure::Failed(message));
                    };
                    let (Numbers::Strands(values) | Numbers::Points(values)) = &numbers;
                    let range = Scale::without_strays(values.iter().copied(), 0.01);
                    let scale = Scale { title: name.clone(), map: ColorMap::Viridis, ..range };
                    Ok(Self { groom, values: Some((numbers, scale)) })
                }
            },
        }
    }

    /// Coloured by what super-helices say.
    fn by_quantity(model: Model, of: Quantity, progress: &Progress) -> Result<Self, Failure> {
        let (curved, drawn) = match model {
            Model::Polylines(groom) => {
                let curved = Curved::fit(&groom, &FitOptions::default(), progress)?;
                (curved, Some(groom))
            }
            Model::Helices(helices) => (Curved { helices, counts: None, fit: None }, None),
        };
        progress.stage(format!("measuring {}", of.name()));
        let (groom, numbers) = match quantity(&curved.helices, of) {
            QuantityValues::Strands(values) => {
                let groom = match drawn {
                    Some(groom) => groom,
                    None => curved.sample(&SamplingArgs::default())?,
                };
                (groom, Numbers::Strands(values))
            }
            QuantityValues::Joints(values) => sample_with(curved, values)?,
        };
        let (Numbers::Strands(values) | Numbers::Points(values)) = &numbers;
        let scale = scale_of(of, values, unit(of, groom.unit));
        Ok(Self { groom, values: Some((numbers, scale)) })
    }

    fn draw(&self, args: &RenderArgs) -> Result<RgbImage, Failure> {
        let options = RenderOptions {
            view: view(args.view),
            size: Size::new(args.size.0, args.size.1),
            width: args.width.map_or(StrandWidth::Auto, StrandWidth::Fixed),
            ..RenderOptions::default()
        };
        let coloring = match &self.values {
            None => Coloring::Natural,
            Some((Numbers::Strands(values), scale)) => Coloring::Strands(values, scale),
            Some((Numbers::Points(values), scale)) => Coloring::Points(values, scale),
        };
        Ok(render(&self.groom, &coloring, &options)?)
    }
}

/// Samples super-helices along with one number a joint.
fn sample_with(mut curved: Curved, joints: Vec<f64>) -> Result<(Groom, Numbers), Failure> {
    const COLORED_BY: &str = "colored by";
    let helices: &mut HelixGroom = &mut curved.helices;
    helices.insert_joint_attribute(COLORED_BY, Column::scalar(joints))?;
    let mut groom = curved.sample(&SamplingArgs::default())?;
    let values = match groom.remove_point_attribute(COLORED_BY) {
        Some(column) => column.first_components().collect(),
        // Polylines that are kept have no joints, and a groom of nothing else has no such column.
        None => vec![f64::NAN; groom.strands().points().len()],
    };
    Ok((groom, Numbers::Points(values)))
}

/// The first numbers of an attribute of strands or points.
fn attribute(groom: &Groom, name: &str) -> Option<Numbers> {
    let strands = groom.strand_attributes().get(name);
    let points = groom.point_attributes().get(name);
    match (strands, points) {
        (Some(column), _) => Some(Numbers::Strands(column.first_components().collect())),
        (None, Some(column)) => Some(Numbers::Points(column.first_components().collect())),
        (None, None) => None,
    }
}

/// The unit of a quantity in words.
fn unit(of: Quantity, metres: Option<f64>) -> String {
    let length = match metres {
        Some(1.0) => "m",
        Some(0.01) => "cm",
        Some(0.001) => "mm",
        _ => "unit",
    };
    match of.length_power() {
        1 => length.into(),
        -1 => format!("1/{length}"),
        _ => String::new(),
    }
}

/// Where the camera stands.
pub(crate) fn view(view: ViewArg) -> View {
    match view {
        ViewArg::Front => View::Front,
        ViewArg::Side => View::Side,
        ViewArg::Back => View::Back,
        ViewArg::Top => View::Top,
        ViewArg::ThreeQuarter => View::ThreeQuarter,
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
    fn sizes_are_one_number_or_two() {
        assert_eq!(parse_size("1200x1600"), Ok((1200, 1600)));
        assert_eq!(parse_size("800"), Ok((800, 800)));
        assert!(parse_size("0").is_err() && parse_size("800x").is_err());
    }
}
