//! Clusters of strands: k-means over rows of numbers.
//!
//! Lloyd's iteration from a k-means++ start (Arthur and Vassilvitskii, "k-means++: the advantages
//! of careful seeding", 2007). [CSE 5.3] clusters strands by root and tip stacked into six numbers,
//! see [`root_tip_features`].

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use tress_geometry::HelixGroom;

/// Rows shared out among clusters.
#[derive(Clone, Debug, PartialEq)]
pub struct Clusters<const D: usize> {
    /// The mean of the rows of each cluster.
    pub centers: Vec<[f64; D]>,
    /// The cluster of each row.
    pub assignment: Vec<u32>,
}

/// Why rows cannot be clustered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ClusterError {
    /// No clusters, or more than there are rows.
    ///
    /// ```
    /// # use tress_analysis::{ClusterError, k_means};
    /// let error = k_means(&[[0.0], [1.0]], 3, 0).unwrap_err();
    /// assert_eq!(error, ClusterError::Count { clusters: 3, rows: 2 });
    /// ```
    #[error(
        "{clusters} clusters cannot be made of {rows} strands: at least 1 and at most one each"
    )]
    Count {
        /// Clusters asked for.
        clusters: usize,
        /// Rows there are.
        rows: usize,
    },
    /// A number that is NaN or infinite.
    ///
    /// ```
    /// # use tress_analysis::{ClusterError, k_means};
    /// assert_eq!(k_means(&[[f64::NAN]], 1, 0), Err(ClusterError::NotFinite { row: 0 }));
    /// ```
    #[error("row {row} holds a number that is not finite")]
    NotFinite {
        /// The first such row.
        row: usize,
    },
}

/// Rounds of Lloyd's iteration at most; grooms settle in 10 to 40.
const MOST_ROUNDS: usize = 100;

/// Shares the rows out among `clusters` so that the squares of their distances to the cluster means
/// are locally least.
///
/// The same rows and seed give the same clusters on any number of threads. Rows in fewer places
/// than there are clusters leave some clusters empty, their centres doubled.
///
/// # Errors
///
/// If there are no clusters or more than rows, or if a number is not finite.
///
/// ```
/// use tress_analysis::k_means;
///
/// let clusters = k_means(&[[0.0], [0.2], [9.0], [9.4]], 2, 7)?;
/// assert_eq!(clusters.assignment[0], clusters.assignment[1]);
/// assert_ne!(clusters.assignment[1], clusters.assignment[2]);
/// # Ok::<(), tress_analysis::ClusterError>(())
/// ```
pub fn k_means<const D: usize>(
    rows: &[[f64; D]],
    clusters: usize,
    seed: u64,
) -> Result<Clusters<D>, ClusterError> {
    if clusters == 0 || rows.len() < clusters {
        return Err(ClusterError::Count { clusters, rows: rows.len() });
    }
    if let Some(row) = rows.iter().position(|row| row.iter().any(|x| !x.is_finite())) {
        return Err(ClusterError::NotFinite { row });
    }
    let mut centers = spread_centers(rows, clusters, &mut Pcg64Mcg::seed_from_u64(seed));
    let mut assignment = assign(rows, &centers);
    for _ in 0..MOST_ROUNDS {
        centers = means(rows, &assignment, centers);
        let next = assign(rows, &centers);
        if next == assignment {
            break;
        }
        assignment = next;
    }
    Ok(Clusters { centers, assignment })
}

impl<const D: usize> Clusters<D> {
    /// The rows of each cluster, ascending.
    #[must_use]
    pub fn members(&self) -> Vec<Vec<usize>> {
        let mut members = vec![Vec::new(); self.centers.len()];
        for (row, &cluster) in self.assignment.iter().enumerate() {
            members[cluster as usize].push(row);
        }
        members
    }
}

