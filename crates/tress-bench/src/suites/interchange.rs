//! Alembic and binary USD: how fast they are written, what comes back, and what Unreal's limit of
//! 255 points a strand costs coils.

use std::f64::consts::TAU;
use std::path::Path;

use tress::fit::{Elements, FitOptions, Sampling};
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, Strands, UpAxis};
use tress::io::unreal::{Placement, UnrealOptions, prepare};
use tress::io::{Frames, WriteError, WriteOptions};

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures};

use super::best_of;

pub(crate) const NAMES: &[&str] = &[
    "abc_write_seconds",
    "abc_read_seconds",
    "abc_round_trip",
    "abc_frames_seconds",
    "usdc_write_seconds",
    "usdc_read_seconds",
    "usdc_round_trip",
    "unreal_guides_error",
    "unreal_guides_error_uniform",
    "unreal_coil_error",
    "unreal_coil_error_uniform",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    let folder = tempfile::tempdir()?;
    let groom = grooms::groom("blender/bl_coily_10k.usdc", 10_000, 160)?;
    // What a million points may take to be read.
    let a_million = |seconds: f64| seconds * groom.strands().points().len() as f64 / 1e6;
    for (format, bar, reading) in
        [("abc", 0.1, Bar::None), ("usdc", 0.3, Bar::AtMost(a_million(0.2)))]
    {
        let path = folder.path().join(format!("groom.{format}"));
        let write = || tress::io::write(&path, &groom, &WriteOptions::default());
        figures.add(&format!("{format}_write_seconds"), best_of(5, write)?, "s", Bar::AtMost(bar));
        let read = best_of(3, || tress::io::read(&path))?;
        figures.add(&format!("{format}_read_seconds"), read, "s", reading);
        let error = round_trip(&groom, &path)?;
        figures.add(&format!("{format}_round_trip"), error, "of its size", Bar::AtMost(1e-6));
    }
    let path = folder.path().join("wind.abc");
    let frames = best_of(1, || {
        let grooms = (0..10).map(|_| Ok::<_, WriteError>(groom.clone()));
        tress::io::write_animation(&path, Frames::default(), &WriteOptions::default(), grooms)
    })?;
    figures.add("abc_frames_seconds", frames, "s", Bar::None);
    unreal(figures)
}

/// The greatest error of a position over the greatest coordinate; strands and their order must be
/// the same.
fn round_trip(groom: &Groom, path: &Path) -> Outcome<f64> {
    let up = groom.up.unwrap_or(UpAxis::Y);
    let back = grooms::polylines(path)?.with_up(up);
    if back.strands().offsets() != groom.strands().offsets() {
        return Err(format!("{} has other strands", path.display()).into());
    }
    let points = groom.strands().points();
    let size = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let errors = points.iter().zip(back.strands().points()).map(|(a, b)| a.distance(*b));
    Ok(errors.fold(0.0, f64::max) / size)
}

/// The greatest error over the coil radius of the same strand, of guides and of a coil of 60 turns,
/// both known at far more than 255 points.
fn unreal(figures: &mut Figures) -> Outcome {
    let guides = grooms::groom("curlycue/curlycue_guides_f00.obj", 98, 108)?;
    let options = FitOptions { elements: Elements::Count(90), ..FitOptions::default() };
    let helices = tress::fit::fit(&guides, &options)?.helices;
    let radii: Vec<Option<f64>> = (0..helices.len())
        .map(|i| tress::analysis::measure(&helices.strand(i)).coil_radius)
        .collect();
    let guides = tress::fit::sample(&helices, &Sampling::Points(1500))?;
    let coil = (0..=60 * 40).map(|i| {
        let angle = f64::from(i) * TAU / 40.0;
        DVec3::new(angle.cos(), 0.3 * angle / TAU, angle.sin())
    });
    let coil = Groom::new(Strands::from_counts([60 * 40 + 1], coil.collect())?);
    for (name, groom, radii, bar) in
        [("guides", &guides, radii, 0.05), ("coil", &coil, vec![Some(1.0)], 0.15)]
    {
        for (suffix, placement, bar) in [
            ("", Placement::Curvature, Bar::AtMost(bar)),
            ("_uniform", Placement::Uniform, Bar::None),
        ] {
            let options = UnrealOptions { placement, ..UnrealOptions::default() };
            // The guides' unit is unknown, so that errors are in it.
            let (_, report) = prepare(&groom.clone().in_space(None, None), &options);
            let shares = report.errors.iter().zip(&radii);
            let shares = shares.filter_map(|(error, radius)| Some(error / (*radius)?));
            let name = format!("unreal_{name}_error{suffix}");
            figures.add(&name, shares.fold(0.0, f64::max), "coil radii", bar);
        }
    }
    Ok(())
}
