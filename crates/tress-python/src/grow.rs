//! From guides to a head of hair: roots scattered, hairs grown.

use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use tress::fit::Spectra;
use tress::geometry::Mesh;
use tress::geometry::glam::DVec3;
use tress::grow::{Coils, Density, GrowOptions, GrowReport, Plan, assign};

use crate::arrays::{Shaped, integers, misshapen, scalars, vectors};
use crate::error::{TressError, refused};
use crate::groom::Groom;
use crate::plain::{merged, report};

/// What was grown, as a dictionary.
#[derive(Serialize)]
struct Words {
    hairs: usize,
    guides: usize,
    straight_guides: usize,
    bare_roots: usize,
    far_roots: usize,
}

impl Words {
    fn of(grown: &GrowReport) -> Self {
        let GrowReport { hairs, guides, straight_guides, bare_roots, far_roots, .. } = *grown;
        Self { hairs, guides, straight_guides, bare_roots, far_roots }
    }
}

/// Grows a hair on each root: loosely at first, then falling into its guide's coil.
///
/// Args:
///     guides: The strands that hairs follow.
///     roots: Where hairs grow, (n, 3).
///     preset: The options to start from, one of `grow_presets()`.
///     library: A groom whose own coils fill the loose part; one that ships with tress where None.
///     seed: The same seed grows the same hairs, on any number of threads.
///     assignment: How roots find guides: "Nearest", {"Noisy": n} or {"NoisyByDistance": n}.
///     loose: The range, as a pair, of the share of the guide that a hair follows loosely.
///     wisp: How far hairs stray from their guide, in coil radii: pairs (place from 0 to 1, radii).
///     shorter: The greatest share of its length that a hair may lack.
///     skip: Period skipping: {"probability": p, "each": "Turns" or "Points"}.
///     fade: Turns of guides from which on hairs make wisps, and make nothing else.
///     opening, locking: Turns over which a loose coil opens, and becomes the guide's.
///     coils: How wide the loose coils are: "Guide" or "Own".
///
/// Options that are None are those of the preset, or the defaults.
///
/// Returns:
///     A Groom with the attribute "guide" of strands, and a report: "hairs", "guides",
///     "straight_guides", "bare_roots", "far_roots".
#[pyfunction]
#[pyo3(signature = (guides, roots, *, preset=None, library=None, seed=0, **options),
       text_signature = "(guides, roots, *, preset=None, library=None, seed=0, assignment=None, \
                         loose=None, wisp=None, shorter=None, skip=None, fade=None, opening=None, \
                         locking=None, coils=None)")]
pub(crate) fn grow<'py>(
    py: Python<'py>,
    guides: &Bound<'_, Groom>,
    roots: &Bound<'_, PyAny>,
    preset: Option<&str>,
    library: Option<&Bound<'_, Groom>>,
    seed: u64,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(Groom, Bound<'py, PyAny>)> {
    let options: GrowOptions = merged(py, &start(preset)?, options)?;
    let roots = vectors(roots, "roots")?;
    let groom = &guides.get().0;
    let library = library.map(|library| library.get().0.strands());
    let (grown, told) = py.detach(|| {
        let coils = match library {
            Some(own) => Coils::new(&Spectra::of(own)),
            None => Coils::shipped().map_err(refused)?,
        };
        let guides = groom.strands();
        let guide_roots: Vec<DVec3> =
            guides.iter().map(|points| points.first().copied().unwrap_or(DVec3::NAN)).collect();
        let assigned = assign(&roots, &guide_roots, options.assignment, seed).map_err(refused)?;
        let plan = Plan::new(guides, &roots, &assigned, coils, &options, seed).map_err(refused)?;
        let grown = plan.grow(guides, &roots).map_err(refused)?;
        PyResult::Ok((grown.in_space(groom.unit, groom.up), plan.report(guides, &roots)))
    })?;
    Ok((Groom(grown), report(py, &Words::of(&told))?))
}

/// The options that a preset stands for.
fn start(preset: Option<&str>) -> PyResult<GrowOptions> {
    let Some(name) = preset else { return Ok(GrowOptions::default()) };
    tress::grow::preset(name).ok_or_else(|| {
        let known: Vec<_> = grow_presets();
        let known = known.join(", ");
        TressError::new_err(format!("no preset is called {name:?}; there is: {known}"))
    })
}

/// The names of the presets of `grow`.
#[pyfunction]
pub(crate) fn grow_presets() -> Vec<&'static str> {
    tress::grow::preset_names().collect()
}

/// Roots on a mesh, evenly spaced.
///
/// Args:
///     vertices: Positions, (v, 3).
///     triangles: Indices of vertices, (t, 3).
///     count: How many roots.
///     density: How dense roots stand: a weight for each vertex, or for each triangle; even where
///         None.
///     seed: The same seed gives the same roots.
///
/// Returns:
///     (count, 3) float64.
#[pyfunction]
#[pyo3(signature = (vertices, triangles, count, *, density=None, seed=0))]
pub(crate) fn scatter<'py>(
    py: Python<'py>,
    vertices: &Bound<'_, PyAny>,
    triangles: &Bound<'_, PyAny>,
    count: usize,
    density: Option<&Bound<'_, PyAny>>,
    seed: u64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let mesh = mesh(vertices, triangles)?;
    let weights = density.map(|density| scalars(density, "density")).transpose()?;
    let density = match &weights {
        None => Density::Even,
        Some(weights) if weights.len() == mesh.positions().len() => Density::Vertices(weights),
        Some(weights) => Density::Faces(weights),
    };
    let roots = py.detach(|| tress::grow::scatter(&mesh, count, density, seed)).map_err(refused)?;
    let values: Vec<f64> = roots.iter().flat_map(|root| root.to_array()).collect();
    values.into_pyarray(py).reshape([roots.len(), 3])
}

fn mesh(vertices: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>) -> PyResult<Mesh> {
    let positions = vectors(vertices, "vertices")?;
    let Shaped { shape, values } = integers(triangles, "triangles")?;
    if !matches!(shape[..], [_, 3] | [0]) {
        return Err(misshapen("triangles", "(n, 3)", &shape));
    }
    let corner = |i: i64| {
        let message = || format!("triangles: there is no vertex {i}");
        u32::try_from(i).map_err(|_| TressError::new_err(message()))
    };
    let corners = values.into_iter().map(corner).collect::<PyResult<Vec<u32>>>()?;
    let (triangles, _) = corners.as_chunks::<3>();
    Mesh::new(positions, triangles.to_vec()).map_err(refused)
}
