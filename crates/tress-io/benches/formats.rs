//! Reading and writing every format: a groom of 1,000 strands of 100 points, in memory.

use std::hint::black_box;
use std::io::Cursor;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use tempfile::tempdir;
use tress_geometry::{Element, Frame, Groom, HelixGroom, Strands};
use tress_io::{Format, WriteOptions, native, obj, read, write};

const STRANDS: usize = 1_000;
const POINTS: usize = 100;

/// Coils, one beside the other, of numbers that 32 bits hold.
fn coils(points: usize) -> Groom {
    let at = |strand: usize, point: usize| {
        let turn = point as f64 * 0.7;
        let position = DVec3::new(strand as f64 + turn.cos(), turn.sin(), 0.1 * point as f64);
        position.as_vec3().as_dvec3()
    };
    let positions = (0..STRANDS * points).map(|i| at(i / points, i % points)).collect();
    let counts = std::iter::repeat_n(points, STRANDS);
    Groom::new(Strands::from_counts(counts, positions).expect("as many as counted"))
}

fn polylines(c: &mut Criterion) {
    let folder = tempdir().expect("a folder to write to");
    for format in Format::ALL {
        if format == Format::Tress {
            continue;
        }
        let groom = coils(if format == Format::Tfx { 64 } else { POINTS });
        let path = folder.path().join(format!("coils.{}", format.extension()));
        write(&path, &groom, &WriteOptions::default()).expect("it fits every format");
        let mut group = c.benchmark_group(format.extension());
        group.throughput(Throughput::Bytes(size(&path)));
        group.bench_function("read", |b| b.iter(|| read(black_box(&path))));
        let copy = folder.path().join(format!("copy.{}", format.extension()));
        let options = WriteOptions::default();
        group.bench_function("write", |b| b.iter(|| write(&copy, black_box(&groom), &options)));
        group.finish();
    }
}

fn size(path: &Path) -> u64 {
    path.metadata().map_or(0, |metadata| metadata.len())
}

fn helices(c: &mut Criterion) {
    let coil = Element { length: 0.1, ..Element::coil(0.5, 0.2) };
    let counts = std::iter::repeat_n(POINTS, STRANDS);
    let elements = Strands::from_counts(counts, vec![coil; STRANDS * POINTS]).expect("as counted");
    let groom = HelixGroom::new(vec![Frame::IDENTITY; STRANDS], elements).expect("a root each");
    let mut bytes = Vec::new();
    native::write(&groom, &mut bytes).expect("memory takes all");
    let mut group = c.benchmark_group("tress");
    group.throughput(Throughput::Bytes(bytes.len() as u64));
    group.bench_function("read", |b| b.iter(|| native::read(black_box(&bytes))));
    group.bench_function("write", |b| {
        b.iter(|| native::write(black_box(&groom), &mut Cursor::new(Vec::new())));
    });
    group.finish();
}

/// The degenerate case: a line for every segment, to be joined.
fn segments(c: &mut Criterion) {
    let groom = coils(POINTS);
    let mut text = String::new();
    for point in groom.strands().points() {
        text += &format!("v {} {} {}\n", point.x, point.y, point.z);
    }
    for range in (0..STRANDS).map(|i| groom.strands().range(i)) {
        for first in range.start..range.end - 1 {
            text += &format!("l {} {}\n", first + 1, first + 2);
        }
    }
    let mut group = c.benchmark_group("obj segments");
    group.throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("read", |b| b.iter(|| obj::read(black_box(text.as_bytes()))));
    group.finish();
}

/// Files of other people's programs, where the folder with them is there.
fn real_grooms(c: &mut Criterion) {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/grooms"));
    let mut group = c.benchmark_group("real grooms");
    group.sample_size(10);
    for name in ["curlycue/curlycue_swatch70_seed1337.obj", "yuksel_straight.hair"] {
        let path = folder.join(name);
        if path.is_file() {
            group.throughput(Throughput::Bytes(size(&path)));
            group.bench_function(name, |b| b.iter(|| read(black_box(&path))));
        }
    }
    group.finish();
}

criterion_group!(benches, polylines, helices, segments, real_grooms);
criterion_main!(benches);
