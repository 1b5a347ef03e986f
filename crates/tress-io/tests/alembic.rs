//! Alembic files: headers made by hand, and real archives where they are at hand.

mod any_groom;
mod breakages;

use std::io::Cursor;
use std::path::{Path, PathBuf};

use glam::{DMat4, DVec3};
use proptest::prelude::*;
use tress_alembic::{Archive, CurvesSample, Kind, Numbers, Parameter, Scope, Values};
use tress_geometry::{Column, Groom, Strands, UpAxis};
use tress_io::{
    Animation, Frames, Model, ReadError, WriteError, WriteOptions, alembic, write_animation,
};

use any_groom::{any_groom, without_given_width};

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
        assert_eq!((alembic.up, usd.up), (None, Some(UpAxis::Z)));
        let turned = usd.with_up(UpAxis::Y);
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn what_is_written_is_read_back_with_y_up(groom in any_groom()) {
        let mut bytes = Cursor::new(Vec::new());
        alembic::write(&groom, &mut bytes).expect("memory takes all");
        let read = read_bytes(bytes.get_ref()).expect("our own archive");
        prop_assert_eq!(without_given_width(read, &groom), groom.with_up(UpAxis::Y));
    }
}

fn line(counts: &[usize], x: f64) -> Groom {
    let n = counts.iter().sum::<usize>();
    let points = (0..n).map(|i| DVec3::new(x, i as f64, 0.0)).collect();
    let strands = Strands::from_counts(counts.iter().copied(), points).expect("their own sum");
    let mut groom = Groom::new(strands);
    let widths = Column::scalar(vec![0.5; counts.len()]);
    groom.insert_strand_attribute("width", widths).expect("a row a strand");
    groom
}

/// Writes an animation and gives the path in its folder.
fn animation(
    name: &str,
    frames: Frames,
    grooms: &[Groom],
) -> Result<(tempfile::TempDir, PathBuf), WriteError> {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join(name);
    let grooms = grooms.iter().map(|groom| Ok::<_, WriteError>(groom.clone()));
    write_animation(&path, frames, &WriteOptions::default(), grooms)?;
    Ok((dir, path))
}

#[test]
fn frames_are_read_one_by_one_whatever_changes() {
    // Still at first, then moving, then other strands, then still.
    let grooms: Vec<Groom> = [
        (&[2, 3][..], 0.0),
        (&[2, 3], 0.0),
        (&[2, 3], 1.0),
        (&[2, 3], 2.0),
        (&[1, 1, 3], 2.0),
        (&[], 2.0),
        (&[], 2.0),
    ]
    .map(|(counts, x)| line(counts, x))
    .to_vec();
    for frames in [Frames::default(), Frames { start: -3.0, rate: 30.0 }] {
        let (_dir, path) =
            animation("\u{e9}t\u{e9} \u{9aea}.abc", frames, &grooms).expect("a file");
        let animation = Animation::open(&path).expect("our own archive");
        assert_eq!((animation.len(), animation.frames()), (grooms.len(), frames));
        for (i, groom) in grooms.iter().enumerate() {
            assert_eq!(animation.read(i).expect("a frame").strands(), groom.strands(), "frame {i}");
        }
        assert_eq!(&alembic::read(&path).expect("the first frame"), &grooms[0]);
    }
}

#[test]
fn frames_that_do_not_go_together_leave_no_file() {
    let mut other = line(&[2, 3], 0.0);
    other.insert_strand_attribute("new", Column::Int(vec![1, 2])).expect("two rows");
    for (name, grooms, expected) in [
        ("a.abc", vec![], "no frame"),
        ("a.abc", vec![line(&[2, 3], 0.0), other.clone()], "\"new\""),
        ("a.usdc", vec![line(&[2, 3], 0.0), other.clone()], "primvars:new"),
        ("a.usdc", vec![other.clone(), line(&[2, 3], 0.0)], "primvars:new"),
        ("a.obj", vec![line(&[2, 3], 0.0)], "holds one groom"),
    ] {
        let message = animation(name, Frames::default(), &grooms).expect_err(expected).to_string();
        assert!(message.contains(expected), "{message}");
    }
    // The caller's own error comes back as it is.
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("a.abc");
    let grooms = [Ok(line(&[2], 0.0)), Err(Mine::Stop)];
    let stopped = write_animation(&path, Frames::default(), &WriteOptions::default(), grooms);
    assert!(matches!(stopped, Err(Mine::Stop)));
}

