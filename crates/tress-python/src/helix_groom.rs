//! `tress.HelixGroom`: super-helices as numpy arrays.

use numpy::ndarray::{ArrayView1, s};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tress::geometry::glam::{DMat3, DVec3};
use tress::geometry::{Attributes, Element, Frame, Groom as Polylines, HelixGroom as Inner, Kept};

use crate::arrays::{Shaped, cut, floats, indices, misshapen, named_columns, scalars, vectors};
use crate::error::{TressError, refused};
use crate::frames;
use crate::groom::{Groom, NewArguments, attributes, new_arguments, place};
use crate::space::{Unit, letter, space};
use crate::views::{columns, lend, table};

/// Super-helices with attributes: what edits act on.
///
/// Strand `i` starts in a root frame and is made of the elements `offsets[i]` to
/// `offsets[i + 1]`, each an arc of a circular helix: its material curvatures `(k0, k1, k2)` are
/// twist about the tangent and bending about the two cross-section directions, in one over length.
/// A strand has one joint more than elements. Strands that could not become helices are kept as the
/// polylines they were and have no elements. `curvatures`, `lengths`, `offsets` and the attributes
/// are views of the groom's own memory; a groom does not change.
///
/// Args:
///     root_positions: Where strands start, (strands, 3).
///     root_frames: Matrices whose columns are the tangent t and the cross-section directions u
///         and v at the root, (strands, 3, 3).
///     curvatures: Material curvatures of the elements, (elements, 3).
///     lengths: Arc lengths of the elements, (elements,).
///     offsets: Where strands begin among the elements, and the number of elements.
///     counts: The number of elements of each strand, instead of offsets.
///     unit: The unit of length: "mm", "cm", "m", "in", "ft" or metres as a number.
///     up: The axis that is up, "y" or "z".
///     strand_attributes: Arrays by name with one row a strand.
///     joint_attributes: Arrays by name with one row a joint, strand after strand.
///     kept_strands: Which strands are no helices, ascending.
///     kept: Their polylines, as a Groom with as many strands.
#[pyclass(frozen, module = "tress")]
#[derive(Debug)]
pub(crate) struct HelixGroom(pub(crate) Inner);

/// Positions and frames: (n, 3) and (n, 3, 3).
type Joints<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray3<f64>>);

/// Numbers from one element to the next in memory: three curvatures and a length.
const STRIDE: usize = 4;

fn numbers(groom: &HelixGroom) -> &[f64] {
    bytemuck::cast_slice(groom.0.elements().points())
}

fn root_axes(value: &Bound<'_, PyAny>) -> PyResult<Vec<DMat3>> {
    let Shaped { shape, values } = floats(value, "root_frames")?;
    match shape[..] {
        [_, 3, 3] | [0] => {
            let (rows, _) = values.as_chunks::<9>();
            Ok(rows.iter().map(|rows| DMat3::from_cols_array(rows).transpose()).collect())
        }
        _ => Err(misshapen("root_frames", "(n, 3, 3)", &shape)),
    }
}

fn elements(curvatures: &[DVec3], lengths: &[f64]) -> PyResult<Vec<Element>> {
    if curvatures.len() != lengths.len() {
        let (curvatures, lengths) = (curvatures.len(), lengths.len());
        let message = format!("{lengths} lengths for {curvatures} curvatures");
        return Err(TressError::new_err(message));
    }
    let pairs = curvatures.iter().zip(lengths);
    Ok(pairs.map(|(&curvature, &length)| Element { curvature, length }).collect())
}

fn kept_parts(
    strands: Option<&Bound<'_, PyAny>>,
    polylines: Option<&Groom>,
    n_strands: usize,
) -> PyResult<Kept> {
    let strands = match strands {
        Some(strands) => indices(strands, "kept_strands", n_strands)?,
        None => Vec::new(),
    };
    let narrow = |i: usize| u32::try_from(i).map_err(refused);
    let strands = strands.into_iter().map(narrow).collect::<PyResult<_>>()?;
    Ok(match polylines {
        None => Kept { strands, ..Kept::default() },
        Some(Groom(groom)) => Kept {
            strands,
            polylines: groom.strands().clone(),
            point_attributes: groom.point_attributes().clone(),
        },
    })
}

