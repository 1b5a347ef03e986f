//! Ways to break a file: cut it, flip its bits, write absurd numbers into it, lengthen it.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Calls `read` with some hundred cuts of a file and with `count` files each in which bytes are
/// flipped and in which numbers are replaced by huge ones.
pub(crate) fn breakages(bytes: &[u8], count: usize, mut read: impl FnMut(&[u8])) {
    let step = bytes.len() / 200 + 1;
    (0..bytes.len()).step_by(step).for_each(|end| read(&bytes[..end]));
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let place = |random: &mut Pcg64Mcg| random.random_range(0..bytes.len());
    for _ in 0..count {
        let mut broken = bytes.to_vec();
        for _ in 0..random.random_range(1..4) {
            let i = place(&mut random);
            broken[i] ^= 1 << random.random_range(0..8);
        }
        read(&broken);
    }
    for _ in 0..count {
        let mut broken = bytes.to_vec();
        let huge = [0x7f, 0xff, 0x01, 0x80][random.random_range(0..4)];
        // Numbers of binary files mostly lie at multiples of 4.
        let start = place(&mut random) & !3;
        let end = (start + [1, 2, 4, 8][random.random_range(0..4)]).min(broken.len());
        broken[start..end].fill(huge);
        read(&broken);
    }
    let mut longer = bytes.to_vec();
    longer.extend([0xff; 100]);
    read(&longer);
}