#[derive(Debug)]
enum Mine {
    Stop,
    Write,
}

impl From<WriteError> for Mine {
    fn from(_: WriteError) -> Self {
        Self::Write
    }
}

#[test]
fn a_file_of_one_groom_is_one_frame() {
    let dir = tempfile::tempdir().expect("a folder");
    for name in ["a.obj", "a.abc"] {
        let path = dir.path().join(name);
        tress_io::write(&path, &line(&[2, 3], 1.0), &WriteOptions::default()).expect("a file");
        let animation = Animation::open(&path).expect("a groom");
        assert_eq!((animation.len(), animation.frames()), (1, Frames::default()));
        assert_eq!(animation.read(4).expect("a frame").strands(), line(&[2, 3], 1.0).strands());
    }
    let missing = Animation::open(dir.path().join("b.abc")).expect_err("no file");
    assert!(matches!(missing, ReadError::Open { .. }), "{missing}");
}

#[test]
fn parameters_of_every_type_and_scope_become_columns() {
    let mut archive = Archive::new(Cursor::new(Vec::new()), "a test").expect("memory");
    let time = archive.add_time(0.0, 1.0);
    let head = archive.add_transform(archive.top(), "head", None).expect("a new name");
    let hair = archive.add_curves(head, "hair", Kind::Linear, time).expect("a new name");
    let points = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let parameters = [
        ("guide", Scope::Constant, Values::scalars(Numbers::I8(&[1]))),
        ("groom_group_id", Scope::Uniform, Values::scalars(Numbers::I16(&[-3, 4]))),
        ("long", Scope::Uniform, Values::scalars(Numbers::I64(&[1 << 40, 2]))),
        ("exact", Scope::Vertex, Values::scalars(Numbers::F64(&[0.1, 0.2, 0.3]))),
        ("name", Scope::Constant, Values::scalars(Numbers::Text(&["fringe"]))),
        ("near", Scope::Uniform, Values::rows(Numbers::I32(&[1, 2, 3, 4, 5, 6]), 3)),
    ]
    .map(|(name, scope, values)| Parameter::new(name, scope, values));
    let sample = CurvesSample {
        points: &points,
        counts: &[2, 1],
        parameters: &parameters,
        ..CurvesSample::default()
    };
    archive.write_curves(hair, &sample).expect("all rows match");
    let bytes = archive.finish().expect("memory").into_inner();
    let groom = read_bytes(&bytes).expect("an archive");
    let of_strands = |name: &str| groom.strand_attributes().get(name).cloned();
    assert_eq!(of_strands("guide"), Some(Column::Int(vec![1, 1])));
    assert_eq!(of_strands("group"), Some(Column::Int(vec![-3, 4])));
    assert_eq!(of_strands("long"), Some(Column::Int(vec![1 << 40, 2])));
    let near = Column::Float { components: 3, values: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0] };
    assert_eq!(of_strands("near"), Some(near));
    assert_eq!(of_strands("name"), None);
    let exact = Column::scalar(vec![0.1, 0.2, 0.3]);
    assert_eq!(groom.point_attributes().get("exact"), Some(&exact));
}

