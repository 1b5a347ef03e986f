//! The report: pictures, numbers, plots and problems on one page.

use std::path::Path;

use rayon::prelude::*;
use tress::analysis::{Hand, Quantiles, Quantity};
use tress::view::plot::Plot;
use tress::view::{Page, View, png};

use crate::failure::Failure;
use crate::report::{count, short};

use super::study::Study;
use super::units::{Shown, Units};
use super::{pictures, plots::SIZE as PLOT};

/// Switchbacks listed one by one, at most.
const LISTED: usize = 20;

/// The page as text.
pub(super) fn page(
    input: &Path,
    study: &Study,
    plots: &[Plot],
    quantities: &[Quantity],
    view: View,
) -> Result<String, Failure> {
    let name = input.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned());
    let (pictures, drawn) = rayon::join(
        || pictures_of(study, quantities, view),
        || plots.par_iter().map(|plot| plot.svg(PLOT)).collect::<Result<Vec<_>, _>>(),
    );
    let mut page = Page::new(&format!("{name}: what the groom is like"));
    introduction(study, &mut page);
    problems(study, &mut page);
    page.heading("Seen");
    for (bytes, caption) in pictures? {
        page.png(&bytes, &caption);
    }
    numbers(study, &mut page);
    page.heading("Plotted");
    page.note(
        "Along every strand: the darker, the more strands. The line is their median, half of them \
         run within the band, nine in ten between the thin lines.",
    );
    for (svg, plot) in drawn?.iter().zip(plots) {
        page.svg(svg, &plot.title);
    }
    switchbacks(study, &mut page);
    page.note(concat!("Made by tress ", env!("CARGO_PKG_VERSION"), "."));
    Ok(page.finish())
}

/// The hair as it grows, and coloured: files of pictures, with what they show.
fn pictures_of(
    study: &Study,
    quantities: &[Quantity],
    view: View,
) -> Result<Vec<(Vec<u8>, String)>, Failure> {
    let pictured = pictured(study, quantities);
    let (natural, coloured) =
        rayon::join(|| pictures::natural(study, view), || pictures::by(study, &pictured, view));
    let captions = pictured.iter().map(|of| format!("By {}.", of.title()));
    let captions = std::iter::once("As it grows.".to_owned()).chain(captions);
    let images: Vec<_> = std::iter::once(natural?).chain(coloured?).zip(captions).collect();
    images.into_par_iter().map(|(image, caption)| Ok((png(&image)?, caption))).collect()
}

/// What is worth a picture: quantities that coils have, where there are any.
fn pictured(study: &Study, quantities: &[Quantity]) -> Vec<Quantity> {
    let asked = [Quantity::Radius, Quantity::Beta, Quantity::Frequency];
    if study.summary.coiled == 0 {
        return vec![Quantity::Length, Quantity::Curvature];
    }
    asked.into_iter().filter(|of| quantities.contains(of)).collect()
}

fn introduction(study: &Study, page: &mut Page) {
    let summary = &study.summary;
    let (strands, points) = (study.groom.strands().len(), study.groom.strands().points().len());
    let unit = match study.groom.unit {
        Some(_) => format!("One unit is {}.", study.units.own()),
        None => "Its unit is not known.".into(),
    };
    page.note(&format!("{} strands, {} points. {unit}", count(strands), count(points)));
    let share = |n: usize| short(100.0 * n as f64 / summary.measured.max(1) as f64);
    if summary.coiled == 0 {
        page.paragraph("No strand goes round its centerline: straight or gently bent hair.");
        return;
    }
    let mut text = format!("{} % of the strands coil or wave. ", share(summary.coiled));
    if let (Some(turns), Some(radius)) = (summary.turns, summary.coil_radius) {
        let coil = study.units.coil();
        let diameter = short(2.0 * radius.median * coil.factor);
        let turns = short(turns.median);
        text +=
            &format!("The middle strand turns {turns} times, {diameter} {} across. ", coil.name);
    }
    let (left, right) = (share(summary.left_handed), share(summary.right_handed));
    text += &format!("{left} % wind to the left, {right} % to the right");
    if 0 < summary.waves {
        text += &format!("; {} % wave in a plane rather than coil", share(summary.waves));
    }
    text += ". ";
    if 0 < summary.switchbacks {
        text += &format!("There are {} switchbacks. ", count(summary.switchbacks));
    }
    let company = study.wisps.in_company();
    if 0 < company {
        let sizes = study.wisps.size().map_or(String::new(), |q| {
            format!(" of {} strands (the largest of {})", short(q.median), short(q.max))
        });
        text += &format!("{} % of the strands run in wisps{sizes}.", share(company));
    }
    page.paragraph(&text);
}

