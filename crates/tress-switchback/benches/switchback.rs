//! Exact switchbacks over the range of coils, their approximation, and a strand that gets one.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use tress_geometry::{Element, Frame, SuperHelix};
use tress_switchback::{
    InsertOptions, Material, Profile, Ritz, RitzOptions, Switchback, insert_at,
};

fn exact(c: &mut Criterion) {
    let material = Material::default();
    let mut group = c.benchmark_group("exact");
    // 0.01 is a coil next to flat, the hardest by far.
    for v in [0.01, 0.05, 0.2, 0.5, 0.95] {
        group.bench_with_input(BenchmarkId::new("cold", v), &v, |b, &v| {
            b.iter(|| Switchback::new(v, &material));
        });
    }
    let switchback = Switchback::new(0.3, &material).expect("within the range that is solved");
    group.bench_function("warm", |b| b.iter(|| switchback.near(0.31)));
    group.bench_function("curvature", |b| b.iter(|| switchback.curvature(3.7)));
    group.finish();
}

fn ritz(c: &mut Criterion) {
    let (material, options) = (Material::default(), RitzOptions::default());
    c.bench_function("ritz", |b| b.iter(|| Ritz::new(0.4, &material, &options)));
}

fn insertion(c: &mut Criterion) {
    let coil = Element::coil(0.5, 0.9);
    let length = std::f64::consts::TAU / coil.curvature.length() / 6.0;
    let elements = vec![Element { length, ..coil }; 150];
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    let middle = 0.5 * strand.length();
    c.bench_function("insert", |b| {
        b.iter(|| insert_at(&strand, middle, &InsertOptions::default()));
    });
}

criterion_group!(benches, exact, ritz, insertion);
criterion_main!(benches);
