//! The Python package `tress`: numpy arrays in, numpy arrays out.
//!
//! This crate is `tress._tress`, the compiled part of the package; what Python imports is
//! `python/tress`, with its type stubs. Classes hold what the facade's types hold, functions are
//! the facade's functions with keywords for options, errors are exceptions (`TressError`). No
//! function holds the interpreter's lock while it works.
//!
//! | module | Python sees |
//! |---|---|
//! | `groom`, `helix_groom` | the classes `Groom` and `HelixGroom` |
//! | `fit`, `edit`, `sculpt`, `switchback`, `grow`, `analysis`, `picture`, `files` | functions |
//! | `centerline`, `inverse` | functions: the lines that coils wind about, operators found |
//! | `helicoid`, `procedural` | the classes `HelicoidGroom` and `ProceduralGroom`, and functions |
//! | `arrays` | arrays in, checked and copied once |
//! | `views`, `frames` | arrays out: views of a groom's memory, and positions and axes of frames |
//! | `plain`, `space`, `progress`, `error` | options and reports, units, progress, exceptions |
//!
//! **Invariant**: a groom that Python holds never changes, so the arrays it hands out may share its
//! memory.

mod analysis;
mod animation;
mod arrays;
mod centerline;
mod edit;
mod error;
mod files;
mod fit;
mod frames;
mod groom;
mod grow;
mod helicoid;
mod helix_groom;
mod inverse;
mod picture;
mod plain;
mod procedural;
mod progress;
mod sculpt;
mod space;
mod switchback;
mod views;

/// Editing coiled hair in curvature space: the compiled part of the package `tress`.
#[pyo3::pymodule]
mod _tress {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::analysis::{analyze, compare, defects, quantity, summarize};
    #[pymodule_export]
    use super::animation::{Animation, write as write_animation};
    #[pymodule_export]
    use super::centerline::centerlines;
    #[pymodule_export]
    use super::edit::{blend, groups, recoil, ruffle};
    #[pymodule_export]
    use super::error::TressError;
    #[pymodule_export]
    use super::files::{read, read_mesh, write, write_unreal};
    #[pymodule_export]
    use super::fit::{fit, sample};
    #[pymodule_export]
    use super::groom::Groom;
    #[pymodule_export]
    use super::grow::{grow, grow_presets, scatter};
    #[pymodule_export]
    use super::helicoid::{
        HelicoidGroom, fill, fit_helicoids, sample_helicoids, to_helices, wisps,
    };
    #[pymodule_export]
    use super::helix_groom::HelixGroom;
    #[pymodule_export]
    use super::inverse::fit_procedural;
    #[pymodule_export]
    use super::picture::{encode, render};
    #[pymodule_export]
    use super::procedural::ProceduralGroom;
    #[pymodule_export]
    use super::sculpt::{Sculptor, armature, sculpt};
    #[pymodule_export]
    use super::switchback::{insert_switchbacks, switchback};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
