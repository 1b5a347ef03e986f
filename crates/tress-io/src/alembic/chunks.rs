//! The frame of an Ogawa archive: a tree of groups and data, checked before ogawa-rs walks it.
//!
//! From byte 16 on a file is made of chunks, addressed by their first byte. A group is a `u64`
//! count and that many `u64` addresses of children; an address with its highest bit set is one of
//! data: a `u64` size and that many bytes. Address 0 is an empty group or empty data. Data may be
//! shared; a group has one parent.

use std::collections::HashSet;

use crate::{ParseError, Problem};

/// Set in the address of data, clear in that of a group.
const DATA: u64 = 1 << 63;
/// Where the address of the root group stands.
const ROOT: usize = 8;
/// Which child of the root group holds the time samplings.
const TIME_SAMPLINGS: usize = 4;

/// Whether all chunks lie within the file and the groups are a tree.
pub(super) fn check(bytes: &[u8]) -> Result<(), ParseError> {
    let root = word(bytes, ROOT)?;
    if let Some(&samplings) = children(bytes, root)?.get(TIME_SAMPLINGS) {
        check_time_samplings(data(bytes, samplings)?, samplings)?;
    }
    let mut seen = HashSet::new();
    let mut pending = vec![root];
    while let Some(address) = pending.pop() {
        if address == 0 {
            continue;
        }
        if !seen.insert(address) {
            let problem = Problem::unexpected("a tree of groups", "a group with two parents");
            return Err(problem.at_byte(index(address)));
        }
        for child in children(bytes, address)? {
            if child & DATA == 0 {
                pending.push(child);
            } else {
                data(bytes, child)?;
            }
        }
    }
    Ok(())
}

/// The addresses in a group.
fn children(bytes: &[u8], address: u64) -> Result<Vec<u64>, ParseError> {
    if address == 0 {
        return Ok(Vec::new());
    }
    let start = index(address);
    let count = word(bytes, start)?;
    let needed = count.saturating_mul(8);
    let rest = &bytes[start + 8..];
    if (rest.len() as u64) < needed {
        return Err(Problem::Truncated { needed, left: rest.len() as u64 }.at_byte(start + 8));
    }
    let words = rest[..index(needed)].chunks_exact(8);
    Ok(words.map(|word| u64::from_le_bytes(word.try_into().unwrap_or_default())).collect())
}

/// The bytes of data.
fn data(bytes: &[u8], address: u64) -> Result<&[u8], ParseError> {
    let address = address & !DATA;
    if address == 0 {
        return Ok(&[]);
    }
    let start = index(address);
    let needed = word(bytes, start)?;
    let rest = &bytes[start + 8..];
    if (rest.len() as u64) < needed {
        return Err(Problem::Truncated { needed, left: rest.len() as u64 }.at_byte(start + 8));
    }
    Ok(&rest[..index(needed)])
}

/// Time samplings are, one after the other, a `u32` number of samples, an `f64` time per cycle, a
/// `u32` count and that many `f64` times; ogawa-rs allocates by that count.
fn check_time_samplings(mut data: &[u8], address: u64) -> Result<(), ParseError> {
    const HEAD: usize = 16;
    while !data.is_empty() {
        let count = data.get(12..HEAD).and_then(|bytes| bytes.try_into().ok());
        let times = u64::from(count.map_or(0, u32::from_le_bytes)) * 8;
        let needed = HEAD as u64 + times;
        if (data.len() as u64) < needed {
            let problem = Problem::Truncated { needed, left: data.len() as u64 };
            return Err(problem.at_byte(index(address & !DATA)));
        }
        data = &data[index(needed)..];
    }
    Ok(())
}

/// The number at `start`.
fn word(bytes: &[u8], start: usize) -> Result<u64, ParseError> {
    let rest = bytes.get(start..).unwrap_or_default();
    match rest.first_chunk() {
        Some(word) => Ok(u64::from_le_bytes(*word)),
        None => Err(Problem::Truncated { needed: 8, left: rest.len() as u64 }.at_byte(start)),
    }
}

/// An address or size as an index; what no memory can hold is behind the end of every file.
fn index(address: u64) -> usize {
    usize::try_from(address).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A header and a root group at byte 16 with these words in and behind it.
    fn archive(words: &[u64]) -> Vec<u8> {
        let mut bytes = b"Ogawa\xff\x00\x01".to_vec();
        for word in [16].iter().chain(words) {
            bytes.extend(word.to_le_bytes());
        }
        bytes
    }

    #[test]
    fn chunks_within_the_file_pass() {
        let data_at_40 = DATA | 40;
        check(&archive(&[2, data_at_40, data_at_40, 8, 0])).expect("one piece of data, shared");
        check(&archive(&[1, 0])).expect("an empty group");
    }

    #[test]
    fn sizes_beyond_the_file_are_cut_short() {
        for broken in [
            archive(&[]),
            archive(&[9, 0]),
            archive(&[u64::MAX]),
            archive(&[1, DATA | 32, 9, 0]),
            archive(&[1, DATA | 32, u64::MAX - 7]),
            archive(&[1, DATA | (u64::MAX - 4)]),
            archive(&[5, 0, 0, 0, 0, DATA | 64, 16, 0, u64::from(u32::MAX) << 32]),
            b"Ogawa\xff\x00\x01\x10".to_vec(),
        ] {
            let error = check(&broken).expect_err("a chunk outside");
            assert!(matches!(error.problem, Problem::Truncated { .. }), "{error}");
        }
    }

    #[test]
    fn groups_in_a_circle_are_refused() {
        for circle in [archive(&[1, 16]), archive(&[2, 40, 40, 1, 0])] {
            let error = check(&circle).expect_err("a group with two parents");
            assert!(matches!(error.problem, Problem::Unexpected { .. }), "{error}");
        }
    }
}
