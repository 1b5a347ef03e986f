//! Sculpting: strands drawn to anchors, once or while something is dragged.

use std::collections::BTreeMap;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::{Deserialize, Serialize};
use tress::geometry::HelixGroom as Inner;
use tress::geometry::Strands;
use tress::geometry::glam::DVec3;
use tress::optimize::{
    Adam, ArmatureOptions, Clustering, Control, Pose, SculptOptions, Sculpted, Solver, Stiffness,
    Stop, apply_pose,
};

use crate::arrays::{indices, scalars, vectors, whole_counts};
use crate::error::{TressError, refused};
use crate::groom::Groom;
use crate::helix_groom::HelixGroom;
use crate::plain::{data, report};

/// The keywords that say how strands are moved.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SculptKeywords {
    stiffness: Option<f64>,
    c: Option<f64>,
    bend_weights: [f64; 3],
    tip_weight: f64,
    solver: Optimiser,
    tolerance: f64,
    max_iterations: usize,
    continuation: f64,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Optimiser {
    Lm,
    Adam,
}

impl Default for SculptKeywords {
    fn default() -> Self {
        let defaults = SculptOptions::default();
        Self {
            stiffness: None,
            c: None,
            bend_weights: defaults.weights.to_array(),
            tip_weight: defaults.tip_weight,
            solver: Optimiser::Lm,
            tolerance: defaults.tolerance,
            max_iterations: defaults.max_iterations,
            continuation: defaults.continuation,
        }
    }
}

impl SculptKeywords {
    fn options(&self) -> PyResult<SculptOptions> {
        let stiffness = match (self.stiffness, self.c) {
            (None, None) => SculptOptions::default().stiffness,
            (Some(stiffness), None) => Stiffness::Relative(stiffness),
            (None, Some(c)) => Stiffness::Raw(c),
            (Some(_), Some(_)) => {
                return Err(PyTypeError::new_err("expected stiffness or c, not both"));
            }
        };
        let solver = match self.solver {
            Optimiser::Lm => Solver::LevenbergMarquardt,
            Optimiser::Adam => Solver::Adam(Adam::default()),
        };
        let Self { tip_weight, tolerance, max_iterations, continuation, .. } = *self;
        Ok(SculptOptions {
            stiffness,
            weights: DVec3::from_array(self.bend_weights),
            tip_weight,
            solver,
            tolerance,
            max_iterations,
            continuation,
        })
    }
}

/// Where strands should go: a pose, or points put somewhere one by one.
struct Targets {
    pose: Option<Pose>,
    anchors: Vec<(usize, f64, DVec3, f64)>,
}

impl Targets {
    /// From the arguments of Python, which are a pose or arrays of one row an anchor.
    fn new(
        pose: Option<&Bound<'_, PyAny>>,
        arrays: [Option<&Bound<'_, PyAny>>; 4],
        n_strands: usize,
    ) -> PyResult<Self> {
        let (pose, [strands, at, anchors, weights]) = match (pose, arrays) {
            (Some(pose), [None, None, None, None]) => {
                let pose = Some(data(pose, "pose")?);
                return Ok(Self { pose, anchors: Vec::new() });
            }
            (pose, arrays) => (pose, arrays),
        };
        let (None, Some(strands), Some(at), Some(anchors)) = (pose, strands, at, anchors) else {
            let message = "expected a pose, or strands, at and anchors";
            return Err(PyTypeError::new_err(message));
        };
        let strands = indices(strands, "strands", n_strands)?;
        let (at, anchors) = (scalars(at, "at")?, vectors(anchors, "anchors")?);
        let weights = match weights {
            Some(weights) => scalars(weights, "weights")?,
            None => vec![1.0; strands.len()],
        };
        let sizes = [at.len(), anchors.len(), weights.len()];
        if sizes.iter().any(|&n| n != strands.len()) {
            let [at, anchors, weights] = sizes;
            let strands = strands.len();
            return Err(TressError::new_err(format!(
                "{strands} strands, {at} places at them, {anchors} anchors and {weights} weights"
            )));
        }
        let rows = strands.into_iter().zip(at).zip(anchors).zip(weights);
        let anchors = rows.map(|(((strand, at), anchor), weight)| (strand, at, anchor, weight));
        Ok(Self { pose: None, anchors: anchors.collect() })
    }

    /// The controls of all strands; places along strands are in parts of their lengths.
    fn controls(&self, groom: &Inner) -> PyResult<Strands<Control>> {
        if let Some(pose) = &self.pose {
            return apply_pose(groom, pose).map_err(refused);
        }
        let mut of_strands = vec![Vec::new(); groom.len()];
        for &(strand, at, anchor, weight) in &self.anchors {
            let arc_length = at * groom.strand(strand).length();
            of_strands[strand].push(Control { arc_length, anchor, weight });
        }
        let mut controls = Strands::default();
        for strand in of_strands {
            controls.push(strand).map_err(refused)?;
        }
        Ok(controls)
    }
}

/// What became of a groom, as a dictionary.
#[derive(Serialize)]
struct Words {
    moved: usize,
    free: usize,
    kept: usize,
    not_finite: usize,
    greatest_anchor_distance: f64,
    worst_strand: Option<usize>,
    unreachable: usize,
    iterations: u64,
    energy_before: f64,
    energy_after: f64,
    stops: BTreeMap<&'static str, usize>,
}

impl Words {
    fn of(sculpted: &Sculpted) -> Self {
        let all = sculpted.summary();
        Self {
            moved: all.strands,
            free: sculpted.free,
            kept: sculpted.kept,
            not_finite: sculpted.not_finite,
            greatest_anchor_distance: all.worst.map_or(0.0, |(_, distance)| distance),
            worst_strand: all.worst.map(|(strand, _)| strand),
            unreachable: all.unreachable,
            iterations: all.iterations.0,
            energy_before: all.start.total(),
            energy_after: all.end.total(),
            stops: all.stops.iter().map(|(stop, n)| (name(*stop), *n)).collect(),
        }
    }
}

fn name(stop: Stop) -> &'static str {
    match stop {
        Stop::Converged => "converged",
        Stop::LocalMinimum => "local-minimum",
        Stop::NoDescent => "no-descent",
        Stop::MaxIterations => "max-iterations",
        Stop::Residual => "residual",
        Stop::NoImprovement => "no-improvement",
    }
}

