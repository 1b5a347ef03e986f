//! Alembic files: headers made by hand, and real archives where they are at hand.

mod breakages;

use std::path::{Path, PathBuf};

use tress_geometry::Groom;
use tress_io::{Model, alembic};

fn read_bytes(bytes: &[u8]) -> Result<Groom, String> {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("hair.abc");
    std::fs::write(&path, bytes).expect("a file");
    alembic::read(&path).map_err(|error| error.to_string())
}

/// A header and words behind it; the root group is at byte 16.
fn archive(words: &[u64]) -> Vec<u8> {
    let mut bytes = b"Ogawa\xff\x00\x01".to_vec();
    [16].iter().chain(words).for_each(|word| bytes.extend(word.to_le_bytes()));
    bytes
}

/// Where the real grooms lie, if they are there.
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn grooms() -> Option<PathBuf> {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/grooms"));
    if !path.is_dir() {
        eprintln!("skipped: there are no real grooms at {}", path.display());
        return None;
    }
    Some(path.to_owned())
}

fn read(path: &Path) -> Groom {
    match tress_io::read(path).expect("a real groom") {
        Model::Polylines(groom) => groom,
        Model::Helices(_) => panic!("polylines"),
    }
}

#[test]
fn what_is_no_archive_is_said() {
    for (bytes, expected) in [
        (&b"\x89HDF\r\n\x1a\n"[..], "HDF5"),
        (b"", "begins with Ogawa"),
        (b"Ogaw", "begins with Ogawa"),
        (b"Ogawa", "cut short"),
        (b"Ogawa\x00\x00\x01", "not written to its end"),
        (b"Ogawa\xff\x00\x01", "cut short"),
    ] {
        let message = read_bytes(bytes).expect_err(expected);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn archives_that_point_outside_or_at_themselves_are_errors() {
    let data = 1 << 63;
    for words in [
        vec![6, data, data, data, data, data, data],
        vec![6, data | 72, data | 72, 0, data | 72, data | 72, data | 72, 4, 0],
        vec![6, data | 72, data | 72, 16, data | 72, data | 72, data | 72, 4, 0],
        vec![6, data | 72, data | 72, 0, data | 72, data | 80, data | 72, 4, 16, 0, u64::MAX],
        vec![u64::MAX],
        vec![1 << 60, 0],
        vec![],
    ] {
        let message = read_bytes(&archive(&words)).expect_err("a broken archive");
        assert!(!message.contains('\n'), "{message}");
    }
}

#[cfg(feature = "usd")]
#[test]
fn blender_writes_the_same_hair_in_alembic_and_usd() {
    let Some(grooms) = grooms() else { return };
    for name in ["bl_coily_500", "bl_coily_10k"] {
        let alembic = read(&grooms.join(format!("blender/{name}.abc")));
        let usd = read(&grooms.join(format!("blender/{name}.usdc")));
        assert_eq!((alembic.up, usd.up), (None, Some(tress_geometry::UpAxis::Z)));
        let turned = usd.with_up(tress_geometry::UpAxis::Y);
        assert_eq!(alembic.strands().offsets(), turned.strands().offsets());
        let points = alembic.strands().points().iter().zip(turned.strands().points());
        let worst = points.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        // Both files hold 32-bit numbers below 1.
        assert!(worst <= f64::from(f32::EPSILON), "{name}: {worst}");
        assert_eq!(alembic.point_attributes().get("width"), turned.point_attributes().get("width"));
    }
}

#[test]
fn hairutil_writes_the_same_hair_in_alembic_and_data() {
    let Some(grooms) = grooms() else { return };
    let alembic = read(&grooms.join("hairutil/Bangs_100.abc"));
    let data = read(&grooms.join("hairutil/Bangs_100.data"));
    assert_eq!(alembic.strands().len(), 100);
    assert_eq!(alembic.strands(), data.strands());
}

#[test]
fn broken_archives_are_errors_or_other_grooms_but_never_a_panic() {
    let Some(grooms) = grooms() else { return };
    let real = std::fs::read(grooms.join("hairutil/Bangs_100.abc")).expect("a real groom");
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("hair.abc");
    // Most of the file is points, in which every bit is as good as another; headers are behind.
    let headers = real.len() - real.len().min(2000);
    breakages::breakages(&real[headers..], 400, |end| {
        let mut broken = real[..headers].to_vec();
        broken.extend(end);
        std::fs::write(&path, &broken).expect("a file");
        if let Err(error) = alembic::read(&path) {
            let message = error.to_string();
            assert!(!message.is_empty() && !message.contains('\n'), "{message}");
        }
    });
}
