//! Edits of curvatures: ruffle, blend, recoil.

use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Deserialize;
use tress::edit::{BlendSpace, Grouping, RecoilKeep, RecoilOptions, RuffleOptions};

use crate::arrays::{Shaped, integers};
use crate::error::{TressError, refused};
use crate::groom::Groom;
use crate::helix_groom::HelixGroom;
use crate::plain::report;

/// Which strands belong together.
///
/// Args:
///     helices: The groom.
///     attribute: Strands with the same value of this attribute of strands belong together.
///     clusters: Instead: so many clusters of strands whose roots and tips are near each other.
///     seed: Where the clustering starts.
///
/// Returns:
///     A number for each strand; 0 for all where nothing is said.
#[pyfunction]
#[pyo3(signature = (helices, *, attribute=None, clusters=None, seed=0))]
pub(crate) fn groups<'py>(
    py: Python<'py>,
    helices: &Bound<'_, HelixGroom>,
    attribute: Option<String>,
    clusters: Option<usize>,
    seed: u64,
) -> PyResult<Bound<'py, PyArray1<u32>>> {
    let grouping = match (attribute, clusters) {
        (None, None) => Grouping::Whole,
        (Some(name), None) => Grouping::Attribute(name),
        (None, Some(clusters)) => Grouping::Clusters(clusters),
        (Some(_), Some(_)) => {
            return Err(PyTypeError::new_err("expected attribute or clusters, not both"));
        }
    };
    let helices = &helices.get().0;
    let groups = py.detach(|| tress::edit::groups(helices, &grouping, seed)).map_err(refused)?;
    Ok(groups.into_pyarray(py))
}

/// Lets strands of a group exchange elements: real curl in another order.
///
/// Args:
///     helices: The groom.
///     groups: A number for each strand, as `groups` gives; all are one group where None.
///     probability: Chance of an element to be replaced, 0 to 1.
///     keep: Elements at the root that are never replaced.
///     blend: From the groom as it is (0) to the ruffled one (1).
///     seed: The same seed gives the same groom, on any number of threads.
///
/// Returns:
///     The ruffled HelixGroom, and a report: "groups", "alone", "untouched", "candidates",
///     "replaced", "unequal".
#[pyfunction]
#[pyo3(signature = (helices, groups=None, *, seed=0, **options),
       text_signature = "(helices, groups=None, *, probability=0.05, keep=30, blend=1.0, seed=0)")]
pub(crate) fn ruffle<'py>(
    py: Python<'py>,
    helices: &Bound<'_, HelixGroom>,
    groups: Option<&Bound<'_, PyAny>>,
    seed: u64,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(HelixGroom, Bound<'py, PyAny>)> {
    let options: RuffleOptions = crate::plain::options(options)?;
    let helices = &helices.get().0;
    let groups = match groups {
        None => vec![0; helices.len()],
        Some(groups) => numbers(groups)?,
    };
    let ruffled = py.detach(|| tress::edit::ruffle(helices, &groups, &options, seed));
    let (ruffled, done) = ruffled.map_err(refused)?;
    Ok((HelixGroom(ruffled), report(py, &done)?))
}

/// Group numbers, each from 0 to 2^32 - 1.
pub(crate) fn numbers(groups: &Bound<'_, PyAny>) -> PyResult<Vec<u32>> {
    let Shaped { values, .. } = integers(groups, "groups")?;
    let narrow = |n: i64| {
        let message = || format!("groups: {n} is outside 0 to 4,294,967,295");
        u32::try_from(n).map_err(|_| TressError::new_err(message()))
    };
    values.into_iter().map(narrow).collect()
}

/// A groom between two grooms, or beyond them.
///
/// Args:
///     a: A HelixGroom, or a Groom for space="position".
///     b: Another with as many strands, and as many elements or points in each.
///     amount: From a (0) to b (1).
///     space: What is mixed: "curvature", in which a coil between two coils is a coil; "darboux"
///         or "position", in which opposite bends cancel.
///
/// Returns:
///     A groom of the same class, with the attributes of a.
#[pyfunction]
#[pyo3(signature = (a, b, amount=0.5, *, space="curvature"))]
pub(crate) fn blend<'py>(
    py: Python<'py>,
    a: &Bound<'py, PyAny>,
    b: &Bound<'py, PyAny>,
    amount: f64,
    space: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let space = match space {
        "curvature" => BlendSpace::Curvature,
        "darboux" => BlendSpace::Darboux,
        "position" => {
            let (a, b) = (a.cast::<Groom>()?.get(), b.cast::<Groom>()?.get());
            let blended = py.detach(|| tress::edit::blend_positions(&a.0, &b.0, amount));
            return Ok(Bound::new(py, Groom(blended.map_err(refused)?))?.into_any());
        }
        other => {
            return Err(TressError::new_err(format!(
                "space: expected \"curvature\", \"darboux\" or \"position\", found {other:?}"
            )));
        }
    };
    let (a, b) = (a.cast::<HelixGroom>()?.get(), b.cast::<HelixGroom>()?.get());
    let blended = py.detach(|| tress::edit::blend(&a.0, &b.0, amount, space));
    Ok(Bound::new(py, HelixGroom(blended.map_err(refused)?))?.into_any())
}

/// The keywords of [`recoil`].
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct RecoilKeywords {
    radius: f64,
    frequency: f64,
    keep: Keep,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum Keep {
    Length,
    Turns,
    Advance,
    Centerline,
}

impl Default for RecoilKeywords {
    fn default() -> Self {
        Self { radius: 1.0, frequency: 1.0, keep: Keep::Length }
    }
}

/// Changes coils: tighter or looser, wider or narrower.
///
/// Args:
///     helices: The groom.
///     radius: Factor of the coil radius.
///     frequency: Factor of the spatial frequency, the turns in a length of axis.
///     keep: What stays: "length" of arcs, "turns", "advance" along the axis, or "centerline": the
///         advance, and strands brought back to the lines that they wound about.
///
/// Strands kept as polylines stay as they are.
#[pyfunction]
#[pyo3(signature = (helices, **options),
       text_signature = "(helices, *, radius=1.0, frequency=1.0, keep='length')")]
pub(crate) fn recoil(
    py: Python<'_>,
    helices: &Bound<'_, HelixGroom>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<HelixGroom> {
    let RecoilKeywords { radius, frequency, keep } = crate::plain::options(options)?;
    let centerline = keep == Keep::Centerline;
    let keep = match keep {
        Keep::Length => RecoilKeep::Length,
        Keep::Turns => RecoilKeep::Turns,
        Keep::Advance | Keep::Centerline => RecoilKeep::Advance,
    };
    let options = RecoilOptions { radius, frequency, keep };
    let helices = &helices.get().0;
    py.detach(|| {
        let mut changed = tress::edit::recoil(helices, &options).map_err(refused)?;
        if centerline {
            tress::optimize::hold_centerlines(helices, &mut changed).map_err(refused)?;
        }
        Ok(HelixGroom(changed))
    })
}
