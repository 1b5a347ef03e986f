//! Tables as comma-separated values; the first row names the columns, with units in brackets.

use std::fmt::Write as _;

use tress::analysis::{Hand, StrandMeasures};
use tress::view::plot::{Layer, Plot};

use super::study::Study;

/// One row a strand, in the groom's own unit.
pub(super) fn strands(study: &Study) -> String {
    let unit = study.units.own();
    let mut text = format!(
        "strand,length [{unit}],reach [{unit}],curl_index,turns,coil_radius [{unit}],\
         pitch [{unit}],frequency [turns/{unit} of centerline],circularity,roundness,hand,\
         hand_balance,switchbacks,frizz,wisp,phase_locked\n"
    );
    for (i, measures) in study.analysis.strands.iter().enumerate() {
        let _ = write!(text, "{i},");
        match measures {
            Some(measures) => text.push_str(&row(measures)),
            None => text.push_str(&",".repeat(12)),
        }
        let locked = study.wisps.locked.get(i).copied();
        let wisp = study.wisps.wisp.get(i).map_or(String::new(), u32::to_string);
        let _ = writeln!(text, ",{wisp},{}", number(locked));
    }
    text
}

fn row(m: &StrandMeasures) -> String {
    let hand = match m.hand {
        Hand::Right => "right",
        Hand::Left => "left",
        Hand::Neither => "neither",
    };
    [
        m.length.to_string(),
        m.reach.to_string(),
        number(Some(m.curl_index())),
        m.turns.to_string(),
        number(m.coil_radius),
        number(m.pitch),
        number(m.frequency),
        m.circularity.to_string(),
        m.roundness.to_string(),
        hand.into(),
        m.hand_balance.to_string(),
        m.switchbacks.to_string(),
        m.frizz.to_string(),
    ]
    .join(",")
}

/// One row a point, in the groom's own unit.
pub(super) fn along(study: &Study) -> String {
    let unit = study.units.own();
    let mut text = format!(
        "strand,arc_length [{unit}],curvature [1/{unit}],twist [1/{unit}],radius [{unit}],\
         pitch [{unit}],frequency [turns/{unit} of centerline],beta,beta_fourier,circularity\n"
    );
    let strands = study.groom.strands();
    let columns = study.analysis.along.columns();
    for i in 0..strands.len() {
        for k in strands.range(i) {
            let _ = write!(text, "{i}");
            for (_, values) in &columns {
                let _ = write!(text, ",{}", number(values.get(k).copied()));
            }
            text.push('\n');
        }
    }
    text
}

/// What every plot shows, point by point: lines, quantiles, and bars by their middles.
pub(super) fn plots(plots: &[Plot]) -> String {
    let mut text = String::from("plot,x_name,y_name,series,x,y\n");
    for plot in plots {
        let log2 = plot.log2_x;
        let mut add = |series: &str, x: f64, y: f64| {
            let x = if log2 { x.exp2() } else { x };
            let names = [&plot.title, &plot.x, &plot.y].map(|name| quoted(name)).join(",");
            let (x, y) = (number(Some(x)), number(Some(y)));
            let _ = writeln!(text, "{names},{},{x},{y}", quoted(series));
        };
        for layer in &plot.layers {
            match layer {
                Layer::Density(density) => {
                    for (x, quantiles) in density.quantiles() {
                        let names = ["5 %", "25 %", "50 %", "75 %", "95 %"];
                        for (name, y) in names.iter().zip(quantiles) {
                            add(name, x, y);
                        }
                    }
                }
                Layer::Line { points, name, .. } => {
                    points.iter().for_each(|&[x, y]| add(name, x, y));
                }
                Layer::Band { points, name, .. } => {
                    for &[x, low, high] in points {
                        add(&format!("{name}, lower"), x, low);
                        add(&format!("{name}, upper"), x, high);
                    }
                }
                Layer::Bars { bars, name, .. } => {
                    bars.iter().for_each(|bar| add(name, 0.5 * (bar.from + bar.to), bar.height));
                }
            }
        }
    }
    text
}

/// A finite number; nothing for any other.
fn number(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or(String::new(), |v| v.to_string())
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}
