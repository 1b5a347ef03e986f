//! One stream of random numbers a strand.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// The random numbers of strand `strand` under `seed`.
///
/// A strand's numbers do not depend on which other strands are worked on, in what order or on how
/// many threads.
///
/// ```
/// use rand::RngExt;
/// use tress_edit::strand_rng;
///
/// assert_eq!(strand_rng(1, 7).random::<u64>(), strand_rng(1, 7).random::<u64>());
/// assert_ne!(strand_rng(1, 7).random::<u64>(), strand_rng(1, 8).random::<u64>());
/// ```
#[must_use]
pub fn strand_rng(seed: u64, strand: usize) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(scramble(scramble(seed) ^ strand as u64))
}

/// The finalizer of `SplitMix64` (Steele et al., "Fast splittable pseudorandom number generators",
/// 2014): neighbouring numbers become unlike ones.
fn scramble(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scrambled_numbers_are_those_of_the_published_generator() {
        // What SplitMix64 gives first and second from the state 0.
        assert_eq!(scramble(0), 0xe220_a839_7b1d_cdaf);
        assert_eq!(scramble(0x9e37_79b9_7f4a_7c15), 0x6e78_9e6a_a1b9_65f4);
    }
}
