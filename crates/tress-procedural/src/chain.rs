//! A chain of operators run over all strands.
//!
//! Operators that move each strand by itself are run one after the other on a strand while it is
//! in the cache, compiled once more for each width of vectors that a processor may have; strands
//! are shared out among threads in blocks.

mod derivative;

use std::ops::Range;

use glam::DVec3;
use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::numbers::{count, of_strand, stream};
use crate::operators::{Convention, CurvatureError, Guides, ParameterError, Scratch, Setting};
use crate::{EvenStrands, Operator};

pub use derivative::Gradients;

/// Operators and the convention they follow.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Chain {
    /// Which formulas.
    pub convention: Convention,
    /// The operators, first to last.
    pub operators: Vec<Operator>,
}

/// What a chain's operators act with: operator guides and random numbers.
#[derive(Clone, Copy, Debug)]
pub struct Bound<'a> {
    /// The operator guides, with as many points as the strands.
    pub guides: &'a EvenStrands,
    /// The operator guide of each strand.
    pub operator_of: &'a [u32],
    /// The random numbers of each operator, see [`draw`](crate::draw).
    pub numbers: &'a [Vec<f64>],
}

/// Why a chain cannot be run.
#[derive(Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChainError {
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// Operator guides with another number of points than the strands.
    #[error("operator guides have {guides} points, expected {strands} as strands have")]
    Points {
        /// Points of an operator guide.
        guides: usize,
        /// Points of a strand.
        strands: usize,
    },
    /// Not one operator guide a strand.
    #[error("operator guides of {given} strands, expected {strands}")]
    Assigned {
        /// Entries given.
        given: usize,
        /// Strands there are.
        strands: usize,
    },
    /// A strand assigned to an operator guide that is not there.
    #[error("strand {strand} belongs to operator guide {guide}, but there are {guides}")]
    NoGuide {
        /// The strand.
        strand: usize,
        /// The guide it is said to belong to.
        guide: u32,
        /// How many there are.
        guides: usize,
    },
    /// Not the random numbers the operators need.
    #[error("operator {operator} has {given} random numbers, expected {expected}")]
    Numbers {
        /// Which operator of the chain, from 0.
        operator: usize,
        /// Numbers given.
        given: usize,
        /// Numbers it needs.
        expected: usize,
    },
    /// An operator in curvature space failed: an option of its own is out of range, for one.
    #[error("{operator} {index}: {source}")]
    Curvature {
        /// The operator's name.
        operator: &'static str,
        /// Which operator of the chain, from 0.
        index: usize,
        /// Why.
        source: CurvatureError,
    },
    /// A chain with an operator that [has no derivative](Operator::is_differentiable).
    #[error("{0} has no derivative")]
    NoDerivative(&'static str),
}

/// Strands that are shared out to a thread at a time.
const BLOCK: usize = 64;

impl Chain {
    fn check(&self, strands: &EvenStrands, bound: &Bound<'_>) -> Result<(), ChainError> {
        for (index, operator) in self.operators.iter().enumerate() {
            operator.check(index)?;
        }
        let guides = bound.guides.points_each();
        if guides != strands.points_each() {
            return Err(ChainError::Points { guides, strands: strands.points_each() });
        }
        let given = bound.operator_of.len();
        if given != strands.len() {
            return Err(ChainError::Assigned { given, strands: strands.len() });
        }
        let guides = bound.guides.len();
        let strays = |&(_, &guide): &(usize, &u32)| guide as usize >= guides;
        if let Some((strand, &guide)) = bound.operator_of.iter().enumerate().find(strays) {
            return Err(ChainError::NoGuide { strand, guide, guides });
        }
        for (o, operator) in self.operators.iter().enumerate() {
            let given = bound.numbers.get(o).map_or(0, Vec::len);
            let expected = count(operator, strands.len(), guides);
            if given != expected {
                return Err(ChainError::Numbers { operator: o, given, expected });
            }
        }
        Ok(())
    }

    /// Runs the operators over strands, in place. `seed` is for operators that have no stored
    /// numbers and draw: ruffle, switchback and skip.
    ///
    /// # Errors
    ///
    /// If a parameter is out of range or what the operators act with does not fit the strands; the
    /// strands are then as they were, or none where an operator in curvature space failed.
    pub fn apply(
        &self,
        strands: &mut EvenStrands,
        bound: &Bound<'_>,
        seed: u64,
    ) -> Result<(), ChainError> {
        self.check(strands, bound)?;
        let guides = Guides::new(bound.guides, &self.operators);
        let work = Work { chain: self, bound, guides: &guides };
        let mut first = 0;
        while first < self.operators.len() {
            let run = self.operators[first..].iter().take_while(|o| o.is_differentiable()).count();
            work.apply(first..first + run, strands);
            first += run;
            if let Some(operator) = self.operators.get(first) {
                let seed = stream(&self.operators, first, seed);
                operator.apply_to_all(strands, bound.operator_of, seed).map_err(|source| {
                    let operator = operator.name();
                    ChainError::Curvature { operator, index: first, source }
                })?;
                first += 1;
            }
        }
        Ok(())
    }
}

/// A chain, what its operators act with, and the rows of its operator guides.
#[derive(Clone, Copy)]
struct Work<'a> {
    chain: &'a Chain,
    bound: &'a Bound<'a>,
    guides: &'a Guides,
}

impl<'a> Work<'a> {
    /// Runs operators that move each strand by itself.
    fn apply(self, run: Range<usize>, strands: &mut EvenStrands) {
        if run.is_empty() {
            return;
        }
        let m = strands.points_each();
        strands.points_mut().par_chunks_mut(m * BLOCK).enumerate().for_each_init(
            || Scratch::new(m),
            |scratch, (block, points)| {
                let (work, run) = (self, run.clone());
                Arch::new().dispatch(BlockRun { work, run, first: block * BLOCK, points, scratch });
            },
        );
    }

    /// What operator `o` knows of a strand.
    #[inline(always)]
    fn setting(&self, o: usize, strand: usize) -> Setting<'a> {
        let guide = self.bound.operator_of[strand] as usize;
        Setting {
            convention: self.chain.convention,
            guide: self.bound.guides.strand(guide),
            rows: self.guides.rows(guide),
            numbers: of_strand(&self.chain.operators[o], &self.bound.numbers[o], strand, guide),
        }
    }
}

/// Operators to be run on the strands of a block.
struct BlockRun<'a> {
    work: Work<'a>,
    run: Range<usize>,
    /// The index of the block's first strand.
    first: usize,
    points: &'a mut [DVec3],
    scratch: &'a mut Scratch,
}

impl NullaryFnOnce for BlockRun<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { work, run, first, points, scratch } = self;
        for (row, strand) in points.chunks_exact_mut(scratch.points_each()).enumerate() {
            scratch.load(strand);
            for o in run.clone() {
                work.chain.operators[o].apply(&work.setting(o, first + row), scratch);
            }
            scratch.store(strand);
        }
    }
}

#[cfg(test)]
mod tests;
