//! A search for the parameters of a chain: over the range of each, then all of them downhill.

use nalgebra::{DMatrix, DVector};

use super::parameters::{LossError, StageError, Watch};
use super::ranges::{Handle, handles, mean_length, pairs};
use super::sample::Sample;
use super::slices::Slices;
use crate::{Bound, Chain, ChainError, EvenStrands, Operator, ProceduralGroom};

/// What stays while parameters change.
pub(super) struct Problem {
    pub(super) groom: ProceduralGroom,
    pub(super) instanced: EvenStrands,
    guides: EvenStrands,
    operator_of: Vec<u32>,
    numbers: Vec<Vec<f64>>,
}

impl Problem {
    /// The strands named, at the groom's parameters.
    pub(super) fn new(groom: &ProceduralGroom, instanced: &EvenStrands, strands: &[usize]) -> Self {
        let numbers =
            groom.chain.operators.iter().zip(&groom.numbers).map(|(operator, numbers)| {
                match operator {
                    Operator::Curl(_) => numbers.clone(),
                    _ if numbers.is_empty() => Vec::new(),
                    _ => strands.iter().map(|&i| numbers[i]).collect(),
                }
            });
        Self {
            instanced: instanced.select(strands),
            guides: groom.operator_guide_points(),
            operator_of: strands.iter().map(|&i| groom.operator_of[i]).collect(),
            numbers: numbers.collect(),
            groom: groom.clone(),
        }
    }

    pub(super) fn strands(&self, operators: &[Operator]) -> Result<EvenStrands, ChainError> {
        let bound =
            Bound { guides: &self.guides, operator_of: &self.operator_of, numbers: &self.numbers };
        let mut strands = self.instanced.clone();
        let chain = Chain { operators: operators.to_vec(), ..self.groom.chain.clone() };
        chain.apply(&mut strands, &bound, self.groom.seed)?;
        Ok(strands)
    }
}

/// What a search has found so far.
pub(super) struct Search {
    problem: Problem,
    slices: Slices,
    pub(super) operators: Vec<Operator>,
    pub(super) handles: Vec<Handle>,
}

/// A step that takes less than this share of the loss is the last of its round.
const LEAST_GAIN: f64 = 1e-4;
/// Damping of the first trial of a step, over the curvature of the loss.
const DAMPING: f64 = 1e-3;
/// Trials of a step, each damped 8 times as much as the one before: to 30 times the curvature.
const TRIALS: usize = 6;

impl Search {
    /// A search over at most `count` of the `sound` strands, from the groom's operators;
    /// `instanced` are all the groom's strands before operators.
    pub(super) fn new(
        groom: &ProceduralGroom,
        instanced: &EvenStrands,
        targets: &EvenStrands,
        sound: &[usize],
        count: usize,
        slices: usize,
    ) -> Self {
        let sample = Sample::new(groom, sound, count);
        let problem = Problem::new(groom, instanced, &sample.strands);
        let targets = targets.select(&sample.strands);
        let slices = Slices::new(&targets, &problem.instanced, &sample, slices, groom.seed);
        let operators = groom.chain.operators.clone();
        let handles = handles(&operators, mean_length(instanced), targets.points_each());
        Self { problem, slices, operators, handles }
    }

    fn residuals(&self, operators: &[Operator]) -> Result<DVector<f64>, StageError> {
        let strands = self.problem.strands(operators)?;
        let residuals = DVector::from_vec(self.slices.residuals(&strands));
        if residuals.iter().all(|r| r.is_finite()) {
            return Ok(residuals);
        }
        let place = format!("at the operators {operators:?}");
        Err(LossError { place }.into())
    }

    /// The loss at the operators found so far.
    pub(super) fn loss(&self) -> Result<f64, StageError> {
        self.loss_at(&self.operators)
    }

    fn loss_at(&self, operators: &[Operator]) -> Result<f64, StageError> {
        let residuals = self.residuals(operators)?;
        Ok(residuals.norm_squared() / residuals.len().max(1) as f64)
    }

