//! Roots on a scalp, no two too near each other.
//!
//! Four times as many points as wanted are drawn evenly by area and density; of these, those that
//! stand closest are taken away one after the other until the wanted number is left: Yuksel,
//! "Sample elimination for generating Poisson disk sample sets", CGF 34(2), 2015. A point's weight
//! is the sum over its neighbours of `(1 - d / 2 r)^8`, with `r` the radius at which discs would
//! be packed as densely as they can be, `r^2 = A / (2 sqrt(3) N)`; where density is higher, `r` is
//! smaller by its root.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec3;
use kiddo::SquaredEuclidean;
use kiddo::immutable::float::kdtree::ImmutableKdTree;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use tress_geometry::Mesh;

/// Points drawn for each that is left. More makes distances evener and takes longer.
const DRAWN: usize = 4;

/// Triangles of varying density are drawn from by rejection; a draw is given up after so many.
const TRIES: usize = 64;

/// How dense roots stand where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Density<'a> {
    /// As dense everywhere.
    Even,
    /// A weight a triangle; 0 keeps it bare.
    Faces(&'a [f64]),
    /// A weight a vertex, linear between.
    Vertices(&'a [f64]),
}

/// Why roots cannot be scattered.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScatterError {
    /// Nothing to stand on: no triangles, or none with an area and a density.
    ///
    /// ```
    /// # use tress_geometry::Mesh;
    /// # use tress_grow::{Density, ScatterError, scatter};
    /// let error = scatter(&Mesh::default(), 5, Density::Even, 1);
    /// assert_eq!(error, Err(ScatterError::NoArea));
    /// ```
    #[error("the mesh has no area that hair may grow on")]
    NoArea,
    /// Not one weight for each triangle or vertex.
    #[error("{weights} densities for {expected} {of}")]
    Weights {
        /// Weights given.
        weights: usize,
        /// Triangles or vertices there are.
        expected: usize,
        /// Which of the two.
        of: &'static str,
    },
    /// A density below 0 or not finite.
    #[error("density {index} is {value}, which is not a finite number of 0 or more")]
    Weight {
        /// Of which triangle or vertex.
        index: usize,
        /// What it is.
        value: f64,
    },
    /// More roots than 32 bits tell apart.
    #[error("{0} roots are more than can be told apart")]
    TooMany(usize),
}

/// So many roots on a mesh.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::Mesh;
/// use tress_grow::{Density, scatter};
///
/// let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
/// let positions = square.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
/// let mesh = Mesh::new(positions, vec![[0, 1, 2], [0, 2, 3]])?;
/// let roots = scatter(&mesh, 100, Density::Even, 1)?;
/// let nearest = |p: &DVec3| {
///     roots.iter().filter(|q| *q != p).map(|q| p.distance(*q)).fold(f64::INFINITY, f64::min)
/// };
/// // A hundred random points would have some pair at about a thousandth.
/// assert!(roots.len() == 100 && roots.iter().all(|p| nearest(p) > 0.06));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// See [`ScatterError`].
pub fn scatter(
    mesh: &Mesh,
    count: usize,
    density: Density<'_>,
    seed: u64,
) -> Result<Vec<DVec3>, ScatterError> {
    check(mesh, density)?;
    if u32::try_from(count.saturating_mul(DRAWN)).is_err() {
        return Err(ScatterError::TooMany(count));
    }
    let weights: Vec<f64> = (0..mesh.triangles().len())
        .map(|i| corner_weights(mesh, density, i).into_iter().fold(0.0, f64::max))
        .collect();
    let mut sum = 0.0;
    let reach: Vec<f64> = weights
        .iter()
        .enumerate()
        .map(|(i, weight)| {
            let share = weight * mesh.area(i);
            sum += if share.is_finite() { share } else { 0.0 };
            sum
        })
        .collect();
    if sum <= 0.0 || !sum.is_finite() {
        return Err(ScatterError::NoArea);
    }
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let drawn: Vec<(DVec3, f64)> =
        (0..count * DRAWN).map(|_| draw(mesh, density, &weights, &reach, &mut rng)).collect();
    Ok(eliminate(&drawn, count, mass(mesh, density)))
}

fn check(mesh: &Mesh, density: Density<'_>) -> Result<(), ScatterError> {
    let (weights, expected, of) = match density {
        Density::Even => return Ok(()),
        Density::Faces(weights) => (weights, mesh.triangles().len(), "triangles"),
        Density::Vertices(weights) => (weights, mesh.positions().len(), "vertices"),
    };
    if weights.len() != expected {
        return Err(ScatterError::Weights { weights: weights.len(), expected, of });
    }
    let bad = weights.iter().position(|w| !(w.is_finite() && 0.0 <= *w));
    bad.map_or(Ok(()), |index| Err(ScatterError::Weight { index, value: weights[index] }))
}

