//! Guides to begin with: clusters of strands, smoothed [IPG 5.2].
//!
//! Strands are clustered by k-means on their roots and on the means of eight stretches of the
//! strand relative to its root (means, because single points of a coil say more about its phase
//! than about its course). A cluster's guide is the mean of its strands, put at the root of the
//! strand nearest their mean root, and smoothed along itself. Operator guides are the k-medoids of
//! the guides by the same measure.

use glam::DVec3;
use rayon::prelude::*;
use tress_analysis::{ClusterError, k_means};

use super::Smoothing;
use super::courses::segments;
use super::guides::set_lengths;
use crate::EvenStrands;

/// Stretches of a strand whose means are compared.
const STRETCHES: usize = 8;
/// A root and the mean of each stretch.
const FEATURES: usize = 3 + 3 * STRETCHES;

/// Guides to begin with.
#[derive(Clone, Debug, PartialEq)]
pub struct Initial {
    /// Means of the clusters, not smoothed: what instancing weights are found with.
    pub means: EvenStrands,
    /// The guides: the means, smoothed.
    pub guides: EvenStrands,
    /// The strand each guide's root is taken from.
    pub root_strands: Vec<usize>,
    /// The strands of each cluster.
    pub members: Vec<Vec<usize>>,
}

/// Why no guides can be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InitialError {
    /// More guides than strands, or none.
    #[error("{guides} guides cannot be found for {strands} strands: at least 1, at most one each")]
    Count {
        /// Guides asked for.
        guides: usize,
        /// Strands there are.
        strands: usize,
    },
    /// A strand with a coordinate that is not finite.
    #[error("strand {strand} has a coordinate that is not finite")]
    NotFinite {
        /// The strand.
        strand: usize,
    },
}

/// What strands are compared by.
fn features(strands: &EvenStrands, root_weight: f64) -> Vec<[f64; FEATURES]> {
    let m = strands.points_each();
    let scale = 1.0 / (STRETCHES as f64).sqrt();
    let feature = |strand: &[DVec3]| {
        let mut row = [0.0; FEATURES];
        row[..3].copy_from_slice(&(strand[0] * root_weight).to_array());
        for stretch in 0..STRETCHES {
            let (from, to) = (stretch * m / STRETCHES, (stretch + 1) * m / STRETCHES);
            let points = &strand[from..to.max(from + 1)];
            let mean = points.iter().sum::<DVec3>() / points.len() as f64 - strand[0];
            row[3 + 3 * stretch..][..3].copy_from_slice(&(mean * scale).to_array());
        }
        row
    };
    strands.points().par_chunks(m).map(feature).collect()
}

/// Clusters strands and gives each cluster a guide; `root_weight` is the weight of roots against
/// the rest of the strands.
///
/// # Errors
///
/// If there are fewer strands than guides, or a coordinate is not finite.
pub fn initialize(
    strands: &EvenStrands,
    guides: usize,
    root_weight: f64,
    smoothing: &Smoothing,
    seed: u64,
) -> Result<Initial, InitialError> {
    let clusters =
        k_means(&features(strands, root_weight), guides, seed).map_err(|error| match error {
            ClusterError::NotFinite { row } => InitialError::NotFinite { strand: row },
            _ => InitialError::Count { guides, strands: strands.len() },
        })?;
    let members: Vec<Vec<usize>> =
        clusters.members().into_iter().filter(|members| !members.is_empty()).collect();
    let root_strands: Vec<usize> = members.par_iter().map(|m| central(strands, m)).collect();
    let m = strands.points_each();
    let mut means = EvenStrands::zeros(members.len(), m);
    means.points_mut().par_chunks_mut(m).zip(&members).zip(&root_strands).for_each(
        |((out, members), &root)| {
            for &i in members {
                let strand = strands.strand(i);
                for (sum, x) in out.iter_mut().zip(strand) {
                    *sum += (*x - strand[0]) / members.len() as f64;
                }
            }
            let root = strands.strand(root)[0];
            out.iter_mut().for_each(|x| *x += root);
        },
    );
    let mut guides = means.clone();
    smoothing.apply_to_all(&mut guides);
    Ok(Initial { means, guides, root_strands, members })
}

impl Initial {
    /// Gives the guides the lengths that their strands have in the mean, each smoothed a little by
    /// itself: a mean of strands that bend apart is shorter than any of them.
    pub(super) fn restore_lengths(&mut self, strands: &EvenStrands, smoothing: &Smoothing) {
        let m = strands.points_each();
        self.guides.points_mut().par_chunks_mut(m).zip(&self.members).for_each(
            |(guide, members)| set_lengths(guide, &mean_lengths(strands, members, smoothing)),
        );
    }
}

/// Of the steps that smooth a guide, the share that a strand's length is taken after: enough for
/// frizz not to count as length, and little enough for the strand's own course to do.
const LENGTH_SHARE: usize = 16;

/// The mean lengths of the segments of strands, each smoothed a little by itself.
fn mean_lengths(strands: &EvenStrands, members: &[usize], smoothing: &Smoothing) -> Vec<f64> {
    let mut lengths = vec![0.0; strands.points_each() - 1];
    let smoothing = Smoothing { steps: smoothing.steps / LENGTH_SHARE, ..*smoothing };
    for &i in members {
        let mut strand = strands.strand(i).to_vec();
        smoothing.apply(&mut strand);
        for (sum, segment) in lengths.iter_mut().zip(segments(&strand)) {
            *sum += segment.length() / members.len() as f64;
        }
    }
    lengths
}

