//! Arrays in: anything that numpy takes for an array, checked and copied once.

use numpy::ndarray::ArrayViewD;
use numpy::{
    PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tress::geometry::glam::DVec3;
use tress::geometry::{Column, Strands};

use crate::error::{TressError, refused};

/// Numbers with the shape they came in, row after row.
pub(crate) struct Shaped<T> {
    pub(crate) shape: Vec<usize>,
    pub(crate) values: Vec<T>,
}

/// The numbers of an array-like of integers or floating-point numbers.
pub(crate) fn floats(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Shaped<f64>> {
    let array = array_like(value, name, b"fiu", "numbers")?;
    converted(&array, "float64")
}

/// The numbers of an array-like of integers; an empty one may be of any type.
pub(crate) fn integers(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Shaped<i64>> {
    let empty = value.len().is_ok_and(|n| n == 0);
    let kinds: &[u8] = if empty { b"fiub" } else { b"iub" };
    let array = array_like(value, name, kinds, "integers")?;
    converted(&array, "int64")
}

/// One number a row.
pub(crate) fn scalars(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    let Shaped { shape, values } = floats(value, name)?;
    if shape.len() == 1 { Ok(values) } else { Err(misshapen(name, "(n,)", &shape)) }
}

/// Places in an array of `length`.
pub(crate) fn indices(value: &Bound<'_, PyAny>, name: &str, length: usize) -> PyResult<Vec<usize>> {
    let Shaped { shape, values } = integers(value, name)?;
    if shape.len() != 1 {
        return Err(misshapen(name, "(n,)", &shape));
    }
    let place = |i: i64| match usize::try_from(i) {
        Ok(i) if i < length => Ok(i),
        _ => Err(TressError::new_err(format!("{name}: there is no {i} among {length}"))),
    };
    values.into_iter().map(place).collect()
}

/// Three numbers a row.
pub(crate) fn vectors(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<DVec3>> {
    let Shaped { shape, values } = floats(value, name)?;
    match shape[..] {
        [_, 3] | [0] => Ok(bytemuck::cast_slice(&values).to_vec()),
        _ => Err(misshapen(name, "(n, 3)", &shape)),
    }
}

/// Points cut into strands: by `offsets`, by `counts`, or by the first axis of an array of three.
pub(crate) fn strands(
    positions: &Bound<'_, PyAny>,
    offsets: Option<&Bound<'_, PyAny>>,
    counts: Option<&Bound<'_, PyAny>>,
) -> PyResult<Strands<DVec3>> {
    let Shaped { shape, values } = floats(positions, "positions")?;
    match shape[..] {
        [_, 3] | [0] => cut(bytemuck::cast_slice(&values).to_vec(), offsets, counts),
        [n, each, 3] if offsets.is_none() && counts.is_none() => {
            let points = bytemuck::cast_slice(&values).to_vec();
            Strands::from_counts(std::iter::repeat_n(each, n), points).map_err(refused)
        }
        _ => Err(misshapen("positions", "(n, 3), or (strands, points, 3) without offsets", &shape)),
    }
}

/// Values cut into strands by `offsets` or by `counts`, of which there must be one.
pub(crate) fn cut<T>(
    values: Vec<T>,
    offsets: Option<&Bound<'_, PyAny>>,
    counts: Option<&Bound<'_, PyAny>>,
) -> PyResult<Strands<T>> {
    match (offsets, counts) {
        (Some(offsets), None) => {
            let Shaped { shape, values: ends } = integers(offsets, "offsets")?;
            if shape.len() != 1 {
                return Err(misshapen("offsets", "(n,)", &shape));
            }
            let narrow = |(i, end): (usize, i64)| {
                let message = || format!("offset {i} is {end}, outside 0 to 4,294,967,295");
                u32::try_from(end).map_err(|_| TressError::new_err(message()))
            };
            let ends = ends.into_iter().enumerate().map(narrow).collect::<PyResult<_>>()?;
            Strands::new(ends, values).map_err(refused)
        }
        (None, Some(counts)) => {
            Strands::from_counts(whole_counts(counts, "counts")?, values).map_err(refused)
        }
        (None, None) if values.is_empty() => Ok(Strands::default()),
        (None, None) => Err(PyTypeError::new_err("expected offsets or counts to cut strands by")),
        (Some(_), Some(_)) => Err(PyTypeError::new_err("expected offsets or counts, not both")),
    }
}

/// Numbers of things, at least 0 each.
pub(crate) fn whole_counts(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<usize>> {
    let Shaped { shape, values } = integers(value, name)?;
    if shape.len() != 1 {
        return Err(misshapen(name, "(n,)", &shape));
    }
    let count = |n: i64| {
        let message = || format!("{name}: {n} is less than 0");
        usize::try_from(n).map_err(|_| TressError::new_err(message()))
    };
    values.into_iter().map(count).collect()
}

/// An attribute: integers stay integers, rows of several numbers are floating-point.
fn column(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Column> {
    let array = array_like(value, name, b"fiub", "numbers")?;
    match (array.shape(), array.dtype().kind()) {
        ([_], b'i' | b'u' | b'b') => Ok(Column::Int(converted::<i64>(&array, "int64")?.values)),
        ([_], _) => Ok(Column::scalar(converted(&array, "float64")?.values)),
        (&[_, components], _) => {
            Ok(Column::Float { components, values: converted(&array, "float64")?.values })
        }
        (shape, _) => Err(misshapen(name, "(rows,) or (rows, components)", shape)),
    }
}

/// Attributes by name.
pub(crate) fn named_columns(named: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(String, Column)>> {
    let named = named.into_iter().flatten();
    named
        .map(|(name, values)| {
            let name: String = name.extract()?;
            let column = column(&values, &name)?;
            Ok((name, column))
        })
        .collect()
}

/// Attributes by name, nothing where None stands for one.
pub(crate) fn columns_or_none(
    named: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<(String, Option<Column>)>> {
    let named = named.into_iter().flatten();
    named
        .map(|(name, values)| {
            let name: String = name.extract()?;
            let column = if values.is_none() { None } else { Some(column(&values, &name)?) };
            Ok((name, column))
        })
        .collect()
}

/// The error for an array of another shape.
pub(crate) fn misshapen(name: &str, expected: &str, found: &[usize]) -> PyErr {
    let sizes: Vec<String> = found.iter().map(usize::to_string).collect();
    let comma = if sizes.len() == 1 { "," } else { "" };
    let found = sizes.join(", ");
    TressError::new_err(format!("{name}: expected the shape {expected}, found ({found}{comma})"))
}

/// The array that numpy makes of a value, if its numbers are of the kinds wanted.
fn array_like<'py>(
    value: &Bound<'py, PyAny>,
    name: &str,
    kinds: &[u8],
    words: &str,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    let array = value.py().import("numpy")?.call_method1("asarray", (value,))?;
    let array = array.cast_into::<PyUntypedArray>()?;
    let dtype = array.dtype();
    if kinds.contains(&dtype.kind()) {
        return Ok(array);
    }
    Err(PyTypeError::new_err(format!("{name}: expected an array of {words}, found {dtype}")))
}

/// The values in the order of C, as another type where they are not of it yet.
fn converted<T: numpy::Element + Copy>(
    array: &Bound<'_, PyUntypedArray>,
    dtype: &str,
) -> PyResult<Shaped<T>> {
    let contiguous =
        array.py().import("numpy")?.call_method1("ascontiguousarray", (array, dtype))?;
    let contiguous = contiguous.cast_into::<PyArrayDyn<T>>()?;
    let readonly = contiguous.readonly();
    let view: ArrayViewD<'_, T> = readonly.as_array();
    Ok(Shaped { shape: array.shape().to_vec(), values: view.iter().copied().collect() })
}
