//! Files in and out.

use std::path::PathBuf;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tress::io::unreal::{self, Placement, UnrealOptions};
use tress::io::{Model, UsdCurves, WriteOptions};

use crate::error::{TressError, not_read, not_written};
use crate::groom::Groom;
use crate::helix_groom::HelixGroom;

/// Reads a file; its extension names the format.
///
/// Returns:
///     A Groom, or a HelixGroom from a .tress file.
///
/// Raises:
///     OSError: The file cannot be opened.
///     TressError: Its extension is not known, or its contents are not a groom.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyAny>> {
    match py.detach(|| tress::io::read(path)).map_err(not_read)? {
        Model::Polylines(groom) => Ok(Bound::new(py, Groom(groom))?.into_any()),
        Model::Helices(helices) => Ok(Bound::new(py, HelixGroom(helices))?.into_any()),
    }
}

/// What `read_mesh` gives: positions, triangles, density.
type Mesh<'py> =
    (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<u32>>, Option<Bound<'py, PyArray1<f64>>>);

/// Reads a mesh for `scatter` from an .obj or .ply file.
///
/// Returns:
///     Vertices, (v, 3); triangles, (t, 3), polygons cut into such; and the density of hair that
///     the file has for vertices, or else for triangles, None where it has none.
///
/// Raises:
///     OSError: The file cannot be opened.
///     TressError: Its extension is another, or it holds no mesh.
#[pyfunction]
pub(crate) fn read_mesh(py: Python<'_>, path: PathBuf) -> PyResult<Mesh<'_>> {
    let scalp = py.detach(|| tress::io::mesh::read(path)).map_err(not_read)?;
    let positions = scalp.mesh.positions();
    let numbers: Vec<f64> = positions.iter().flat_map(|p| p.to_array()).collect();
    let triangles = scalp.mesh.triangles();
    let density = scalp.vertex_density.or(scalp.face_density);
    Ok((
        numbers.into_pyarray(py).reshape([positions.len(), 3])?,
        triangles.as_flattened().to_vec().into_pyarray(py).reshape([triangles.len(), 3])?,
        density.map(|density| density.into_pyarray(py)),
    ))
}

/// Writes a file, whole or not at all; its extension names the format. A HelixGroom goes to a
/// .tress file, a Groom to any other.
///
/// Args:
///     path: The file.
///     groom: What goes into it.
///     usd_curves: What a USD file says lies between points: "linear" or "catmull-rom".
///
/// Returns:
///     What the format has no place for, in words; an empty list where nothing is lost.
///
/// Raises:
///     OSError: The disk does not take the file; what was there before is as it was.
///     TressError: The extension is not known or not written, or a strand cannot be expressed.
#[pyfunction]
#[pyo3(signature = (path, groom, *, usd_curves="linear"))]
pub(crate) fn write(
    py: Python<'_>,
    path: PathBuf,
    groom: &Bound<'_, PyAny>,
    usd_curves: &str,
) -> PyResult<Vec<String>> {
    let usd_curves = self::usd_curves(usd_curves)?;
    if let Ok(helices) = groom.cast::<HelixGroom>() {
        let helices = &helices.get().0;
        py.detach(|| tress::io::write_helices(path, helices)).map_err(not_written)?;
        return Ok(Vec::new());
    }
    let groom = &groom.cast::<Groom>()?.get().0;
    let options = WriteOptions { usd_curves };
    let lost = py.detach(|| tress::io::write(path, groom, &options)).map_err(not_written)?;
    Ok(lost.iter().map(ToString::to_string).collect())
}

/// What is said to lie between points in USD.
pub(crate) fn usd_curves(name: &str) -> PyResult<UsdCurves> {
    match name {
        "linear" => Ok(UsdCurves::Linear),
        "catmull-rom" => Ok(UsdCurves::CatmullRom),
        other => Err(TressError::new_err(format!(
            "usd_curves: expected \"linear\" or \"catmull-rom\", found {other:?}"
        ))),
    }
}

/// Writes an .abc file as Unreal's groom importer wants it: in centimetres, with its parameters,
/// and with no more points a strand than it takes.
///
/// Args:
///     path: The file.
///     groom: The polylines; "group", "id", "uv", "width" and "color" become Unreal's parameters.
///     most_points: Points that a strand may have.
///     placement: Where points are put on strands that have more: by "curvature", or "uniform" for
///         comparison.
///
/// Returns:
///     A report: "resampled" strands, the "most_points" one had, "errors" of each strand in
///     centimetres, and whether the "unit_is_assumed".
#[pyfunction]
#[pyo3(signature = (path, groom, *, most_points=255, placement="curvature"))]
pub(crate) fn write_unreal<'py>(
    py: Python<'py>,
    path: PathBuf,
    groom: &Bound<'_, Groom>,
    most_points: usize,
    placement: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let placement = match placement {
        "curvature" => Placement::Curvature,
        "uniform" => Placement::Uniform,
        other => {
            return Err(TressError::new_err(format!(
                "placement: expected \"curvature\" or \"uniform\", found {other:?}"
            )));
        }
    };
    let options = UnrealOptions { most_points, placement };
    let groom = &groom.get().0;
    let told = py.detach(|| unreal::write(path, groom, &options)).map_err(not_written)?;
    let named = PyDict::new(py);
    named.set_item("resampled", told.resampled)?;
    named.set_item("most_points", told.most_points)?;
    named.set_item("errors", told.errors.into_pyarray(py))?;
    named.set_item("unit_is_assumed", told.unit_is_assumed)?;
    Ok(named)
}
