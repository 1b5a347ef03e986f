//! A repair of what ogawa-rs reads of an archive.

use ogawa_rs::{Archive, ArchiveReader};

/// Which child of the root group holds the texts that objects and properties share.
const SHARED_TEXTS: usize = 5;

/// Puts back the last of the texts that headers refer to, which ogawa-rs 0.4 leaves empty.
///
/// The texts are pairs as in `schema=AbcGeom_Curve_v2;geoScope=vtx`, each with its length in a
/// byte before it. In an archive with few kinds of objects the last may well be what says that an
/// object holds curves.
pub(super) fn restore_last(archive: &mut Archive, file: &mut dyn ArchiveReader) {
    let Ok(data) = archive.root_group.load_data(file, SHARED_TEXTS) else { return };
    let mut bytes = vec![0; usize::try_from(data.size.min(file.size())).unwrap_or_default()];
    if data.read(0, file, &mut bytes).is_err() {
        return;
    }
    let Some(last) = archive.indexed_meta_data.last_mut() else { return };
    for pair in last_text(&bytes).split(';') {
        if let Some((key, value)) = pair.split_once('=') {
            last.tokens.insert(key.to_owned(), value.to_owned());
        }
    }
}

/// The last text, or nothing if lengths and bytes do not match.
fn last_text(mut bytes: &[u8]) -> &str {
    let mut last: &[u8] = &[];
    while let [length, rest @ ..] = bytes {
        let Some((text, behind)) = rest.split_at_checked(usize::from(*length)) else { return "" };
        (last, bytes) = (text, behind);
    }
    std::str::from_utf8(last).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::last_text;

    #[test]
    fn the_last_text_is_found_by_lengths() {
        assert_eq!(last_text(b"\x03a=b\x05cd=ef"), "cd=ef");
        assert_eq!(last_text(b"\x03a=b\x00"), "");
        assert_eq!(last_text(b"\x03a=b\x09cd=ef"), "");
        assert_eq!(last_text(b""), "");
    }
}
