//! The derivative of a chain: the exact vector-Jacobian product.
//!
//! Gradients of what strands share are added up block by block in the order of the strands, so
//! that they do not depend on the number of threads.

use glam::DVec3;
use rayon::prelude::*;

use super::{BLOCK, Bound, Chain, ChainError, Work};
use crate::numbers::count;
use crate::operators::{Guides, Scratch, Sums};
use crate::{EvenStrands, Operator};

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

impl Chain {
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
        let guides = Guides::new(bound.guides, &self.operators);
        let work = Work { chain: self, bound, guides: &guides };
        let mut gradients = self.zeros(strands, bound, gradient);
        let blocks = blocks(bound, &mut gradients.strands);
        let totals: Vec<BlockSums> = blocks
            .into_par_iter()
            .map_init(
                || Tape::new(self.operators.len(), strands.points_each()),
                |tape, block| self.pull_back_block(block, strands, &work, tape),
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
        work: &Work<'_>,
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
            tape.record(work, i, strands.strand(i));
            for o in (0..self.operators.len()).rev() {
                let mut strand_sums = Sums {
                    guide: &mut sums.guide,
                    parameters: &mut sums.parameters[o],
                    numbers: [0.0; 2],
                };
                let setting = work.setting(o, i);
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

    /// Runs the operators on strand `i`, keeping what each was given.
    fn record(&mut self, work: &Work<'_>, i: usize, strand: &[DVec3]) {
        self.scratch.load(strand);
        for (o, given) in self.points.chunks_exact_mut(strand.len()).enumerate() {
            self.scratch.store(given);
            work.chain.operators[o].apply(&work.setting(o, i), &mut self.scratch);
        }
    }
}
