//! Guides refined under the expectation loss [IPG 5.4].
//!
//! The loss is the mean square distance of the targets from what a guide's strands are on average:
//! the instanced strands, which bend, curl and frizz leave where they are in the mean [IPG 7].
//!
//! One target is one draw of what its guide may give, so the gradient is noisy; neighbouring guides
//! are alike, so it is [smoothed over them](filter), and guides [step](descent) by their turnings.

mod descent;
mod filter;

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use self::descent::Descent;
use self::filter::Filter;
use super::courses::segments;
use super::parameters::{LossError, StageError};
use super::weights::vertex_loss;
use crate::{Bound, Chain, EvenStrands, Instances, Operator, ProceduralGroom, Roots, draw};

/// How guides are refined.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GuideOptions {
    /// Corrections to begin with: each moves guides by the mean of what their strands are off,
    /// smoothed over neighbouring guides. Default 8; they find what neighbours have in common in a
    /// few steps, as the bend at the root that smoothing along the strand took away.
    pub corrections: usize,
    /// Steps of Adam after that, when guides are found again with operators known. Default 20.
    pub steps: usize,
    /// How far a tip may turn in a step, in radians, spread over the guide's points. Default 0.005.
    pub turn: f64,
    /// How much longer or shorter a segment may become in a step, as a fraction. Default 0.0005;
    /// 0 keeps the lengths.
    pub stretch: f64,
    /// `lambda`: how far gradients are smoothed over neighbouring guides. Default 10.
    pub smoothing: f64,
    /// How far guides are evened out over the next neighbours before anything else. Default 0.1; 1
    /// at least under bends, which leave more in a mean of a few dozen strands.
    pub evenness: f64,
    /// `sigma_d`: root directions that differ by more do not smooth each other. Default 0.3.
    pub directions: f64,
}

impl Default for GuideOptions {
    fn default() -> Self {
        Self {
            corrections: 8,
            steps: 20,
            turn: 0.005,
            stretch: 0.0005,
            smoothing: 10.0,
            evenness: 0.1,
            directions: 0.3,
        }
    }
}

/// Moves the groom's guides so that its strands are in the mean what the targets are; those of
/// `sound` are compared.
///
/// `operators` are those of the groom that do not leave strands where they are in the mean: clump
/// and bend. Their random numbers are drawn anew at every step. `watch` is told the loss before
/// every step. Gives the last loss.
///
/// # Errors
///
/// If the groom cannot be built or the loss is not a number; the guides are then those of the last
/// good step.
///
/// # Panics
///
/// If there is not one target a strand.
pub fn refine_guides(
    groom: &mut ProceduralGroom,
    targets: &EvenStrands,
    sound: &[usize],
    operators: &[Operator],
    options: &GuideOptions,
    watch: &mut dyn FnMut(f64),
) -> Result<f64, StageError> {
    assert_eq!(targets.len(), groom.roots.len(), "a target for every strand");
    groom.check()?;
    let model = Expectation::new(groom, sound, operators)?;
    let targets = targets.select(sound);
    let filter = Filter::new(&groom.guides, &groom.guide_roots(), options);
    let mut descent = Descent::new(&groom.guides);
    let mut last = 0.0;
    for step in 0..options.corrections + options.steps {
        let (instanced, numbers, mut strands) = model.strands(&groom.guides, step)?;
        let loss = vertex_loss(&strands, &targets);
        if !loss.is_finite() {
            return Err(LossError { place: format!("at step {step} of the guides") }.into());
        }
        watch(loss);
        last = loss;
        let residuals = strands.points_mut().par_iter_mut().zip(targets.points());
        residuals.for_each(|(x, target)| *x -= *target);
        if step < options.corrections {
            let stretch = operators.is_empty() && options.stretch > 0.0;
            correct(&mut groom.guides, &model.instances, &strands, &filter, stretch);
            continue;
        }
        let by_points = model.pull_back(&groom.guides, &instanced, &numbers, &strands)?;
        let fade = 1.0 - (step - options.corrections) as f64 / options.steps as f64;
        descent.step(&mut groom.guides, &by_points, &filter, fade, options);
    }
    Ok(last)
}

/// Evens guides out over the next neighbours: a guide is the mean of a few dozen strands and
/// carries what these happened to draw, where neighbours are to be alike.
pub(super) fn even_out(guides: &mut EvenStrands, roots: &Roots, options: &GuideOptions) {
    let m = guides.points_each();
    let near = GuideOptions { smoothing: options.evenness, ..*options };
    let filter = Filter::new(guides, roots, &near);
    let each: Vec<DVec3> = guides.iter().flat_map(segments).collect();
    let mut directions: Vec<DVec3> = each.iter().map(|e| e.normalize_or_zero()).collect();
    let mut lengths: Vec<DVec3> = each.iter().map(|e| DVec3::X * e.length()).collect();
    filter.apply(&mut directions, m - 1);
    filter.apply(&mut lengths, m - 1);
    for g in 0..guides.len() {
        let row = g * (m - 1)..(g + 1) * (m - 1);
        let guide = guides.strand_mut(g);
        for (k, (d, length)) in directions[row.clone()].iter().zip(&lengths[row]).enumerate() {
            guide[k + 1] = guide[k] + d.normalize_or_zero() * length.x;
        }
    }
}

