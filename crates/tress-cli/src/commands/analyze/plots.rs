//! The plots of an analysis.

use rayon::prelude::*;
use tress::analysis::{Quantity, StrandMeasures};
use tress::view::plot::{COLORS, Density, Layer, Line, Plot, histogram};
use tress::view::{Panel, Size, png, sheet as picture_sheet};

use crate::failure::Failure;

use super::study::Study;
use super::units::{Shown, Units};

/// Pixels of a plot.
pub(crate) const SIZE: Size = Size::new(760, 460);

/// Grooms of no more strands are plotted line by line.
const FEW: usize = 24;

/// Bars of a histogram.
const BARS: usize = 40;

/// The colours of the median and of what lies about it.
const MEDIAN: [u8; 3] = COLORS[1];

/// All plots: quantities along the strands, then distributions over the strands, then the spectrum.
pub(crate) fn all(study: &Study, quantities: &[Quantity]) -> Vec<Plot> {
    let shares = shares(study);
    let mut plots: Vec<Plot> =
        quantities.par_iter().filter_map(|&of| along(study, of, &shares)).collect();
    plots.extend(histograms(study).into_iter().map(|(title, shown, values)| Plot {
        title: title.into(),
        x: shown.titled(title),
        y: "strands".into(),
        layers: vec![Layer::bars(histogram(&shown.of(values), BARS))],
        ..Plot::default()
    }));
    plots.push(spectrum(&[(study, "", COLORS[0])]));
    plots
}

/// A quantity along every strand, from root to tip; none for one that strands have as a whole.
fn along(study: &Study, of: Quantity, shares: &[f64]) -> Option<Plot> {
    let (title, shown, values) = column(study, of)?;
    let values = shown.of(values.iter().copied());
    let strands = study.groom.strands();
    let lines = || {
        let ranges = (0..strands.len()).map(|i| strands.range(i));
        ranges.map(|range| Line { x: &shares[range.clone()], y: &values[range] })
    };
    let density = Density::of(lines(), [0.0, 1.0]);
    let [low, high] = density.y_range();
    let mut layers = if strands.len() <= FEW {
        let thin = |line: Line<'_>| Layer::Line {
            points: line.x.iter().zip(line.y).map(|(x, y)| [*x, *y]).collect(),
            name: String::new(),
            color: [140, 172, 196],
            width: 1,
        };
        lines().map(thin).collect()
    } else {
        vec![Layer::Density(density.clone())]
    };
    layers.extend(quantile_layers(&density, MEDIAN, "median", true));
    Some(Plot {
        title: format!("{title} along every strand"),
        x: "share of the strand's length, from root to tip".into(),
        y: shown.titled(title),
        layers,
        x_range: Some([0.0, 1.0]),
        y_range: Some([low, high]),
        ..Plot::default()
    })
}

/// Median, quartiles and the lines that a tenth of the strands are beyond.
pub(crate) fn quantile_layers(
    density: &Density,
    color: [u8; 3],
    name: &str,
    outer: bool,
) -> Vec<Layer> {
    let quantiles: Vec<(f64, [f64; 5])> = density.quantiles().collect();
    let line = |k: usize, width: u32, name: &str| Layer::Line {
        points: quantiles.iter().map(|(x, q)| [*x, q[k]]).collect(),
        name: name.into(),
        color,
        width,
    };
    let between = Layer::Band {
        points: quantiles.iter().map(|(x, q)| [*x, q[1], q[3]]).collect(),
        name: format!("half of {}", if outer { "the strands" } else { name }),
        color,
        opacity: 0.25,
    };
    let mut layers = vec![between];
    if outer {
        layers.extend([line(0, 1, "9 of 10 strands"), line(4, 1, "")]);
    }
    layers.push(line(2, 3, name));
    layers
}

/// A column along the strands, with its title and unit.
pub(crate) fn column(study: &Study, of: Quantity) -> Option<(&'static str, Shown, &[f64])> {
    let along = &study.analysis.along;
    let (title, values) = match of {
        Quantity::Radius => ("Coil radius", &along.radius),
        Quantity::Frequency => ("Turns a length of centerline", &along.frequency),
        Quantity::Pitch => ("Pitch", &along.pitch),
        Quantity::Beta => ("Beta", &along.beta),
        Quantity::BetaFourier => ("Beta, Fourier centerline", &along.beta_fourier),
        Quantity::Curvature => ("Curvature", &along.curvature),
        Quantity::Twist => ("Twist", &along.twist),
        Quantity::Handedness => {
            ("Circularity (\u{2212}1 left, 0 planar, 1 right)", &along.circularity)
        }
        Quantity::Turns | Quantity::Length => return None,
    };
    Some((title, study.shown(of), values))
}

