//! Polylines to super-helices.

use std::time::Instant;

use tress::fit::{Elements, FitOptions, Fitted, Refine, fit};
use tress::geometry::Groom;
use tress::io::WriteOptions;

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures, say};
use crate::process;

pub(crate) const NAMES: &[&str] = &[
    "fit_guides_rms_n40",
    "fit_guides_rms_n90",
    "fit_guides_rms_n108",
    "fit_guides_greatest_n90",
    "fit_guides_length_n90",
    "fit_guides_direct_rms_n90",
    "fit_10k_seconds",
    "fit_10k_direct_seconds",
    "fit_10k_rms",
    "fit_strand_us_1k",
    "fit_strand_us_10k",
    "fit_strand_us_100k",
    "memory_peak_ratio_fit",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    guides(figures)?;
    head(figures)?;
    linear(figures)
}

fn fitted(groom: &Groom, n: usize, refine: Option<Refine>) -> Outcome<Fitted> {
    let elements = Elements::Count(n);
    Ok(fit(groom, &FitOptions { elements, refine, ..FitOptions::default() })?)
}

/// The 98 coily guides: how near, and how length changes.
fn guides(figures: &mut Figures) -> Outcome {
    let guides = grooms::groom("curlycue/curlycue_guides_f00.obj", 98, 108)?;
    for (n, bar) in [(40, 0.058), (90, 0.0153), (108, 0.012)] {
        let deviation = fitted(&guides, n, Some(Refine::default()))?.report.deviation;
        let name = format!("fit_guides_rms_n{n}");
        figures.add(&name, deviation.rms, "unit", Bar::AtMost(bar));
        if n == 90 {
            let percent = 100.0 * deviation.length_change;
            figures.add("fit_guides_greatest_n90", deviation.greatest, "unit", Bar::None);
            figures.add("fit_guides_length_n90", percent, "%", Bar::AtMost(0.1));
        }
    }
    let direct = fitted(&guides, 90, None)?.report.deviation;
    figures.add("fit_guides_direct_rms_n90", direct.rms, "unit", Bar::None);
    Ok(())
}

/// Ten thousand strands of 160 points to 90 elements, as a whole process and in memory.
fn head(figures: &mut Figures) -> Outcome {
    let folder = tempfile::tempdir()?;
    let input = match grooms::real("blender/bl_coily_10k.usdc") {
        Some(path) => path,
        None => {
            say("# bl_coily_10k.usdc is not there: measured on 10,000 generated strands");
            let path = folder.path().join("head.hair");
            tress::io::write(&path, &grooms::generated(10_000, 160), &WriteOptions::default())?;
            path
        }
    };
    let output = folder.path().join("head.tress");
    let (from, to) = (input.to_string_lossy(), output.to_string_lossy());
    let program = process::program()?;
    let taken = process::best(&program, &["fit", &from, &to, "--elements", "90"], 2)?;
    figures.add("fit_10k_seconds", taken.seconds, "s", Bar::AtMost(5.0));
    if let Some(peak) = taken.peak {
        // In memory, 24 bytes a point come in and 32 an element go out.
        let groom = grooms::polylines(&input)?;
        let bytes = 24 * groom.strands().points().len() + 32 * 90 * groom.strands().len();
        figures.add("memory_peak_ratio_fit", peak / bytes as f64, "", Bar::AtMost(3.0));
    }
    let groom = grooms::polylines(&input)?;
    figures.add(
        "fit_10k_rms",
        fitted(&groom, 90, Some(Refine::default()))?.report.deviation.rms,
        "unit",
        Bar::None,
    );
    let direct = super::best_of(3, || fitted(&groom, 90, None))?;
    figures.add("fit_10k_direct_seconds", direct, "s", Bar::AtMost(0.5));
    Ok(())
}

/// Time a strand does not grow with the number of strands.
fn linear(figures: &mut Figures) -> Outcome {
    for (name, strands) in [("1k", 1_000), ("10k", 10_000), ("100k", 100_000)] {
        let groom = grooms::generated(strands, 60);
        let started = Instant::now();
        fitted(&groom, 40, Some(Refine::default()))?;
        let each = 1e6 * started.elapsed().as_secs_f64() / strands as f64;
        figures.add(&format!("fit_strand_us_{name}"), each, "us", Bar::None);
    }
    Ok(())
}
