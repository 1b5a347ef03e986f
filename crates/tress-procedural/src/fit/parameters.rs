//! The parameters of the operators [IPG 5.5], in few, good steps.
//!
//! The paper alternates three losses for up to 9,000 steps of Adam. Here random numbers and slices
//! are drawn once and kept, which makes every loss a smooth function of a handful of parameters,
//! and
//!
//! 1. each parameter is first looked for over its whole range, the others
//!    held (a start may be as far off as it likes);
//! 2. all of them together are refined by Levenberg-Marquardt steps on the ranks of
//!    [slices](super::slices), derivatives by differences;
//! 3. where it is asked for, scale and clump are set to where the
//!    [correlations](super::correlation) of target and model agree, found by bisection;
//!
//! and 2 and 3 are repeated a few times. Scale and clump are among the parameters of 1 and 2: the
//! paper's segments do not show them, segments relative to the guide do.

use glam::DVec3;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::correlation::{Likeness, Patches, crossing};
use super::slices::Slices;
use crate::instancing::nearest;
use crate::{Bound, ChainError, EvenStrands, Operator, ProceduralGroom};

/// How parameters are looked for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ParameterOptions {
    /// Strands that are compared. Default 2000: ranks are then known to about 2 % of their spread.
    pub strands: usize,
    /// Slices of segments, and as many of spectra. Default 64.
    pub slices: usize,
    /// Rounds over the whole range of each parameter. Default 2; 0 keeps to the neighbourhood.
    pub searches: usize,
    /// Levenberg-Marquardt steps a round. Default 8.
    pub steps: usize,
    /// Rounds of steps and correlations. Default 3.
    pub rounds: usize,
    /// Patches of neighbours whose correlations are measured. Default 24.
    pub patches: usize,
    /// Whether scale and clump are at last set to where the correlations of neighbours agree, as in
    /// the paper; else they are found with the others. Default no: with the guides' segments taken
    /// away, slices show both, and finding all at once measured better.
    pub correlate: bool,
}

impl Default for ParameterOptions {
    fn default() -> Self {
        Self {
            strands: 2000,
            slices: 64,
            searches: 2,
            steps: 8,
            rounds: 3,
            patches: 24,
            correlate: false,
        }
    }
}

