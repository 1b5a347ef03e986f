//! Instancing weights as a nonnegative least squares a strand [IPG 5.3].
//!
//! A strand's weights `w >= 0`, summing to 1, are to bring `sum_k w_k g_k` nearest the strand, both
//! relative to their roots. With `d_k = g_k - x` that is the point of the hull of the `d_k` nearest
//! the origin, and that is a nonnegative least squares: the least of
//! `|sum_k y_k d_k|^2 + c^2 (sum_k y_k - 1)^2` over `y >= 0` is at a multiple of `w`, since along
//! `y = t w` it is `c^2 q / (q + c^2)` with `q = |sum w_k d_k|^2`, which grows with `q`. It is
//! solved exactly, by the active sets of Lawson and Hanson ("Solving least squares problems",
//! 1974), where \[IPG\] takes 2,000 steps of Adam.

use glam::DVec3;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::{EvenStrands, Instances};

/// The weights that bring every strand nearest its target, from the guides that `instances` names.
///
/// # Panics
///
/// If `instances` has another number of strands than there are targets, or names a guide that is
/// not there.
#[must_use]
pub fn fit_weights(
    guides: &EvenStrands,
    targets: &EvenStrands,
    instances: &Instances,
) -> Instances {
    assert_eq!(instances.len(), targets.len(), "instances for every target");
    let weights: Vec<Vec<f64>> = (0..targets.len())
        .into_par_iter()
        .map(|i| {
            let named: Vec<usize> = instances.strand(i).map(|(guide, _)| guide).collect();
            strand_weights(guides, targets.strand(i), &named)
        })
        .collect();
    Instances { weights: weights.concat(), ..instances.clone() }
}

/// Multiples of the spacing of guides that are tried for `sigma`.
const SIGMAS: [f64; 8] = [0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0, 1.25];

/// The `sigma` of weights by distance that brings strands nearest their targets, with its
/// instances: how far a guide's strands are alike before they turn into the next one's is the
/// groom's own, and clump is what is left of it. `spacing` is that of the guides.
pub(super) fn fit_sigma(
    guides: &EvenStrands,
    targets: &EvenStrands,
    spacing: f64,
    by_distance: impl Fn(f64) -> Instances,
) -> (f64, Instances) {
    let roots = targets.roots();
    let instances = |sigma| (sigma, by_distance(sigma));
    let loss = |(_, instances): &(f64, Instances)| {
        vertex_loss(&instances.instance(guides, &roots), targets)
    };
    let (mut best, mut least) = (instances(spacing), f64::INFINITY);
    for factor in SIGMAS {
        let trial = instances(factor * spacing);
        let value = loss(&trial);
        if value < least {
            (best, least) = (trial, value);
        }
    }
    best
}

/// Mean square distance of points of instanced strands from their targets [IPG 5].
pub(crate) fn vertex_loss(strands: &EvenStrands, targets: &EvenStrands) -> f64 {
    let squares = |(a, b): (&DVec3, &DVec3)| a.distance_squared(*b);
    let m = strands.points_each();
    let rows = strands.points().par_chunks(m).zip(targets.points().par_chunks(m));
    let sums: Vec<f64> = rows.map(|(a, b)| a.iter().zip(b).map(squares).sum()).collect();
    sums.iter().sum::<f64>() / strands.points().len().max(1) as f64
}

fn strand_weights(guides: &EvenStrands, target: &[DVec3], named: &[usize]) -> Vec<f64> {
    let k = named.len();
    let differences: Vec<Vec<DVec3>> = named
        .iter()
        .map(|&guide| {
            let guide = guides.strand(guide);
            let relative = |(g, x): (&DVec3, &DVec3)| (*g - guide[0]) - (*x - target[0]);
            guide.iter().zip(target).map(relative).collect()
        })
        .collect();
    let dot = |a: &[DVec3], b: &[DVec3]| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum::<f64>();
    let gram = DMatrix::from_fn(k, k, |a, b| dot(&differences[a], &differences[b]));
    simplex_least(&gram)
}

/// The `w >= 0`, summing to 1, with the least `w' G w`.
fn simplex_least(gram: &DMatrix<f64>) -> Vec<f64> {
    let k = gram.nrows();
    let size = gram.diagonal().max();
    if size <= 0.0 || !size.is_finite() {
        // Every guide fits as well as any: the nearest is taken.
        let mut weights = vec![0.0; k];
        weights[0] = 1.0;
        return weights;
    }
    // c^2 = size, and a trace of the identity so that equal guides share evenly.
    let matrix = gram / size + DMatrix::from_element(k, k, 1.0) + DMatrix::identity(k, k) * 1e-12;
    let y = nonnegative(&matrix, &DVector::from_element(k, 1.0));
    let sum: f64 = y.iter().sum();
    y.iter().map(|y| y / sum).collect()
}

/// Lawson and Hanson's active sets for `min y' A y - 2 b' y`, `y >= 0`, `A` positive definite.
fn nonnegative(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let k = b.len();
    let mut y = DVector::zeros(k);
    let mut free: Vec<usize> = Vec::new();
    // Each round frees one variable; a strictly falling energy bounds them far below this.
    for _ in 0..10 * k {
        let gradient = b - a * &y;
        let climbs = |&i: &usize| !free.contains(&i) && gradient[i] > 1e-12;
        let steepest = (0..k).filter(climbs).max_by(|&i, &j| gradient[i].total_cmp(&gradient[j]));
        let Some(next) = steepest else { break };
        free.push(next);
        while !free.is_empty() {
            let part = DMatrix::from_fn(free.len(), free.len(), |i, j| a[(free[i], free[j])]);
            let right = DVector::from_fn(free.len(), |i, _| b[free[i]]);
            let Some(factor) = part.cholesky() else { return y };
            let solution = factor.solve(&right);
            if solution.iter().all(|&value| value > 0.0) {
                y.fill(0.0);
                free.iter().zip(solution.iter()).for_each(|(&i, &value)| y[i] = value);
                break;
            }
            // As far towards the solution as all stay nonnegative; what reaches 0 is held there.
            let steps = free.iter().zip(solution.iter()).filter(|(_, value)| **value <= 0.0);
            let step = steps.map(|(&i, value)| y[i] / (y[i] - value)).fold(1.0, f64::min);
            for (&i, value) in free.iter().zip(solution.iter()) {
                y[i] += step * (value - y[i]);
            }
            let before = free.len();
            free.retain(|&i| y[i] > 1e-14);
            (0..k).filter(|i| !free.contains(i)).for_each(|i| y[i] = 0.0);
            if free.len() == before {
                return y;
            }
        }
    }
    y
}

#[cfg(test)]
mod tests;
