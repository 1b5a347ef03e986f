//! A chain of operators run over all strands, and its derivative.
//!
//! Operators that move each strand by itself are run one after the other on a strand while it is
//! in the cache; strands are shared out among threads in blocks. Gradients of what strands share
//! are added up block by block in the order of the strands, so that they do not depend on the
//! number of threads.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::numbers::{count, of_strand};
use crate::operators::{
    Convention, CurvatureError, Normals, ParameterError, Scratch, Setting, Sums,
    apply_in_curvature_space, normals,
};
use crate::{EvenStrands, Operator};

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

/// Gradients of a loss by all that goes into a chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradients {
    /// By the points of the strands given.
    pub strands: EvenStrands,
    /// By the points of the operator guides.
    pub guides: EvenStrands,
    /// By the parameters of each operator, see [`Operator::parameters`].
    pub parameters: Vec<Vec<f64>>,
    /// By the random numbers of each operator.
    pub numbers: Vec<Vec<f64>>,
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
    /// An operator in curvature space failed.
    #[error(transparent)]
    Curvature(#[from] CurvatureError),
    /// A chain with an operator in curvature space has no derivative.
    #[error("{0} acts in curvature space and has no derivative")]
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

    /// Runs the operators over strands, in place. `seed` is for operators in curvature space.
    ///
    /// # Errors
    ///
    /// If a parameter is out of range or what the operators act with does not fit the strands; the
    /// strands are then as they were, unless an operator in curvature space failed.
    pub fn apply(
        &self,
        strands: &mut EvenStrands,
        bound: &Bound<'_>,
        seed: u64,
    ) -> Result<(), ChainError> {
        self.check(strands, bound)?;
        let normals = self.normals(bound.guides);
        let mut first = 0;
        while first < self.operators.len() {
            let run = self.operators[first..].iter().take_while(|o| o.is_differentiable()).count();
            self.apply_run(first..first + run, strands, bound, &normals);
            first += run;
            if let Some(operator) = self.operators.get(first) {
                let taken =
                    std::mem::replace(strands, EvenStrands::zeros(0, strands.points_each()));
                *strands = apply_in_curvature_space(operator, taken, bound.operator_of, seed)?;
                first += 1;
            }
        }
        Ok(())
    }

    /// Runs operators that move each strand by itself.
    fn apply_run(
        &self,
        run: std::ops::Range<usize>,
        strands: &mut EvenStrands,
        bound: &Bound<'_>,
        normals: &[Normals],
    ) {
        let m = strands.points_each();
        strands.points_mut().par_chunks_mut(m * BLOCK).enumerate().for_each_init(
            || Scratch::new(m),
            |scratch, (block, points)| {
                for (row, strand) in points.chunks_exact_mut(m).enumerate() {
                    let i = block * BLOCK + row;
                    for o in run.clone() {
                        let setting = self.setting(o, i, bound, normals);
                        self.operators[o].apply(strand, &setting, scratch);
                    }
                }
            },
        );
    }

    /// Normals and binormals of the operator guides, if an operator needs them.
    fn normals(&self, guides: &EvenStrands) -> Vec<Normals> {
        if !self.operators.iter().any(|operator| matches!(operator, Operator::Curl(_))) {
            return Vec::new();
        }
        let m = guides.points_each();
        let mut all = vec![[DVec3::ZERO; 2]; guides.points().len()];
        all.par_chunks_mut(m).zip(guides.points().par_chunks(m)).for_each(|(out, guide)| {
            normals(guide, out);
        });
        all
    }

    #[inline]
    fn setting<'a>(
        &self,
        o: usize,
        strand: usize,
        bound: &Bound<'a>,
        normals: &'a [Normals],
    ) -> Setting<'a> {
        let guide = bound.operator_of[strand] as usize;
        let m = bound.guides.points_each();
        Setting {
            convention: self.convention,
            guide: bound.guides.strand(guide),
            normals: normals.get(guide * m..(guide + 1) * m).unwrap_or_default(),
            numbers: of_strand(&self.operators[o], &bound.numbers[o], strand, guide),
        }
    }

    /// The gradients of a loss by all that goes into the chain, from that by the points that come
    /// out: the exact vector-Jacobian product.
    ///
    /// # Errors
    ///
    /// As [`Self::apply`], and if an operator has no derivative.
    pub fn pull_back(
        &self,
        strands: &EvenStrands,
        bound: &Bound<'_>,
        gradient: &EvenStrands,
    ) -> Result<Gradients, ChainError> {
        self.check(strands, bound)?;
        if let Some(operator) = self.operators.iter().find(|o| !o.is_differentiable()) {
            return Err(ChainError::NoDerivative(operator.name()));
        }
        let normals = self.normals(bound.guides);
        let mut gradients = self.zeros(strands, bound, gradient);
        let blocks = blocks(bound, &mut gradients.strands);
        let totals: Vec<BlockSums> = blocks
            .into_par_iter()
            .map_init(
                || Tape::new(self.operators.len(), strands.points_each()),
                |tape, block| self.pull_back_block(block, strands, bound, &normals, tape),
            )
            .collect();
        for total in totals {
            self.add(total, &mut gradients, bound.guides.points_each());
        }
        Ok(gradients)
    }

    fn zeros(&self, strands: &EvenStrands, bound: &Bound<'_>, gradient: &EvenStrands) -> Gradients {
        let numbers = |o: &Operator| vec![0.0; count(o, strands.len(), bound.guides.len())];
        Gradients {
            strands: gradient.clone(),
            guides: EvenStrands::zeros(bound.guides.len(), strands.points_each()),
            parameters: self.operators.iter().map(|o| vec![0.0; o.parameters().len()]).collect(),
            numbers: self.operators.iter().map(numbers).collect(),
        }
    }

    /// Pulls the gradients of some strands of one operator guide back.
    fn pull_back_block(
        &self,
        block: Block<'_>,
        strands: &EvenStrands,
        bound: &Bound<'_>,
        normals: &[Normals],
        tape: &mut Tape,
    ) -> BlockSums {
        let m = strands.points_each();
        let mut sums = BlockSums {
            guide_index: block.guide,
            guide: vec![DVec3::ZERO; m],
            parameters: self.operators.iter().map(|o| vec![0.0; o.parameters().len()]).collect(),
            numbers: vec![Vec::with_capacity(block.strands.len()); self.operators.len()],
            strands: block.strands.iter().map(|(i, _)| *i).collect(),
        };
        for (i, gradient) in block.strands {
            tape.record(self, strands.strand(i), |o| self.setting(o, i, bound, normals));
            for o in (0..self.operators.len()).rev() {
                let mut strand_sums = Sums {
                    guide: &mut sums.guide,
                    parameters: &mut sums.parameters[o],
                    numbers: [0.0; 2],
                };
                let setting = self.setting(o, i, bound, normals);
                let given = &tape.points[o * m..(o + 1) * m];
                let operator = &self.operators[o];
                operator.pull_back(given, &setting, gradient, &mut strand_sums, &mut tape.scratch);
                sums.numbers[o].push(strand_sums.numbers);
            }
        }
        sums
    }

    /// Adds what a block came to.
    fn add(&self, total: BlockSums, gradients: &mut Gradients, points_each: usize) {
        let guide = total.guide_index;
        let range = guide * points_each..(guide + 1) * points_each;
        for (sum, part) in gradients.guides.points_mut()[range].iter_mut().zip(&total.guide) {
            *sum += *part;
        }
        for (o, operator) in self.operators.iter().enumerate() {
            for (sum, part) in gradients.parameters[o].iter_mut().zip(&total.parameters[o]) {
                *sum += part;
            }
            let numbers = &mut gradients.numbers[o];
            let shared = matches!(operator, Operator::Curl(_));
            for (&i, [first, second]) in total.strands.iter().zip(&total.numbers[o]) {
                if shared {
                    numbers[2 * guide] += first;
                    numbers[2 * guide + 1] += second;
                } else if !numbers.is_empty() {
                    numbers[i] += first;
                }
            }
        }
    }
}