/// Strands of a patch, as many as there may be: [IPG 6] takes the lesser of 200 and a hundredth.
const PATCH: usize = 60;

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
pub enum ParametersError {
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

/// A parameter that is looked for: which of which operator, and where it may be.
#[derive(Clone, Copy, Debug)]
struct Handle {
    operator: usize,
    index: usize,
    least: f64,
    greatest: f64,
    /// Size of a step that shows.
    step: f64,
    /// Whether candidates are spread evenly by ratio.
    by_ratio: bool,
}

/// What stays while parameters change.
struct Problem {
    groom: ProceduralGroom,
    instanced: EvenStrands,
    guides: EvenStrands,
    operator_of: Vec<u32>,
    numbers: Vec<Vec<f64>>,
}

impl Problem {
    /// The strands named, at the groom's parameters.
    fn new(groom: &ProceduralGroom, instanced: &EvenStrands, strands: &[usize]) -> Self {
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

    fn strands(&self, operators: &[Operator]) -> Result<EvenStrands, ChainError> {
        let bound =
            Bound { guides: &self.guides, operator_of: &self.operator_of, numbers: &self.numbers };
        let mut strands = self.instanced.clone();
        let chain =
            crate::Chain { convention: self.groom.chain.convention, operators: operators.to_vec() };
        chain.apply(&mut strands, &bound, self.groom.seed)?;
        Ok(strands)
    }
}

/// What a search has found so far.
struct Search<'a> {
    problem: &'a Problem,
    slices: &'a Slices,
    operators: Vec<Operator>,
    handles: Vec<Handle>,
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
) -> Result<f64, ParametersError> {
    let (strands, points_each) = (groom.roots.len(), groom.guides.points_each());
    if targets.len() != strands || targets.points_each() != points_each {
        let (given, points) = (targets.len(), targets.points_each());
        return Err(ParametersError::Targets { given, points, strands, points_each });
    }
    groom.check()?;
    let instanced = groom.instances()?.instance(&groom.guides, &groom.roots.positions);
    let chosen = spread(sound, options.strands);
    let problem = Problem::new(groom, &instanced, &chosen);
    let chosen_targets = targets.select(&chosen);
    let slices =
        Slices::new(&chosen_targets, problem.instanced.clone(), options.slices, groom.seed);
    let length = mean_length(&chosen_targets);
    begin(&mut groom.chain.operators, length);
    let handles = handles(&groom.chain.operators, length, points_each);
    let mut search = Search {
        problem: &problem,
        slices: &slices,
        operators: groom.chain.operators.clone(),
        handles,
    };
    let correlations = Correlations::new(groom, &instanced, targets, sound, options);
    for round in 0..options.searches {
        for h in 0..search.handles.len() {
            let loss = search.scan(h, if round == 0 { 16 } else { 10 }, round > 0)?;
            watch(loss, &search.operators);
            groom.chain.operators.clone_from(&search.operators);
        }
    }
    let mut loss = search.loss(&search.operators)?;
    for _ in 0..options.rounds {
        if options.correlate {
            correlations.settle(&mut search.operators)?;
        }
        for _ in 0..options.steps {
            let before = search.loss(&search.operators)?;
            loss = search.step(before)?;
            watch(loss, &search.operators);
            groom.chain.operators.clone_from(&search.operators);
            if before - loss < 1e-4 * before {
                break;
            }
        }
    }
    if options.correlate {
        correlations.settle(&mut search.operators)?;
    }
    groom.chain.operators.clone_from(&search.operators);
    watch(loss, &search.operators);
    Ok(loss)
}

/// At most `count` of the strands, evenly spread over the list.
fn spread(strands: &[usize], count: usize) -> Vec<usize> {
    let n = strands.len();
    if n <= count {
        return strands.to_vec();
    }
    (0..count).map(|k| strands[k * n / count]).collect()
}

fn mean_length(strands: &EvenStrands) -> f64 {
    let length =
        |strand: &[DVec3]| -> f64 { strand.windows(2).map(|ends| ends[0].distance(ends[1])).sum() };
    strands.iter().map(length).sum::<f64>() / strands.len().max(1) as f64
}

/// Gives lengths and frequencies that begin at 0, where nothing else would show, a size: curls of
/// five turns a strand, frizz of ten cells.
fn begin(operators: &mut [Operator], length: f64) {
    let unless_given = |value: &mut f64, size: f64| {
        if *value == 0.0 {
            *value = size;
        }
    };
    for operator in operators {
        match operator {
            Operator::Curl(curl) => {
                unless_given(&mut curl.radius, 0.03 * length);
                unless_given(&mut curl.frequency, 5.0 / (3.0 * length));
            }
            Operator::Frizz(frizz) => {
                unless_given(&mut frizz.amplitude, 0.01 * length);
                unless_given(&mut frizz.frequency, 10.0 / length);
            }
            _ => {}
        }
    }
}

/// The parameters, with ranges for strands of this mean length.
fn handles(operators: &[Operator], length: f64, points_each: usize) -> Vec<Handle> {
    let m = points_each as f64;
    let mut handles = Vec::new();
    for (operator, o) in operators.iter().zip(0..) {
        let mut add = |index, least: f64, greatest: f64, step: f64, by_ratio| {
            handles.push(Handle { operator: o, index, least, greatest, step, by_ratio });
        };
        match operator {
            Operator::Scale(_) => add(0, 0.0, 1.0, 0.01, false),
            Operator::Clump(_) => add(0, 0.05, MOST_CLUMP, 0.05, true),
            Operator::Bend(_) => {
                add(0, 0.0, 180.0, 4.0, false);
                add(1, 0.0, 1.0, 0.04, false);
            }
            Operator::Curl(_) => {
                // From a third of a turn a strand to a turn in four points; 3 omega turns a unit.
                let (few, many) = (0.1 / length, m / (12.0 * length));
                add(1, few, many, 0.01 / length, true);
                add(0, 0.002 * length, 0.25 * length, 0.002 * length, true);
                add(3, 0.0, 1.0, 0.04, false);
                add(2, 0.0, 0.5 * many, 0.02 / length, false);
            }
            Operator::Frizz(_) => {
                add(1, 0.0005 * length, 0.4 * length, 0.001 * length, true);
                add(0, 1.0 / length, m / (3.0 * length), 0.2 / length, true);
            }
            _ => {}
        }
    }
    handles
}

fn value(operators: &mut [Operator], handle: &Handle) -> f64 {
    operators[handle.operator].values()[handle.index]
}

fn set(operators: &mut [Operator], handle: &Handle, value: f64) {
    let clamped = value.clamp(handle.least, handle.greatest);
    if let Some(slot) = operators[handle.operator].values_mut().into_iter().nth(handle.index) {
        *slot = clamped;
    }
}

impl Search<'_> {
    fn residuals(&self, operators: &[Operator]) -> Result<DVector<f64>, ParametersError> {
        let strands = self.problem.strands(operators)?;
        let residuals = DVector::from_vec(self.slices.residuals(&strands));
        if residuals.iter().all(|r| r.is_finite()) {
            return Ok(residuals);
        }
        let place = format!("at the operators {operators:?}");
        Err(LossError { place }.into())
    }

    fn loss(&self, operators: &[Operator]) -> Result<f64, ParametersError> {
        let residuals = self.residuals(operators)?;
        Ok(residuals.norm_squared() / residuals.len().max(1) as f64)
    }