/// The strand of a cluster whose root is nearest the mean root.
fn central(strands: &EvenStrands, members: &[usize]) -> usize {
    let root = |i: usize| strands.strand(i)[0];
    let mean = members.iter().map(|&i| root(i)).sum::<DVec3>() / members.len() as f64;
    let distance = |i: usize| root(i).distance_squared(mean);
    let nearer = |a: &usize, b: &usize| distance(*a).total_cmp(&distance(*b));
    members.iter().copied().min_by(nearer).unwrap_or(0)
}

/// Weight of the root against the strand for operator guides.
const MEDOID_ROOT_WEIGHT: f64 = 2.0;
/// Rounds of k-medoids at most.
const MOST_ROUNDS: usize = 30;

/// `count` of the strands that stand for all of them: k-medoids by roots and course.
///
/// Medoids to begin with are those farthest from the ones before; then strands go to the nearest
/// medoid and each group chooses the strand with the least sum of distances to the others, until
/// nothing changes. All strands if `count` is as many or more.
///
/// ```
/// use glam::DVec3;
/// use tress_procedural::{EvenStrands, fit::medoids};
///
/// let at = |x: f64| [DVec3::X * x, DVec3::X * x + DVec3::Y];
/// let strands = [0.0, 0.1, 0.2, 9.0, 9.1, 9.2].into_iter().flat_map(at).collect();
/// assert_eq!(medoids(&EvenStrands::new(2, strands)?, 2), [1, 4]);
/// # Ok::<(), tress_procedural::EvenError>(())
/// ```
#[must_use]
pub fn medoids(strands: &EvenStrands, count: usize) -> Vec<u32> {
    let rows = features(strands, MEDOID_ROOT_WEIGHT);
    let all = || (0..).take(rows.len());
    if count >= rows.len() || count == 0 {
        return all().collect();
    }
    let distance = |a: usize, b: usize| -> f64 {
        rows[a].iter().zip(&rows[b]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    let mut medoids = farthest(rows.len(), count, distance);
    for _ in 0..MOST_ROUNDS {
        let mut groups = vec![Vec::new(); count];
        let near = |i: usize| {
            let nearer = |a: &usize, b: &usize| {
                distance(i, medoids[*a]).total_cmp(&distance(i, medoids[*b]))
            };
            (0..count).min_by(nearer).unwrap_or(0)
        };
        let nearest: Vec<usize> = (0..rows.len()).into_par_iter().map(near).collect();
        nearest.iter().enumerate().for_each(|(i, &group)| groups[group].push(i));
        let next: Vec<usize> = groups
            .par_iter()
            .zip(&medoids)
            .map(|(group, &medoid)| {
                let sum = |i: usize| -> f64 { group.iter().map(|&j| distance(i, j)).sum() };
                let sums: Vec<(f64, usize)> = group.iter().map(|&i| (sum(i), i)).collect();
                let best = sums.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
                best.map_or(medoid, |(_, i)| i)
            })
            .collect();
        if next == medoids {
            break;
        }
        medoids = next;
    }
    medoids.sort_unstable();
    all().filter(|&i: &u32| medoids.binary_search(&(i as usize)).is_ok()).collect()
}

/// Rows each farthest from those before it.
fn farthest(rows: usize, count: usize, distance: impl Fn(usize, usize) -> f64) -> Vec<usize> {
    let mut chosen = vec![0];
    let mut nearest: Vec<f64> = (0..rows).map(|i| distance(i, 0)).collect();
    while chosen.len() < count {
        let by_distance = |a: &usize, b: &usize| nearest[*a].total_cmp(&nearest[*b]);
        let next = (0..rows).max_by(by_distance).unwrap_or(0);
        chosen.push(next);
        for (i, least) in nearest.iter_mut().enumerate() {
            *least = least.min(distance(i, next));
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clusters_of_coils_become_smooth_guides() {
        let coil = |i: usize| {
            let (x, phase) = ((i / 10) as f64 * 5.0 + 0.01 * (i % 10) as f64, i as f64);
            (0..100).map(move |j| {
                let (s, angle) = (0.1 * f64::from(j), 0.6 * f64::from(j) + phase);
                DVec3::new(x + 0.3 * angle.sin(), -s, 0.3 * angle.cos())
            })
        };
        let strands = EvenStrands::new(100, (0..30).flat_map(coil).collect()).expect("30 strands");
        let initial =
            initialize(&strands, 3, 2.0, &Smoothing::default(), 1).expect("three clusters");
        assert_eq!(initial.guides.len(), 3);
        for guide in initial.guides.iter() {
            let length: f64 = guide.windows(2).map(|ends| ends[0].distance(ends[1])).sum();
            assert!(length < 11.0, "a line of 9.9, not a coil of 20: {length}");
        }
        let error = initialize(&strands, 31, 2.0, &Smoothing::default(), 1).unwrap_err();
        assert_eq!(error, InitialError::Count { guides: 31, strands: 30 });
    }
}