/// The armature of a groom at rest: for each cluster of strands a chain of joints.
///
/// Args:
///     helices: The groom.
///     clusters: How many clusters of strands, by root and tip.
///     lengths: Where joints are, in parts of the strands' lengths, ascending.
///     seed: Where the clustering starts.
///     blend: How far a strand is also moved by other clusters than its own, from 0.
///
/// Returns:
///     A pose in which nothing is moved: a dictionary with "groups", each with "joints", whose
///     "translate", "rotate" (degrees about x, then y, then z) and "scale" are there to be changed
///     before the pose goes to `sculpt`.
#[pyfunction]
#[pyo3(signature = (helices, *, clusters=8, lengths=None, seed=0, blend=0.0),
       text_signature = "(helices, *, clusters=8, lengths=(1/3, 2/3, 1), seed=0, blend=0.0)")]
pub(crate) fn armature<'py>(
    py: Python<'py>,
    helices: &Bound<'_, HelixGroom>,
    clusters: usize,
    lengths: Option<&Bound<'_, PyAny>>,
    seed: u64,
    blend: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let lengths = match lengths {
        Some(lengths) => scalars(lengths, "lengths")?,
        None => ArmatureOptions::default().lengths,
    };
    let options =
        ArmatureOptions { clusters: Clustering { count: clusters, seed, blend }, lengths };
    let helices = &helices.get().0;
    let pose = py.detach(|| tress::optimize::armature(helices, &options)).map_err(refused)?;
    report(py, &pose)
}

/// Moves strands to anchors by bending them as little as possible; no strand gets longer.
///
/// Args:
///     helices: The groom as it is.
///     pose: What moves strands: a dictionary as `armature` gives, or the text of a pose in RON.
///     strands, at, anchors, weights: Instead of a pose, one row for each point that is put
///         somewhere: its strand, where it is on it in parts of its length, where it should go
///         (n, 3), and how much it matters (1 where not given).
///     stiffness: What bending costs, whatever the unit: 0 meets every anchor, 1 hardly bends;
///         1e-4 where nothing is said.
///     c: Instead: the published constant, in the fourth power of the unit.
///     bend_weights: How dear a change of each of k0, k1, k2 is.
///     tip_weight: How dear a change at the tip is, in parts of one at the root.
///     solver: "lm", or "adam" as published for comparison.
///     tolerance, max_iterations, continuation: When a strand is done, when the solver gives up,
///         and how far anchors move in one step, in parts of the strand's extent.
///
/// Returns:
///     The sculpted HelixGroom, and a report: "moved", "free", "greatest_anchor_distance",
///     "unreachable", "iterations", "stops" and more.
#[pyfunction]
#[pyo3(signature = (helices, pose=None, *, strands=None, at=None, anchors=None, weights=None,
                    **options),
       text_signature = "(helices, pose=None, *, strands=None, at=None, anchors=None, \
                         weights=None, stiffness=None, c=None, bend_weights=(0.1, 1, 1), \
                         tip_weight=0.15, solver='lm', tolerance=1e-6, max_iterations=200, \
                         continuation=0.25)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords of Python")]
