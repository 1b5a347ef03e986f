//! What objects and properties say of themselves: pairs, as in `key=value;key=value`.

use std::sync::Arc;

use super::ReadError;

/// Pairs of texts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MetaData(Arc<str>);

impl MetaData {
    pub(super) fn new(text: &[u8]) -> Self {
        Self(String::from_utf8_lossy(text).into())
    }

    /// The value of a key.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&str> {
        let mut pairs = self.0.split(';').filter_map(|pair| pair.split_once('='));
        pairs.find(|(own, _)| *own == key).map(|(_, value)| value)
    }

    /// The schema of an object: `AbcGeom_Xform_v3`, `AbcGeom_Curve_v2` and others.
    #[must_use]
    pub fn schema(&self) -> Option<&str> {
        self.get("schema")
    }
}

/// The texts that headers share, each behind its length in a byte; the first is empty.
pub(super) fn shared(mut data: &[u8], at: u64) -> Result<Vec<MetaData>, ReadError> {
    let mut texts = vec![MetaData::default()];
    while let [length, rest @ ..] = data {
        let Some((text, behind)) = rest.split_at_checked(usize::from(*length)) else {
            return Err(ReadError::Broken { at, what: "the texts that headers share" });
        };
        texts.push(MetaData::new(text));
        data = behind;
    }
    Ok(texts)
}