fn problems(study: &Study, page: &mut Page) {
    page.heading("Problems in the file");
    let defects = &study.defects;
    if defects.is_empty() {
        page.good("None found.");
    }
    for (what, (n, first)) in &defects.strands {
        page.warning(&format!("{} strands {what}; the first is strand {first}.", count(*n)));
    }
    if 0 < defects.repeated_points {
        let n = count(defects.repeated_points);
        page.warning(&format!("{n} points stand where the point before them does."));
    }
    if let Some(first) = defects.first_long_segment {
        let n = count(defects.long_segments);
        page.warning(&format!(
            "{n} strands with a segment ten times as long as their others; the first is strand \
             {first}."
        ));
    }
}

fn numbers(study: &Study, page: &mut Page) {
    page.heading("In numbers");
    let (s, units) = (&study.summary, study.units);
    let doubled = |q: Option<Quantiles>| {
        q.map(|q| Quantiles {
            min: 2.0 * q.min,
            lower: 2.0 * q.lower,
            median: 2.0 * q.median,
            upper: 2.0 * q.upper,
            max: 2.0 * q.max,
        })
    };
    let rows: [(&str, Shown, Option<Quantiles>); 12] = [
        ("length", units.strand(), s.length),
        ("curl index (length over reach)", Units::none(), s.curl_index),
        ("turns", Units::none(), s.turns),
        ("turns a length of hair", units.per_length("turns"), s.turns_per_length),
        ("coil diameter", units.coil(), doubled(s.coil_radius)),
        ("pitch", units.coil(), s.pitch),
        ("turns a length of centerline", units.per_length("turns"), s.frequency),
        ("circularity (1 winds one way, 0 neither)", Units::none(), s.circularity),
        ("roundness (1 coil, 0 wave)", Units::none(), s.roundness),
        ("frizz (share of power finer than the coil)", Units::none(), s.frizz),
        ("phase-locked share of the length", Units::none(), study.locked()),
        ("strands in a wisp", Units::none(), study.wisps.size()),
    ];
    let row = |(name, shown, quantiles): &(&str, Shown, Option<Quantiles>)| {
        let mut cells = vec![(*name).to_owned(), shown.name.clone()];
        if let Some(q) = quantiles {
            let all = [q.min, q.lower, q.median, q.upper, q.max];
            cells.extend(all.map(|v| short(v * shown.factor)));
        }
        cells
    };
    let head =
        ["quantity", "unit", "least", "a quarter below", "median", "a quarter above", "most"];
    page.table(&head, &rows.iter().map(row).collect::<Vec<_>>());
}

fn switchbacks(study: &Study, page: &mut Page) {
    let all = &study.analysis.switchbacks;
    if all.is_empty() {
        return;
    }
    page.heading("Switchbacks");
    let shown = study.units.strand();
    let hand = |hand: Hand| match hand {
        Hand::Right => "right",
        Hand::Left => "left",
        Hand::Neither => "neither",
    };
    let row = |s: &tress::analysis::Switchback| {
        let at = short(s.arc_length * shown.factor);
        let hands = format!("{} to {}", hand(s.before), hand(s.behind));
        vec![s.strand.to_string(), at, hands, short(s.confidence)]
    };
    let rows: Vec<Vec<String>> = all.iter().take(LISTED).map(row).collect();
    let from_root = shown.titled("from the root");
    page.table(&["strand", &from_root, "hand", "confidence"], &rows);
    if LISTED < all.len() {
        page.note(&format!("{} more are in the tables.", count(all.len() - LISTED)));
    }
}
