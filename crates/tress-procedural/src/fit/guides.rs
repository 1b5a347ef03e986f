//! Guides refined under the expectation loss [IPG 5.4].
//!
//! The loss is the mean square distance of the targets from what a guide's strands are on average:
//! the instanced strands, which bend, curl and frizz leave where they are in the mean [IPG 7].
//!
//! Guides are held by the turning at their points and the lengths of their segments, which is the
//! curvature parameterization of [IPG 10, Crane 2013]; the paper's spherical angles have a pole, so
//! here a point's turning is a rotation vector in space. Turning at point `k` moves all behind it:
//! with `f_j` the gradient by point `j`, the gradient by the turning is the torque
//! `sum_{j > k} (x_j - x_k) x f_j`, and by the length of segment `k` it is `d_k . sum_{j > k} f_j`:
//! one sweep from the tip for all of them.
//!
//! One target is one draw of what its guide may give, so the gradient is noisy; neighbouring guides
//! are alike, so it is smoothed over them: `(I + lambda L) g' = g`, `L` the Laplacian of the
//! Delaunay triangulation of the guides' roots with weights `exp(-|t_a - t_b|^2 / (2 sigma_d^2))`
//! by root directions `t`, so that nothing is smoothed over a parting. (An implicit form of the
//! bilateral gradient filter of Chang et al. 2024.) Steps are Adam's.

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

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

/// The gradients by turning at each point but the tip and by the length of each segment (kept in
/// x), from those by points.
fn sweep(guide: &[DVec3], by_points: &[DVec3], by_turning: &mut [DVec3], by_length: &mut [DVec3]) {
    let mut force = DVec3::ZERO;
    let mut torque = DVec3::ZERO;
    for k in (0..guide.len() - 1).rev() {
        // Torque about the point before is that about this one plus the lever's.
        let e = guide[k + 1] - guide[k];
        force += by_points[k + 1];
        torque += e.cross(force);
        by_turning[k] = torque;
        by_length[k] = DVec3::X * e.normalize_or_zero().dot(force);
    }
}

/// Turns and stretches a guide against the gradients' directions.
fn advance(guide: &mut [DVec3], turning: &[DVec3], length: &[DVec3], turn: f64, stretch: f64) {
    let mut rotation = DQuat::IDENTITY;
    let mut before = guide[0];
    for k in 0..guide.len() - 1 {
        let end = guide[k + 1];
        rotation = DQuat::from_scaled_axis(-turn * turning[k]) * rotation;
        let e = rotation * (end - before) * (1.0 - stretch * length[k].x);
        before = end;
        guide[k + 1] = guide[k] + e;
    }
}

/// Adam's steps in turnings and lengths (Kingma and Ba 2015, with their defaults).
///
/// Second moments are taken for a guide's point as a whole and not for each coordinate, so that
/// steps do not depend on the axes.
struct Descent {
    first: [Vec<DVec3>; 2],
    second: [Vec<f64>; 2],
    steps: i32,
}

impl Descent {
    fn new(guides: &EvenStrands) -> Self {
        let count = guides.len() * (guides.points_each() - 1);
        let first = vec![DVec3::ZERO; count];
        let second = vec![0.0; count];
        Self { first: [first.clone(), first], second: [second.clone(), second], steps: 0 }
    }

    /// Moves the guides against the gradient by their points; `fade` is the share of a step.
    fn step(
        &mut self,
        guides: &mut EvenStrands,
        by_points: &EvenStrands,
        filter: &Filter,
        fade: f64,
        options: &GuideOptions,
    ) {
        let m = guides.points_each();
        let mut by_turning = vec![DVec3::ZERO; guides.len() * (m - 1)];
        let mut by_length = by_turning.clone();
        let rows = by_turning.par_chunks_mut(m - 1).zip(by_length.par_chunks_mut(m - 1));
        rows.enumerate().for_each(|(g, (turning, length))| {
            sweep(guides.strand(g), by_points.strand(g), turning, length);
        });
        filter.apply(&mut by_turning, m - 1);
        filter.apply(&mut by_length, m - 1);
        self.directions(&mut by_turning, &mut by_length);
        let (turn, stretch) = (fade * options.turn / (m as f64).sqrt(), fade * options.stretch);
        let rows = by_turning.par_chunks(m - 1).zip(by_length.par_chunks(m - 1));
        guides.points_mut().par_chunks_mut(m).zip(rows).for_each(|(guide, (turning, length))| {
            advance(guide, turning, length, turn, stretch);
        });
    }

