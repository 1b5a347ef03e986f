//! `tress.Groom`: polylines as numpy arrays.

use numpy::ndarray::ArrayView1;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::PyClass;
use pyo3::exceptions::{PyIndexError, PyKeyError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use tress::geometry::{Attributes, Groom as Inner};

use crate::arrays::{columns_or_none, indices, named_columns, strands, vectors};
use crate::error::{TressError, refused};
use crate::space::{Unit, letter, space, up_axis};
use crate::views::{columns, lend, rows};

/// Polylines with attributes, a unit and an up axis: what files hold.
///
/// Strand `i` is `positions[offsets[i]:offsets[i + 1]]`. The arrays that a groom hands out are
/// views of its own memory: they cost nothing and cannot be written. A groom does not change; what
/// changes it gives another.
///
/// Args:
///     positions: Points, as an array-like of shape (n, 3); or (strands, points, 3), which needs
///         neither offsets nor counts.
///     offsets: Where strands begin among the points, and as the last entry the number of points.
///     counts: The number of points of each strand, instead of offsets.
///     unit: The unit of length: "mm", "cm", "m", "in", "ft" or metres as a number.
///     up: The axis that is up, "y" or "z".
///     point_attributes: Arrays by name with one row a point.
///     strand_attributes: Arrays by name with one row a strand.
///
/// Coordinates that are not finite are data: a fit keeps such strands as they are.
///
/// Example:
///     >>> groom = Groom([[0, 0, 0], [0, 1, 0], [1, 0, 0]], counts=[2, 1], unit="cm")
///     >>> len(groom), groom.offsets.tolist()
///     (2, [0, 2, 3])
#[pyclass(frozen, module = "tress")]
#[derive(Debug)]
pub(crate) struct Groom(pub(crate) Inner);

/// Attributes of so many rows out of a dictionary of arrays.
pub(crate) fn attributes(named: Option<&Bound<'_, PyDict>>, rows: usize) -> PyResult<Attributes> {
    let mut table = Attributes::new(rows);
    for (name, column) in named_columns(named)? {
        table.insert(name, column).map_err(refused)?;
    }
    Ok(table)
}

/// What makes an object anew, for `pickle` and `copy`: arguments by place and by name.
pub(crate) type NewArguments<'py> = (Bound<'py, PyTuple>, Bound<'py, PyDict>);

/// The arguments that have the names of attributes.
pub(crate) fn new_arguments<'py>(
    object: &Bound<'py, impl PyClass>,
    positional: &[&str],
    keywords: &[&str],
) -> PyResult<NewArguments<'py>> {
    let values = positional.iter().map(|name| object.as_any().getattr(*name));
    let named = PyDict::new(object.py());
    for name in keywords {
        named.set_item(name, object.as_any().getattr(*name)?)?;
    }
    Ok((PyTuple::new(object.py(), values.collect::<PyResult<Vec<_>>>()?)?, named))
}

