//! Procedural grooms: guides and operators to strands.

use std::path::PathBuf;

use pyo3::prelude::*;
use tress::procedural::{EvenStrands, Operator, ProceduralGroom as Inner, Roots};

use crate::arrays::{Shaped, floats, misshapen, vectors};
use crate::error::refused;
use crate::groom::Groom;
use crate::plain::{data, report};

/// A groom as guides and a chain of operators: what artists edit.
///
/// Args:
///     guides: (guides, points, 3).
///     roots: Where strands grow, (n, 3).
///     operators: What is done to the strands one after the other: dictionaries of one name, such
///         as {"Clump": {"profile": 1.5}}, or the text of a list in RON.
///     seed: Where random numbers come from.
///     instancing: How strands choose guides: {"Gaussian": {"neighbors": n, "sigma": s}}.
///     widths: Widths of every strand at places even from root to tip, linear between.
///
/// Example:
///     >>> groom = tress.ProceduralGroom(guides, roots, [{"Clump": {"profile": 1.5}}])
///     >>> strands = groom.build()
#[pyclass(frozen, module = "tress")]
#[derive(Debug)]
pub(crate) struct ProceduralGroom(pub(crate) Inner);

#[pymethods]
impl ProceduralGroom {
    #[new]
    #[pyo3(signature = (guides, roots, operators=None, *, seed=0, instancing=None, widths=None))]
    fn new(
        guides: &Bound<'_, PyAny>,
        roots: &Bound<'_, PyAny>,
        operators: Option<&Bound<'_, PyAny>>,
        seed: u64,
        instancing: Option<&Bound<'_, PyAny>>,
        widths: Option<Vec<f64>>,
    ) -> PyResult<Self> {
        let Shaped { shape, values } = floats(guides, "guides")?;
        let &[_, each, 3] = &shape[..] else {
            return Err(misshapen("guides", "(guides, points, 3)", &shape));
        };
        let guides = EvenStrands::new(each, bytemuck::cast_slice(&values).to_vec());
        let roots = Roots { positions: vectors(roots, "roots")?, uv: None };
        let mut groom = Inner::new(guides.map_err(refused)?, roots).map_err(refused)?;
        groom.seed = seed;
        groom.widths = widths.unwrap_or_default();
        if let Some(operators) = operators {
            groom.chain.operators = data(operators, "operators")?;
        }
        if let Some(instancing) = instancing {
            groom.instancing = data(instancing, "instancing")?;
        }
        groom.draw_missing();
        Ok(Self(groom))
    }

    /// Reads a procedural groom from its RON file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        py.detach(|| Inner::read(&path)).map(Self).map_err(refused)
    }

    /// Writes the RON file, and the file with its arrays beside it.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| self.0.write(&path)).map_err(refused)
    }

    /// The strands; the same to the last bit every time.
    fn build(&self, py: Python<'_>) -> PyResult<Groom> {
        py.detach(|| self.0.build_groom()).map(Groom).map_err(refused)
    }

    /// The operators, as dictionaries.
    #[getter]
    fn operators<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        report(py, &self.0.chain.operators)
    }

    /// Where random numbers come from.
    #[getter]
    fn seed(&self) -> u64 {
        self.0.seed
    }

    /// The guides, as a Groom.
    #[getter]
    fn guides(&self) -> PyResult<Groom> {
        let strands = self.0.guides.clone().into_strands().map_err(refused)?;
        let groom = tress::geometry::Groom::new(strands);
        Ok(Groom(groom.in_space(self.0.unit, self.0.up)))
    }

    /// The same guides and roots with other operators; those of a place and kind that were there
    /// keep their random numbers.
    fn with_operators(&self, operators: &Bound<'_, PyAny>) -> PyResult<Self> {
        let mut groom = self.0.clone();
        groom.chain.operators = data(operators, "operators")?;
        groom.draw_missing();
        Ok(Self(groom))
    }

    fn __repr__(&self) -> String {
        let names: Vec<_> = self.0.chain.operators.iter().map(Operator::name).collect();
        let (guides, strands) = (self.0.guides.len(), self.0.roots.len());
        let names = names.join(", ");
        format!("<tress.ProceduralGroom: {guides} guides, {strands} strands, {names}>")
    }
}
