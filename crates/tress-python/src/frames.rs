//! Frames out: positions and axes as arrays of their own.

use numpy::{IntoPyArray, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use tress::geometry::Frame;

/// Where frames stand, (n, 3).
pub(crate) fn positions<'py>(
    py: Python<'py>,
    frames: &[Frame],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let values: Vec<f64> = frames.iter().flat_map(|frame| frame.position.to_array()).collect();
    values.into_pyarray(py).reshape([frames.len(), 3])
}

/// How frames stand, (n, 3, 3): matrices whose columns are their axes.
pub(crate) fn axes<'py>(py: Python<'py>, frames: &[Frame]) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let rows = |frame: &Frame| frame.axes.transpose().to_cols_array();
    let values: Vec<f64> = frames.iter().flat_map(rows).collect();
    values.into_pyarray(py).reshape([frames.len(), 3, 3])
}
