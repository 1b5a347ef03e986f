//! Generalized helicoids: one hair that knows its neighbours.

use numpy::ndarray::ArrayView1;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use tress::geometry::glam::DVec3;
use tress::helicoid::{
    FillOptions, FitOptions, FitReport, HelicoidGroom as Inner, Piece, Roots, Tracing, WispOptions,
};

use crate::arrays::{vectors, whole_counts};
use crate::error::refused;
use crate::frames;
use crate::groom::Groom;
use crate::helix_groom::HelixGroom;
use crate::plain::{merged, report};
use crate::space::letter;
use crate::views::{columns, lend};

/// Hairs as chains of generalized helicoids, as `fit_helicoids` and `fill` make them.
///
/// Piece `j` of a hair is the flow line of a field of directions with the parameters
/// `(kT, kN, kB, alpha)`, the bends of the hair itself and of its neighbours, over a length.
#[pyclass(frozen, module = "tress")]
#[derive(Debug)]
pub(crate) struct HelicoidGroom(Inner);

impl HelicoidGroom {
    fn pieces(&self) -> &[Piece] {
        self.0.pieces().points()
    }
}

#[pymethods]
impl HelicoidGroom {
    /// The number of strands, those kept as polylines included.
    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __repr__(&self) -> String {
        let (strands, pieces) = (self.0.len(), self.pieces().len());
        format!("<tress.HelicoidGroom: {strands} strands, {pieces} pieces>")
    }

    /// Where hairs start, (strands, 3).
    #[getter]
    fn root_positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        frames::positions(py, self.0.roots())
    }

    /// The root frames, (strands, 3, 3): matrices whose columns are tangent, normal and binormal.
    #[getter]
    fn root_frames<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        frames::axes(py, self.0.roots())
    }

    /// `(kT, kN, kB, alpha)` of all pieces, (n, 4).
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let pieces = self.pieces();
        let of = |piece: &Piece| [piece.k.kt, piece.k.kn, piece.k.kb, piece.k.alpha];
        let values: Vec<f64> = pieces.iter().flat_map(of).collect();
        values.into_pyarray(py).reshape([pieces.len(), 4])
    }

    /// Arc lengths of all pieces.
    #[getter]
    fn lengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.pieces().iter().map(|piece| piece.length).collect::<Vec<_>>().into_pyarray(py)
    }

    /// Where hairs begin among the pieces, and the number of pieces; uint32, read-only.
    #[getter]
    fn offsets<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        lend(slf, |groom| ArrayView1::from(groom.0.pieces().offsets()))
    }

    /// Which strands are kept as polylines.
    #[getter]
    fn kept_strands<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        self.0.kept().keys().copied().collect::<Vec<_>>().into_pyarray(py)
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
}

/// What a fit came to, as a dictionary.
#[derive(Serialize)]
struct Words {
    kept: usize,
    above_tolerance: usize,
    frechet: Vec<f64>,
    rms: Vec<f64>,
    pieces: Vec<usize>,
}

impl Words {
    fn of(told: FitReport) -> Self {
        let FitReport { kept, above_tolerance, frechet, rms, pieces, .. } = told;
        Self { kept: kept.len(), above_tolerance, frechet, rms, pieces }
    }
}

/// Fits chains of generalized helicoids to the strands of a groom.
///
/// Args:
///     groom: The polylines; or a HelixGroom, whose positions are then fitted.
///     method: "Newton", or "Simplex" as published.
///     pieces: {"UpTo": n} or {"Equal": n}; equally many for guides that `fill` mixes.
///     roll: How root frames stand: "Bend", or "Steady" for guides whose bends differ.
///     tolerance: Frechet distance that is small enough, over the strand's length.
///     threshold, shortest, regularization: Where strands are split, the least length of a piece
///         over the strand's, and what parameters cost.
///
/// Options that are None have their defaults.
///
/// Returns:
///     The HelicoidGroom, and a report: "frechet", "rms" and "pieces" of each strand, "kept" and
///     "above_tolerance".
#[pyfunction]
#[pyo3(signature = (groom, **options),
       text_signature = "(groom, *, method=None, pieces=None, roll=None, tolerance=None, \
                         threshold=None, shortest=None, regularization=None)")]
pub(crate) fn fit_helicoids<'py>(
    py: Python<'py>,
    groom: &Bound<'py, PyAny>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(HelicoidGroom, Bound<'py, PyAny>)> {
    let options: FitOptions = merged(py, &FitOptions::default(), options)?;
    let fitted = if let Ok(helices) = groom.cast::<HelixGroom>() {
        let helices = &helices.get().0;
        py.detach(|| tress::helicoid::from_helices(helices, &options)).map_err(refused)?
    } else {
        let groom = &groom.cast::<Groom>()?.get().0;
        py.detach(|| tress::helicoid::fit(groom, &options)).map_err(refused)?
    };
    Ok((HelicoidGroom(fitted.hairs), report(py, &Words::of(fitted.report))?))
}

