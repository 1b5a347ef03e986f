//! Instancing: strands blended from the guides about them [IPG 3].
//!
//! `x_{i,j} = r_i + sum_k w_{ik} (g_{k,j} - g_{k,0})`, the weights of a strand summing to 1, `r_i`
//! its root. They fall with the distance of the roots: in the scalp's texture coordinates where
//! both sides have them, over the scalp where its mesh is given, and else in space:
//! `w = exp(-d^2 / sigma^2)`, normalised.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{EvenStrands, Surface};

/// How strands choose the guides they are blended from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Instancing {
    /// The nearest guides by root, weighted by distance.
    Gaussian {
        /// Guides a strand is blended from.
        neighbors: usize,
        /// `sigma`, in texture coordinates where roots have them, else in the groom's unit.
        sigma: f64,
    },
    /// Guides and weights as they are stored with the groom.
    Stored,
}

/// The guides of each strand and their weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Instances {
    /// Guides a strand is blended from, at least 1.
    pub each: usize,
    /// `each` guides for every strand, nearest first.
    pub guides: Vec<u32>,
    /// The weight of each, summing to 1 for a strand.
    pub weights: Vec<f64>,
}

/// Where roots are: in space, and on the scalp where that is known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Roots {
    /// Positions.
    pub positions: Vec<DVec3>,
    /// Texture coordinates of the scalp, one row a root.
    pub uv: Option<Vec<[f64; 2]>>,
}

impl Roots {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// The roots named, in that order.
    ///
    /// # Panics
    ///
    /// If a root is not there.
    #[must_use]
    pub fn select(&self, roots: &[usize]) -> Self {
        let uv = self.uv.as_ref().map(|uv| roots.iter().map(|&i| uv[i]).collect());
        Self { positions: roots.iter().map(|&i| self.positions[i]).collect(), uv }
    }

    /// Points whose distances are those of roots: on the scalp if `other` has texture coordinates
    /// too, else in space.
    pub(crate) fn places(&self, other: &Self) -> Vec<DVec3> {
        match (&self.uv, &other.uv) {
            (Some(uv), Some(_)) => uv.iter().map(|&[u, v]| DVec3::new(u, v, 0.0)).collect(),
            _ => self.positions.clone(),
        }
    }
}

/// The `count` nearest of `places` to each of `to`, nearest first, with squared distances; fewer
/// where there are fewer.
pub(crate) fn nearest(places: &[DVec3], to: &[DVec3], count: usize) -> Vec<Vec<(f64, u32)>> {
    to.par_iter()
        .map(|point| {
            let mut best: Vec<(f64, u32)> = Vec::with_capacity(count + 1);
            for (k, place) in (0..).zip(places) {
                let square = place.distance_squared(*point);
                let worst = best.last().map_or(f64::INFINITY, |last| last.0);
                if best.len() < count || square < worst {
                    let at = best.partition_point(|near| near.0 <= square);
                    best.insert(at, (square, k));
                    best.truncate(count);
                }
            }
            best
        })
        .collect()
}

