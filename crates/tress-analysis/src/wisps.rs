//! Wisps: strands that run together.
//!
//! Coils of a wisp share a way: side by side, their centerlines are nearer than a coil radius and
//! their phases are much the same, though both stray as they go on. The affinity of two strands is
//! how far that is so in the mean along the shorter one (see `abreast`); straight hair has no
//! phase, and half the distance of neighbouring roots stands for the radius. How close the strands
//! of a wisp are differs from groom to groom and from wisp to wisp, so that an affinity is held
//! against those that the strand has to its closest company. Strands are then joined by average
//! linkage (see `linkage`).
//!
//! Two coils are *phase-locked* where they lie in each other's grooves: abreast, position by
//! position, they are nearer than the radius, which neither coils beside each other nor coils more
//! than 60 degrees out of phase are.

mod abreast;
mod linkage;

use std::num::NonZero;

use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;
use serde::Serialize;
use tress_geometry::Groom;

use crate::{Analysis, Quantiles};
use abreast::{Way, abreast};
use linkage::average_linkage;

/// Which strands run together.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Wisps {
    /// The wisp of each strand, numbered by their first strands.
    pub wisp: Vec<u32>,
    /// Strands of each wisp; 1 for a strand that runs alone.
    pub sizes: Vec<u32>,
    /// The share of each strand's length along which it is phase-locked with one other, that for
    /// which it is greatest; NaN for strands that are no curves.
    pub locked: Vec<f64>,
}

/// Neighbours looked at, at each of three heights.
const NEIGHBOURS: NonZero<usize> = NonZero::new(16).expect("it is not 0");

/// Shares of the middle length at which neighbours are looked for.
const HEIGHTS: [f64; 3] = [0.25, 0.5, 0.75];

/// Strands that are a strand's closest company: it is held against their mean affinity.
const COMPANY: usize = 4;

/// Company is not taken for closer than this: strands of less are alone.
const LEAST_COMPANY: f64 = 0.1;

/// Wisps are joined whose strands are, in the mean, this close: as a share of how close a strand
/// is to its company. Of grooms with known wisps, 0.2 joins some that hang into each other, and 0.5
/// splits some that fan out.
const TOGETHER: f64 = 0.3;

impl Wisps {
    /// The wisps of a groom. `analysis` is that of the same groom, [`Analysis::of`]: it knows the
    /// strands' coil radii, and their centerlines point by point.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_analysis::{Analysis, Wisps};
    /// use tress_geometry::{Groom, Strands};
    ///
    /// // Two wisps of two coils each, ten units apart.
    /// let coil = |x: f64| (0..=96).map(move |i| {
    ///     let (sine, cosine) = (std::f64::consts::TAU * f64::from(i) / 12.0).sin_cos();
    ///     DVec3::new(x + cosine, 0.1 * f64::from(i), sine)
    /// });
    /// let points = [0.0, 0.2, 10.0, 10.2].into_iter().flat_map(coil).collect();
    /// let groom = Groom::new(Strands::from_counts([97; 4], points)?);
    /// let wisps = Wisps::of(&groom, &Analysis::of(&groom));
    /// assert_eq!((wisps.wisp, wisps.sizes), (vec![0, 0, 1, 1], vec![2, 2]));
    /// assert!(wisps.locked.iter().all(|share| 0.99 < *share));
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[must_use]
    pub fn of(groom: &Groom, analysis: &Analysis) -> Self {
        let n = groom.strands().len();
        let ways = ways(groom, analysis);
        let pairs = neighbours(&ways);
        let found: Vec<_> = pairs
            .into_par_iter()
            .filter_map(|[i, j]| Some(([i, j], abreast(ways[i].as_ref()?, ways[j].as_ref()?))))
            .collect();
        let unlocked = |way: &Option<Way<'_>>| if way.is_some() { 0.0 } else { f64::NAN };
        let mut locked: Vec<f64> = ways.iter().map(unlocked).collect();
        for ([i, j], pair) in &found {
            locked[*i] = locked[*i].max(pair.locked[0]);
            locked[*j] = locked[*j].max(pair.locked[1]);
        }
        let affinities: Vec<([usize; 2], f64)> =
            found.into_iter().map(|(pair, abreast)| (pair, abreast.affinity)).collect();
        let cluster = average_linkage(n, &in_company(n, &affinities), TOGETHER);
        let (wisp, sizes) = numbered(&cluster);
        Self { wisp, sizes, locked }
    }

