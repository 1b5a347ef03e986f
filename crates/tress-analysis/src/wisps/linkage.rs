//! Clusters by average linkage: the two that are closest in the mean become one, until none are
//! close enough.
//!
//! The affinity of two clusters is the mean over the pairs of their members that are known; chance
//! links between neighbouring wisps, of which there are few, do not join them as they would if one
//! link were enough.

use std::collections::{BTreeMap, BinaryHeap};

/// A sum of affinities and how many they are.
#[derive(Clone, Copy, Debug, Default)]
struct Link {
    sum: f64,
    pairs: f64,
}

impl Link {
    fn mean(self) -> f64 {
        self.sum / self.pairs
    }
}

/// The cluster of each of `n` items, named by one of its members, from the affinities (not
/// negative) of pairs of them; clusters are joined while their affinity is at least `least`.
pub(super) fn average_linkage(n: usize, pairs: &[([usize; 2], f64)], least: f64) -> Vec<usize> {
    let mut links: Vec<BTreeMap<usize, Link>> = vec![BTreeMap::new(); n];
    let mut closest = BinaryHeap::new();
    for &([a, b], affinity) in pairs {
        let link = Link { sum: affinity, pairs: 1.0 };
        links[a].insert(b, link);
        links[b].insert(a, link);
        closest.extend((least <= affinity).then(|| key(affinity, a, b)));
    }
    let mut cluster: Vec<usize> = (0..n).collect();
    while let Some((bits, a, b)) = closest.pop() {
        // Pairs that have been joined, or whose mean has moved since, are passed over.
        if links[a].get(&b).is_none_or(|link| link.mean().to_bits() != bits) {
            continue;
        }
        let (kept, gone) = if links[a].len() < links[b].len() { (b, a) } else { (a, b) };
        cluster[gone] = kept;
        for (other, more) in std::mem::take(&mut links[gone]) {
            links[other].remove(&gone);
            if other == kept {
                continue;
            }
            let link = links[kept].entry(other).or_default();
            (link.sum, link.pairs) = (link.sum + more.sum, link.pairs + more.pairs);
            let link = *link;
            links[other].insert(kept, link);
            closest.extend((least <= link.mean()).then(|| key(link.mean(), kept, other)));
        }
    }
    let last = |mut i: usize| {
        while cluster[i] != i {
            i = cluster[i];
        }
        i
    };
    (0..n).map(last).collect()
}

/// What pairs are ordered by: affinities that are not negative are ordered as their bits are.
fn key(affinity: f64, a: usize, b: usize) -> (u64, usize, usize) {
    (affinity.to_bits(), a.max(b), a.min(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_link_does_not_join_what_is_else_apart() {
        // Two triangles of which one corner each are close, and a lone item.
        let mut pairs = vec![];
        for [a, b] in [[0, 1], [0, 2], [1, 2], [3, 4], [3, 5], [4, 5]] {
            pairs.push(([a, b], 0.8));
        }
        for a in 0..3 {
            for b in 3..6 {
                pairs.push(([a, b], if (a, b) == (2, 3) { 0.7 } else { 0.05 }));
            }
        }
        let found = average_linkage(7, &pairs, 0.3);
        assert!(found[..3].iter().all(|c| *c == found[0]));
        assert!(found[3..6].iter().all(|c| *c == found[3]));
        assert!(found[0] != found[3] && found[6] == 6);
        // Down to the mean of their links they are one.
        let all = average_linkage(6, &pairs, 0.1);
        assert!(all.iter().all(|c| *c == all[0]));
        assert_eq!(average_linkage(0, &[], 0.1), Vec::<usize>::new());
    }
}
