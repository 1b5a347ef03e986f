//! Texts that headers share: what objects and properties say of themselves, as
//! `schema=AbcGeom_Curve_v2;geoScope=vtx`.
//!
//! Each header refers to its text by a byte; 0 is the empty text, and [`INLINE`] says that the text
//! stands in the header itself, because it is long or comes after the 254th.

use std::collections::HashMap;

/// The byte that says that a text follows.
pub(crate) const INLINE: u8 = 0xff;

/// The texts of an archive.
#[derive(Debug, Default)]
pub(crate) struct Texts {
    indices: HashMap<String, u8>,
    /// Every text behind its length in a byte.
    bytes: Vec<u8>,
}

impl Texts {
    /// The byte that stands for a text.
    pub(crate) fn index(&mut self, text: &str) -> u8 {
        if text.is_empty() {
            return 0;
        }
        if let Some(&index) = self.indices.get(text) {
            return index;
        }
        let next = u8::try_from(self.indices.len() + 1).unwrap_or(INLINE);
        let Ok(length) = u8::try_from(text.len()) else { return INLINE };
        if next != INLINE {
            self.indices.insert(text.to_owned(), next);
            self.bytes.push(length);
            self.bytes.extend(text.as_bytes());
        }
        next
    }

    /// All of them, as the file holds them.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::{INLINE, Texts};

    #[test]
    fn a_text_is_stored_once_and_the_255th_not_at_all() {
        let mut texts = Texts::default();
        assert_eq!((texts.index(""), texts.index("a=b"), texts.index("a=b")), (0, 1, 1));
        assert_eq!(texts.index(&"long".repeat(64)), INLINE);
        assert_eq!(texts.bytes(), b"\x03a=b");
        for i in 2..=254_u8 {
            assert_eq!(texts.index(&i.to_string()), i);
        }
        let before = texts.bytes().len();
        assert_eq!((texts.index("one more"), texts.bytes().len()), (INLINE, before));
        assert_eq!(texts.index("254"), 254);
    }
}