/// Some strands of one operator guide, with the gradients by them.
struct Block<'a> {
    guide: usize,
    strands: Vec<(usize, &'a mut [DVec3])>,
}

/// What a block adds to the gradients.
struct BlockSums {
    guide_index: usize,
    guide: Vec<DVec3>,
    parameters: Vec<Vec<f64>>,
    numbers: Vec<Vec<[f64; 2]>>,
    strands: Vec<usize>,
}

/// Strands by operator guide, at most [`BLOCK`] together.
fn blocks<'a>(bound: &Bound<'_>, gradient: &'a mut EvenStrands) -> Vec<Block<'a>> {
    let m = gradient.points_each();
    let mut open: Vec<Vec<(usize, &mut [DVec3])>> = Vec::new();
    open.resize_with(bound.guides.len(), Vec::new);
    let mut blocks = Vec::new();
    for (i, row) in gradient.points_mut().chunks_exact_mut(m).enumerate() {
        let guide = bound.operator_of[i] as usize;
        open[guide].push((i, row));
        if open[guide].len() == BLOCK {
            blocks.push(Block { guide, strands: std::mem::take(&mut open[guide]) });
        }
    }
    let rest = open.into_iter().enumerate().filter(|(_, strands)| !strands.is_empty());
    blocks.extend(rest.map(|(guide, strands)| Block { guide, strands }));
    blocks
}

/// What each operator was given, for one strand.
struct Tape {
    points: Vec<DVec3>,
    scratch: Scratch,
}

impl Tape {
    fn new(operators: usize, points_each: usize) -> Self {
        let points = vec![DVec3::ZERO; operators * points_each];
        Self { points, scratch: Scratch::new(points_each) }
    }

    fn record<'s>(
        &mut self,
        chain: &Chain,
        strand: &[DVec3],
        setting: impl Fn(usize) -> Setting<'s>,
    ) {
        let m = strand.len();
        if self.points.is_empty() {
            return;
        }
        self.points[..m].copy_from_slice(strand);
        for o in 1..chain.operators.len() {
            let (given, put) = self.points.split_at_mut(o * m);
            put[..m].copy_from_slice(&given[(o - 1) * m..]);
            chain.operators[o - 1].apply(&mut put[..m], &setting(o - 1), &mut self.scratch);
        }
    }
}

#[cfg(test)]
mod tests;
