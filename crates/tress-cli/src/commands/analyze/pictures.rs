//! Pictures of a groom, natural and coloured by quantities.

use tress::analysis::{Quantity, QuantityValues};
use tress::view::{
    ColorMap, Coloring, Panel, RenderOptions, RgbImage, Scale, Size, View, png, render, sheet,
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

/// The hair coloured by a quantity, with its legend.
pub(crate) fn by(study: &Study, of: Quantity, view: View) -> Result<RgbImage, Failure> {
    let shown = study.shown(of);
    let (values, is_of_strands) = match study.analysis.values(of) {
        QuantityValues::Strands(values) => (shown.of(values), true),
        QuantityValues::Joints(values) => (shown.of(values), false),
    };
    let map = match of {
        Quantity::Handedness | Quantity::Beta => ColorMap::PurpleGreen,
        Quantity::Twist | Quantity::Pitch => ColorMap::BlueRed,
        _ => ColorMap::Viridis,
    };
    let range = Scale::without_strays(values.iter().copied(), 0.01);
    let mut scale = Scale { title: of.title().into(), unit: shown.name, map, ..range };
    if matches!(of, Quantity::Handedness | Quantity::Beta) {
        (scale.min, scale.max) = (-1.0, 1.0);
    } else if of.is_signed() {
        scale = scale.symmetric();
    }
    let coloring = if is_of_strands {
        Coloring::Strands(&values, &scale)
    } else {
        Coloring::Points(&values, &scale)
    };
    Ok(render(&study.groom, &coloring, &options(view))?)
}

/// Pictures by each of the quantities on one sheet, as the bytes of a PNG file.
pub(crate) fn sheet_by(
    study: &Study,
    quantities: &[Quantity],
    view: View,
) -> Result<Vec<u8>, Failure> {
    let images: Vec<RgbImage> =
        quantities.iter().map(|&of| by(study, of, view)).collect::<Result<_, _>>()?;
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