/// Where each point lies on its strand, 0 at the root and 1 at the tip.
pub(crate) fn shares(study: &Study) -> Vec<f64> {
    let arc_length = &study.analysis.along.arc_length;
    let strands = study.groom.strands();
    let mut shares = Vec::with_capacity(arc_length.len());
    for i in 0..strands.len() {
        let along = &arc_length[strands.range(i)];
        let length = along.last().copied().unwrap_or(0.0);
        shares.extend(along.iter().map(|s| s / length));
    }
    shares
}

type Distribution = (&'static str, Shown, Vec<f64>);

/// What is distributed over the strands; what no strand has is left out.
pub(crate) fn histograms(study: &Study) -> Vec<Distribution> {
    let units = study.units;
    let of = |value: fn(&StrandMeasures) -> Option<f64>| study.over_strands(value);
    let all = [
        ("Length", units.strand(), of(|m| Some(m.length))),
        ("Turns", Units::none(), of(|m| Some(m.turns))),
        ("Coil diameter", units.coil(), of(|m| m.coil_radius.map(|r| 2.0 * r))),
        ("Pitch", units.coil(), of(|m| m.pitch)),
        ("Curl index (length over reach)", Units::none(), of(|m| Some(m.curl_index()))),
        (
            "Hand balance (\u{2212}1 left, 1 right)",
            Units::none(),
            of(|m| m.coil_radius.map(|_| m.hand_balance)),
        ),
    ];
    all.into_iter().filter(|(_, _, values)| !values.is_empty()).collect()
}

/// The spectra of one groom or more.
pub(crate) fn spectrum(studies: &[(&Study, &str, [u8; 3])]) -> Plot {
    let shown = studies.first().map_or(Units::none(), |(s, ..)| s.units.per_length("turns"));
    let layers = studies.iter().map(|(study, name, color)| {
        let shares = study.analysis.spectrum.shares();
        let points = with_power(&shares)
            .iter()
            .map(|(f, share)| [(f * shown.factor).log2(), 100.0 * share])
            .collect();
        Layer::line(points, *color).named(*name)
    });
    Plot {
        title: "Spectrum of the hair's direction".into(),
        x: shown.titled("turns a length of hair"),
        y: "power, % a twelfth of an octave".into(),
        layers: layers.collect(),
        log2_x: true,
        ..Plot::default()
    }
}

/// A spectrum without its ends that hold next to nothing.
fn with_power(shares: &[(f64, f64)]) -> &[(f64, f64)] {
    let most = shares.iter().map(|(_, share)| *share).fold(0.0, f64::max);
    let there = |(_, share): &(f64, f64)| 2e-3 * most < *share;
    let ends = shares.iter().position(there).zip(shares.iter().rposition(there));
    ends.map_or(&[], |(first, last)| &shares[first..=last])
}

/// All plots on one sheet, as the bytes of an SVG or PNG file.
pub(crate) fn sheet(plots: &[Plot], as_svg: bool) -> Result<Vec<u8>, Failure> {
    const COLUMNS: usize = 2;
    let columns = COLUMNS.min(plots.len()).max(1);
    if as_svg {
        let (width, height) =
            (SIZE.width as usize * columns, SIZE.height as usize * plots.len().div_ceil(columns));
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\">\n"
        );
        for (i, plot) in plots.iter().enumerate() {
            let place = [i % columns * SIZE.width as usize, i / columns * SIZE.height as usize];
            let ([x, y], drawn) = (place, plot.svg(SIZE)?);
            svg.push_str(&drawn.replacen("<svg ", &format!("<svg x=\"{x}\" y=\"{y}\" "), 1));
        }
        svg.push_str("</svg>\n");
        return Ok(svg.into_bytes());
    }
    let pictures = plots.iter().map(|plot| plot.picture(SIZE)).collect::<Result<Vec<_>, _>>()?;
    let panels: Vec<Panel<'_>> =
        pictures.iter().map(|image| Panel { image, caption: "" }).collect();
    Ok(png(&picture_sheet(&panels, columns, [255; 3])?)?)
}
