//! How well two groupings agree, as wisps found and wisps known do.

use std::collections::BTreeMap;

/// The adjusted Rand index of two groupings of the same things (Hubert and Arabie, "Comparing
/// partitions", 1985): 1 for the same, 0 in the mean for groupings by chance.
///
/// What a group is called does not matter. Of a longer list the rest is left out.
///
/// ```
/// use tress_analysis::adjusted_rand;
///
/// assert_eq!(adjusted_rand(&[0, 0, 1, 1], &["b", "b", "a", "a"]), 1.0);
/// // Each puts two pairs together, one of them the same; by chance it would be 0.4 of one.
/// let index = adjusted_rand(&[0, 0, 1, 1, 2], &[0, 0, 1, 2, 2]);
/// assert!((index - (1.0 - 0.4) / (2.0 - 0.4)).abs() < 1e-12);
/// ```
#[must_use]
pub fn adjusted_rand<A: Ord, B: Ord>(a: &[A], b: &[B]) -> f64 {
    let pairs = |n: f64| 0.5 * n * (n - 1.0);
    let (mut both, mut of_a, mut of_b) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    for (a, b) in a.iter().zip(b) {
        *both.entry((a, b)).or_insert(0.0) += 1.0;
        *of_a.entry(a).or_insert(0.0) += 1.0;
        *of_b.entry(b).or_insert(0.0) += 1.0;
    }
    let all = pairs(a.len().min(b.len()) as f64);
    let together = both.into_values().map(pairs).sum::<f64>();
    let of_a = of_a.into_values().map(pairs).sum::<f64>();
    let of_b = of_b.into_values().map(pairs).sum::<f64>();
    let (by_chance, most) = (of_a * of_b / all, 0.5 * (of_a + of_b));
    // All together in both, or all alone.
    if 0.0 < all && by_chance < most { (together - by_chance) / (most - by_chance) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groupings_that_tell_nothing_apart_agree() {
        for same in [adjusted_rand(&[7; 5], &[1; 5]), adjusted_rand(&[1, 2, 3], &[3, 1, 2])] {
            assert!((same - 1.0).abs() < 1e-12);
        }
        assert!((adjusted_rand::<i32, i32>(&[], &[]) - 1.0).abs() < 1e-12);
        assert!(adjusted_rand(&[1, 1, 1, 1], &[1, 2, 3, 4]).abs() < 1e-12);
    }

    #[test]
    fn chance_counts_for_nothing() {
        let a: Vec<u32> = (0..1000).map(|i| i % 10).collect();
        let b: Vec<u32> = (0..1000).map(|i| i / 100).collect();
        assert!(adjusted_rand(&a, &b).abs() < 0.02);
    }
}
