//! Wisps: strands that run together.
//!
//! Two coils lie in each other's grooves where they are *phase-locked*: at the same arc length from
//! the root they are nearer than a coil radius, so that neither their centerlines nor their phases
//! (by 60 degrees) are far apart. Straight hair has no phase; there, half the distance of
//! neighbouring roots stands for the radius, and strands run together where they are nearer than
//! they grow. Strands that run together for at least half of the shorter one's length are of one
//! wisp, and so are strands that share a neighbour.

use std::num::NonZero;

use glam::DVec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;
use serde::Serialize;
use tress_geometry::Groom;
use tress_geometry::polyline::{arc_lengths, defect, place};

use crate::{Analysis, Quantiles};

/// Which strands run together.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Wisps {
    /// The wisp of each strand, numbered by their first strands.
    pub wisp: Vec<u32>,
    /// Strands of each wisp; 1 for a strand that runs alone.
    pub sizes: Vec<u32>,
    /// The share of each strand's length along which it runs together with another; NaN for
    /// strands that are no curves.
    pub locked: Vec<f64>,
}

/// Places at which a strand of the middle length is held against its neighbours.
const PLACES: usize = 48;

/// Neighbours looked at, at each of three places.
const NEIGHBOURS: NonZero<usize> = NonZero::new(16).expect("it is not 0");

/// Strands that run together for so much of the shorter one are of one wisp.
const TOGETHER: f64 = 0.5;