#[pymethods]
impl Groom {
    #[new]
    #[pyo3(signature = (positions, offsets=None, *, counts=None, unit=None, up=None,
                        point_attributes=None, strand_attributes=None))]
    fn new(
        positions: &Bound<'_, PyAny>,
        offsets: Option<&Bound<'_, PyAny>>,
        counts: Option<&Bound<'_, PyAny>>,
        unit: Option<Unit>,
        up: Option<&str>,
        point_attributes: Option<&Bound<'_, PyDict>>,
        strand_attributes: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let strands = strands(positions, offsets, counts)?;
        let of_points = attributes(point_attributes, strands.points().len())?;
        let of_strands = attributes(strand_attributes, strands.len())?;
        let (unit, up) = space(unit.as_ref(), up)?;
        let groom = Inner::with_attributes(strands, of_points, of_strands).map_err(refused)?;
        Ok(Self(groom.in_space(unit, up)))
    }

    /// The points of all strands, (n, 3) float64, read-only.
    #[getter]
    fn positions<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        lend(slf, |groom| rows(groom.0.strands().points()))
    }

    /// Where strands begin, and the number of points; uint32, read-only.
    #[getter]
    fn offsets<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        lend(slf, |groom| ArrayView1::from(groom.0.strands().offsets()))
    }

    /// The number of points of each strand.
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let ends = self.0.strands().offsets().windows(2);
        ends.map(|ends| i64::from(ends[1] - ends[0])).collect::<Vec<_>>().into_pyarray(py)
    }

    /// Metres in one unit of length, or None where that is not known.
    #[getter]
    fn unit(&self) -> Option<f64> {
        self.0.unit
    }

    /// The axis that is up, "y" or "z", or None where that is not known.
    #[getter]
    fn up(&self) -> Option<&'static str> {
        self.0.up.map(letter)
    }

    /// Arrays by name with one row a point, read-only.
    #[getter]
    fn point_attributes<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        columns(slf, |groom| groom.0.point_attributes())
    }

    /// Arrays by name with one row a strand, read-only.
    #[getter]
    fn strand_attributes<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        columns(slf, |groom| groom.0.strand_attributes())
    }

    /// The number of strands.
    fn __len__(&self) -> usize {
        self.0.strands().len()
    }

    /// The points of one strand, read-only.
    fn __getitem__<'py>(
        slf: &Bound<'py, Self>,
        strand: isize,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let strands = slf.get().0.strands();
        let i = place(strand, strands.len())?;
        Ok(lend(slf, move |groom| rows(groom.0.strands().strand(i))))
    }

    fn __repr__(&self) -> String {
        let (strands, points) = (self.0.strands().len(), self.0.strands().points().len());
        let unit = self.0.unit.map_or(String::new(), |metres| format!(", unit {metres} m"));
        let up = self.0.up.map_or(String::new(), |up| format!(", {} up", letter(up)));
        format!("<tress.Groom: {strands} strands, {points} points{unit}{up}>")
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __getnewargs_ex__<'py>(slf: &Bound<'py, Self>) -> PyResult<NewArguments<'py>> {
        let keywords = ["unit", "up", "point_attributes", "strand_attributes"];
        new_arguments(slf, &["positions", "offsets"], &keywords)
    }

    /// The same groom with its points elsewhere.
    fn with_positions(&self, positions: &Bound<'_, PyAny>) -> PyResult<Self> {
        let points = vectors(positions, "positions")?;
        let mut moved = self.0.clone();
        let (found, expected) = (points.len(), moved.strands().points().len());
        if found != expected {
            let message = format!("positions: expected {expected} points, found {found}");
            return Err(TressError::new_err(message));
        }
        moved.positions_mut().copy_from_slice(&points);
        Ok(Self(moved))
    }

    /// The same groom with further attributes; those of a name that is there are replaced, and
    /// taken away where the array is None.
    #[pyo3(signature = (*, point=None, strand=None))]
    fn with_attributes(
        &self,
        point: Option<&Bound<'_, PyDict>>,
        strand: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut groom = self.0.clone();
        for (name, column) in columns_or_none(point)? {
            match column {
                Some(column) => groom.insert_point_attribute(name, column).map_err(refused)?,
                None => drop(groom.remove_point_attribute(&name)),
            }
        }
        for (name, column) in columns_or_none(strand)? {
            match column {
                Some(column) => groom.insert_strand_attribute(name, column).map_err(refused)?,
                None => drop(groom.remove_strand_attribute(&name)),
            }
        }
        Ok(Self(groom))
    }

    /// The same groom said to be in this unit, with this axis up; nothing moves.
    #[pyo3(signature = (unit=None, up=None))]
    fn in_space(&self, unit: Option<Unit>, up: Option<&str>) -> PyResult<Self> {
        let (unit, up) = space(unit.as_ref(), up)?;
        Ok(Self(self.0.clone().in_space(unit, up)))
    }

    /// The groom turned so that this axis is up; as it is where its own is not known.
    fn turned_up(&self, up: &str) -> PyResult<Self> {
        Ok(Self(self.0.clone().with_up(up_axis(up)?)))
    }

    /// The strands named, in that order, with their attributes.
    fn select(&self, strands: &Bound<'_, PyAny>) -> PyResult<Self> {
        let strands = indices(strands, "strands", self.0.strands().len())?;
        Ok(Self(self.0.select(&strands)))
    }

    /// This groom and behind it the strands of another in the same space, with like attributes.
    fn joined(&self, other: &Self) -> PyResult<Self> {
        let mut groom = self.0.clone();
        groom.append(&other.0).map_err(refused)?;
        Ok(Self(groom))
    }

    /// One number a strand: the strand's own, or the mean of its points'.
    fn strand_values<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        match self.0.strand_values(name) {
            Some(values) => Ok(values.into_pyarray(py)),
            None => Err(PyKeyError::new_err(name.to_owned())),
        }
    }
}

/// A place counted from the front or, as Python does, from the back.
pub(crate) fn place(i: isize, length: usize) -> PyResult<usize> {
    let from_front = if i < 0 { i.checked_add_unsigned(length) } else { Some(i) };
    match from_front.and_then(|i| usize::try_from(i).ok()) {
        Some(i) if i < length => Ok(i),
        _ => Err(PyIndexError::new_err(format!("there is no strand {i} among {length}"))),
    }
}
