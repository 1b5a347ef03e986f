//! The tree of groups and data that an Ogawa file is, held against the file before it is walked.

use std::collections::HashSet;

use super::ReadError;

/// Set in the address of data, clear in that of a group.
const DATA: u64 = 1 << 63;
/// Where the address of the root group stands.
const ROOT: u64 = 8;

/// Where a chunk is, and whether it is data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Address(u64);

impl Address {
    /// A group without children.
    pub(crate) const NONE: Self = Self(0);

    /// The byte that it begins at.
    pub(super) fn byte(self) -> u64 {
        self.0 & !DATA
    }

    pub(super) fn is_data(self) -> bool {
        self.0 & DATA != 0
    }
}

/// A file in which every chunk lies within the file and every group has one parent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tree<'a> {
    bytes: &'a [u8],
    root: Address,
}

impl<'a> Tree<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, ReadError> {
        let mut tree = Self { bytes, root: Address::NONE };
        tree.root = Address(tree.word(ROOT)?);
        let mut seen = HashSet::new();
        let mut pending = vec![tree.root];
        while let Some(address) = pending.pop() {
            if address == Address::NONE {
                continue;
            }
            if !seen.insert(address.0) {
                let what = "a group with two parents";
                return Err(ReadError::Broken { at: address.0, what });
            }
            for child in tree.children(address)? {
                if child.is_data() {
                    tree.data(child)?;
                } else {
                    pending.push(child);
                }
            }
        }
        Ok(tree)
    }

    pub(super) fn root(&self) -> Address {
        self.root
    }

    /// What is in a group; nothing in data.
    pub(super) fn children(&self, group: Address) -> Result<Vec<Address>, ReadError> {
        if group == Address::NONE || group.is_data() {
            return Ok(Vec::new());
        }
        let size = self.word(group.0)?.saturating_mul(8);
        let words = self.behind(group.0, size)?.as_chunks().0;
        Ok(words.iter().map(|word| Address(u64::from_le_bytes(*word))).collect())
    }

    /// The bytes of data; none of a group.
    pub(super) fn data(&self, data: Address) -> Result<&'a [u8], ReadError> {
        match data.byte() {
            0 => Ok(&[]),
            _ if !data.is_data() => Ok(&[]),
            start => self.behind(start, self.word(start)?),
        }
    }

    /// The bytes behind the size or count at `start`.
    fn behind(&self, start: u64, needed: u64) -> Result<&'a [u8], ReadError> {
        let at = start.saturating_add(8);
        let rest = self.from(at);
        let size = usize::try_from(needed).unwrap_or(usize::MAX);
        let left = rest.len() as u64;
        rest.get(..size).ok_or(ReadError::Truncated { at, needed, left })
    }

    fn word(&self, at: u64) -> Result<u64, ReadError> {
        let rest = self.from(at);
        let left = rest.len() as u64;
        let word = rest.first_chunk().ok_or(ReadError::Truncated { at, needed: 8, left })?;
        Ok(u64::from_le_bytes(*word))
    }

    fn from(&self, at: u64) -> &'a [u8] {
        usize::try_from(at).ok().and_then(|at| self.bytes.get(at..)).unwrap_or_default()
    }
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
        Tree::new(&archive(&[2, data_at_40, data_at_40, 8, 0])).expect("one piece of data, shared");
        Tree::new(&archive(&[1, 0])).expect("an empty group");
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
            b"Ogawa\xff\x00\x01\x10".to_vec(),
        ] {
            let error = Tree::new(&broken).expect_err("a chunk outside");
            assert!(matches!(error, ReadError::Truncated { .. }), "{error}");
        }
    }

    #[test]
    fn groups_in_a_circle_are_refused() {
        for circle in [archive(&[1, 16]), archive(&[2, 40, 40, 1, 0])] {
            let error = Tree::new(&circle).expect_err("a group with two parents");
            assert!(matches!(error, ReadError::Broken { .. }), "{error}");
        }
    }
}
