//! One stream of random numbers a hair, so that a result depends on the seed and not on threads.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// The random numbers of hair `hair` under `seed`.
pub(crate) fn hair_rng(seed: u64, hair: usize) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(scramble(scramble(seed) ^ hair as u64))
}

/// The finalizer of `SplitMix64` (Steele et al., "Fast splittable pseudorandom number generators",
/// 2014): neighbouring numbers become unlike ones.
fn scramble(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