/// Root and tip of each strand, stacked as in [CSE 5.3].
///
/// Strands kept as polylines have a root only; it stands in for the tip, and 0 for what of it is
/// not finite.
#[must_use]
pub fn root_tip_features(groom: &HelixGroom) -> Vec<[f64; 6]> {
    let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
    (0..groom.len())
        .into_par_iter()
        .map(|i| {
            let strand = groom.strand(i);
            let (root, tip) = (strand.root.position, strand.tip().position);
            [root.x, root.y, root.z, tip.x, tip.y, tip.z].map(finite)
        })
        .collect()
}

/// k-means++: each further centre is a row drawn with a chance that grows with the square of its
/// distance to the centres there are.
fn spread_centers<const D: usize>(
    rows: &[[f64; D]],
    clusters: usize,
    rng: &mut Pcg64Mcg,
) -> Vec<[f64; D]> {
    let mut centers = vec![rows[rng.random_range(0..rows.len())]];
    let mut nearest = vec![f64::INFINITY; rows.len()];
    while centers.len() < clusters {
        let latest = centers[centers.len() - 1];
        for (least, row) in nearest.iter_mut().zip(rows) {
            *least = least.min(square_distance(row, &latest));
        }
        let mut left = rng.random::<f64>() * nearest.iter().sum::<f64>();
        let drawn = nearest.iter().position(|&square| {
            left -= square;
            left < 0.0
        });
        // Rows that all stand on centres leave nothing to draw: any row does.
        centers.push(rows[drawn.unwrap_or_else(|| rng.random_range(0..rows.len()))]);
    }
    centers
}

fn assign<const D: usize>(rows: &[[f64; D]], centers: &[[f64; D]]) -> Vec<u32> {
    let nearest = |row: &[f64; D]| {
        let mut best = (f64::INFINITY, 0_u32);
        for (cluster, center) in (0..).zip(centers) {
            let square = square_distance(row, center);
            if square < best.0 {
                best = (square, cluster);
            }
        }
        best.1
    };
    rows.par_iter().with_min_len(1024).map(nearest).collect()
}

/// The mean row of each cluster; an empty cluster keeps its centre.
fn means<const D: usize>(
    rows: &[[f64; D]],
    assignment: &[u32],
    mut centers: Vec<[f64; D]>,
) -> Vec<[f64; D]> {
    let mut sums = vec![([0.0; D], 0_usize); centers.len()];
    for (row, &cluster) in rows.iter().zip(assignment) {
        let (sum, count) = &mut sums[cluster as usize];
        sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += x);
        *count += 1;
    }
    for (center, (sum, count)) in centers.iter_mut().zip(sums) {
        if 0 < count {
            *center = sum.map(|x| x / count as f64);
        }
    }
    centers
}

fn square_distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blobs() -> Vec<[f64; 2]> {
        let mut rng = Pcg64Mcg::seed_from_u64(5);
        let mut near = |x: f64, y: f64| [x + rng.random::<f64>(), y + rng.random::<f64>()];
        (0..300).map(|i| near(f64::from(i % 3) * 20.0, f64::from(i % 2) * 20.0)).collect()
    }

    #[test]
    fn well_parted_blobs_are_found() {
        let rows = blobs();
        let clusters = k_means(&rows, 6, 1).expect("six of 300");
        for (i, row) in rows.iter().enumerate() {
            let center = clusters.centers[clusters.assignment[i] as usize];
            assert!(square_distance(row, &center) < 1.0, "row {i} is far from its centre");
        }
        assert_eq!(clusters.members().iter().map(Vec::len).sum::<usize>(), 300);
        assert!(clusters.members().iter().all(|members| members.len() == 50));
    }

    #[test]
    fn threads_do_not_change_clusters() {
        let rows = blobs();
        let on = |threads| {
            let pool =
                rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| k_means(&rows, 17, 3))
        };
        assert_eq!(on(1), on(3));
    }

    #[test]
    fn rows_all_in_one_place_are_no_trouble() {
        let clusters = k_means(&[[1.0, 2.0]; 5], 3, 0).expect("three of five");
        assert_eq!(clusters.centers, vec![[1.0, 2.0]; 3]);
        assert_eq!(k_means::<1>(&[], 0, 0), Err(ClusterError::Count { clusters: 0, rows: 0 }));
    }
}