/// What strands are in the mean: instanced, and moved by operators whose numbers are drawn anew.
struct Expectation {
    chain: Chain,
    instances: Instances,
    roots: Vec<DVec3>,
    operator_guides: Vec<usize>,
    operator_of: Vec<u32>,
    seed: u64,
}

impl Expectation {
    fn new(
        groom: &ProceduralGroom,
        sound: &[usize],
        operators: &[Operator],
    ) -> Result<Self, StageError> {
        let chain = Chain { operators: operators.to_vec(), ..groom.chain.clone() };
        Ok(Self {
            chain,
            instances: groom.instances()?.select(sound),
            roots: sound.iter().map(|&i| groom.roots.positions[i]).collect(),
            operator_guides: groom.operator_guides.iter().map(|&g| g as usize).collect(),
            operator_of: sound.iter().map(|&i| groom.operator_of[i]).collect(),
            seed: groom.seed,
        })
    }

    /// Instanced strands, the numbers drawn for this step, and the strands that come out.
    fn strands(
        &self,
        guides: &EvenStrands,
        step: usize,
    ) -> Result<(EvenStrands, Vec<Vec<f64>>, EvenStrands), StageError> {
        let instanced = self.instances.instance(guides, &self.roots);
        let seed = self.seed ^ (1 + step as u64);
        let operators = &self.chain.operators;
        let numbers = draw(operators, self.roots.len(), self.operator_guides.len(), seed);
        let operator_guides = guides.select(&self.operator_guides);
        let mut strands = instanced.clone();
        self.chain.apply(&mut strands, &self.bound(&operator_guides, &numbers), seed)?;
        Ok((instanced, numbers, strands))
    }

    fn bound<'a>(&'a self, guides: &'a EvenStrands, numbers: &'a [Vec<f64>]) -> Bound<'a> {
        Bound { guides, operator_of: &self.operator_of, numbers }
    }

    /// The gradient by the guides' points from that by the strands that come out.
    fn pull_back(
        &self,
        guides: &EvenStrands,
        instanced: &EvenStrands,
        numbers: &[Vec<f64>],
        gradient: &EvenStrands,
    ) -> Result<EvenStrands, StageError> {
        let operator_guides = guides.select(&self.operator_guides);
        let bound = self.bound(&operator_guides, numbers);
        let by = self.chain.pull_back(instanced, &bound, gradient)?;
        let mut by_points = self.instances.pull_back(guides.len(), &by.strands);
        for (row, &guide) in by.guides.iter().zip(&self.operator_guides) {
            let sums = by_points.strand_mut(guide).iter_mut().zip(row);
            sums.for_each(|(sum, part)| *sum += *part);
        }
        Ok(by_points)
    }
}

/// What all strands that are blended from a guide are off by in the mean, smoothed over neighbours
/// and taken from the guide; `residuals` are strands less targets, roots at 0.
fn correct(
    guides: &mut EvenStrands,
    instances: &Instances,
    residuals: &EvenStrands,
    filter: &Filter,
    stretch: bool,
) {
    let m = guides.points_each();
    let mut shares = vec![0.0; guides.len()];
    for i in 0..instances.len() {
        instances.strand(i).for_each(|(guide, weight)| shares[guide] += weight);
    }
    let mut mean = instances.pull_back(guides.len(), residuals);
    for (g, share) in shares.iter().enumerate() {
        let over = if *share > 0.0 { 1.0 / share } else { 0.0 };
        mean.strand_mut(g).iter_mut().for_each(|x| *x *= over);
        mean.strand_mut(g)[0] = DVec3::ZERO;
    }
    filter.apply(mean.points_mut(), m);
    guides.points_mut().par_chunks_mut(m).zip(mean.points().par_chunks(m)).for_each(
        |(guide, mean)| {
            let lengths: Vec<f64> = segments(guide).map(DVec3::length).collect();
            guide.iter_mut().zip(mean).for_each(|(x, mean)| *x -= *mean);
            if !stretch {
                set_lengths(guide, &lengths);
            }
        },
    );
}

/// Gives the segments of a strand other lengths; directions stay.
pub(super) fn set_lengths(strand: &mut [DVec3], lengths: &[f64]) {
    let mut before = strand[0];
    for (k, length) in lengths.iter().enumerate() {
        let end = strand[k + 1];
        let direction = (end - before).normalize_or_zero();
        before = end;
        strand[k + 1] = strand[k] + direction * *length;
    }
}

#[cfg(test)]
mod tests;
