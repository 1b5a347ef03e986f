//! What curvatures say: summaries, quantities, defects.

use std::collections::BTreeMap;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use tress::analysis::{Analysis, Hand, Quantity, QuantityValues, StrandMeasures, Switchback};

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
///     name: Of strands "turns", "length" or "handedness" (1 right, -1 left, 0 neither); of joints
///         "radius", "curvature", "twist", "frequency", "pitch" or "beta".
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

/// Everything there is to know of a groom's curl.
///
/// Args:
///     groom: A Groom, or a HelixGroom, whose places are then its joints.
///
/// Returns:
///     A dictionary of arrays by name:
///     "strands", one row a strand, NaN where there is no coil or no curve: "length", "reach",
///     "turns", "coil_radius", "pitch", "frequency", "circularity", "hand" (1 right, -1 left, 0
///     neither), "hand_balance", "switchbacks", "frizz";
///     "along", one row a point or joint: "arc_length", "curvature", "twist", "radius", "pitch",
///     "frequency", "beta", "circularity";
///     "switchbacks", one row each: "strand", "arc_length", "before", "behind" (hands),
///     "confidence";
///     "spectrum", "frequency" in turns a unit of arc length and "share" of the power;
///     and "summary" as `summarize` gives it.
#[pyfunction]
pub(crate) fn analyze<'py>(
    py: Python<'py>,
    groom: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyDict>> {
    let analysis = if let Ok(helices) = groom.cast::<HelixGroom>() {
        let helices = &helices.get().0;
        py.detach(|| Analysis::of_helices(helices))
    } else {
        let groom = &groom.cast::<Groom>()?.get().0;
        py.detach(|| Analysis::of(groom))
    };
    let along = PyDict::new(py);
    for (name, values) in analysis.along.columns() {
        along.set_item(name, values.to_vec().into_pyarray(py))?;
    }
    let named = PyDict::new(py);
    named.set_item("strands", of_strands(py, &analysis.strands)?)?;
    named.set_item("along", along)?;
    named.set_item("switchbacks", of_switchbacks(py, &analysis.switchbacks)?)?;
    let (frequencies, shares): (Vec<f64>, Vec<f64>) =
        analysis.spectrum.shares().into_iter().unzip();
    let spectrum = PyDict::new(py);
    spectrum.set_item("frequency", frequencies.into_pyarray(py))?;
    spectrum.set_item("share", shares.into_pyarray(py))?;
    named.set_item("spectrum", spectrum)?;
    named.set_item("summary", report(py, &analysis.summary())?)?;
    Ok(named)
}

/// How far two grooms are apart.
///
/// Args:
///     a, b: Two Grooms in the same unit.
///
/// Returns:
///     A dictionary: "nearest", distances from each point of either to the other; "by_index",
///     distances of strands of the same index; "distributions", how far lengths, turns, coil radii
///     and more must move to be distributed as the other's; None where there is nothing to compare.
#[pyfunction]
pub(crate) fn compare<'py>(
    py: Python<'py>,
    a: &Bound<'_, Groom>,
    b: &Bound<'_, Groom>,
) -> PyResult<Bound<'py, PyAny>> {
    let (a, b) = (&a.get().0, &b.get().0);
    let comparison = py.detach(|| {
        let analyses = [a, b].map(Analysis::of);
        tress::analysis::compare([a, b], [&analyses[0], &analyses[1]])
    });
    report(py, &comparison)
}

fn of_strands<'py>(
    py: Python<'py>,
    strands: &[Option<StrandMeasures>],
) -> PyResult<Bound<'py, PyDict>> {
    type Of = fn(&StrandMeasures) -> f64;
    let columns: [(&str, Of); 11] = [
        ("length", |m| m.length),
        ("reach", |m| m.reach),
        ("turns", |m| m.turns),
        ("coil_radius", |m| m.coil_radius.unwrap_or(f64::NAN)),
        ("pitch", |m| m.pitch.unwrap_or(f64::NAN)),
        ("frequency", |m| m.frequency.unwrap_or(f64::NAN)),
        ("circularity", |m| m.circularity),
        ("hand", |m| f64::from(sign(m.hand))),
        ("hand_balance", |m| m.hand_balance),
        ("switchbacks", |m| m.switchbacks as f64),
        ("frizz", |m| m.frizz),
    ];
    let named = PyDict::new(py);
    for (name, of) in columns {
        let values = strands.iter().map(|strand| strand.as_ref().map_or(f64::NAN, of));
        named.set_item(name, values.collect::<Vec<_>>().into_pyarray(py))?;
    }
    Ok(named)
}

fn of_switchbacks<'py>(py: Python<'py>, found: &[Switchback]) -> PyResult<Bound<'py, PyDict>> {
    let named = PyDict::new(py);
    let strands = found.iter().filter_map(|s| i64::try_from(s.strand).ok());
    named.set_item("strand", strands.collect::<Vec<_>>().into_pyarray(py))?;
    let places: Vec<f64> = found.iter().map(|s| s.arc_length).collect();
    named.set_item("arc_length", places.into_pyarray(py))?;
    let before: Vec<i64> = found.iter().map(|s| i64::from(sign(s.before))).collect();
    named.set_item("before", before.into_pyarray(py))?;
    let behind: Vec<i64> = found.iter().map(|s| i64::from(sign(s.behind))).collect();
    named.set_item("behind", behind.into_pyarray(py))?;
    let confidence: Vec<f64> = found.iter().map(|s| s.confidence).collect();
    named.set_item("confidence", confidence.into_pyarray(py))?;
    Ok(named)
}

fn sign(hand: Hand) -> i32 {
    match hand {
        Hand::Right => 1,
        Hand::Left => -1,
        Hand::Neither => 0,
    }
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
