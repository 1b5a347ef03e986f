//! What is written here, as the `ogawa-rs` crate reads it.

use std::io::{self, Cursor, Read, Seek, SeekFrom};

use ogawa_rs::{ArchiveReader, CurvesSchema, ObjectReader};
use tress_alembic::{Archive, CurvesSample, Error, Kind, Numbers, Scope, Values};

/// A file in memory, as ogawa-rs wants it.
struct Bytes(Cursor<Vec<u8>>);

impl Read for Bytes {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

impl Seek for Bytes {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        self.0.seek(place)
    }
}

impl ArchiveReader for Bytes {
    fn size(&self) -> u64 {
        self.0.get_ref().len() as u64
    }
}

fn archive(n_curves: usize, n_points: i32) -> Result<Vec<u8>, Error> {
    let mut archive = Archive::new(Cursor::new(Vec::new()), "a test")?;
    let time = archive.add_time(0.0, 1.0 / 24.0);
    let head = archive.add_transform(archive.top(), "head", None)?;
    let hair = archive.add_curves(head, "hair", Kind::Linear, time)?;
    // Something behind it, whose texts are the last of those that headers share.
    archive.add_transform(archive.top(), "last", None)?;
    let counts = vec![n_points; n_curves];
    let points: Vec<[f32; 3]> = (0_u8..250)
        .cycle()
        .take(n_curves * n_points as usize)
        .map(|i| [i.into(), 1.0, 2.0])
        .collect();
    let sample = CurvesSample {
        points: &points,
        counts: &counts,
        widths: Some((Scope::Constant, &[0.5])),
        ..CurvesSample::default()
    };
    archive.write_curves(hair, &sample)?;
    Ok(archive.finish()?.into_inner())
}

#[test]
fn another_reader_finds_the_same_curves() {
    let mut file = Bytes(Cursor::new(archive(300, 7).expect("memory takes all")));
    let archive = ogawa_rs::Archive::new(&mut file).expect("an archive");
    let child = |parent: &ObjectReader, file: &mut Bytes| {
        parent
            .load_child(0, file, &archive.indexed_meta_data, &archive.time_samplings)
            .expect("an object")
    };
    let root = archive.load_root_object(&mut file).expect("an object");
    let head = child(&root, &mut file);
    let hair = child(&head, &mut file);
    assert_eq!((head.header.name.as_str(), hair.header.name.as_str()), ("head", "hair"));
    let schema = CurvesSchema::new_from_object_reader(&hair, &mut file, &archive).expect("curves");
    let points = schema.load_positions_sample(0, &mut file).expect("positions");
    assert_eq!((points.len(), points[2099]), (2100, [99.0, 1.0, 2.0]));
    let counts = schema.load_n_vertices_sample(0, &mut file).expect("counts");
    assert_eq!(counts, [7; 300]);
    assert!(schema.is_constant() && schema.has_width() && !schema.has_uv());
}

#[test]
fn instances_take_nothing_in() {
    let mut archive = Archive::new(Cursor::new(Vec::new()), "a test").expect("memory");
    let time = archive.add_time(0.0, 1.0);
    let head = archive.add_transform(archive.top(), "head", None).expect("a new name");
    let again = archive.add_instance(archive.top(), "again", head).expect("a new name");
    let refused = [
        archive.add_transform(again, "inner", None).map(drop),
        archive.add_curves(again, "hair", Kind::Linear, time).map(drop),
        archive.set_user_property(again, "made_by", Values::scalars(Numbers::I8(&[1]))),
        archive.write_curves(again, &CurvesSample::default()),
    ];
    for (i, outcome) in refused.into_iter().enumerate() {
        assert!(matches!(outcome, Err(Error::NoObject)), "{i}: {outcome:?}");
    }
    assert!(matches!(archive.add_instance(head, "twice", again), Err(Error::NoObject)));
}

#[test]
fn instances_do_not_hold_each_other() {
    let mut archive = Archive::new(Cursor::new(Vec::new()), "a test").expect("memory");
    let [a, b, c] = ["a", "b", "c"]
        .map(|name| archive.add_transform(archive.top(), name, None).expect("a new name"));
    archive.add_instance(a, "of b", b).expect("b holds nothing");
    archive.add_instance(b, "of c", c).expect("c holds nothing");
    archive.add_instance(c, "of a", a).expect_err("a shows b, which shows c");
    archive.add_instance(c, "of the top", archive.top()).expect_err("the top holds c");
    archive.add_instance(a, "of c", c).expect("c holds nothing");
}
