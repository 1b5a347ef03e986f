//! Polylines to super-helices and back.

use std::collections::BTreeMap;
use std::sync::atomic::Ordering;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::{Deserialize, Serialize};
use tress::fit::{
    Deviation, Elements, FitOptions, FitReport, Floating, Refine, Sampling, TangentRule, Tolerance,
};

use crate::arrays::whole_counts;
use crate::error::refused;
use crate::groom::Groom;
use crate::helix_groom::HelixGroom;
use crate::plain::report;
use crate::progress::watched;

/// The keywords of [`fit`].
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct FitKeywords {
    elements: Option<usize>,
    tolerance: Option<f64>,
    tolerance_of_radius: Option<f64>,
    tangents: Tangents,
    floating: Floats,
    refine: bool,
    steps: usize,
    prior: f64,
    lengths: bool,
    root: bool,
    measure: bool,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Tangents {
    Uniform,
    Centripetal,
    Circle,
    Helix,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Floats {
    Points,
    Tangents,
}

impl Default for FitKeywords {
    fn default() -> Self {
        let Refine { steps, prior, lengths, root } = Refine::default();
        Self {
            elements: None,
            tolerance: None,
            tolerance_of_radius: None,
            tangents: Tangents::Helix,
            floating: Floats::Points,
            refine: true,
            steps,
            prior,
            lengths,
            root,
            measure: true,
        }
    }
}

impl FitKeywords {
    fn options(&self) -> PyResult<FitOptions> {
        let elements = match (self.elements, self.tolerance, self.tolerance_of_radius) {
            (None, None, None) => Elements::PerSegment,
            (Some(count), None, None) => Elements::Count(count),
            (None, Some(length), None) => Elements::Tolerance(Tolerance::Length(length)),
            (None, None, Some(share)) => Elements::Tolerance(Tolerance::OfRadius(share)),
            _ => {
                return Err(PyTypeError::new_err(
                    "expected one of elements, tolerance and tolerance_of_radius",
                ));
            }
        };
        let tangents = match self.tangents {
            Tangents::Uniform => TangentRule::Uniform,
            Tangents::Centripetal => TangentRule::Centripetal,
            Tangents::Circle => TangentRule::Circle,
            Tangents::Helix => TangentRule::Helix,
        };
        let floating = match self.floating {
            Floats::Points => Floating::Points,
            Floats::Tangents => Floating::Tangents,
        };
        let Self { steps, prior, lengths, root, measure, .. } = *self;
        let refine = self.refine.then_some(Refine { steps, prior, lengths, root });
        Ok(FitOptions { elements, tangents, floating, refine, measure })
    }
}

/// What a fit came to, as a dictionary.
#[derive(Serialize)]
struct Words {
    strands: usize,
    elements: usize,
    kept: BTreeMap<&'static str, usize>,
    #[serde(flatten)]
    deviation: Deviation,
}

impl Words {
    fn of(fit: &FitReport) -> Self {
        let kept = fit.kept.iter().map(|(reason, n)| (reason.describe(), *n)).collect();
        Self { strands: fit.strands, elements: fit.elements, kept, deviation: fit.deviation }
    }
}

/// Fits a super-helix to every strand.
///
/// Args:
///     groom: The polylines.
///     elements: Elements a strand; one a segment where nothing is said.
///     tolerance: Instead: as few elements as keep every point this near, in the groom's unit.
///     tolerance_of_radius: Instead: as few as keep every point within this share of the strand's
///         coil radius; 0.02 is 2 %.
///     tangents: How tangents at the points are found: "helix", "circle", "centripetal" or
///         "uniform".
///     floating: What moves to make neighbours co-helical: "points" or "tangents".
///     refine: Whether the arcs are refined against the points, which takes ten times as long.
///     steps, prior, lengths, root: The refinement's greatest number of steps, how strongly
///         neighbouring curvatures are held together, and whether lengths of elements and the
///         tangent at the root may change.
///     measure: Whether the report says how near the fit came.
///     progress: Called now and then with the share that is done, from 0 to 1.
///
/// Returns:
///     The HelixGroom, and a report: numbers of strands, elements and kept strands by reason, and
///     "rms", "greatest", "rms_of_radius", "length_change" and more of how far fit and input are
///     apart, in the groom's unit.
///
/// Example:
///     >>> helices, report = tress.fit(groom, elements=90)
///     >>> report["rms"], report["greatest"]
#[pyfunction]
#[pyo3(signature = (groom, *, progress=None, **options),
       text_signature = "(groom, *, elements=None, tolerance=None, tolerance_of_radius=None, \
                         tangents='helix', floating='points', refine=True, steps=8, prior=1e-3, \
                         lengths=True, root=True, measure=True, progress=None)")]
