//! Pictures of a groom, natural and coloured by quantities.

use tress::analysis::{Quantity, QuantityValues};
use tress::view::{
    ColorMap, Coloring, Panel, RenderOptions, RgbImage, Scale, Size, View, png, render,
    render_each, sheet,
};

use crate::failure::Failure;

use super::study::Study;

/// Pixels of a picture.
pub(crate) const SIZE: u32 = 900;

fn options(view: View) -> RenderOptions {
    RenderOptions { view, size: Size::new(SIZE, SIZE), ..RenderOptions::default() }
}

/// The hair as it grows.
pub(crate) fn natural(study: &Study, view: View) -> Result<RgbImage, Failure> {
    Ok(render(&study.groom, &Coloring::Natural, &options(view))?)
}

/// The hair coloured by each quantity, with its legend.
pub(crate) fn by(
    study: &Study,
    quantities: &[Quantity],
    view: View,
) -> Result<Vec<RgbImage>, Failure> {
    let shown: Vec<(QuantityValues, Scale)> =
        quantities.iter().map(|&of| values_and_scale(study, of)).collect();
    let colorings: Vec<Coloring<'_>> = shown
        .iter()
        .map(|(values, scale)| match values {
            QuantityValues::Strands(values) => Coloring::Strands(values, scale),
            QuantityValues::Joints(values) => Coloring::Points(values, scale),
        })
        .collect();
    Ok(render_each(&study.groom, &colorings, &options(view))?)
}

/// Values in the unit that they are shown in, and what shows them.
fn values_and_scale(study: &Study, of: Quantity) -> (QuantityValues, Scale) {
    let unit = study.shown(of);
    let mut shown = study.analysis.values(of);
    let (QuantityValues::Strands(values) | QuantityValues::Joints(values)) = &mut shown;
    values.iter_mut().for_each(|value| *value *= unit.factor);
    let scale = scale_of(of, values, unit.name);
    (shown, scale)
}

/// What shows the values of a quantity; one stray in a hundred at either end does not stretch it.
pub(crate) fn scale_of(of: Quantity, values: &[f64], unit: String) -> Scale {
    let map = match of {
        Quantity::Handedness | Quantity::Beta | Quantity::BetaFourier => ColorMap::PurpleGreen,
        Quantity::Twist | Quantity::Pitch => ColorMap::BlueRed,
        _ => ColorMap::Viridis,
    };
    let range = Scale::without_strays(values.iter().copied(), 0.01);
    let scale = Scale { title: of.title().into(), unit, map, ..range };
    match map {
        ColorMap::PurpleGreen => Scale { min: -1.0, max: 1.0, ..scale },
        _ if of.is_signed() => scale.symmetric(),
        _ => scale,
    }
}

/// Pictures by each of the quantities on one sheet, as the bytes of a PNG file.
pub(crate) fn sheet_by(
    study: &Study,
    quantities: &[Quantity],
    view: View,
) -> Result<Vec<u8>, Failure> {
    let images = by(study, quantities, view)?;
    if let [image] = &images[..] {
        return Ok(png(image)?);
    }
    let panels: Vec<Panel<'_>> = images
        .iter()
        .zip(quantities)
        .map(|(image, of)| Panel { image, caption: of.title() })
        .collect();
    let columns = if images.len() <= 4 { 2 } else { 3 };
    Ok(png(&sheet(&panels, columns, RenderOptions::default().background)?)?)
}