impl Instances {
    /// The nearest guides of each root, weighted by distance.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_procedural::{Instances, Roots};
    ///
    /// let guides = Roots { positions: vec![DVec3::ZERO, DVec3::X], uv: None };
    /// let roots = Roots { positions: vec![0.25 * DVec3::X], uv: None };
    /// let instances = Instances::by_distance(&guides, &roots, 2, 1.0);
    /// assert_eq!(instances.guides, [0, 1]);
    /// assert!((instances.weights[1] / instances.weights[0] - (-0.5_f64).exp()).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn by_distance(guides: &Roots, roots: &Roots, neighbors: usize, sigma: f64) -> Self {
        let each = neighbors.clamp(1, guides.len().max(1));
        Self::weighted(each, &nearest(&guides.places(roots), &roots.places(guides), each), sigma)
    }

    /// The guides of each root that are nearest over a scalp, weighted by that distance; where a
    /// root's piece of the scalp bears no guide, those nearest in space.
    #[must_use]
    pub fn over_surface(
        surface: &Surface,
        guides: &[DVec3],
        roots: &[DVec3],
        neighbors: usize,
        sigma: f64,
    ) -> Self {
        let each = neighbors.clamp(1, guides.len().max(1));
        let mut near = surface.nearest(guides, roots, each);
        for (near, root) in near.iter_mut().zip(roots).filter(|(near, _)| near.is_empty()) {
            *near = nearest(guides, std::slice::from_ref(root), each).concat();
        }
        Self::weighted(each, &near, sigma)
    }

    /// From the nearest guides of each root with their squared distances, `each` or fewer.
    fn weighted(each: usize, near: &[Vec<(f64, u32)>], sigma: f64) -> Self {
        let mut instances = Self { each, guides: Vec::new(), weights: Vec::new() };
        for near in near {
            // Taken from the least, so that one at least is not lost below the smallest number.
            let least = near.first().map_or((0.0, 0), |nearest| *nearest);
            let weights =
                near.iter().map(|(square, _)| (-(square - least.0) / (sigma * sigma)).exp());
            let sum: f64 = weights.clone().sum();
            let none = each - near.len();
            instances.weights.extend(weights.map(|weight| weight / sum));
            instances.weights.extend(std::iter::repeat_n(0.0, none));
            instances.guides.extend(near.iter().map(|(_, guide)| *guide));
            instances.guides.extend(std::iter::repeat_n(least.1, none));
        }
        instances
    }

    /// How many strands there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.guides.len().checked_div(self.each).unwrap_or(0)
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.guides.is_empty()
    }

    /// The guides of a strand, with their weights.
    pub fn strand(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = i * self.each..(i + 1) * self.each;
        let guides = self.guides[range.clone()].iter().map(|&guide| guide as usize);
        guides.zip(self.weights[range].iter().copied())
    }

    /// The strands named, in that order.
    ///
    /// # Panics
    ///
    /// If a strand is not there.
    #[must_use]
    pub fn select(&self, strands: &[usize]) -> Self {
        let rows = || strands.iter().flat_map(|&i| i * self.each..(i + 1) * self.each);
        Self {
            each: self.each,
            guides: rows().map(|row| self.guides[row]).collect(),
            weights: rows().map(|row| self.weights[row]).collect(),
        }
    }

    /// The strands at `roots`, blended from `guides`.
    ///
    /// # Panics
    ///
    /// If there is not one root a strand or a guide is not there.
    #[must_use]
    pub fn instance(&self, guides: &EvenStrands, roots: &[DVec3]) -> EvenStrands {
        assert_eq!(roots.len(), self.len(), "a root for every strand");
        let m = guides.points_each();
        let mut strands = EvenStrands::zeros(roots.len(), m);
        strands.points_mut().par_chunks_mut(m).with_min_len(64).enumerate().for_each(|(i, out)| {
            out.fill(roots[i]);
            for (guide, weight) in self.strand(i).filter(|&(_, weight)| weight != 0.0) {
                let guide = guides.strand(guide);
                for (x, g) in out.iter_mut().zip(guide) {
                    *x += weight * (*g - guide[0]);
                }
            }
            // The guides' first points cancel exactly.
            out[0] = roots[i];
        });
        strands
    }

    /// The gradient of a loss by the guides' points, from that by the strands'.
    ///
    /// # Panics
    ///
    /// If there are not as many strands or a guide is not there.
    #[must_use]
    pub fn pull_back(&self, guides: usize, gradient: &EvenStrands) -> EvenStrands {
        assert_eq!(gradient.len(), self.len(), "a gradient for every strand");
        let m = gradient.points_each();
        let mut by_guide: Vec<Vec<(usize, f64)>> = vec![Vec::new(); guides];
        for i in 0..self.len() {
            for (guide, weight) in self.strand(i).filter(|&(_, weight)| weight != 0.0) {
                by_guide[guide].push((i, weight));
            }
        }
        let mut out = EvenStrands::zeros(guides, m);
        out.points_mut().par_chunks_mut(m).zip(by_guide).for_each(|(out, strands)| {
            for (i, weight) in strands {
                for (sum, by_x) in out[1..].iter_mut().zip(&gradient.strand(i)[1..]) {
                    *sum += weight * *by_x;
                }
            }
            let sum = out[1..].iter().sum::<DVec3>();
            out[0] = -sum;
        });
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guides() -> EvenStrands {
        let at = |x: f64, up: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(x, up, 1.0)];
        EvenStrands::new(2, [at(0.0, 1.0), at(1.0, 3.0)].concat()).expect("two strands")
    }

    #[test]
    fn a_strand_at_a_guide_far_from_others_is_that_guide() {
        let guides = guides();
        let roots = Roots { positions: guides.roots(), uv: None };
        let instances = Instances::by_distance(&roots, &roots, 8, 0.01);
        assert_eq!(instances.each, 2, "no more neighbours than guides");
        assert_eq!(instances.instance(&guides, &roots.positions), guides);
    }

    #[test]
    fn texture_coordinates_decide_where_both_sides_have_them() {
        let guides = Roots { positions: guides().roots(), uv: Some(vec![[1.0, 0.0], [0.0, 0.0]]) };
        let roots = Roots { positions: vec![DVec3::ZERO], uv: Some(vec![[0.0, 0.0]]) };
        assert_eq!(Instances::by_distance(&guides, &roots, 1, 1.0).guides, [1]);
        let roots = Roots { uv: None, ..roots };
        assert_eq!(Instances::by_distance(&guides, &roots, 1, 1.0).guides, [0]);
    }

    #[test]
    fn guides_that_no_way_leads_to_weigh_nothing() {
        use tress_geometry::Mesh;
        let corners = |x: f64| [x, x + 1.0, x + 2.0].map(|x| DVec3::new(x, (x % 2.0).abs(), 0.0));
        let mesh = Mesh::new([corners(0.0), corners(10.0)].concat(), vec![[0, 1, 2], [3, 4, 5]]);
        let surface = Surface::new(&mesh.expect("corners")).expect("a mesh");
        let guides = [DVec3::X, 11.0 * DVec3::X];
        let roots = [DVec3::X * 1.1, DVec3::X * 10.9];
        let instances = Instances::over_surface(&surface, &guides, &roots, 2, 100.0);
        assert_eq!((instances.each, instances.guides[0], instances.guides[2]), (2, 0, 1));
        assert_eq!(instances.weights, [1.0, 0.0, 1.0, 0.0]);
        // Both guides on one piece: those of the other are found in space.
        let instances = Instances::over_surface(&surface, &[DVec3::X], &roots, 2, 100.0);
        assert_eq!((&instances.guides[..], &instances.weights[..]), (&[0, 0][..], &[1.0, 1.0][..]));
    }

    #[test]
    fn the_gradient_by_guides_is_the_transpose() {
        let guides = guides();
        let roots = Roots { positions: vec![DVec3::ONE, DVec3::X * 0.3], uv: None };
        let by_root = Roots { positions: guides.roots(), uv: None };
        let instances = Instances::by_distance(&by_root, &roots, 2, 0.8);
        let strands = instances.instance(&guides, &roots.positions);
        let points = (0..4).map(|i| DVec3::new(f64::from(i), 1.0, -2.0)).collect();
        let gradient = EvenStrands::new(2, points).expect("two strands");
        let back = instances.pull_back(2, &gradient);
        let dot = |a: &EvenStrands, b: &EvenStrands| -> f64 {
            a.points().iter().zip(b.points()).map(|(a, b)| a.dot(*b)).sum()
        };
        let moved: Vec<DVec3> = strands.iter().flat_map(|s| [DVec3::ZERO, s[1] - s[0]]).collect();
        let moved = EvenStrands::new(2, moved).expect("two strands");
        assert!((dot(&gradient, &moved) - dot(&back, &guides)).abs() < 1e-12);
    }
}
