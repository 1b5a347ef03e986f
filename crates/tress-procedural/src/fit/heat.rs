//! Heat smoothing of strands [IPG 6]: implicit steps of the heat equation along a strand.
//!
//! Each step solves `(I + lambda L) x' = x` with the first points and the tip held, `L` the second
//! difference. `lambda` is that of strands of a hundred segments; for `n` it is taken times
//! `(n / 100)^2`, so that the same part of a strand is evened out however many points it has. The
//! matrix is the same for every strand and step: tridiagonal with constant coefficients, factored
//! once.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::EvenStrands;

/// How strongly strands are smoothed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Smoothing {
    /// `lambda`: length of a step on strands of a hundred segments. Default 1.
    pub lambda: f64,
    /// Steps. Default 80: waves shorter than about two fifths of the strand go.
    pub steps: usize,
    /// Fraction of the points that is held at the root, so that hair leaves the scalp as it does.
    /// Default 0.05.
    pub fixed: f64,
}

impl Default for Smoothing {
    fn default() -> Self {
        Self { lambda: 1.0, steps: 80, fixed: 0.05 }
    }
}

impl Smoothing {
    /// Smooths all strands in place.
    pub(super) fn apply_to_all(&self, strands: &mut EvenStrands) {
        let m = strands.points_each();
        strands.points_mut().par_chunks_mut(m).for_each(|strand| self.apply(strand));
    }

    /// Smooths a strand in place.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_procedural::fit::Smoothing;
    ///
    /// let zigzag = |j: u32| DVec3::new(f64::from(j), f64::from(j % 2), 0.0);
    /// let mut strand: Vec<DVec3> = (0..40).map(zigzag).collect();
    /// Smoothing::default().apply(&mut strand);
    /// assert!((strand[20] - strand[19]).y.abs() < 0.03);
    /// assert_eq!(strand[39], zigzag(39));
    /// ```
    pub fn apply(&self, strand: &mut [DVec3]) {
        let m = strand.len();
        let held = (1..m).find(|&j| j as f64 >= self.fixed * m as f64).unwrap_or(m);
        if m < held + 2 || self.lambda <= 0.0 {
            return;
        }
        // Free points `held .. m - 1`; `factors[j]` is the upper entry of row j after elimination.
        let free = m - 1 - held;
        let lambda = self.lambda * ((m - 1) as f64 / 100.0).powi(2);
        let diagonal = 1.0 + 2.0 * lambda;
        let mut factors = Vec::with_capacity(free);
        let mut above = 0.0;
        for _ in 0..free {
            above = -lambda / (diagonal + lambda * above);
            factors.push(above);
        }
        for _ in 0..self.steps {
            Self::step(&mut strand[held - 1..], lambda, &factors);
        }
    }

    /// One step; the first and last point given are held.
    fn step(points: &mut [DVec3], lambda: f64, factors: &[f64]) {
        let last = points.len() - 1;
        let mut before = points[0];
        for (j, factor) in factors.iter().enumerate() {
            // Row j: (x_j + lambda y_{j-1}) / pivot, and pivot = -lambda / factor.
            let pivot = -lambda / factor;
            before = (points[j + 1] + lambda * before) / pivot;
            points[j + 1] = before;
        }
        for j in (1..last).rev() {
            let behind = points[j + 1];
            points[j] -= factors[j - 1] * behind;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_solves_the_implicit_equation() {
        let strand: Vec<DVec3> =
            (0..30).map(f64::from).map(|s| DVec3::new(s, (2.0 * s).sin(), s.cos())).collect();
        let lambda = 0.7 * (100.0_f64 / 29.0).powi(2);
        let smoothing = Smoothing { lambda, steps: 1, fixed: 0.1 };
        let mut out = strand.clone();
        smoothing.apply(&mut out);
        assert_eq!(out[..3], strand[..3]);
        assert_eq!(out[29], strand[29]);
        for j in 3..29 {
            let second = 2.0 * out[j] - out[j - 1] - out[j + 1];
            assert!((out[j] + 0.7 * second - strand[j]).length() < 1e-13, "row {j}");
        }
    }

    #[test]
    fn the_same_part_of_a_strand_is_evened_out_however_many_points_it_has() {
        let wave = |points: u32| -> Vec<DVec3> {
            let s = move |j: u32| f64::from(j) / f64::from(points - 1);
            (0..points).map(|j| DVec3::new(s(j), 0.1 * (12.0 * s(j)).sin(), 0.0)).collect()
        };
        let (mut coarse, mut fine) = (wave(51), wave(201));
        let smoothing = Smoothing { fixed: 0.0, steps: 20, ..Smoothing::default() };
        smoothing.apply(&mut coarse);
        smoothing.apply(&mut fine);
        for (j, x) in coarse.iter().enumerate() {
            assert!(x.distance(fine[4 * j]) < 2e-3, "point {j}");
        }
        assert!((coarse[19].y - wave(51)[19].y).abs() > 0.02, "a crest is lowered");
    }
}
