//! Wisps found in grooms of which it is known what is a wisp.

use std::collections::BTreeMap;

use tress_analysis::{Analysis, Wisps};
use tress_fixtures::{PatchOptions, coily_patch};
use tress_geometry::{Column, Groom, names};

/// The adjusted Rand index of two groupings (Hubert and Arabie, "Comparing partitions", 1985): 1 for
/// the same, 0 in the mean for groupings by chance.
fn agreement(a: &[i64], b: &[u32]) -> f64 {
    let pairs = |counts: Vec<f64>| counts.into_iter().map(|n| 0.5 * n * (n - 1.0)).sum::<f64>();
    fn count<K: Ord>(keys: impl Iterator<Item = K>) -> Vec<f64> {
        let mut counts = BTreeMap::new();
        keys.for_each(|key| *counts.entry(key).or_insert(0.0) += 1.0);
        counts.into_values().collect()
    }
    let both = pairs(count(a.iter().zip(b)));
    let (of_a, of_b) = (pairs(count(a.iter())), pairs(count(b.iter())));
    let by_chance = of_a * of_b / pairs(vec![a.len() as f64]);
    (both - by_chance) / (0.5 * (of_a + of_b) - by_chance)
}

/// Wisps found, and how well they agree with those that the strands were made in.
fn found(groom: &Groom) -> (Wisps, f64) {
    let wisps = Wisps::of(groom, &Analysis::of(groom));
    let Some(Column::Int(known)) = groom.strand_attributes().get(names::GROUP) else {
        panic!("the groom says which strand is of which wisp");
    };
    let agreement = agreement(known, &wisps.wisp);
    (wisps, agreement)
}

#[test]
fn wisps_of_a_fixture_are_found() {
    for seed in [1, 3] {
        let options = PatchOptions { wisps: 4, strands_per_wisp: 5, ..PatchOptions::default() };
        let (wisps, agreement) = found(&coily_patch(&options, seed));
        let big = wisps.sizes.iter().filter(|&&size| 3 <= size).count();
        assert!(big == 4 && 0.85 < agreement, "seed {seed}: {:?} {agreement}", wisps.sizes);
    }
    let options = PatchOptions { wisps: 12, ..PatchOptions::default() };
    let (wisps, agreement) = found(&coily_patch(&options, 7));
    assert!(0.8 < agreement, "{:?} {agreement}", wisps.sizes);
}
