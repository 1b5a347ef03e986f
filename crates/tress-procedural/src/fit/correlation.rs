//! How strands go together, measured as a determinantal point process does [IPG 13 - 18].
//!
//! Of a patch of neighbouring strands a kernel `K_ab = exp(-d_ab / sigma)` is made, `d` the square
//! of the difference of lengths (for scale) or the mean distance of points over that of roots (for
//! clump). `log det K` is large when the strands of a patch are unlike and small when they are
//! alike. Averaged over patches it falls or rises steadily with the one parameter it stands for, so
//! the parameter is where target and model agree: a root, found by bisection with the model's
//! random numbers kept, where \[IPG\] takes 1,000 steps of Adam on the square of the difference.
//!
//! `sigma` is the median of `d` over the target's pairs (the paper's 0.1 presumes a head of about
//! one unit), and a hundredth is added to the diagonal, below which equal strands are noise.

use glam::DVec3;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::EvenStrands;

/// Added to the kernel's diagonal.
const RIDGE: f64 = 1e-2;

/// What a patch is compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Likeness {
    /// Lengths of strands, for scale.
    Length,
    /// Distances of strands over those of their roots, for clump.
    Distance,
}

/// Patches of neighbouring strands and the target's mean `log det`.
#[derive(Clone, Debug)]
pub(crate) struct Patches {
    patches: Vec<Vec<usize>>,
    likeness: Likeness,
    sigma: f64,
    target: f64,
}

impl Patches {
    /// `patches` name strands of `targets`.
    pub(crate) fn new(targets: &EvenStrands, patches: Vec<Vec<usize>>, likeness: Likeness) -> Self {
        let mut all: Vec<f64> = patches
            .par_iter()
            .flat_map_iter(|patch| distances(targets, patch, likeness).as_slice().to_vec())
            .filter(|&d| d > 0.0)
            .collect();
        all.sort_unstable_by(f64::total_cmp);
        let sigma = all.get(all.len() / 2).copied().unwrap_or(1.0);
        let mut patches = Self { patches, likeness, sigma, target: 0.0 };
        patches.target = patches.mean(targets);
        patches
    }

    /// Mean `log det` over the patches, a strand.
    fn mean(&self, strands: &EvenStrands) -> f64 {
        let each: Vec<f64> = self
            .patches
            .par_iter()
            .map(|patch| {
                let kernel =
                    distances(strands, patch, self.likeness).map(|d| (-d / self.sigma).exp());
                let n = patch.len();
                log_determinant(kernel + DMatrix::identity(n, n) * RIDGE) / n as f64
            })
            .collect();
        each.iter().sum::<f64>() / each.len().max(1) as f64
    }

    /// How much more unlike the strands are than the target's.
    pub(crate) fn excess(&self, strands: &EvenStrands) -> f64 {
        self.mean(strands) - self.target
    }
}

/// `d` of every pair of a patch.
fn distances(strands: &EvenStrands, patch: &[usize], likeness: Likeness) -> DMatrix<f64> {
    let length = |i: usize| -> f64 {
        strands.strand(i).windows(2).map(|ends| ends[0].distance(ends[1])).sum()
    };
    let lengths: Vec<f64> = patch.iter().map(|&i| length(i)).collect();
    let n = patch.len();
    let mut out = DMatrix::zeros(n, n);
    for a in 0..n {
        for b in 0..a {
            let d = match likeness {
                Likeness::Length => (lengths[a] - lengths[b]).powi(2),
                Likeness::Distance => {
                    relative_distance(strands.strand(patch[a]), strands.strand(patch[b]))
                }
            };
            out[(a, b)] = d;
            out[(b, a)] = d;
        }
    }
    out
}

/// [IPG 17]: the mean distance of points over that of the roots.
fn relative_distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    let roots = a[0].distance(b[0]);
    let sum: f64 = a.iter().zip(b).map(|(a, b)| a.distance(*b)).sum();
    if roots > 0.0 { sum / (roots * a.len() as f64) } else { 0.0 }
}

/// The logarithm of the determinant's absolute value.
fn log_determinant(matrix: DMatrix<f64>) -> f64 {
    // Relative distances are no metric: the kernel may have small negative eigenvalues, and LU
    // copes with them where Cholesky would not.
    let lu = matrix.lu();
    lu.u().diagonal().iter().map(|pivot| pivot.abs().max(1e-300).ln()).sum()
}

/// Where a function that crosses zero at most once does, by bisection within `least..=greatest` in
/// the square root of the parameter; the end nearest to zero if it does not.
///
/// `halvings` evaluations after the two at the ends.
pub(crate) fn crossing<E>(
    least: f64,
    greatest: f64,
    halvings: usize,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let (mut a, mut b) = (least.sqrt(), greatest.sqrt());
    let (at_a, at_b) = (function(least)?, function(greatest)?);
    if at_a * at_b > 0.0 {
        return Ok(if at_a.abs() < at_b.abs() { least } else { greatest });
    }
    for _ in 0..halvings {
        let middle = 0.5 * (a + b);
        if function(middle * middle)? * at_a > 0.0 {
            a = middle;
        } else {
            b = middle;
        }
    }
    Ok((0.5 * (a + b)).powi(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bound, Chain, Clump, Operator, Scale, draw};

    /// 60 straight strands about one operator guide.
    fn strands(operator: Operator, seed: u64) -> EvenStrands {
        let line = |i: u32| {
            let root = DVec3::new(0.1 * f64::from(i % 8), 0.0, 0.1 * f64::from(i / 8));
            (0..20).map(move |j| root + DVec3::Y * f64::from(j))
        };
        let mut strands = EvenStrands::new(20, (0..60).flat_map(line).collect()).expect("strands");
        let guides = strands.select(&[27]);
        let operators = vec![operator];
        let numbers = draw(&operators, 60, 1, seed);
        let bound = Bound { guides: &guides, operator_of: &[0; 60], numbers: &numbers };
        let chain = Chain { operators, ..Chain::default() };
        chain.apply(&mut strands, &bound, 0).expect("a sound chain");
        strands
    }

    fn check_steady(likeness: Likeness, truth: f64, operator: impl Fn(f64) -> Operator, more: f64) {
        let patches = vec![(0..30).collect(), (30..60).collect()];
        let patches = Patches::new(&strands(operator(truth), 1), patches, likeness);
        let excess = |value: f64| patches.excess(&strands(operator(value), 2)) * more;
        let values: Vec<f64> = [0.3, 0.6, 1.0, 1.6, 2.5].map(|by| excess(by * truth)).to_vec();
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{values:?}");
        let found = crossing(0.0, 4.0 * truth, 12, |value| Ok::<f64, ()>(excess(value)));
        let found = found.expect("nothing fails");
        assert!((found / truth - 1.0).abs() < 0.2, "{found} against {truth}");
    }

    #[test]
    fn lengths_grow_more_unlike_with_scale() {
        check_steady(Likeness::Length, 0.2, |random| Operator::Scale(Scale { random }), 1.0);
    }

    #[test]
    fn strands_grow_more_alike_with_clump() {
        check_steady(Likeness::Distance, 1.0, |profile| Operator::Clump(Clump { profile }), -1.0);
    }
}