/// Polylines along helicoids, points even in arc length.
///
/// Args:
///     hairs: The helicoids.
///     points: Points of every strand; or
///     counts: points of each strand.
#[pyfunction]
#[pyo3(signature = (hairs, *, points=None, counts=None))]
pub(crate) fn sample_helicoids(
    py: Python<'_>,
    hairs: &Bound<'_, HelicoidGroom>,
    points: Option<usize>,
    counts: Option<&Bound<'_, PyAny>>,
) -> PyResult<Groom> {
    let hairs = &hairs.get().0;
    let counts = match (points, counts) {
        (Some(points), None) => vec![points; hairs.len()],
        (None, Some(counts)) => whole_counts(counts, "counts")?,
        _ => return Err(PyTypeError::new_err("expected points or counts")),
    };
    let count = |i: usize| counts.get(i).copied().unwrap_or(0);
    let sampled = py.detach(|| tress::helicoid::sample_counts(hairs, count, Tracing::default()));
    sampled.map(Groom).map_err(refused)
}

/// Super-helices that follow helicoids: each piece cut into elements of equal length.
///
/// Args:
///     hairs: The helicoids.
///     per_piece: Elements a piece; twice as many are four times as near.
#[pyfunction]
#[pyo3(signature = (hairs, *, per_piece=20))]
pub(crate) fn to_helices(
    py: Python<'_>,
    hairs: &Bound<'_, HelicoidGroom>,
    per_piece: usize,
) -> PyResult<HelixGroom> {
    let hairs = &hairs.get().0;
    let helices = py.detach(|| tress::helicoid::to_helices(hairs, per_piece));
    helices.map(HelixGroom).map_err(refused)
}

/// Spreads every hair to a wisp of the hairs that its field of directions knows beside it.
///
/// Args:
///     guides: The helicoids.
///     hairs: Hairs of a wisp, the guide first.
///     radius: Radius of the disc of roots.
///     fanning, frizz: How far hairs turn about their roots, and segments turn, in radians.
///     profile: Factors of the distance from the guide, evenly from root to tip.
///     waviness: Waves about every hair: {"amplitude": their radius, "frequency": radians in a unit
///         of length, "fade_in": the arc length over which they grow}.
///     points: Points of a hair.
///     seed: The same seed makes the same wisps.
///
/// Returns:
///     A Groom whose attribute "group" tells the wisps apart.
#[pyfunction]
#[pyo3(signature = (guides, *, seed=0, **options),
       text_signature = "(guides, *, hairs=256, radius=0.05, fanning=0.0, frizz=0.0, profile=None, \
                         waviness=None, points=40, seed=0)")]
pub(crate) fn wisps(
    py: Python<'_>,
    guides: &Bound<'_, HelicoidGroom>,
    seed: u64,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Groom> {
    let options: WispOptions = merged(py, &WispOptions::default(), options)?;
    let guides = &guides.get().0;
    let spread = py.detach(|| tress::helicoid::wisps(guides, &options, Tracing::default(), seed));
    spread.map(Groom).map_err(refused)
}

/// Fills in hairs between guides, whose helicoids are mixed by distance.
///
/// Args:
///     guides: Helicoids with equally many pieces.
///     roots: Where hairs grow, (n, 3).
///     normals, guide_normals: The surface's unit normals at the roots and at the guides' roots;
///         frames are mixed as they are where None.
///     mixing: What is mixed: "Bends", or "Parameters" as published.
///     exponent: The power of the inverse distance.
///     neighbors: How many of the nearest guides count; 0 for all.
///
/// Returns:
///     The HelicoidGroom of the new hairs, and those that had to take the nearest guide's
///     parameters.
#[pyfunction]
#[pyo3(signature = (guides, roots, *, normals=None, guide_normals=None, **options),
       text_signature = "(guides, roots, *, normals=None, guide_normals=None, mixing=None, \
                         exponent=None, neighbors=None)")]
pub(crate) fn fill<'py>(
    py: Python<'py>,
    guides: &Bound<'_, HelicoidGroom>,
    roots: &Bound<'_, PyAny>,
    normals: Option<&Bound<'_, PyAny>>,
    guide_normals: Option<&Bound<'_, PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(HelicoidGroom, Bound<'py, PyArray1<i64>>)> {
    let options: FillOptions = merged(py, &FillOptions::default(), options)?;
    let positions = vectors(roots, "roots")?;
    let given = |normals: Option<&Bound<'_, PyAny>>, name: &str| -> PyResult<Option<Vec<DVec3>>> {
        normals.map(|normals| vectors(normals, name)).transpose()
    };
    let normals = (given(normals, "normals")?, given(guide_normals, "guide_normals")?);
    let roots = match &normals {
        (None, None) => Roots::Points(&positions),
        (Some(normals), Some(at_guides)) => {
            Roots::Surface { positions: &positions, normals, at_guides }
        }
        _ => return Err(PyTypeError::new_err("expected normals of both roots and guides")),
    };
    let guides = &guides.get().0;
    let filled = py.detach(|| tress::helicoid::fill(guides, roots, &options)).map_err(refused)?;
    let replaced = filled.replaced.iter().filter_map(|&i| i64::try_from(i).ok());
    Ok((HelicoidGroom(filled.hairs), replaced.collect::<Vec<_>>().into_pyarray(py)))
}
