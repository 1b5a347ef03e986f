//! `MurmurHash3` (A. Appleby, 2011; public domain), the x64 variant of 128 bits, seed 0: the key
//! that stands before every sample of an Alembic file.

/// A digest.
pub(crate) type Digest = [u8; 16];

const C1: u64 = 0x87c3_7b91_1142_53d5;
const C2: u64 = 0x4cf5_ad43_2745_937f;

/// The digest of some bytes.
pub(crate) fn digest(bytes: &[u8]) -> Digest {
    let (mut h1, mut h2) = (0_u64, 0_u64);
    let (blocks, tail) = bytes.as_chunks::<16>();
    for block in blocks {
        let [k1, k2] = words(block);
        h1 ^= scramble1(k1);
        h1 = h1.rotate_left(27).wrapping_add(h2).wrapping_mul(5).wrapping_add(0x52dc_e729);
        h2 ^= scramble2(k2);
        h2 = h2.rotate_left(31).wrapping_add(h1).wrapping_mul(5).wrapping_add(0x3849_5ab5);
    }
    // Bytes that are not there scramble to nothing.
    let mut last = [0; 16];
    last[..tail.len()].copy_from_slice(tail);
    let [k1, k2] = words(&last);
    h1 ^= scramble1(k1);
    h2 ^= scramble2(k2);

    h1 ^= bytes.len() as u64;
    h2 ^= bytes.len() as u64;
    h1 = h1.wrapping_add(h2);
    h2 = h2.wrapping_add(h1);
    h1 = avalanche(h1);
    h2 = avalanche(h2);
    h1 = h1.wrapping_add(h2);
    h2 = h2.wrapping_add(h1);
    let mut digest = [0; 16];
    digest[..8].copy_from_slice(&h1.to_le_bytes());
    digest[8..].copy_from_slice(&h2.to_le_bytes());
    digest
}

fn words(block: &[u8; 16]) -> [u64; 2] {
    let (words, _) = block.as_chunks::<8>();
    [u64::from_le_bytes(words[0]), u64::from_le_bytes(words[1])]
}

fn scramble1(k: u64) -> u64 {
    k.wrapping_mul(C1).rotate_left(31).wrapping_mul(C2)
}

fn scramble2(k: u64) -> u64 {
    k.wrapping_mul(C2).rotate_left(33).wrapping_mul(C1)
}

fn avalanche(mut k: u64) -> u64 {
    k ^= k >> 33;
    k = k.wrapping_mul(0xff51_afd7_ed55_8ccd);
    k ^= k >> 33;
    k = k.wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    k ^ k >> 33
}

#[cfg(test)]
mod tests {
    use super::digest;

    /// Digests as the C++ library wrote them before these samples.
    #[test]
    fn digests_are_those_of_the_reference_library() {
        for (bytes, expected) in [
            (&b"\x01"[..], 0x16fe_7483_905c_ce7a_8567_0e43_e467_8877_u128),
            (b"tress 1\0", 0x32d2_ed69_8f33_c8d4_5e51_9dcd_813e_f443),
            (b"abc\0defg\0", 0xf775_30f7_095a_8214_d6bf_4edc_ba31_b9c4),
            (b"\x05\0\0\0\x07\0\0\0", 0x63bf_8449_9f99_bcc6_0e37_fd22_8740_0aec),
        ] {
            assert_eq!(digest(bytes), expected.to_be_bytes(), "{bytes:?}");
        }
    }
}