pub(crate) fn sculpt<'py>(
    py: Python<'py>,
    helices: &Bound<'_, HelixGroom>,
    pose: Option<&Bound<'_, PyAny>>,
    strands: Option<&Bound<'_, PyAny>>,
    at: Option<&Bound<'_, PyAny>>,
    anchors: Option<&Bound<'_, PyAny>>,
    weights: Option<&Bound<'_, PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(HelixGroom, Bound<'py, PyAny>)> {
    let keywords: SculptKeywords = crate::plain::options(options)?;
    let options = keywords.options()?;
    let helices = &helices.get().0;
    let targets = Targets::new(pose, [strands, at, anchors, weights], helices.len())?;
    let (groom, sculpted) = py.detach(|| -> PyResult<_> {
        let controls = targets.controls(helices)?;
        let mut groom = helices.clone();
        let sculpted = tress::optimize::sculpt(&mut groom, &controls, &options).map_err(refused)?;
        Ok((groom, sculpted))
    })?;
    Ok((HelixGroom(groom), report(py, &Words::of(&sculpted))?))
}

/// Sculpts a groom again and again from the same rest, each time from where the last call left it:
/// what an interactive tool does while a joint is dragged.
///
/// Args:
///     helices: The groom at rest.
///     stiffness, c, bend_weights, tip_weight, solver, tolerance, max_iterations, continuation: As
///         for `sculpt`.
///
/// Example:
///     >>> sculptor = tress.Sculptor(helices)
///     >>> sculptor.sculpt(strands=[0], at=[1.0], anchors=[[0, -3, 1]])
///     >>> positions = sculptor.sample(counts).positions
#[pyclass(module = "tress")]
#[derive(Debug)]
pub(crate) struct Sculptor(tress::optimize::Sculptor);

#[pymethods]
impl Sculptor {
    #[new]
    #[pyo3(signature = (helices, **options),
           text_signature = "(helices, *, stiffness=None, c=None, bend_weights=(0.1, 1, 1), \
                             tip_weight=0.15, solver='lm', tolerance=1e-6, max_iterations=200, \
                             continuation=0.25)")]
    fn new(helices: &Bound<'_, HelixGroom>, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let keywords: SculptKeywords = crate::plain::options(options)?;
        let rest = helices.get().0.clone();
        tress::optimize::Sculptor::new(rest, keywords.options()?).map(Self).map_err(refused)
    }

    /// The groom as it was given.
    #[getter]
    fn rest(&self) -> HelixGroom {
        HelixGroom(self.0.rest().clone())
    }

    /// The groom as the last call left it.
    #[getter]
    fn pose(&self) -> HelixGroom {
        HelixGroom(self.0.pose().clone())
    }

    /// Draws strands to where a pose or anchors put them, from the last pose on; strands that
    /// neither moves go back to rest. The arguments are those of the function `sculpt`.
    #[pyo3(signature = (pose=None, *, strands=None, at=None, anchors=None, weights=None))]
    fn sculpt<'py>(
        &mut self,
        py: Python<'py>,
        pose: Option<&Bound<'_, PyAny>>,
        strands: Option<&Bound<'_, PyAny>>,
        at: Option<&Bound<'_, PyAny>>,
        anchors: Option<&Bound<'_, PyAny>>,
        weights: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let inner = &mut self.0;
        let targets = Targets::new(pose, [strands, at, anchors, weights], inner.rest().len())?;
        let sculpted = py.detach(|| {
            let controls = targets.controls(inner.rest())?;
            inner.sculpt(&controls).map_err(refused)
        })?;
        report(py, &Words::of(&sculpted))
    }

    /// Polylines of the pose, with so many points for each strand.
    fn sample(&self, py: Python<'_>, counts: &Bound<'_, PyAny>) -> PyResult<Groom> {
        let counts = whole_counts(counts, "counts")?;
        let how = tress::fit::Sampling::Counts(&counts);
        py.detach(|| tress::fit::sample(self.0.pose(), &how)).map(Groom).map_err(refused)
    }
}