/// The density at the corners of triangle `i`.
fn corner_weights(mesh: &Mesh, density: Density<'_>, i: usize) -> [f64; 3] {
    match density {
        Density::Even => [1.0; 3],
        Density::Faces(weights) => [weights[i]; 3],
        Density::Vertices(weights) => mesh.triangles()[i].map(|corner| weights[corner as usize]),
    }
}

/// The integral of density over area.
fn mass(mesh: &Mesh, density: Density<'_>) -> f64 {
    let of = |i| corner_weights(mesh, density, i).iter().sum::<f64>() / 3.0 * mesh.area(i);
    (0..mesh.triangles().len()).map(of).filter(|m| m.is_finite()).sum()
}

/// A point drawn by area and density, and the density there.
fn draw(
    mesh: &Mesh,
    density: Density<'_>,
    weights: &[f64],
    reach: &[f64],
    rng: &mut Pcg64Mcg,
) -> (DVec3, f64) {
    let total = reach[reach.len() - 1];
    let mut drawn = (DVec3::ZERO, 0.0);
    for _ in 0..TRIES {
        let chance = rng.random::<f64>() * total;
        let i = reach.partition_point(|r| *r <= chance).min(reach.len() - 1);
        let (a, b): (f64, f64) = (rng.random(), rng.random());
        // Even over the triangle (Osada et al. 2002).
        let (p, q) = (1.0 - a.sqrt(), a.sqrt() * b);
        let [x, y, z] = mesh.corners(i);
        let [d, e, f] = corner_weights(mesh, density, i);
        let mix = [p, 1.0 - p - q, q];
        let here = mix[0] * d + mix[1] * e + mix[2] * f;
        drawn = (mix[0] * x + mix[1] * y + mix[2] * z, here);
        if rng.random::<f64>() * weights[i] < here {
            break;
        }
    }
    drawn
}

