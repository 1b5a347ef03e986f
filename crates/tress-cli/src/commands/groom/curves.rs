//! What a fit did, as a page: losses and parameters over its steps, and pictures side by side.

use tress::geometry::Groom;
use tress::procedural::ProceduralGroom;
use tress::procedural::fit::{Record, Stage};
use tress::view::plot::{Layer, Plot};
use tress::view::{Bounds, Coloring, Page, Panel, RenderOptions, Size, png, render_within, sheet};

use crate::failure::Failure;
use crate::report::short;

const PLOT: Size = Size::new(640, 300);

/// The page.
pub(super) fn page(
    target: &Groom,
    groom: &ProceduralGroom,
    history: &[Record],
) -> Result<String, Failure> {
    let mut page = Page::new("A procedural groom found");
    page.heading("Target, recovered, guides");
    page.png(&pictures(target, groom)?, "seen by the same camera");
    page.heading("Parameters");
    let mut rows = Vec::new();
    for operator in &groom.chain.operators {
        for (parameter, value) in operator.parameters().iter().zip(operator.values()) {
            rows.push(vec![operator.name().into(), parameter.name.into(), short(value)]);
        }
    }
    page.table(&["operator", "parameter", "value"], &rows);
    page.heading("Losses");
    for stage in [Stage::Guides, Stage::Parameters, Stage::Numbers] {
        let losses: Vec<f64> =
            history.iter().filter(|r| r.stage == stage).map(|r| r.loss).collect();
        if 1 < losses.len() {
            page.svg(&curve(stage.describe(), "loss", &losses)?, caption(stage));
        }
    }
    page.heading("Parameters over the steps");
    let steps: Vec<&Record> = history.iter().filter(|r| r.stage == Stage::Parameters).collect();
    for (o, operator) in groom.chain.operators.iter().enumerate() {
        for (p, parameter) in operator.parameters().iter().enumerate() {
            let at = |record: &&Record| Some(*record.parameters.get(o)?.get(p)?);
            let values: Vec<f64> = steps.iter().filter_map(at).collect();
            if 1 < values.len() {
                let name = format!("{} {}", operator.name(), parameter.name);
                page.svg(&curve(&name, parameter.name, &values)?, &name);
            }
        }
    }
    Ok(page.finish())
}

fn caption(stage: Stage) -> &'static str {
    match stage {
        Stage::Parameters => {
            "finding parameters: with few strands from those given and from ordinary ones, then with \
             more from the better"
        }
        stage => stage.describe(),
    }
}

fn curve(title: &str, y: &str, values: &[f64]) -> Result<String, Failure> {
    let points = values.iter().enumerate().map(|(i, value)| [i as f64, *value]).collect();
    let plot = Plot {
        title: title.into(),
        x: "step".into(),
        y: y.into(),
        layers: vec![Layer::line(points, [20, 20, 20])],
        ..Plot::default()
    };
    Ok(plot.svg(PLOT)?)
}

/// Target, recovered and guides side by side.
fn pictures(target: &Groom, groom: &ProceduralGroom) -> Result<Vec<u8>, Failure> {
    let guides = Groom::new(groom.guides.clone().into_strands()?).in_space(groom.unit, groom.up);
    let options = RenderOptions { size: Size::new(480, 480), ..RenderOptions::default() };
    let grooms = [(target, "target"), (&groom.build_groom()?, "recovered"), (&guides, "guides")];
    let bounds = Bounds::around(target.strands().points().iter().copied());
    let images =
        grooms.map(|(groom, _)| render_within(groom, bounds, &Coloring::Natural, &options));
    let [a, b, c] = images;
    let images = [a?, b?, c?];
    let panels = images.iter().zip(grooms).map(|(image, (_, caption))| Panel { image, caption });
    let panels: Vec<Panel<'_>> = panels.collect();
    Ok(png(&sheet(&panels, 3, options.background)?)?)
}
