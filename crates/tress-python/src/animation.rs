//! Files that hold a groom at several times.

use std::path::PathBuf;

use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use tress::geometry::Groom as Inner;
use tress::io::{Animation as Frames, WriteError, WriteOptions};

use crate::error::{not_read, not_written};
use crate::files::usd_curves;
use crate::groom::Groom;

/// An Alembic or USD file with a groom at each of several times; any other file is one frame.
///
/// Frames are read when they are asked for.
///
/// Example:
///     >>> for groom in tress.Animation("wind.abc"):
///     ...     print(groom.positions.mean(axis=0))
#[pyclass(frozen, module = "tress")]
#[derive(Debug)]
pub(crate) struct Animation(Frames);

#[pymethods]
impl Animation {
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        py.detach(|| Frames::open(path)).map(Self).map_err(not_read)
    }

    /// The number of frames.
    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// One frame.
    fn __getitem__(&self, py: Python<'_>, frame: isize) -> PyResult<Groom> {
        let length = self.0.len();
        let from_front = if frame < 0 { frame.checked_add_unsigned(length) } else { Some(frame) };
        let frame = from_front.and_then(|i| usize::try_from(i).ok()).filter(|i| *i < length);
        let frame =
            frame.ok_or_else(|| PyIndexError::new_err(format!("there are {length} frames")))?;
        py.detach(|| self.0.read(frame)).map(Groom).map_err(not_read)
    }

    /// The number of the first frame.
    #[getter]
    fn start(&self) -> f64 {
        self.0.frames().start
    }

    /// Frames a second.
    #[getter]
    fn rate(&self) -> f64 {
        self.0.frames().rate
    }
}

/// Writes grooms, one a frame, to one .abc, .usdc or .usd file.
///
/// Args:
///     path: The file.
///     grooms: The frames; attributes are those of the first on every one.
///     start: The number of the first frame.
///     rate: Frames a second.
///     usd_curves: What a USD file says lies between points: "linear" or "catmull-rom".
///
/// Returns:
///     What the format has no place for, in words.
#[pyfunction]
#[pyo3(name = "write_animation")]
#[pyo3(signature = (path, grooms, *, start=1.0, rate=24.0, usd_curves="linear"))]
pub(crate) fn write<'py>(
    py: Python<'py>,
    path: PathBuf,
    grooms: Vec<Bound<'py, Groom>>,
    start: f64,
    rate: f64,
    usd_curves: &str,
) -> PyResult<Vec<String>> {
    let options = WriteOptions { usd_curves: self::usd_curves(usd_curves)? };
    let frames = tress::io::Frames { start, rate };
    let grooms: Vec<&Inner> = grooms.iter().map(|groom| &groom.get().0).collect();
    let one_by_one = grooms.into_iter().map(|groom| Ok::<_, WriteError>(groom.clone()));
    let lost = py.detach(|| tress::io::write_animation(path, frames, &options, one_by_one));
    Ok(lost.map_err(not_written)?.iter().map(ToString::to_string).collect())
}