impl Wisps {
    /// The wisps of a groom, of which `analysis` knows the coil radii.
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
    /// assert_eq!(wisps.locked, [1.0; 4]);
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[must_use]
    pub fn of(groom: &Groom, analysis: &Analysis) -> Self {
        let n = groom.strands().len();
        let Some(ways) = Ways::of(groom, analysis) else {
            let wisp = (0..u32::try_from(n).unwrap_or(u32::MAX)).collect();
            return Self { wisp, sizes: vec![1; n], locked: vec![f64::NAN; n] };
        };
        let neighbours = ways.neighbours();
        let found: Vec<(f64, Vec<usize>)> =
            (0..n).into_par_iter().map(|i| ways.together(i, &neighbours[i])).collect();
        let mut parents: Vec<usize> = (0..n).collect();
        for (i, (_, mates)) in found.iter().enumerate() {
            for &mate in mates {
                join(&mut parents, i, mate);
            }
        }
        let (wisp, sizes) = numbered(&mut parents);
        Self { wisp, sizes, locked: found.into_iter().map(|(locked, _)| locked).collect() }
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

/// Strands at even arc lengths that are the same for all of them.
struct Ways {
    /// Places of each strand, as far as it reaches; none for a strand that is no curve.
    places: Vec<Vec<DVec3>>,
    /// How near another strand must be to run together with each.
    near: Vec<f64>,
}

impl Ways {
    /// `None` where there is no curve.
    fn of(groom: &Groom, analysis: &Analysis) -> Option<Self> {
        let lengths = analysis.strands.iter().flatten().map(|m| m.length);
        let step = Quantiles::of(lengths)?.median / PLACES as f64;
        let places: Vec<Vec<DVec3>> = (0..groom.strands().len())
            .into_par_iter()
            .map(|i| spaced(groom.strands().strand(i), step))
            .collect();
        let roots: Vec<[f64; 3]> =
            places.iter().filter_map(|p| Some(p.first()?.to_array())).collect();
        let apart = 0.5 * root_distance(&roots)?;
        let radius =
            |i: usize| analysis.strands.get(i).copied().flatten().and_then(|m| m.coil_radius);
        let near = (0..places.len()).map(|i| radius(i).unwrap_or(apart)).collect();
        Some(Self { places, near })
    }

    /// Strands that come near each strand at some height, ascending.
    fn neighbours(&self) -> Vec<Vec<usize>> {
        let mut all = vec![Vec::new(); self.places.len()];
        for height in [PLACES / 4, PLACES / 2, 3 * PLACES / 4] {
            let there: Vec<usize> =
                (0..self.places.len()).filter(|&i| height < self.places[i].len()).collect();
            let points: Vec<[f64; 3]> =
                there.iter().map(|&i| self.places[i][height].to_array()).collect();
            if points.is_empty() {
                continue;
            }
            let tree: ImmutableKdTree<f64, 3> = ImmutableKdTree::new_from_slice(&points);
            let near = |point: &[f64; 3]| -> Vec<usize> {
                let found = tree.nearest_n::<SquaredEuclidean>(point, NEIGHBOURS);
                let items = found.iter().filter_map(|n| usize::try_from(n.item).ok());
                items.filter_map(|item| there.get(item).copied()).collect()
            };
            let found: Vec<Vec<usize>> = points.par_iter().map(near).collect();
            for (&i, found) in there.iter().zip(found) {
                all[i].extend(found.into_iter().filter(|&j| j != i));
            }
        }
        for neighbours in &mut all {
            neighbours.sort_unstable();
            neighbours.dedup();
        }
        all
    }

    /// The share of strand `i` that runs together with any neighbour, and the neighbours that are
    /// of its wisp.
    fn together(&self, i: usize, neighbours: &[usize]) -> (f64, Vec<usize>) {
        let own = &self.places[i];
        if own.is_empty() {
            return (f64::NAN, vec![]);
        }
        let mut locked = vec![false; own.len()];
        let mut mates = Vec::new();
        for &j in neighbours {
            let near = self.near[i].min(self.near[j]);
            let mut together = 0_usize;
            for ((p, q), locked) in own.iter().zip(&self.places[j]).zip(&mut locked) {
                let is_near = p.distance_squared(*q) <= near * near;
                together += usize::from(is_near);
                *locked |= is_near;
            }
            let shorter = own.len().min(self.places[j].len());
            if TOGETHER * shorter as f64 <= together as f64 {
                mates.push(j);
            }
        }
        (locked.iter().filter(|l| **l).count() as f64 / own.len() as f64, mates)
    }
}

/// Places of a polyline every `step`, from its root on.
fn spaced(points: &[DVec3], step: f64) -> Vec<DVec3> {
    if defect(points).is_some() {
        return vec![];
    }
    let mut along = Vec::with_capacity(points.len());
    arc_lengths(points, &mut along);
    let length = along[along.len() - 1];
    let mut places = Vec::new();
    let mut s = 0.0;
    // A strand a thousand times as long as the others is held against them where they are.
    while s <= length && places.len() < 20 * PLACES {
        let (i, f) = place(&along, s);
        places.push(if f == 0.0 { points[i] } else { points[i].lerp(points[i + 1], f) });
        s += step;
    }
    places
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

/// The first of the strands joined to this one.
fn first(parents: &mut [usize], mut i: usize) -> usize {
    while parents[i] != i {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    i
}

fn join(parents: &mut [usize], i: usize, j: usize) {
    let (i, j) = (first(parents, i), first(parents, j));
    parents[i.max(j)] = i.min(j);
}

/// The wisp of each strand, numbered in the order of their first strands, and their sizes.
fn numbered(parents: &mut [usize]) -> (Vec<u32>, Vec<u32>) {
    let mut number = vec![u32::MAX; parents.len()];
    let mut sizes: Vec<u32> = Vec::new();
    let mut wisp = Vec::with_capacity(parents.len());
    for i in 0..parents.len() {
        let first = first(parents, i);
        if number[first] == u32::MAX {
            number[first] = u32::try_from(sizes.len()).unwrap_or(u32::MAX);
            sizes.push(0);
        }
        sizes[number[first] as usize] += 1;
        wisp.push(number[first]);
    }
    (wisp, sizes)
}

#[cfg(test)]
mod tests {
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
        assert!(found.locked.iter().all(|l| l.is_nan()));
        let same = coils(&[(0.0, 0.0); 40]);
        assert_eq!(wisps(&same).sizes, [40]);
    }
}
