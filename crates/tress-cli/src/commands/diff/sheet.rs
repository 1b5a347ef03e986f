//! Two grooms side by side, and their distributions one on the other.

use tress::analysis::Quantity;
use tress::view::plot::{COLORS, Density, Layer, Line, Plot, histogram_within};
use tress::view::{
    Bounds, Coloring, Page, Panel, RenderOptions, RgbImage, Size, StrandWidth, View, png,
    render_within, sensible_width, sheet,
};

use crate::commands::analyze::plots::{
    SIZE as PLOT, column, histograms, quantile_layers, shares, spectrum,
};
use crate::commands::analyze::study::Study;
use crate::failure::Failure;

/// Pixels of a picture.
const PICTURE: u32 = 760;

/// Bars of a histogram.
const BARS: usize = 40;

/// Both grooms by one camera, before and after, and below them what is distributed otherwise.
pub(super) fn png_of(a: &Study, b: &Study, view: View) -> Result<Vec<u8>, Failure> {
    let [before, after] = pictures(a, b, view)?;
    let size = Size::new(PICTURE, PICTURE * PLOT.height / PLOT.width);
    let plots = plots(a, b);
    let drawn: Vec<RgbImage> =
        plots.iter().map(|plot| plot.picture(size)).collect::<Result<_, _>>()?;
    let mut panels = vec![
        Panel { image: &before, caption: "before" },
        Panel { image: &after, caption: "after" },
    ];
    panels.extend(drawn.iter().map(|image| Panel { image, caption: "" }));
    Ok(png(&sheet(&panels, 2, RenderOptions::default().background)?)?)
}

/// The report.
pub(super) fn page_of(
    a: &Study,
    b: &Study,
    names: &[String; 2],
    lines: &[(String, String)],
    view: View,
) -> Result<String, Failure> {
    let mut page = Page::new(&format!("{} and {}", names[0], names[1]));
    page.heading("Apart");
    let rows: Vec<Vec<String>> =
        lines.iter().map(|(name, what)| vec![name.clone(), what.clone()]).collect();
    page.table(&["", ""], &rows);
    page.heading("Seen");
    for (image, name) in pictures(a, b, view)?.iter().zip(names) {
        page.png(&png(image)?, name);
    }
    page.heading("Plotted");
    for plot in plots(a, b) {
        page.svg(&plot.svg(PLOT)?, &plot.title);
    }
    Ok(page.finish())
}

fn pictures(a: &Study, b: &Study, view: View) -> Result<[RgbImage; 2], Failure> {
    let bounds = Bounds::of(&a.groom).union(Bounds::of(&b.groom));
    let options = RenderOptions {
        view,
        size: Size::new(PICTURE, PICTURE),
        width: StrandWidth::Fixed(sensible_width(&a.groom)),
        ..RenderOptions::default()
    };
    let draw = |study: &Study| render_within(&study.groom, bounds, &Coloring::Natural, &options);
    Ok([draw(a)?, draw(b)?])
}

fn plots(a: &Study, b: &Study) -> Vec<Plot> {
    let along = [Quantity::Radius, Quantity::Frequency, Quantity::Beta];
    let mut plots: Vec<Plot> = along.iter().filter_map(|&of| along_both(a, b, of)).collect();
    plots.push(spectrum(&[(a, "before", COLORS[0]), (b, "after", COLORS[1])]));
    for (title, shown, values) in histograms(a) {
        let Some((_, _, others)) = histograms(b).into_iter().find(|(t, ..)| *t == title) else {
            continue;
        };
        let (values, others) = (shown.of(values), shown.of(others));
        let both = values.iter().chain(&others).copied().filter(|v| v.is_finite());
        let (low, high) =
            both.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let bars = |values: &[f64], color, name: &str| Layer::Bars {
            bars: histogram_within(values, BARS, [low, high]),
            name: name.into(),
            color,
            opacity: 0.5,
        };
        plots.push(Plot {
            title: title.into(),
            x: shown.titled(title),
            y: "strands".into(),
            layers: vec![bars(&values, COLORS[0], "before"), bars(&others, COLORS[1], "after")],
            ..Plot::default()
        });
    }
    plots
}

/// A quantity along the strands of both.
fn along_both(a: &Study, b: &Study, of: Quantity) -> Option<Plot> {
    let mut layers = Vec::new();
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for (study, name, color) in [(a, "before", COLORS[0]), (b, "after", COLORS[1])] {
        let (_, shown, values) = column(study, of)?;
        let (shares, values) = (shares(study), shown.of(values.iter().copied()));
        let strands = study.groom.strands();
        let ranges = (0..strands.len()).map(|i| strands.range(i));
        let lines = ranges.map(|range| Line { x: &shares[range.clone()], y: &values[range] });
        let density = Density::of(lines, [0.0, 1.0]);
        let [low, high] = density.y_range();
        range = [range[0].min(low), range[1].max(high)];
        layers.extend(quantile_layers(&density, color, name, false));
    }
    let (title, shown, _) = column(a, of)?;
    Some(Plot {
        title: format!("{title} along the strands"),
        x: "share of the strand's length, from root to tip".into(),
        y: shown.titled(title),
        layers,
        x_range: Some([0.0, 1.0]),
        y_range: Some(range),
        ..Plot::default()
    })
}
