//! The lines that coils wind about.

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use tress::fit::{Centerline, centerline, centerline_of_turns};
use tress::geometry::polyline::Defect;

use crate::arrays::scalars;
use crate::error::TressError;
use crate::groom::Groom;

/// The lines that strands wind about.
///
/// Args:
///     groom: The polylines.
///     turns: How many turns each strand has, where that is known, as from another frame of an
///         animation; found where None. A strand of 0 turns is its own line.
///
/// Returns:
///     A Groom with a point on the line for each point of the groom, and the turns of each strand.
///     Strands that are no curves stay as they are, their turns NaN.
#[pyfunction]
#[pyo3(signature = (groom, *, turns=None))]
pub(crate) fn centerlines<'py>(
    py: Python<'py>,
    groom: &Bound<'_, Groom>,
    turns: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Groom, Bound<'py, PyArray1<f64>>)> {
    let groom = &groom.get().0;
    let turns = turns.map(|turns| scalars(turns, "turns")).transpose()?;
    let (given, strands) = (turns.as_ref().map(Vec::len), groom.strands().len());
    if let Some(given) = given.filter(|given| *given != strands) {
        let message = format!("turns: expected {strands}, a number a strand, found {given}");
        return Err(TressError::new_err(message));
    }
    let (lines, turns) = py.detach(|| {
        let line = |i: usize| -> Result<Centerline, Defect> {
            let points = groom.strands().strand(i);
            match &turns {
                None => centerline(points),
                Some(turns) => centerline_of_turns(points, turns[i]),
            }
        };
        let lines: Vec<_> = (0..strands).into_par_iter().map(line).collect();
        let mut moved = groom.clone();
        let mut found = Vec::with_capacity(strands);
        for (i, line) in lines.into_iter().enumerate() {
            let Ok(line) = line else {
                found.push(f64::NAN);
                continue;
            };
            found.push(line.turns());
            let points = &mut moved.positions_mut()[groom.strands().range(i)];
            points.iter_mut().zip(line.points()).for_each(|(point, on_line)| *point = on_line);
        }
        (moved, found)
    });
    Ok((Groom(lines), turns.into_pyarray(py)))
}
