//! The operators that act in curvature space: the strands are fitted with super-helices, changed,
//! and sampled again.
//!
//! Strands of an operator guide are a group, as wisps are for [`tress_edit::ruffle`] and
//! [`tress_switchback::insert`]: a ruffle exchanges pieces among them, and their coils change hands
//! at the same places.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_edit::{recoil, ruffle};
use tress_fit::{Elements, FitOptions, Sampling, fit, sample};
use tress_geometry::{Groom, HelixGroom};
use tress_switchback::{InsertOptions, Placing, insert};

use super::Operator;
use crate::EvenStrands;

/// Coils that change hands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Switchback {
    /// Where. Default halfway along the strands of an operator guide.
    pub places: Placing,
    /// How they are shaped.
    pub shape: InsertOptions,
}

impl Default for Switchback {
    fn default() -> Self {
        Self { places: Placing::Shares(vec![0.5]), shape: InsertOptions::default() }
    }
}

/// Why an operator in curvature space failed.
#[derive(Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurvatureError {
    /// The strands could not be fitted.
    #[error(transparent)]
    Fit(#[from] tress_fit::FitError),
    /// The coils could not be changed.
    #[error(transparent)]
    Recoil(#[from] tress_edit::RecoilError),
    /// The strands could not be ruffled.
    #[error(transparent)]
    Ruffle(#[from] tress_edit::RuffleError),
    /// The coils could not change hands.
    #[error(transparent)]
    Switchback(#[from] tress_switchback::InsertGroomError),
    /// The strands could not be sampled.
    #[error(transparent)]
    Sample(#[from] tress_fit::SampleError),
    /// More points than offsets tell apart.
    #[error(transparent)]
    Offsets(#[from] tress_geometry::OffsetsError),
    /// The strands came back with other numbers of points.
    #[error(transparent)]
    Even(#[from] crate::EvenError),
}

/// The strands with one operator applied; `operator_of[i]` is the group of strand `i`.
pub(super) fn apply(
    operator: &Operator,
    strands: EvenStrands,
    operator_of: &[u32],
    seed: u64,
) -> Result<EvenStrands, CurvatureError> {
    let changed = |helices: HelixGroom| -> Result<HelixGroom, CurvatureError> {
        Ok(match operator {
            Operator::Recoil(options) => recoil(&helices, options)?,
            Operator::Ruffle(options) => ruffle(&helices, operator_of, options, seed)?.0,
            Operator::Switchback(Switchback { places, shape }) => {
                insert(&helices, operator_of, places, shape, seed)?.0
            }
            _ => helices,
        })
    };
    let points_each = strands.points_each();
    let roots: Vec<DVec3> = strands.roots();
    let groom = Groom::new(strands.into_strands()?);
    let elements = Elements::Count(points_each - 1);
    let options = FitOptions { elements, measure: false, ..FitOptions::default() };
    let helices = changed(fit(&groom, &options)?.helices)?;
    let sampled = sample(&helices, &Sampling::Points(points_each))?;
    let mut even = EvenStrands::try_from(sampled.strands())?;
    // Roots stay where they were to the last bit.
    for (i, root) in roots.into_iter().enumerate() {
        even.strand_mut(i)[0] = root;
    }
    Ok(even)
}
