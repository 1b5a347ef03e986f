//! What guides are moved by, smoothed over their neighbours.
//!
//! `(I + lambda L) g' = g`, `L` the Laplacian of the Delaunay triangulation of the guides' roots
//! with weights `exp(-|t_a - t_b|^2 / (2 sigma_d^2))` by root directions `t`, so that nothing is
//! smoothed over a parting. (An implicit form of the bilateral gradient filter of Chang et al.
//! 2024.)

use glam::DVec3;
use rayon::prelude::*;

use super::GuideOptions;
use crate::{EvenStrands, Roots};

/// The bilateral filter over neighbouring guides.
pub(super) struct Filter {
    /// Neighbours of each guide with `lambda` times their weight.
    neighbors: Vec<Vec<(usize, f64)>>,
}

/// Sweeps of Gauss-Seidel in place of a solution: the system is diagonally dominant, and what is
/// left after these moves a gradient by less than the draws of random numbers do.
const SWEEPS: usize = 12;

impl Filter {
    pub(super) fn new(guides: &EvenStrands, roots: &Roots, options: &GuideOptions) -> Self {
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
    pub(super) fn apply(&self, rows: &mut [DVec3], each: usize) {
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
pub(super) fn edges(roots: &Roots) -> Vec<(usize, usize)> {
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
pub(super) fn flattened(positions: &[DVec3]) -> Vec<delaunator::Point> {
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
