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
//! Scale and clump are among the parameters: the paper's segments do not show them, segments
//! relative to the guide do. Where it is asked for, they are at last set to where the
//! [correlations](super::correlation) of target and model agree, found by bisection.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::courses::segments;
use super::ranges::{begin, handles, pairs};
use super::search::{Problem, Search};
use super::settle::Correlations;
use super::slices::Slices;
use crate::{ChainError, EvenStrands, Operator, ProceduralGroom};

/// How parameters are looked for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ParameterOptions {
    /// Strands that are compared. Default 2000: ranks are then known to about 2 % of their spread.
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
    /// the paper. Default no: with the guides' segments taken away slices show it, and measured
    /// better where guides are good; where they are not, as under bends of more than 90 degrees,
    /// errors of guides look like a spread of lengths, and this keeps out of it.
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
        self.rounds * (count + self.steps + 2) + 1
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
    let chosen = spread(sound, options.strands);
    let problem = Problem::new(groom, &instanced, &chosen);
    let chosen_targets = targets.select(&chosen);
    let slices =
        Slices::new(&chosen_targets, problem.instanced.clone(), options.slices, groom.seed);
    let length = mean_length(&problem.instanced);
    begin(&mut groom.chain.operators, length);
    let handles = handles(&groom.chain.operators, length, points_each);
    let operators = groom.chain.operators.clone();
    let mut search = Search { problem: &problem, slices: &slices, operators, handles };
    let correlations = Correlations::new(groom, &instanced, targets, sound, options);
    let mut loss = search.loss()?;
    for _ in 0..options.rounds {
        for h in 0..search.handles.len() {
            loss = search.scan(h, options.searches, loss)?;
            watch(loss, &search.operators);
            groom.chain.operators.clone_from(&search.operators);
        }
        for pair in pairs(&search.operators, &search.handles) {
            loss = search.scan_pair(pair, options.searches / 2, loss)?;
            watch(loss, &search.operators);
        }
        for _ in 0..options.steps {
            let before = loss;
            loss = search.step(before)?;
            watch(loss, &search.operators);
            groom.chain.operators.clone_from(&search.operators);
            if before - loss < LEAST_GAIN * before {
                break;
            }
        }
    }
    correlations.settle(&mut search.operators)?;
    loss = search.loss()?;
    watch(loss, &search.operators);
    groom.chain.operators.clone_from(&search.operators);
    Ok(loss)
}

/// A step that takes less than this share of the loss is the last of its round.
const LEAST_GAIN: f64 = 1e-4;

/// At most `count` of the strands, evenly spread over the list.
pub(super) fn spread(strands: &[usize], count: usize) -> Vec<usize> {
    let n = strands.len();
    if n <= count {
        return strands.to_vec();
    }
    (0..count).map(|k| strands[k * n / count]).collect()
}

fn mean_length(strands: &EvenStrands) -> f64 {
    let length = |strand: &[DVec3]| segments(strand).map(DVec3::length).sum::<f64>();
    strands.iter().map(length).sum::<f64>() / strands.len().max(1) as f64
}

#[cfg(test)]
mod tests;
