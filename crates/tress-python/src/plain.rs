//! Options in and reports out: Python's dictionaries to the library's types and back.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::TressError;

/// Keyword arguments as the options they are; none are the defaults. A keyword that is not known
/// raises `TypeError`, as for any function of Python.
pub(crate) fn options<T: DeserializeOwned + Default>(
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<T> {
    let Some(keywords) = keywords else { return Ok(T::default()) };
    let named = plain(keywords.as_any())?;
    pythonize::depythonize(&named).map_err(|error| PyTypeError::new_err(error.to_string()))
}

/// Options with some of them replaced by keyword arguments; those that are None stay.
pub(crate) fn merged<T: Serialize + DeserializeOwned>(
    py: Python<'_>,
    start: &T,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<T> {
    let all = pythonize::pythonize(py, start)?.cast_into::<PyDict>()?;
    for (name, value) in keywords.into_iter().flatten() {
        if !value.is_none() {
            all.set_item(name, plain(&value)?)?;
        }
    }
    pythonize::depythonize(&all).map_err(|error| PyTypeError::new_err(error.to_string()))
}

/// A dictionary, or a text in RON, as the data it describes.
pub(crate) fn data<T: DeserializeOwned>(value: &Bound<'_, PyAny>, name: &str) -> PyResult<T> {
    if let Ok(text) = value.extract::<String>() {
        // As in the files of the program: the fields of a variant stand in its own parentheses.
        let ron = ron::Options::default()
            .with_default_extension(ron::extensions::Extensions::UNWRAP_VARIANT_NEWTYPES);
        return ron.from_str(&text).map_err(|error| {
            let (line, column) = (error.span.start.line, error.span.start.col);
            let code = error.code;
            TressError::new_err(format!("{name}: line {line}, column {column}: {code}"))
        });
    }
    pythonize::depythonize(&plain(value)?)
        .map_err(|error| TressError::new_err(format!("{name}: {error}")))
}

/// A report as dictionaries, lists and numbers.
pub(crate) fn report<'py>(py: Python<'py>, report: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    Ok(pythonize::pythonize(py, report)?)
}

/// The same with arrays and scalars of numpy, at any depth, as lists and numbers of Python.
fn plain<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = value.py();
    if let Ok(named) = value.cast::<PyDict>() {
        let copy = PyDict::new(py);
        for (key, item) in named {
            copy.set_item(key, plain(&item)?)?;
        }
        return Ok(copy.into_any());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items = value.try_iter()?.map(|item| plain(&item?)).collect::<PyResult<Vec<_>>>()?;
        return Ok(PyList::new(py, items)?.into_any());
    }
    match value.getattr_opt("tolist")? {
        Some(to_list) => to_list.call0(),
        None => Ok(value.clone()),
    }
}
