//! What curvatures say: summaries, quantities, defects.

use std::collections::BTreeMap;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use tress::analysis::{Hand, Quantity, QuantityValues, StrandMeasures};

use crate::error::refused;
use crate::groom::Groom;
use crate::helix_groom::HelixGroom;
use crate::plain::report;

/// A groom in a few numbers: strands, hands, and the least, quartiles and greatest of arc lengths,
/// turns and coil radii, as a dictionary; None where no strand has a value.
#[pyfunction]
pub(crate) fn summarize<'py>(
    py: Python<'py>,
    helices: &Bound<'_, HelixGroom>,
) -> PyResult<Bound<'py, PyAny>> {
    let helices = &helices.get().0;
    report(py, &py.detach(|| tress::analysis::summarize(helices)))
}

/// The values of a quantity, NaN where there is none.
///
/// Args:
///     helices: The groom.
///     name: Of strands "radius", "turns", "length" or "handedness" (1 right, -1 left, 0 neither);
///         of joints "curvature" or "twist".
///
/// Returns:
///     One number a strand or one a joint.
#[pyfunction]
pub(crate) fn quantity<'py>(
    py: Python<'py>,
    helices: &Bound<'_, HelixGroom>,
    name: &str,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let of: Quantity = name.parse().map_err(refused)?;
    let helices = &helices.get().0;
    let values = py.detach(|| match tress::analysis::quantity(helices, of) {
        QuantityValues::Strands(values) | QuantityValues::Joints(values) => values,
    });
    Ok(values.into_pyarray(py))
}

/// What is measured on each strand, as a dictionary of arrays with one row a strand: "length",
/// "reach", "turns", "coil_radius" (NaN where there is no coil), "hand" (1 right, -1 left, 0
/// neither) and "hand_balance".
#[pyfunction]
pub(crate) fn measure<'py>(
    py: Python<'py>,
    helices: &Bound<'_, HelixGroom>,
) -> PyResult<Bound<'py, PyDict>> {
    let helices = &helices.get().0;
    let all: Vec<StrandMeasures> =
        py.detach(|| helices.iter().map(|strand| tress::analysis::measure(&strand)).collect());
    let named = PyDict::new(py);
    let column = |of: fn(&StrandMeasures) -> f64| -> Vec<f64> { all.iter().map(of).collect() };
    named.set_item("length", column(|m| m.length).into_pyarray(py))?;
    named.set_item("reach", column(|m| m.reach).into_pyarray(py))?;
    named.set_item("turns", column(|m| m.turns).into_pyarray(py))?;
    let radii = column(|m| m.coil_radius.unwrap_or(f64::NAN));
    named.set_item("coil_radius", radii.into_pyarray(py))?;
    let hands = all.iter().map(|m| match m.hand {
        Hand::Right => 1_i64,
        Hand::Left => -1,
        Hand::Neither => 0,
    });
    named.set_item("hand", hands.collect::<Vec<_>>().into_pyarray(py))?;
    named.set_item("hand_balance", column(|m| m.hand_balance).into_pyarray(py))?;
    Ok(named)
}

/// Defects as a dictionary.
#[derive(Serialize)]
struct Words {
    strands: BTreeMap<&'static str, Seen>,
    repeated_points: usize,
    long_segments: usize,
    first_long_segment: Option<usize>,
}

/// How often a defect was seen, and where first.
#[derive(Serialize)]
struct Seen {
    count: usize,
    first: usize,
}

/// What is wrong with polylines.
///
/// Returns:
///     A dictionary: "strands" that no curve can be fitted to, by reason how many ("count") and
///     which is the "first"; "repeated_points"; "long_segments" and "first_long_segment".
#[pyfunction]
pub(crate) fn defects<'py>(
    py: Python<'py>,
    groom: &Bound<'_, Groom>,
) -> PyResult<Bound<'py, PyAny>> {
    let groom = &groom.get().0;
    let found = py.detach(|| tress::analysis::defects(groom));
    let strands = found.strands.iter();
    let strands = strands.map(|(reason, &(count, first))| (*reason, Seen { count, first }));
    let words = Words {
        strands: strands.collect(),
        repeated_points: found.repeated_points,
        long_segments: found.long_segments,
        first_long_segment: found.first_long_segment,
    };
    report(py, &words)
}
