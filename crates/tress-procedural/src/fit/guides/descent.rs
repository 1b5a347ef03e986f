//! Steps of guides by their curvature.
//!
//! Guides are held by the turning at their points and the lengths of their segments, which is the
//! curvature parameterization of [IPG 10, Crane 2013]; the paper's spherical angles have a pole, so
//! here a point's turning is a rotation vector in space. Turning at point `k` moves all behind it:
//! with `f_j` the gradient by point `j`, the gradient by the turning is the torque
//! `sum_{j > k} (x_j - x_k) x f_j`, and by the length of segment `k` it is `d_k . sum_{j > k} f_j`:
//! one sweep from the tip for all of them. Steps are Adam's.

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::GuideOptions;
use super::filter::Filter;
use crate::EvenStrands;

/// The gradients by turning at each point but the tip and by the length of each segment (kept in
/// x), from those by points.
pub(super) fn sweep(
    guide: &[DVec3],
    by_points: &[DVec3],
    by_turning: &mut [DVec3],
    by_length: &mut [DVec3],
) {
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
pub(super) fn advance(
    guide: &mut [DVec3],
    turning: &[DVec3],
    length: &[DVec3],
    turn: f64,
    stretch: f64,
) {
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
pub(super) struct Descent {
    first: [Vec<DVec3>; 2],
    second: [Vec<f64>; 2],
    steps: i32,
}

impl Descent {
    pub(super) fn new(guides: &EvenStrands) -> Self {
        let count = guides.len() * (guides.points_each() - 1);
        let first = vec![DVec3::ZERO; count];
        let second = vec![0.0; count];
        Self { first: [first.clone(), first], second: [second.clone(), second], steps: 0 }
    }

    /// Moves the guides against the gradient by their points; `fade` is the share of a step.
    pub(super) fn step(
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
