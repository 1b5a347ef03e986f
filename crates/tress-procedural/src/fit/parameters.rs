//! The parameters of the operators [IPG 5.5], in few, good steps.
//!
//! The paper alternates three losses for up to 9,000 steps of Adam. Here random numbers and slices
//! are drawn once and kept, which makes every loss a smooth function of a handful of parameters,
//! and
//!
//! 1. each parameter is looked for over its whole range, the others held (a start may be as far
//!    off as it likes), and two that can stand in for each other over the ranges of both;
//! 2. all of them together go downhill by Levenberg-Marquardt steps on the ranks of
//!    [slices](super::slices), derivatives by differences;
//!
//! and that is done twice: what was looked for while the others were far off is looked for again.
//! Before that, pairs and a way downhill are tried with fewer strands, from the parameters given
//! and from ordinary ones, so that a start that is far off does not lead into a valley of its own.
//! Scale and clump are among the parameters: the paper's segments do not show them, differences of
//! [neighbours](super::sample) do. Where it is asked for, they are at last set to where the
//! [correlations](super::correlation) of target and model agree, found by bisection.

use serde::{Deserialize, Serialize};

use super::ranges::{begin, mean_length, ordinary};
use super::search::Search;
use super::settle::Correlations;
use crate::{ChainError, EvenStrands, Operator, ProceduralGroom};

/// How parameters are looked for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ParameterOptions {
    /// Strands that are compared, each with the mean of its patch and with its neighbour, which
    /// comes in addition. Default 2000: ranks are then known to about 2 % of their spread.
    pub strands: usize,
    /// Slices of segments, and as many of spectra. Default 64.
    pub slices: usize,
    /// Rounds of looking for each parameter alone, then going downhill with all. Default 2.
    pub rounds: usize,
    /// Values of each parameter that are tried over its range in a round. Default 16; 0 keeps to
    /// the neighbourhood of the start.
    pub searches: usize,
    /// Levenberg-Marquardt steps a round, at most. Default 12.
    pub steps: usize,
    /// Patches of neighbours whose correlations are measured. Default 24.
    pub patches: usize,
    /// Whether scale is at last set to where the correlations of neighbours' lengths agree, as in
    /// the paper. Default no: slices of the differences of neighbours show it, and measured better.
    pub correlate_scale: bool,
    /// Whether clump is at last set to where the correlations of neighbours' distances agree.
    /// Default no: slices measured better on all known grooms.
    pub correlate_clump: bool,
}

impl Default for ParameterOptions {
    fn default() -> Self {
        Self {
            strands: 2000,
            slices: 64,
            rounds: 2,
            searches: 16,
            steps: 12,
            patches: 24,
            correlate_scale: false,
            correlate_clump: false,
        }
    }
}

impl ParameterOptions {
    /// Whether an operator's parameter is found by correlations.
    pub(super) fn correlates(&self, operator: &Operator) -> bool {
        match operator {
            Operator::Scale(_) => self.correlate_scale,
            Operator::Clump(_) => self.correlate_clump,
            _ => false,
        }
    }

    /// Steps that are told at most.
    pub(super) fn most_steps(&self, operators: &[Operator]) -> usize {
        let count: usize = operators.iter().map(|operator| operator.parameters().len()).sum();
        self.rounds * (count + self.steps) + 2 * self.steps + 2
    }
}

/// A loss that is not a number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the loss is not a number {place}")]
pub struct LossError {
    /// Where it came up.
    pub place: String,
}

/// Why parameters cannot be found.
#[derive(Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StageError {
    /// The chain cannot be run.
    #[error(transparent)]
    Chain(#[from] ChainError),
    /// Not one target a strand, or with other numbers of points.
    #[error("{given} target strands of {points} points, expected {strands} of {points_each}")]
    Targets {
        /// Target strands.
        given: usize,
        /// Points of each.
        points: usize,
        /// Strands of the groom.
        strands: usize,
        /// Points of each.
        points_each: usize,
    },
    /// The loss is not a number.
    #[error(transparent)]
    Loss(#[from] LossError),
    /// The groom cannot be built.
    #[error(transparent)]
    Build(#[from] crate::BuildError),
}

/// A report of the loss and all parameters after each step.
pub type Watch<'a> = dyn FnMut(f64, &[Operator]) + 'a;

/// Finds the parameters of the groom's scale, clump, bend, curl and frizz that give strands like
/// `targets`, strand `i` of which grows where the groom's does; those of `sound` are compared.
///
/// `watch` is told the loss and the operators after every step. Gives the last loss.
///
/// # Errors
///
/// If the targets do not fit the groom, the chain cannot be run or the loss is not a number; the
/// groom then has the last good parameters.
pub fn fit_parameters(
    groom: &mut ProceduralGroom,
    targets: &EvenStrands,
    sound: &[usize],
    options: &ParameterOptions,
    watch: &mut Watch<'_>,
) -> Result<f64, StageError> {
    let (strands, points_each) = (groom.roots.len(), groom.guides.points_each());
    if targets.len() != strands || targets.points_each() != points_each {
        let (given, points) = (targets.len(), targets.points_each());
        return Err(StageError::Targets { given, points, strands, points_each });
    }
    groom.check()?;
    let instanced = groom.instances()?.instance(&groom.guides, &groom.roots.positions);
    let length = mean_length(&instanced);
    begin(&mut groom.chain.operators, length);
    let mut search =
        Search::new(groom, &instanced, targets, sound, options.strands, options.slices);
    let mut loss = search.loss()?;
    watch(loss, &search.operators);
    if options.searches > 0 {
        let few = options.strands / COARSER;
        let mut coarse = Search::new(groom, &instanced, targets, sound, few, options.slices);
        search.operators = best_start(&mut coarse, length, options, watch)?;
        groom.chain.operators.clone_from(&search.operators);
        loss = search.loss()?;
    }
    for _ in 0..options.rounds {
        for h in 0..search.handles.len() {
            loss = search.scan(h, options.searches, loss)?;
            watch(loss, &search.operators);
            groom.chain.operators.clone_from(&search.operators);
        }
        loss = search.scan_pairs(options.searches, loss)?;
        loss = search.descend(options.steps, loss, watch)?;
        groom.chain.operators.clone_from(&search.operators);
    }
    if groom.chain.operators.iter().any(|operator| options.correlates(operator)) {
        let correlations = Correlations::new(groom, &instanced, targets, sound, options);
        correlations.settle(&mut search.operators)?;
        loss = search.loss()?;
        groom.chain.operators.clone_from(&search.operators);
    }
    watch(loss, &search.operators);
    Ok(loss)
}

/// How many times fewer strands the first look over all parameters takes.
const COARSER: usize = 4;

/// Where to begin: from the parameters given and from [ordinary] ones, the pairs that show only
/// together are looked for and all go downhill; the better of the two.
fn best_start(
    search: &mut Search,
    length: f64,
    options: &ParameterOptions,
    watch: &mut Watch<'_>,
) -> Result<Vec<Operator>, StageError> {
    let mut best: Option<(f64, Vec<Operator>)> = None;
    for start in [search.operators.clone(), ordinary(&search.operators, length)] {
        search.operators = start;
        let loss = search.loss()?;
        let loss = search.scan_pairs(options.searches, loss)?;
        let loss = search.descend(options.steps, loss, watch)?;
        if best.as_ref().is_none_or(|(least, _)| loss < *least) {
            best = Some((loss, search.operators.clone()));
        }
    }
    Ok(best.map_or_else(Vec::new, |(_, operators)| operators))
}

#[cfg(test)]
mod tests;
