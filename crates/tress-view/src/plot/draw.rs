//! Plots drawn by plotters, to SVG and to pixels.

use std::sync::Once;

use image::RgbImage;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{Density, Layer, Plot, PlotError};
use crate::{Rgb, Size};

const PAPER: RGBColor = RGBColor(255, 255, 255);
const INK: RGBColor = RGBColor(42, 40, 38);
const SOFT: RGBColor = RGBColor(221, 216, 208);

/// The darkest shade of a density.
const DENSE: Rgb = [16, 62, 98];

/// The least room for axes and words, and the most pixels.
const LEAST: [u32; 2] = [160, 120];
const MOST_PIXELS: u64 = 1 << 26;

type Chart<'a, 'b, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

pub(super) fn svg(plot: &Plot, size: Size) -> Result<String, PlotError> {
    check(size)?;
    let mut text = String::new();
    draw(plot, &SVGBackend::with_string(&mut text, (size.width, size.height)).into_drawing_area())?;
    Ok(text)
}

pub(super) fn picture(plot: &Plot, size: Size) -> Result<RgbImage, PlotError> {
    check(size)?;
    let mut image = RgbImage::new(size.width, size.height);
    let pixels = BitMapBackend::with_buffer(image.as_mut(), (size.width, size.height));
    draw(plot, &pixels.into_drawing_area())?;
    Ok(image)
}

fn check(size: Size) -> Result<(), PlotError> {
    let Size { width, height } = size;
    let pixels = u64::from(width) * u64::from(height);
    if width < LEAST[0] || height < LEAST[1] || MOST_PIXELS < pixels {
        return Err(PlotError::Size { width, height });
    }
    Ok(())
}

fn failed(error: impl std::fmt::Display) -> PlotError {
    PlotError::Drawing(error.to_string())
}

/// The typeface of pictures serves plots too.
fn register_typeface() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        for style in [FontStyle::Normal, FontStyle::Bold] {
            // It is read, or words are left out, as in pictures.
            let _ = plotters::style::register_font(
                "sans-serif",
                style,
                epaint_default_fonts::UBUNTU_LIGHT,
            );
        }
    });
}

fn draw<B: DrawingBackend>(plot: &Plot, area: &DrawingArea<B, Shift>) -> Result<(), PlotError> {
    register_typeface();
    area.fill(&PAPER).map_err(failed)?;
    let (width, height) = area.dim_in_pixel();
    // Letters grow with the plot, up to a size that is read with ease.
    let letters = (f64::from(width.min(height)) / 22.0).clamp(11.0, 26.0);
    let [[x0, x1], [y0, y1]] = plot.ranges();
    let pixels = |factor: f64| crate::num::ceil_to_count(factor * letters, 400);
    let body = draw_head(plot, area, letters)?;
    let mut chart = ChartBuilder::on(&body)
        .margin(pixels(0.7))
        .x_label_area_size(pixels(3.0))
        .y_label_area_size(pixels(5.0))
        .build_cartesian_2d(x0..x1, y0..y1)
        .map_err(failed)?;
    let along = |x: &f64| short(if plot.log2_x { x.exp2() } else { *x });
    chart
        .configure_mesh()
        .x_labels(7)
        .y_labels(6)
        .x_desc(&plot.x)
        .y_desc(&plot.y)
        .x_label_formatter(&along)
        .y_label_formatter(&|y: &f64| short(*y))
        .label_style(("sans-serif", letters).into_font().color(&INK))
        .axis_desc_style(("sans-serif", letters).into_font().color(&INK))
        .axis_style(INK.mix(0.6))
        .bold_line_style(SOFT)
        .light_line_style(TRANSPARENT)
        .draw()
        .map_err(failed)?;
    for layer in &plot.layers {
        draw_layer(&mut chart, layer)?;
    }
    area.present().map_err(failed)
}

/// Draws the title, and below it a row of keys to the layers that have names, where they hide
/// nothing; what is left of the area.
fn draw_head<B: DrawingBackend>(
    plot: &Plot,
    area: &DrawingArea<B, Shift>,
    letters: f64,
) -> Result<DrawingArea<B, Shift>, PlotError> {
    const KEY: i32 = 20;
    let pixels = |factor: f64| crate::num::ceil_to_count(factor * letters, 400).cast_signed();
    let named = || plot.layers.iter().filter(|layer| !layer.name().is_empty());
    let (line, gap) = (pixels(1.5), pixels(1.2));
    let title_height = pixels(2.2);
    let keys_height = if named().next().is_some() { line } else { 0 };
    let (head, body) = area.split_vertically(title_height + keys_height);
    let (width, _) = area.dim_in_pixel();
    let middle = width.cast_signed() / 2;
    let words = |size: f64| ("sans-serif", size * letters).into_font().color(&INK);
    let title = words(1.2).pos(Pos::new(HPos::Center, VPos::Center));
    head.draw(&Text::new(plot.title.as_str(), (middle, title_height / 2 + 2), title))
        .map_err(failed)?;
    let style = words(0.95).pos(Pos::new(HPos::Left, VPos::Center));
    let mut keys = Vec::new();
    for layer in named() {
        let (words, _) = head.estimate_text_size(layer.name(), &style).map_err(failed)?;
        keys.push((layer, KEY + KEY / 3 + words.cast_signed()));
    }
    let all = keys.iter().map(|(_, width)| width + gap).sum::<i32>() - gap;
    let (mut x, y) = ((middle - all / 2).max(0), title_height + line / 2);
    for (layer, width) in keys {
        draw_key(&head, layer, [x, x + KEY], y)?;
        let at = (x + KEY + KEY / 3, y);
        head.draw(&Text::new(layer.name(), at, style.clone())).map_err(failed)?;
        x += width + gap;
    }
    Ok(body)
}

