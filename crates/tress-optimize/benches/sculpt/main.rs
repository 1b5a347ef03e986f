//! Gradient, whole grooms and dragged frames: `cargo bench -p tress-optimize`.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DMat3, DVec3};
use tress_optimize::{Objective, SculptOptions, Sculptor, sculpt};

mod algorithms;
mod scenes;

use scenes::{coils, pulled_down};

/// Energy and gradient of one strand with 3 controls; beside it the Jacobian that the published
/// algorithms need for the same.
fn gradient(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("gradient");
    for n in [22, 45, 90, 180] {
        let groom = coils(1, n);
        let strand = groom.strand(0);
        let controls = pulled_down(&groom, 3, 0.5);
        let options = SculptOptions::published(20.0);
        let mut energy = Objective::new(&strand, controls.strand(0), &options).expect("controls");
        let mut out = vec![DVec3::ZERO; n];
        group.bench_function(BenchmarkId::new("adjoint", n), |bencher| {
            bencher.iter(|| energy.evaluate(black_box(strand.elements), &mut out));
        });
        let at: Vec<f64> = controls.strand(0).iter().map(|c| c.arc_length).collect();
        let mut blocks = vec![DMat3::ZERO; 3 * n];
        let mut tables = algorithms::Tables::default();
        group.bench_function(BenchmarkId::new("published", n), |bencher| {
            bencher.iter(|| {
                algorithms::jacobian(black_box(&strand), &at, &mut tables, &mut blocks);
            });
        });
    }
    group.finish();
}

/// Whole grooms from rest, in strands a second: it should not depend on how many there are.
fn grooms(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("groom");
    group.sample_size(10);
    for (strands, n) in [(256, 90), (1024, 90), (4096, 90), (1024, 22), (1024, 45), (1024, 180)] {
        let rest = coils(strands, n);
        let controls = pulled_down(&rest, 3, 0.5);
        group.throughput(Throughput::Elements(strands as u64));
        group.bench_function(format!("{strands}x{n}"), |bencher| {
            bencher.iter_batched_ref(
                || rest.clone(),
                |groom| sculpt(groom, &controls, &SculptOptions::default()).expect("controls"),
                criterion::BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

/// One frame of a dragged joint: 2,025 strands of 45 elements with one control.
fn drag(criterion: &mut Criterion) {
    let rest = coils(2025, 45);
    let frames: Vec<_> =
        (0..100).map(|i| pulled_down(&rest, 1, 0.005 * f64::from(i % 50))).collect();
    let mut sculptor = Sculptor::new(rest, SculptOptions::default()).expect("options");
    let mut frame = 0;
    criterion.bench_function("drag", |bencher| {
        bencher.iter(|| {
            frame = (frame + 1) % frames.len();
            sculptor.sculpt(&frames[frame]).expect("controls")
        });
    });
}

criterion_group!(benches, gradient, grooms, drag);
criterion_main!(benches);