    /// Puts Adam's directions in place of the gradients.
    fn directions(&mut self, turning: &mut [DVec3], length: &mut [DVec3]) {
        self.steps += 1;
        let (one, two) = (1.0 - 0.9_f64.powi(self.steps), 1.0 - 0.999_f64.powi(self.steps));
        for (k, gradients) in [turning, length].into_iter().enumerate() {
            let moments = self.first[k].par_iter_mut().zip(&mut self.second[k]);
            gradients.par_iter_mut().zip(moments).for_each(|(gradient, (first, second))| {
                *first = 0.9 * *first + 0.1 * *gradient;
                *second = 0.999 * *second + 0.001 * gradient.length_squared();
                let size = (*second / two).sqrt();
                *gradient = if size > 0.0 { *first / one / size } else { DVec3::ZERO };
            });
        }
    }
}

/// The bilateral filter over neighbouring guides.
struct Filter {
    /// Neighbours of each guide with `lambda` times their weight.
    neighbors: Vec<Vec<(usize, f64)>>,
}

/// Sweeps of Gauss-Seidel in place of a solution: the system is diagonally dominant, and what is
/// left after these moves a gradient by less than the draws of random numbers do.
const SWEEPS: usize = 12;

impl Filter {
    fn new(guides: &EvenStrands, roots: &Roots, options: &GuideOptions) -> Self {
        let mut neighbors = vec![Vec::new(); guides.len()];
        let tangents: Vec<DVec3> =
            guides.iter().map(|guide| (guide[1] - guide[0]).normalize_or_zero()).collect();
        let spread = 2.0 * options.directions * options.directions;
        for (a, b) in edges(roots) {
            let weight =
                options.smoothing * (-tangents[a].distance_squared(tangents[b]) / spread).exp();
            neighbors[a].push((b, weight));
            neighbors[b].push((a, weight));
        }
        Self { neighbors }
    }

    /// Smooths rows of `each` numbers, one row a guide.
    fn apply(&self, rows: &mut [DVec3], each: usize) {
        // Columns are independent: they are shared out, and each is swept in order.
        let columns: Vec<Vec<DVec3>> = (0..each)
            .into_par_iter()
            .map(|j| {
                let given: Vec<DVec3> = rows.iter().skip(j).step_by(each).copied().collect();
                let mut column = given.clone();
                for _ in 0..SWEEPS {
                    for (a, neighbors) in self.neighbors.iter().enumerate() {
                        let weights: f64 = neighbors.iter().map(|(_, weight)| weight).sum();
                        let about: DVec3 =
                            neighbors.iter().map(|&(b, weight)| weight * column[b]).sum();
                        column[a] = (given[a] + about) / (1.0 + weights);
                    }
                }
                column
            })
            .collect();
        for (j, column) in columns.iter().enumerate() {
            rows.iter_mut().skip(j).step_by(each).zip(column).for_each(|(to, from)| *to = *from);
        }
    }
}

/// The edges of the Delaunay triangulation of roots: in texture coordinates where there are some,
/// else on the plane seen from the head's middle (an equal-angle map about the mean direction).
fn edges(roots: &Roots) -> Vec<(usize, usize)> {
    let points: Vec<delaunator::Point> = match &roots.uv {
        Some(uv) => uv.iter().map(|&[x, y]| delaunator::Point { x, y }).collect(),
        None => flattened(&roots.positions),
    };
    let triangles = delaunator::triangulate(&points).triangles;
    let mut edges: Vec<(usize, usize)> = triangles
        .chunks_exact(3)
        .flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])])
        .map(|(a, b)| (a.min(b), a.max(b)))
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Roots on a plane: directions from their middle, by angle from the upmost (azimuthal
/// equidistant).
fn flattened(positions: &[DVec3]) -> Vec<delaunator::Point> {
    let n = positions.len().max(1) as f64;
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    positions.iter().for_each(|x| (low, high) = (low.min(*x), high.max(*x)));
    let mean = positions.iter().sum::<DVec3>() / n;
    // Scalps are caps: a middle below the roots sees all of them.
    let axis = (mean - 0.5 * (low + high)).try_normalize().unwrap_or(DVec3::Y);
    let middle = mean - axis * 0.5 * (high - low).length();
    let (u, v) = axis.any_orthonormal_pair();
    let point = |x: &DVec3| {
        let d = (*x - middle).normalize_or_zero();
        let angle = d.angle_between(axis);
        let aside = DVec3::new(d.dot(u), d.dot(v), 0.0).normalize_or_zero() * angle;
        delaunator::Point { x: aside.x, y: aside.y }
    };
    positions.iter().map(point).collect()
}

#[cfg(test)]
mod tests;