    /// Sizes of the wisps of two strands or more.
    #[must_use]
    pub fn size(&self) -> Option<Quantiles> {
        Quantiles::of(self.sizes.iter().filter(|&&size| 1 < size).map(|&size| f64::from(size)))
    }

    /// Strands that are in a wisp of two strands or more.
    #[must_use]
    pub fn in_company(&self) -> usize {
        self.sizes.iter().filter(|&&size| 1 < size).map(|&size| size as usize).sum()
    }
}

/// The strands that are curves, with what is near for each.
fn ways<'a>(groom: &'a Groom, analysis: &'a Analysis) -> Vec<Option<Way<'a>>> {
    let strands = groom.strands();
    let measured = |i: usize| analysis.strands.get(i).copied().flatten();
    let curves = (0..strands.len()).filter(|&i| measured(i).is_some());
    let roots: Vec<[f64; 3]> = curves.map(|i| strands.strand(i)[0].to_array()).collect();
    let apart = root_distance(&roots).map_or(0.0, |distance| 0.5 * distance);
    let way = |i: usize| {
        let near = measured(i)?.coil_radius.unwrap_or(apart);
        let center = analysis.along.center.get(strands.range(i))?;
        Some(Way::new(strands.strand(i), center, near))
    };
    (0..strands.len()).into_par_iter().map(way).collect()
}