#[test]
fn curves_of_several_objects_stand_where_their_transforms_put_them() {
    let mut archive = Archive::new(Cursor::new(Vec::new()), "a test").expect("memory");
    let time = archive.add_time(0.0, 1.0);
    let mut moved = [0.0; 16];
    for (i, number) in [(0, 2.0), (5, 2.0), (10, 2.0), (12, 10.0), (15, 1.0)] {
        moved[i] = number;
    }
    let head = archive.add_transform(archive.top(), "head", Some(&moved)).expect("a new name");
    for (name, x) in [("fringe", 1.0), ("back", 2.0)] {
        let hair = archive.add_curves(head, name, Kind::Linear, time).expect("a new name");
        let points = [[x, 0.0, 0.0]];
        let sample = CurvesSample { points: &points, counts: &[1], ..CurvesSample::default() };
        archive.write_curves(hair, &sample).expect("one point");
    }
    let groom = read_bytes(&archive.finish().expect("memory").into_inner()).expect("an archive");
    let at = |x: f64| DVec3::new(x, 0.0, 0.0);
    assert_eq!(groom.strands().points(), [at(12.0), at(14.0)]);
    assert_eq!(groom.strand_attributes().get("group"), Some(&Column::Int(vec![0, 1])));
}

#[test]
fn an_archive_of_ours_that_is_broken_is_an_error_or_another_groom() {
    let grooms = [line(&[2, 3], 0.0), line(&[2, 3], 1.0)];
    let (_dir, path) = animation("a.abc", Frames::default(), &grooms).expect("a file");
    let whole = std::fs::read(&path).expect("our own file");
    breakages::breakages(&whole, 300, |broken| {
        if let Err(message) = read_bytes(broken) {
            assert!(!message.is_empty() && !message.contains('\n'), "{message}");
        }
        std::fs::write(&path, broken).expect("a file");
        if let Ok(animation) = Animation::open(&path) {
            (0..animation.len().min(3)).for_each(|i| drop(animation.read(i)));
        }
    });
}

#[test]
fn instances_stand_where_they_are_as_often_as_they_are() {
    let mut archive = Archive::new(Cursor::new(Vec::new()), "a test").expect("memory");
    let time = archive.add_time(0.0, 1.0);
    let moved = |x: f64| {
        let mut matrix = DMat4::IDENTITY.to_cols_array();
        matrix[12] = x;
        matrix
    };
    let group = archive.add_transform(archive.top(), "left", Some(&moved(10.0))).expect("a name");
    let curls = archive.add_transform(group, "curls", Some(&moved(1.0))).expect("a name");
    let hair = archive.add_curves(curls, "hair", Kind::Linear, time).expect("a name");
    let sample = CurvesSample {
        points: &[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0]],
        counts: &[2, 1],
        parameters: &[Parameter::new("id", Scope::Uniform, Values::scalars(Numbers::I32(&[7, 8])))],
        ..CurvesSample::default()
    };
    archive.write_curves(hair, &sample).expect("rows match");
    let right = archive.add_transform(archive.top(), "right", Some(&moved(-10.0))).expect("a name");
    let again = archive.add_instance(right, "again", curls).expect("a name");
    assert!(archive.add_curves(again, "more", Kind::Linear, time).is_err());
    archive.add_instance(right, "hair alone", hair).expect("a name");
    let groom = read_bytes(&archive.finish().expect("memory").into_inner()).expect("an archive");
    // Left, once more with its own transform, and the curves without it.
    let roots: Vec<f64> = groom.strands().iter().map(|strand| strand[0].x).collect();
    assert_eq!(roots, [11.0, 11.5, -9.0, -8.5, -10.0, -9.5]);
    let column = |name: &str| groom.strand_attributes().get(name).cloned();
    assert_eq!(column("group"), Some(Column::Int(vec![0, 0, 1, 1, 2, 2])));
    assert_eq!(column("id"), Some(Column::Int(vec![7, 8, 7, 8, 7, 8])));
}

#[test]
fn no_curves_and_curves_of_one_point_are_kept() {
    for counts in [&[][..], &[0, 0], &[1], &[0, 1, 0, 2, 1]] {
        let (_dir, path) = animation("a.abc", Frames::default(), &[line(counts, 1.0)]).expect("");
        let back = alembic::read(&path).expect("our own file");
        assert_eq!(back.strands(), line(counts, 1.0).strands(), "{counts:?}");
    }
}
