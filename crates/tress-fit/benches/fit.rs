//! Fits of coils, and one strand of nothing but trouble.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use tress_fit::{Elements, FitOptions, HelixArc, Sampling, Tolerance, fit, fit_strand, sample};
use tress_geometry::{Groom, Strands};

/// A coil of `turns` turns whose axis bends, nine points a turn.
fn coil(turns: u32, phase: f64) -> Vec<DVec3> {
    let at = |i: u32| {
        let a = f64::from(i) * std::f64::consts::TAU / 9.0;
        let r = 0.5 + 0.05 * (0.17 * a + phase).sin();
        DVec3::new(r * a.cos() + 0.002 * a * a, r * a.sin(), 0.1 * a)
    };
    (0..9 * turns).map(at).collect()
}

fn groom(strands: u32) -> Groom {
    let mut coils = Strands::default();
    for i in 0..strands {
        coils.push(coil(18, f64::from(i))).expect("offsets reach so far");
    }
    Groom::new(coils)
}

fn direct() -> FitOptions {
    FitOptions { refine: None, elements: Elements::Count(90), ..FitOptions::default() }
}

fn refined() -> FitOptions {
    FitOptions { elements: Elements::Count(90), ..FitOptions::default() }
}

fn arcs(c: &mut Criterion) {
    let (chord, t0, t1) = (DVec3::new(1.0, 1.0, 0.4), DVec3::X, DVec3::new(0.1, 0.9, 0.1));
    let t1 = tress_fit::float_tangent(t0, chord, t1.normalize());
    c.bench_function("arc", |b| b.iter(|| HelixArc::joining(black_box(chord), t0, t1)));
}

fn strands(c: &mut Criterion) {
    let mut group = c.benchmark_group("strands");
    group.sample_size(10);
    for n in [100, 1000] {
        let groom = groom(n);
        group.throughput(Throughput::Elements(u64::from(n)));
        group.bench_with_input(BenchmarkId::new("direct", n), &groom, |b, groom| {
            b.iter(|| fit(groom, &direct()));
        });
        group.bench_with_input(BenchmarkId::new("refined", n), &groom, |b, groom| {
            b.iter(|| fit(groom, &refined()));
        });
        let fitted = fit(&groom, &direct()).expect("valid options");
        group.bench_with_input(BenchmarkId::new("sample", n), &fitted.helices, |b, helices| {
            b.iter(|| sample(helices, &Sampling::Points(160)));
        });
    }
    group.finish();
}

fn points(c: &mut Criterion) {
    let mut group = c.benchmark_group("points of a strand");
    for turns in [6, 24, 96] {
        let points = coil(turns, 0.0);
        group.throughput(Throughput::Elements(points.len() as u64));
        group.bench_with_input(BenchmarkId::from_parameter(points.len()), &points, |b, points| {
            b.iter(|| fit_strand(points, &FitOptions::default()));
        });
    }
    let tolerance = Elements::Tolerance(Tolerance::OfRadius(0.02));
    let options = FitOptions { elements: tolerance, ..FitOptions::default() };
    let even = coil(18, 0.0);
    group.bench_function("within 2 % of the radius", |b| b.iter(|| fit_strand(&even, &options)));
    let folded: Vec<DVec3> =
        (0..160).map(|i| DVec3::X * f64::from((i % 40 - 20_i32).abs())).collect();
    group.bench_function("doubled back", |b| b.iter(|| fit_strand(&folded, &refined())));
    group.finish();
}

criterion_group!(benches, arcs, strands, points);
criterion_main!(benches);