    /// Tries `count` values over a parameter's range, more where it needs a
    /// [finer](Handle::fineness) look, then half as many about the best of them, and keeps what is
    /// better than the loss `before`; gives the loss.
    pub(super) fn scan(&mut self, h: usize, count: usize, before: f64) -> Result<f64, StageError> {
        let handle = self.handles[h];
        let mut best = (before, handle.value(&self.operators));
        self.try_all(&handle, handle.fineness * count, &mut best)?;
        self.try_all(&handle.about(best.1), count / 2, &mut best)?;
        handle.set(&mut self.operators, best.1);
        Ok(best.0)
    }

    /// Tries values over the ranges of two parameters together, for all that can stand in for each
    /// other, and keeps what is better than the loss `before`; gives the loss.
    ///
    /// What one of two takes away the other can give: looked for one after the other, scale and
    /// clump run to the ends of their ranges. `count` is as for [`Self::scan`].
    pub(super) fn scan_pairs(&mut self, count: usize, before: f64) -> Result<f64, StageError> {
        let mut best = before;
        for [a, b] in pairs(&self.operators, &self.handles) {
            let [first, second] = [a, b].map(|h| self.handles[h]);
            let mut operators = self.operators.clone();
            let mut found = self.operators.clone();
            for value in first.spread(first.fineness * count / 2) {
                first.set(&mut operators, value);
                for value in second.spread(count / 2) {
                    second.set(&mut operators, value);
                    let loss = self.loss_at(&operators)?;
                    if loss < best {
                        best = loss;
                        found.clone_from(&operators);
                    }
                }
            }
            self.operators = found;
        }
        Ok(best)
    }

    fn try_all(
        &self,
        handle: &Handle,
        count: usize,
        best: &mut (f64, f64),
    ) -> Result<(), StageError> {
        let mut operators = self.operators.clone();
        for candidate in handle.spread(count) {
            handle.set(&mut operators, candidate);
            let loss = self.loss_at(&operators)?;
            if loss < best.0 {
                *best = (loss, candidate);
            }
        }
        Ok(())
    }

    /// At most `steps` Levenberg-Marquardt steps from the loss `before`, until one gains little;
    /// gives the loss.
    pub(super) fn descend(
        &mut self,
        steps: usize,
        mut before: f64,
        watch: &mut Watch<'_>,
    ) -> Result<f64, StageError> {
        for _ in 0..steps {
            let loss = self.step(before)?;
            watch(loss, &self.operators);
            let gain = before - loss;
            before = loss;
            if gain < LEAST_GAIN * (loss + gain) {
                break;
            }
        }
        Ok(before)
    }

    /// One Levenberg-Marquardt step from the loss `before`, damped until it helps; gives the loss.
    fn step(&mut self, before: f64) -> Result<f64, StageError> {
        if self.handles.is_empty() {
            return Ok(before);
        }
        let here = self.residuals(&self.operators)?;
        let jacobian = self.jacobian(&here)?;
        let normal = jacobian.transpose() * &jacobian;
        let gradient = jacobian.transpose() * &here;
        let mut damping = DAMPING;
        for _ in 0..TRIALS {
            let mut damped = normal.clone();
            for h in 0..self.handles.len() {
                damped[(h, h)] += damping * normal[(h, h)] + 1e-12;
            }
            if let Some(factor) = damped.cholesky() {
                let mut operators = self.operators.clone();
                for (handle, change) in self.handles.iter().zip(factor.solve(&gradient).iter()) {
                    let now = handle.value(&operators);
                    handle.set(&mut operators, now - change * handle.step);
                }
                let loss = self.loss_at(&operators)?;
                if loss < before {
                    self.operators = operators;
                    return Ok(loss);
                }
            }
            damping *= 8.0;
        }
        Ok(before)
    }

    /// Differences of the residuals over a step of each parameter, into its range.
    fn jacobian(&self, here: &DVector<f64>) -> Result<DMatrix<f64>, StageError> {
        let mut jacobian = DMatrix::zeros(here.len(), self.handles.len());
        for (h, handle) in self.handles.iter().enumerate() {
            let mut operators = self.operators.clone();
            let now = handle.value(&operators);
            let step = if now + handle.step > handle.greatest { -handle.step } else { handle.step };
            handle.set(&mut operators, now + step);
            let there = self.residuals(&operators)?;
            jacobian.set_column(h, &((there - here) * step.signum()));
        }
        Ok(jacobian)
    }
}
