//! Switchbacks: coils that change hands.

use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tress::switchback::{
    DoubleSwitchback, InsertOptions, Material, Placing, Profile, Ritz, RitzOptions, Switchback,
    material_curvature,
};

use crate::arrays::scalars;
use crate::edit::numbers;
use crate::error::{TressError, refused};
use crate::helix_groom::HelixGroom;
use crate::plain::report;

/// Puts switchbacks into strands: from there on they wind the other way.
///
/// Args:
///     helices: The groom.
///     groups: The wisp of each strand; strands of a wisp get theirs at the same places. All are
///         one where None.
///     arc_lengths: Where: at these arc lengths from the root; or
///     shares: at these shares, 0 to 1, of the wisp's median length; or
///     density: at random, so many in a unit of arc length.
///     seed: What random places are drawn from.
///     poisson_ratio: Of the hair.
///     share: How much of the coil's curvature a switchback may still be off at its ends.
///     elements_per_turn: Elements to a turn within a switchback.
///
/// Returns:
///     The HelixGroom, whose strands may have other numbers of elements, and a report: "placed"
///     (pairs of strand and switchback), "strands", "asked", "no_room", "no_coil", "most_needed".
#[pyfunction]
#[pyo3(signature = (helices, groups=None, *, arc_lengths=None, shares=None, density=None, seed=0,
                    **options),
       text_signature = "(helices, groups=None, *, arc_lengths=None, shares=None, density=None, \
                         seed=0, poisson_ratio=0.4, share=0.05, elements_per_turn=24)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords of Python")]
pub(crate) fn insert_switchbacks<'py>(
    py: Python<'py>,
    helices: &Bound<'_, HelixGroom>,
    groups: Option<&Bound<'_, PyAny>>,
    arc_lengths: Option<&Bound<'_, PyAny>>,
    shares: Option<&Bound<'_, PyAny>>,
    density: Option<f64>,
    seed: u64,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(HelixGroom, Bound<'py, PyAny>)> {
    let options: InsertOptions = crate::plain::options(options)?;
    let placing = match (arc_lengths, shares, density) {
        (Some(places), None, None) => Placing::ArcLengths(scalars(places, "arc_lengths")?),
        (None, Some(shares), None) => Placing::Shares(scalars(shares, "shares")?),
        (None, None, Some(density)) => Placing::Density(density),
        _ => return Err(PyTypeError::new_err("expected one of arc_lengths, shares and density")),
    };
    let helices = &helices.get().0;
    let groups = groups.map(numbers).transpose()?.unwrap_or_else(|| vec![0; helices.len()]);
    let (groom, told) = py
        .detach(|| tress::switchback::insert(helices, &groups, &placing, &options, seed))
        .map_err(refused)?;
    Ok((HelixGroom(groom), report(py, &told)?))
}

/// The material curvatures of a switchback in equilibrium, in units of the rest curvature.
///
/// Args:
///     v: Frequency of the coils on either side, within -1 to 1: right-handed before the switchback
///         where positive.
///     arc_lengths: Where, from the middle of the switchback, in units of the rest radius.
///     poisson_ratio, rest_twist: Of the hair.
///     method: "exact", the equilibrium solved; "double", that of two switchbacks at once, an S
///         that gives the first hand back; "ritz", the published approximation of the first.
///
/// Returns:
///     `(k0, k1, k2)` at each arc length, (n, 3).
#[pyfunction]
#[pyo3(signature = (v, arc_lengths, *, poisson_ratio=0.4, rest_twist=0.0, method="exact"))]
pub(crate) fn switchback<'py>(
    py: Python<'py>,
    v: f64,
    arc_lengths: &Bound<'_, PyAny>,
    poisson_ratio: f64,
    rest_twist: f64,
    method: &str,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let arc_lengths = scalars(arc_lengths, "arc_lengths")?;
    let material = Material { poisson_ratio, rest_twist };
    let curvatures = py.detach(|| match method {
        "exact" => Ok(along(&Switchback::new(v, &material).map_err(refused)?, &arc_lengths)),
        "double" => Ok(along(&DoubleSwitchback::new(v, &material).map_err(refused)?, &arc_lengths)),
        "ritz" => {
            let ritz = Ritz::new(v, &material, &RitzOptions::default()).map_err(refused)?;
            Ok(along(&ritz, &arc_lengths))
        }
        other => Err(TressError::new_err(format!(
            "method: expected \"exact\", \"double\" or \"ritz\", found {other:?}"
        ))),
    })?;
    curvatures.into_pyarray(py).reshape([arc_lengths.len(), 3])
}

/// Material curvatures at arc lengths, row after row.
fn along(profile: &impl Profile, arc_lengths: &[f64]) -> Vec<f64> {
    let at = |&s: &f64| material_curvature(profile.curvature(s)).to_array();
    arc_lengths.iter().flat_map(at).collect()
}