/// A sample of a layer's line or filling.
fn draw_key<B: DrawingBackend>(
    head: &DrawingArea<B, Shift>,
    layer: &Layer,
    [left, right]: [i32; 2],
    y: i32,
) -> Result<(), PlotError> {
    match layer {
        Layer::Density(_) => Ok(()),
        Layer::Line { color, width, .. } => {
            let style = rgb(*color).stroke_width(*width);
            head.draw(&PathElement::new(vec![(left, y), (right, y)], style)).map_err(failed)
        }
        Layer::Band { color, opacity, .. } | Layer::Bars { color, opacity, .. } => {
            let style = rgb(*color).mix(*opacity).filled();
            head.draw(&Rectangle::new([(left, y - 5), (right, y + 5)], style)).map_err(failed)
        }
    }
}

fn draw_layer<B: DrawingBackend>(
    chart: &mut Chart<'_, '_, B>,
    layer: &Layer,
) -> Result<(), PlotError> {
    match layer {
        Layer::Density(density) => draw_density(chart, density)?,
        Layer::Line { points, color, width, .. } => {
            let style = rgb(*color).stroke_width(*width);
            let pieces = points.split(|p| !p.iter().all(|v| v.is_finite()));
            for piece in pieces.filter(|piece| !piece.is_empty()) {
                let line = LineSeries::new(piece.iter().map(|&[x, y]| (x, y)), style);
                chart.draw_series(line).map_err(failed)?;
            }
        }
        Layer::Band { points, color, opacity, .. } => {
            let finite = points.iter().filter(|p| p.iter().all(|v| v.is_finite()));
            let upper = finite.clone().map(|&[x, _, high]| (x, high));
            let lower = finite.rev().map(|&[x, low, _]| (x, low));
            let outline: Vec<(f64, f64)> = upper.chain(lower).collect();
            let style = rgb(*color).mix(*opacity).filled();
            let band = std::iter::once(Polygon::new(outline, style));
            chart.draw_series(band).map_err(failed)?;
        }
        Layer::Bars { bars, color, opacity, .. } => {
            let style = rgb(*color).mix(*opacity).filled();
            let rectangles = bars
                .iter()
                .filter(|bar| 0.0 < bar.height)
                .map(|bar| Rectangle::new([(bar.from, 0.0), (bar.to, bar.height)], style));
            chart.draw_series(rectangles).map_err(failed)?;
        }
    }
    Ok(())
}

fn draw_density<B: DrawingBackend>(
    chart: &mut Chart<'_, '_, B>,
    density: &Density,
) -> Result<(), PlotError> {
    let cells = density.runs().into_iter().map(|([left, low, right, high], dark)| {
        // From the faintest that is still seen on paper.
        let share = 0.12 + 0.88 * dark;
        let mixed = DENSE.map(|v| {
            let v = f64::from(v);
            crate::num::byte(crate::num::narrow(255.0 + (v - 255.0) * share))
        });
        Rectangle::new([(left, low), (right, high)], rgb(mixed).filled())
    });
    chart.draw_series(cells).map_err(failed)?;
    Ok(())
}

fn rgb([r, g, b]: Rgb) -> RGBColor {
    RGBColor(r, g, b)
}

/// A tick's number: as many digits as tell ticks apart, without zeros behind them.
fn short(x: f64) -> String {
    let size = x.abs();
    if size < 1e-12 {
        return "0".into();
    }
    if !(1e-4..1e6).contains(&size) {
        return format!("{x:.1e}").replace('-', "\u{2212}");
    }
    let decimals = crate::num::ceil_to_count(3.0 - size.log10(), 6) as usize;
    let text = format!("{x:.decimals$}");
    let text = match text.split_once('.') {
        Some(_) => text.trim_end_matches('0').trim_end_matches('.'),
        None => &text,
    };
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_short() {
        let cases = [(0.0, "0"), (0.25, "0.25"), (-1.5, "\u{2212}1.5"), (1e-7, "1.0e\u{2212}7")];
        for (x, text) in cases {
            assert_eq!(short(x), text);
        }
        assert_eq!([0.004, 120.0, 0.1 + 0.2].map(short), ["0.004", "120", "0.3"]);
    }
}