/// Takes points away, the most crowded first, until `count` are left.
fn eliminate(drawn: &[(DVec3, f64)], count: usize, mass: f64) -> Vec<DVec3> {
    // Where density is d, a root has the area mass / (d count) to itself.
    let packed = (mass / (2.0 * 3.0_f64.sqrt() * count.max(1) as f64)).sqrt();
    let radius = |i: usize| packed / drawn[i].1.max(f64::MIN_POSITIVE).sqrt();
    let places: Vec<[f64; 3]> = drawn.iter().map(|(p, _)| p.to_array()).collect();
    let tree: ImmutableKdTree<f64, u32, 3, 32> = ImmutableKdTree::new_from_slice(&places);
    let crowd = |i: usize| -> Vec<(u32, f64)> {
        let reach = 2.0 * radius(i);
        let near = tree.within_unsorted::<SquaredEuclidean>(&places[i], reach * reach);
        let others = near.iter().filter(|n| n.item as usize != i);
        let mut crowd: Vec<(u32, f64)> =
            others.map(|n| (n.item, (1.0 - n.distance.sqrt() / reach).max(0.0).powi(8))).collect();
        crowd.sort_unstable_by_key(|(other, _)| *other);
        crowd
    };
    let crowds: Vec<Vec<(u32, f64)>> =
        (0..drawn.len()).into_par_iter().with_min_len(256).map(crowd).collect();
    let mut weights: Vec<f64> = crowds.iter().map(|c| c.iter().map(|(_, w)| w).sum()).collect();
    // Weights only fall: an entry that is too high is put back at its place when it comes up.
    let entry = |i: usize, w: f64| (w.to_bits(), Reverse(i));
    let mut heap: BinaryHeap<_> = weights.iter().enumerate().map(|(i, w)| entry(i, *w)).collect();
    let mut left = vec![true; drawn.len()];
    let mut gone = 0;
    while gone + count < drawn.len() {
        let Some((bits, Reverse(i))) = heap.pop() else { break };
        if bits != weights[i].to_bits() {
            heap.push(entry(i, weights[i]));
            continue;
        }
        left[i] = false;
        gone += 1;
        for (other, _) in &crowds[i] {
            let other = *other as usize;
            let own = crowds[other].binary_search_by_key(&i, |(name, _)| *name as usize);
            if let Ok(at) = own {
                weights[other] = (weights[other] - crowds[other][at].1).max(0.0);
            }
        }
    }
    drawn.iter().zip(left).filter(|(_, left)| *left).map(|((p, _), _)| *p).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of two triangles per cell.
    fn plane(cells: u32) -> Mesh {
        let n = cells + 1;
        let at = |i: u32| f64::from(i) / f64::from(cells);
        let positions = (0..n * n).map(|k| DVec3::new(at(k % n), at(k / n), 0.0)).collect();
        let cell = |k: u32| {
            let a = k / cells * n + k % cells;
            [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]]
        };
        Mesh::new(positions, (0..cells * cells).flat_map(cell).collect()).expect("indices fit")
    }

    fn nearest(roots: &[DVec3]) -> Vec<f64> {
        let of = |(i, p): (usize, &DVec3)| {
            let others = roots.iter().enumerate().filter(|(j, _)| *j != i);
            others.map(|(_, q)| p.distance(*q)).fold(f64::INFINITY, f64::min)
        };
        roots.iter().enumerate().map(of).collect()
    }

    #[test]
    fn roots_keep_their_distance_and_their_number() {
        let roots = scatter(&plane(7), 500, Density::Even, 3).expect("an area");
        assert_eq!(roots, scatter(&plane(7), 500, Density::Even, 3).expect("an area"));
        assert_eq!(roots.len(), 500);
        // Packed as densely as can be, 500 roots would be 0.048 apart.
        let packed = 2.0 * (1.0 / (2.0 * 3.0_f64.sqrt() * 500.0)).sqrt();
        let least = nearest(&roots).into_iter().fold(f64::INFINITY, f64::min);
        assert!(0.55 * packed < least, "{least} of {packed}");
        assert!(roots.iter().all(|p| p.z == 0.0 && (0.0..=1.0).contains(&p.x)));
    }

    #[test]
    fn density_decides_how_many_stand_where() {
        let mesh = plane(10);
        let center =
            |t: &[u32; 3]| t.map(|c| mesh.positions()[c as usize].x).iter().sum::<f64>() / 3.0;
        let faces: Vec<f64> =
            mesh.triangles().iter().map(|t| if center(t) < 0.5 { 3.0 } else { 1.0 }).collect();
        let roots = scatter(&mesh, 2000, Density::Faces(&faces), 1).expect("an area");
        let left = roots.iter().filter(|p| p.x < 0.5).count() as f64;
        assert!((left / 2000.0 - 0.75).abs() < 0.02, "{left}");

        let vertices: Vec<f64> = mesh.positions().iter().map(|p| p.x).collect();
        let roots = scatter(&mesh, 2000, Density::Vertices(&vertices), 1).expect("an area");
        let left = roots.iter().filter(|p| p.x < 0.5).count() as f64;
        assert!((left / 2000.0 - 0.25).abs() < 0.02, "{left}");
        assert!(nearest(&roots).iter().all(|d| *d > 0.004));
    }

    #[test]
    fn meshes_without_room_and_broken_densities_are_refused() {
        let flat = Mesh::new(vec![DVec3::ZERO; 3], vec![[0, 1, 2]]).expect("indices fit");
        assert_eq!(scatter(&flat, 5, Density::Even, 1), Err(ScatterError::NoArea));
        let mesh = plane(1);
        assert_eq!(scatter(&mesh, 5, Density::Faces(&[0.0; 2]), 1), Err(ScatterError::NoArea));
        assert!(matches!(
            scatter(&mesh, 5, Density::Faces(&[1.0]), 1),
            Err(ScatterError::Weights { expected: 2, .. })
        ));
        assert!(matches!(
            scatter(&mesh, 5, Density::Vertices(&[1.0, -1.0, 1.0, 1.0]), 1),
            Err(ScatterError::Weight { index: 1, .. })
        ));
        assert_eq!(scatter(&mesh, 0, Density::Even, 1), Ok(vec![]));
        assert_eq!(scatter(&mesh, 1, Density::Even, 1).map(|roots| roots.len()), Ok(1));
        let huge = usize::MAX;
        assert_eq!(scatter(&mesh, huge, Density::Even, 1), Err(ScatterError::TooMany(huge)));
        // A corner nowhere: its triangle is passed over.
        let mut positions = mesh.positions().to_vec();
        positions[1] = DVec3::NAN;
        let torn = Mesh::new(positions, mesh.triangles().to_vec()).expect("indices fit");
        let roots = scatter(&torn, 50, Density::Even, 1).expect("one triangle");
        assert!(roots.len() == 50 && roots.iter().all(|p| p.is_finite()));
    }
}