    /// Tries `count` values of a parameter, over its range or about its value, and keeps the best.
    fn scan(&mut self, h: usize, count: usize, near: bool) -> Result<f64, ParametersError> {
        let handle = self.handles[h];
        let now = value(&mut self.operators, &handle);
        let (mut least, mut greatest) = (handle.least, handle.greatest);
        if near {
            let reach = 0.25 * (greatest - least);
            let by_ratio = handle.by_ratio && now > 0.0;
            least = least.max(if by_ratio { now / 1.8 } else { now - reach });
            greatest = greatest.min(if by_ratio { now * 1.8 } else { now + reach });
        }
        let mut best = (self.loss(&self.operators)?, now);
        for k in 0..count {
            let f = k as f64 / (count - 1) as f64;
            let candidate = if handle.by_ratio && least > 0.0 {
                least * (greatest / least).powf(f)
            } else {
                least + f * (greatest - least)
            };
            let mut operators = self.operators.clone();
            set(&mut operators, &handle, candidate);
            let loss = self.loss(&operators)?;
            if loss < best.0 {
                best = (loss, candidate);
            }
        }
        set(&mut self.operators, &handle, best.1);
        Ok(best.0)
    }

    /// One Levenberg-Marquardt step from the loss `before`, damped until it helps; gives the loss.
    fn step(&mut self, before: f64) -> Result<f64, ParametersError> {
        if self.handles.is_empty() {
            return Ok(before);
        }
        let here = self.residuals(&self.operators)?;
        let mut jacobian = DMatrix::zeros(here.len(), self.handles.len());
        for (h, handle) in self.handles.iter().enumerate() {
            let mut operators = self.operators.clone();
            let now = value(&mut operators, handle);
            let step = if now + handle.step > handle.greatest { -handle.step } else { handle.step };
            set(&mut operators, handle, now + step);
            let there = self.residuals(&operators)?;
            jacobian.set_column(h, &((there - &here) * step.signum()));
        }
        let normal = jacobian.transpose() * &jacobian;
        let gradient = jacobian.transpose() * &here;
        let mut damping = 1e-3;
        for _ in 0..6 {
            let mut damped = normal.clone();
            for h in 0..self.handles.len() {
                damped[(h, h)] += damping * normal[(h, h)] + 1e-12;
            }
            if let Some(factor) = damped.cholesky() {
                let change = factor.solve(&gradient);
                let mut operators = self.operators.clone();
                for (handle, change) in self.handles.iter().zip(change.iter()) {
                    let now = value(&mut operators, handle);
                    set(&mut operators, handle, now - change * handle.step);
                }
                let loss = self.loss(&operators)?;
                if loss < before {
                    self.operators = operators;
                    return Ok(loss);
                }
            }
            damping *= 8.0;
        }
        Ok(before)
    }
}

/// The patches whose correlations decide scale and clump.
struct Correlations {
    problem: Problem,
    lengths: Patches,
    distances: Patches,
}

/// Halvings of the range of scale and clump: to a thousandth of it.
const HALVINGS: usize = 10;
/// The greatest clump that is looked for; beyond it strands meet in a tenth of their length.
const MOST_CLUMP: f64 = 20.0;

impl Correlations {
    fn new(
        groom: &ProceduralGroom,
        instanced: &EvenStrands,
        targets: &EvenStrands,
        sound: &[usize],
        options: &ParameterOptions,
    ) -> Self {
        let places = groom.roots.places(&groom.roots);
        let sound_places: Vec<_> = sound.iter().map(|&i| places[i]).collect();
        let middles: Vec<_> =
            spread(sound, options.patches).into_iter().map(|i| places[i]).collect();
        let size = PATCH.min(sound.len().max(1));
        let near = nearest(&sound_places, &middles, size);
        let mut strands = Vec::new();
        let mut patches = Vec::new();
        for patch in near {
            let first = strands.len();
            strands.extend(patch.iter().map(|&(_, k)| sound[k as usize]));
            patches.push((first..strands.len()).collect::<Vec<usize>>());
        }
        let targets = targets.select(&strands);
        Self {
            problem: Problem::new(groom, instanced, &strands),
            lengths: Patches::new(&targets, patches.clone(), Likeness::Length),
            distances: Patches::new(&targets, patches, Likeness::Distance),
        }
    }

    /// Sets scale and clump to where the target's correlations are met.
    fn settle(&self, operators: &mut [Operator]) -> Result<(), ParametersError> {
        for o in 0..operators.len() {
            let (patches, greatest) = match operators[o] {
                Operator::Scale(_) => (&self.lengths, 1.0),
                Operator::Clump(_) => (&self.distances, MOST_CLUMP),
                _ => continue,
            };
            let handle =
                Handle { operator: o, index: 0, least: 0.0, greatest, step: 0.0, by_ratio: false };
            let mut trial = operators.to_vec();
            let found = crossing(0.0, greatest, HALVINGS, |value| {
                set(&mut trial, &handle, value);
                let excess = patches.excess(&self.problem.strands(&trial)?);
                if excess.is_finite() {
                    return Ok(excess);
                }
                let place = format!("in the correlations at {} {value}", trial[o].name());
                Err(ParametersError::from(LossError { place }))
            })?;
            set(operators, &handle, found);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
