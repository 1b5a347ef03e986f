//! Procedural grooms found for strands that have none.

use std::sync::atomic::{AtomicUsize, Ordering};

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use tress::procedural::fit::{Fitter, FitterError, Stage, StageOptions};
use tress::procedural::{Chain, Convention};

use crate::error::{TressError, refused};
use crate::groom::Groom;
use crate::plain::{data, merged, report};
use crate::procedural::ProceduralGroom;
use crate::progress::watched;

/// Steps that the progress of a stage is told in.
const STEPS: usize = 1000;

/// The stages that work, one after the other.
const WORK: [Stage; 4] = [Stage::Initialize, Stage::Guides, Stage::Parameters, Stage::Numbers];

/// What a fit came to, as a dictionary.
#[derive(Serialize)]
struct Words {
    strands: usize,
    left_out: usize,
    losses: Vec<(&'static str, f64)>,
}

/// Finds guides and operators for strands that have none.
///
/// Args:
///     groom: The strands.
///     operators: The operators to be used, as for `ProceduralGroom`; their parameters are where
///         the search starts.
///     guides: How many guides; 500 where None.
///     operator_guides: How many curls or clumps; as many as guides where None.
///     points: Points a strand.
///     neighbors: Guides that a strand is blended from.
///     own_weights: Whether a strand's guides are weighted as brings it nearest, or by the distance
///         of roots alone.
///     alternations: How often guides and parameters are found again, each with what the other came
///         to.
///     seed: The same seed finds the same groom.
///     root_weight, smoothing, guide, parameters, numbers, flaws: As in the RON files that the
///         program's `groom fit --options` reads, those with several parts as dictionaries.
///     progress: Called now and then with the share that is done, from 0 to 1.
///
/// Options that are None have their defaults.
///
/// Returns:
///     The ProceduralGroom, and a report: "strands", the strands "left_out" that are none, and
///     "losses": pairs of what was being done and the loss, which compare within a stage only.
///
/// Example:
///     >>> found, report = tress.fit_procedural(groom, [{"Clump": {"profile": 1.0}}], guides=50)
#[pyfunction]
#[pyo3(signature = (groom, operators, *, progress=None, **options),
       text_signature = "(groom, operators, *, guides=None, operator_guides=None, points=None, \
                         neighbors=None, own_weights=None, alternations=None, seed=None, \
                         root_weight=None, smoothing=None, guide=None, parameters=None, \
                         numbers=None, flaws=None, progress=None)")]
pub(crate) fn fit_procedural<'py>(
    py: Python<'py>,
    groom: &Bound<'_, Groom>,
    operators: &Bound<'_, PyAny>,
    progress: Option<&Bound<'_, PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(ProceduralGroom, Bound<'py, PyAny>)> {
    let options: StageOptions = merged(py, &StageOptions::default(), options)?;
    let operators = data(operators, "operators")?;
    let chain = Chain { convention: Convention::default(), operators };
    let target = &groom.get().0;
    let fitter = watched(py, progress, STEPS * WORK.len(), |done| {
        let mut fitter = Fitter::new(target, chain, options)?;
        advance(&mut fitter, done)?;
        Ok::<_, FitterError>(fitter)
    })?;
    let fitter = fitter.map_err(refused)?;
    let found = fitter.groom().cloned();
    let found = found.ok_or_else(|| TressError::new_err("nothing was found"))?;
    let strands = fitter.kept().len();
    let losses = fitter.history().iter().map(|record| (record.stage.describe(), record.loss));
    let left_out = target.strands().len() - strands;
    let words = Words { strands, left_out, losses: losses.collect() };
    Ok((ProceduralGroom(found), report(py, &words)?))
}

/// Runs all stages, counting in `done` how many steps of each are.
fn advance(fitter: &mut Fitter, done: &AtomicUsize) -> Result<(), FitterError> {
    while fitter.stage() != Stage::Done {
        let before = WORK.iter().position(|stage| *stage == fitter.stage()).unwrap_or(0);
        fitter.advance(&mut |now| {
            #[expect(clippy::cast_possible_truncation, reason = "it is 0 to STEPS")]
            #[expect(clippy::cast_sign_loss, reason = "it is 0 to STEPS")]
            let steps = (STEPS as f64 * now.done.clamp(0.0, 1.0)) as usize;
            done.store(before * STEPS + steps, Ordering::Relaxed);
        })?;
    }
    Ok(())
}