pub(crate) fn fit<'py>(
    py: Python<'py>,
    groom: &Bound<'_, Groom>,
    progress: Option<&Bound<'_, PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(HelixGroom, Bound<'py, PyAny>)> {
    let keywords: FitKeywords = crate::plain::options(options)?;
    let options = keywords.options()?;
    let groom = &groom.get().0;
    let fitted = watched(py, progress, groom.strands().len(), |done| {
        tress::fit::fit_with(groom, &options, |more| {
            done.fetch_add(more, Ordering::Relaxed);
        })
    })?;
    let fitted = fitted.map_err(refused)?;
    let words = report(py, &Words::of(&fitted.report))?;
    Ok((HelixGroom(fitted.helices), words))
}

/// The keywords of [`sample`].
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SampleKeywords {
    points: Option<usize>,
    spacing: Option<f64>,
    per_turn: Option<f64>,
}

/// Points a turn where nothing is said: a polyline of 16 points a turn is 2 % narrower than its
/// coil at worst.
const POINTS_PER_TURN: f64 = 16.0;

/// Polylines along super-helices, points even in arc length, root and tip included.
///
/// Args:
///     helices: The super-helices.
///     points: Points of every strand.
///     counts: Instead: points of each strand, as `groom.counts` of the groom that was fitted.
///     spacing: Instead: as many as bring neighbours no farther apart than this.
///     per_turn: Instead: so many in one turn of each strand's coil; 16 where nothing is said.
///
/// Strands kept as polylines come back as they are. Strand attributes are carried over, those of
/// joints interpolated to points.
///
/// Example:
///     >>> tress.sample(helices, counts=groom.counts)
#[pyfunction]
#[pyo3(signature = (helices, *, counts=None, **options),
       text_signature = "(helices, *, points=None, counts=None, spacing=None, per_turn=None)")]
pub(crate) fn sample(
    py: Python<'_>,
    helices: &Bound<'_, HelixGroom>,
    counts: Option<&Bound<'_, PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Groom> {
    let keywords: SampleKeywords = crate::plain::options(options)?;
    let counts = counts.map(|counts| whole_counts(counts, "counts")).transpose()?;
    let how = sampling(&keywords, counts.as_deref())?;
    let helices = &helices.get().0;
    py.detach(|| tress::fit::sample(helices, &how)).map(Groom).map_err(refused)
}

fn sampling<'a>(keywords: &SampleKeywords, counts: Option<&'a [usize]>) -> PyResult<Sampling<'a>> {
    match (keywords.points, counts, keywords.spacing, keywords.per_turn) {
        (None, None, None, None) => Ok(Sampling::PerTurn(POINTS_PER_TURN)),
        (Some(points), None, None, None) => Ok(Sampling::Points(points)),
        (None, Some(counts), None, None) => Ok(Sampling::Counts(counts)),
        (None, None, Some(spacing), None) => Ok(Sampling::Spacing(spacing)),
        (None, None, None, Some(n)) => Ok(Sampling::PerTurn(n)),
        _ => Err(PyTypeError::new_err("expected one of points, counts, spacing and per_turn")),
    }
}