#[pymethods]
impl HelixGroom {
    #[new]
    #[pyo3(signature = (root_positions, root_frames, curvatures, lengths, offsets=None, *,
                        counts=None, unit=None, up=None, strand_attributes=None,
                        joint_attributes=None, kept_strands=None, kept=None))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords of Python")]
    fn new(
        root_positions: &Bound<'_, PyAny>,
        root_frames: &Bound<'_, PyAny>,
        curvatures: &Bound<'_, PyAny>,
        lengths: &Bound<'_, PyAny>,
        offsets: Option<&Bound<'_, PyAny>>,
        counts: Option<&Bound<'_, PyAny>>,
        unit: Option<Unit>,
        up: Option<&str>,
        strand_attributes: Option<&Bound<'_, PyDict>>,
        joint_attributes: Option<&Bound<'_, PyDict>>,
        kept_strands: Option<&Bound<'_, PyAny>>,
        kept: Option<&Bound<'_, Groom>>,
    ) -> PyResult<Self> {
        let positions = vectors(root_positions, "root_positions")?;
        let axes = root_axes(root_frames)?;
        if positions.len() != axes.len() {
            let (positions, axes) = (positions.len(), axes.len());
            let message = format!("{axes} root frames for {positions} root positions");
            return Err(TressError::new_err(message));
        }
        let roots = positions.into_iter().zip(axes);
        let roots: Vec<Frame> = roots.map(|(position, axes)| Frame { position, axes }).collect();
        let elements =
            elements(&vectors(curvatures, "curvatures")?, &scalars(lengths, "lengths")?)?;
        let elements = cut(elements, offsets, counts)?;
        let of_strands = attributes(strand_attributes, elements.len())?;
        let of_joints = attributes(joint_attributes, elements.points().len() + elements.len())?;
        let kept = kept_parts(kept_strands, kept.map(Bound::get), elements.len())?;
        let (unit, up) = space(unit.as_ref(), up)?;
        let groom = Inner::with_attributes(roots, elements, of_strands, of_joints, kept);
        Ok(Self(groom.map_err(refused)?.in_space(unit, up)))
    }

    /// Material curvatures `(k0, k1, k2)` of all elements, (n, 3) float64, read-only.
    #[getter]
    fn curvatures<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        lend(slf, |groom| table(numbers(groom), STRIDE).slice_move(s![.., ..3]))
    }

    /// Arc lengths of all elements, (n,) float64, read-only.
    #[getter]
    fn lengths<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<f64>> {
        lend(slf, |groom| table(numbers(groom), STRIDE).slice_move(s![.., 3]))
    }

    /// Where strands begin among the elements, and the number of elements; uint32, read-only.
    #[getter]
    fn offsets<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        lend(slf, |groom| ArrayView1::from(groom.0.elements().offsets()))
    }

    /// The number of elements of each strand.
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let ends = self.0.elements().offsets().windows(2);
        ends.map(|ends| i64::from(ends[1] - ends[0])).collect::<Vec<_>>().into_pyarray(py)
    }

    /// Where strands start, (strands, 3).
    #[getter]
    fn root_positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        frames::positions(py, self.0.roots())
    }

    /// The root frames, (strands, 3, 3): matrices with the columns t, u, v.
    #[getter]
    fn root_frames<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        frames::axes(py, self.0.roots())
    }

    /// Which strands are kept as polylines.
    #[getter]
    fn kept_strands<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        lend(slf, |groom| ArrayView1::from(groom.0.kept().strands.as_slice()))
    }

    /// The polylines of the strands that are no helices, as a Groom of as many strands.
    #[getter]
    fn kept(&self) -> PyResult<Groom> {
        let Kept { polylines, point_attributes, .. } = self.0.kept().clone();
        let no_columns = Attributes::new(polylines.len());
        let groom = Polylines::with_attributes(polylines, point_attributes, no_columns);
        Ok(Groom(groom.map_err(refused)?.in_space(self.0.unit, self.0.up)))
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

    /// Arrays by name with one row a strand, read-only.
    #[getter]
    fn strand_attributes<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        columns(slf, |groom| groom.0.strand_attributes())
    }

    /// Arrays by name with one row a joint, read-only.
    #[getter]
    fn joint_attributes<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        columns(slf, |groom| groom.0.joint_attributes())
    }

    /// The number of strands, kept ones included.
    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __repr__(&self) -> String {
        let (strands, elements) = (self.0.len(), self.0.elements().points().len());
        let kept = match self.0.kept().strands.len() {
            0 => String::new(),
            n => format!(", {n} kept as polylines"),
        };
        format!("<tress.HelixGroom: {strands} strands, {elements} elements{kept}>")
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __getnewargs_ex__<'py>(slf: &Bound<'py, Self>) -> PyResult<NewArguments<'py>> {
        let positional = ["root_positions", "root_frames", "curvatures", "lengths", "offsets"];
        let keywords =
            ["unit", "up", "strand_attributes", "joint_attributes", "kept_strands", "kept"];
        new_arguments(slf, &positional, &keywords)
    }

    /// The positions and frames of the joints of one strand: (joints, 3) and (joints, 3, 3).
    fn joints<'py>(&self, py: Python<'py>, strand: isize) -> PyResult<Joints<'py>> {
        let strand = self.0.strand(place(strand, self.0.len())?);
        let joints: Vec<Frame> = strand.joints().collect();
        Ok((frames::positions(py, &joints)?, frames::axes(py, &joints)?))
    }

    /// The same strands with other curvatures, lengths or both, of as many elements.
    #[pyo3(signature = (curvatures=None, lengths=None))]
    fn with_elements(
        &self,
        curvatures: Option<&Bound<'_, PyAny>>,
        lengths: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let mut groom = self.0.clone();
        let n = groom.elements().points().len();
        let expect = |name: &str, found: usize| {
            let message = || format!("{name}: expected {n} elements, found {found}");
            if found == n { Ok(()) } else { Err(TressError::new_err(message())) }
        };
        if let Some(curvatures) = curvatures {
            let curvatures = vectors(curvatures, "curvatures")?;
            expect("curvatures", curvatures.len())?;
            let elements = groom.elements_mut().points_mut().iter_mut();
            elements.zip(curvatures).for_each(|(element, q)| element.curvature = q);
        }
        if let Some(lengths) = lengths {
            let lengths = scalars(lengths, "lengths")?;
            expect("lengths", lengths.len())?;
            let elements = groom.elements_mut().points_mut().iter_mut();
            elements.zip(lengths).for_each(|(element, length)| element.length = length);
        }
        Ok(Self(groom))
    }

    /// The same groom with further attributes; those of a name that is there are replaced.
    #[pyo3(signature = (*, strand=None, joint=None))]
    fn with_attributes(
        &self,
        strand: Option<&Bound<'_, PyDict>>,
        joint: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut groom = self.0.clone();
        for (name, column) in named_columns(strand)? {
            groom.insert_strand_attribute(name, column).map_err(refused)?;
        }
        for (name, column) in named_columns(joint)? {
            groom.insert_joint_attribute(name, column).map_err(refused)?;
        }
        Ok(Self(groom))
    }

    /// The strands named, ascending and each once, with their attributes.
    fn select(&self, strands: &Bound<'_, PyAny>) -> PyResult<Self> {
        let strands = indices(strands, "strands", self.0.len())?;
        if strands.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Err(TressError::new_err("strands: expected each once, ascending"));
        }
        Ok(Self(self.0.select(&strands)))
    }

    /// This groom and behind it the strands of another in the same space, with like attributes.
    fn joined(&self, other: &Self) -> PyResult<Self> {
        let mut groom = self.0.clone();
        groom.append(&other.0).map_err(refused)?;
        Ok(Self(groom))
    }
}