/// Pairs of strands of which one is among the nearest to the other at some height.
fn neighbours(ways: &[Option<Way<'_>>]) -> Vec<[usize; 2]> {
    let lengths = ways.iter().flatten().map(Way::length);
    let Some(middle) = Quantiles::of(lengths).map(|q| q.median) else { return vec![] };
    let mut pairs = Vec::new();
    for height in HEIGHTS.map(|share| share * middle) {
        let there = |(i, way): (usize, &Option<Way<'_>>)| {
            let way = way.as_ref().filter(|way| height <= way.length())?;
            Some((i, way.center_at(height).0.to_array()))
        };
        let (strands, places): (Vec<usize>, Vec<[f64; 3]>) =
            ways.iter().enumerate().filter_map(there).unzip();
        if places.is_empty() {
            continue;
        }
        let tree: ImmutableKdTree<f64, 3> = ImmutableKdTree::new_from_slice(&places);
        let near = |place: &[f64; 3]| -> Vec<usize> {
            let found = tree.nearest_n::<SquaredEuclidean>(place, NEIGHBOURS);
            let items = found.iter().filter_map(|n| usize::try_from(n.item).ok());
            items.filter_map(|item| strands.get(item).copied()).collect()
        };
        let found: Vec<Vec<usize>> = places.par_iter().map(near).collect();
        for (&i, found) in strands.iter().zip(found) {
            pairs.extend(found.into_iter().filter(|&j| j != i).map(|j| [i.min(j), i.max(j)]));
        }
    }
    pairs.par_sort_unstable();
    pairs.dedup();
    pairs
}

/// Affinities as shares of how close the strands' company is.
fn in_company(n: usize, pairs: &[([usize; 2], f64)]) -> Vec<([usize; 2], f64)> {
    let mut closest = vec![[0.0; COMPANY]; n];
    for ([i, j], affinity) in pairs {
        for strand in [i, j] {
            let closest: &mut [f64; COMPANY] = &mut closest[*strand];
            if closest[0] < *affinity {
                closest[0] = *affinity;
                closest.sort_unstable_by(f64::total_cmp);
            }
        }
    }
    let company: Vec<f64> =
        closest.iter().map(|all| all.iter().sum::<f64>() / COMPANY as f64).collect();
    let share = |&([i, j], affinity): &([usize; 2], f64)| {
        ([i, j], affinity / company[i].min(company[j]).max(LEAST_COMPANY))
    };
    pairs.iter().map(share).collect()
}

/// The median distance of roots to the nearest other one; `None` for fewer than two.
fn root_distance(roots: &[[f64; 3]]) -> Option<f64> {
    if roots.len() < 2 {
        return None;
    }
    let tree: ImmutableKdTree<f64, 3> = ImmutableKdTree::new_from_slice(roots);
    let two = NonZero::new(2)?;
    let nearest = |root: &[f64; 3]| {
        tree.nearest_n::<SquaredEuclidean>(root, two).last().map_or(f64::NAN, |n| n.distance.sqrt())
    };
    let distances: Vec<f64> = roots.par_iter().map(nearest).collect();
    Quantiles::of(distances).map(|q| q.median)
}

/// The wisp of each strand, numbered in the order of their first strands, and their sizes.
fn numbered(cluster: &[usize]) -> (Vec<u32>, Vec<u32>) {
    let mut number = vec![u32::MAX; cluster.len()];
    let mut sizes: Vec<u32> = Vec::new();
    let mut wisp = Vec::with_capacity(cluster.len());
    for &name in cluster {
        if number[name] == u32::MAX {
            number[name] = u32::try_from(sizes.len()).unwrap_or(u32::MAX);
            sizes.push(0);
        }
        sizes[number[name] as usize] += 1;
        wisp.push(number[name]);
    }
    (wisp, sizes)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use tress_geometry::Strands;

    use super::*;

    fn wisps(groom: &Groom) -> Wisps {
        Wisps::of(groom, &Analysis::of(groom))
    }

    /// Coils beside each other, each at its x and with its phase, of 8 turns.
    fn coils(places: &[(f64, f64)]) -> Groom {
        let mut strands = Strands::default();
        for &(x, phase) in places {
            let at = |i: u32| {
                let angle = std::f64::consts::TAU * f64::from(i) / 12.0 + phase;
                DVec3::new(x + angle.cos(), 0.1 * f64::from(i), angle.sin())
            };
            strands.push((0..=96).map(at)).expect("a few points");
        }
        Groom::new(strands)
    }

    #[test]
    fn coils_in_phase_are_a_wisp_and_others_at_the_same_place_are_not() {
        let found = wisps(&coils(&[(0.0, 0.0), (0.3, 0.1), (0.1, 3.0), (5.0, 0.0)]));
        assert_eq!((found.wisp, found.sizes), (vec![0, 0, 1, 2], vec![2, 1, 1]));
        assert_eq!((found.locked[0], found.locked[2]), (1.0, 0.0));
    }

    #[test]
    fn straight_strands_that_draw_together_are_a_wisp() {
        let mut strands = Strands::default();
        // Roots one apart; the first three meet, the last three part.
        for i in 0..6 {
            let x = f64::from(i);
            let (middle, by) = if i < 3 { (1.0, 0.1) } else { (4.0, 1.5) };
            let tip = middle + (x - middle) * by;
            let at = |k: u32| {
                DVec3::new(x + (tip - x) * (f64::from(k) / 4.0).min(1.0), f64::from(k), 0.0)
            };
            strands.push((0..20).map(at)).expect("a few points");
        }
        let found = wisps(&Groom::new(strands));
        assert_eq!((found.wisp.clone(), found.in_company()), (vec![0, 0, 0, 1, 2, 3], 3));
        assert_eq!(found.size().map(|q| q.median), Some(3.0));
    }

    #[test]
    fn odd_grooms_have_wisps_of_one() {
        let none = Groom::new(Strands::default());
        assert_eq!(wisps(&none), Wisps::default());
        let points = vec![DVec3::NAN, DVec3::ZERO, DVec3::X];
        let odd = Groom::new(Strands::from_counts([1, 2], points).expect("three points"));
        let found = wisps(&odd);
        assert_eq!(found.sizes, [1, 1]);
        assert!(found.locked[0].is_nan() && found.locked[1..] == [0.0]);
        let same = coils(&[(0.0, 0.0); 40]);
        assert_eq!(wisps(&same).sizes, [40]);
    }
}
