//! Fits of coils, and one strand of nothing but trouble.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use tress_fit::{
    Elements, FitOptions, HelixArc, Sampling, Spline, TangentRule, Tolerance, deviation, fit,
    fit_strand, float_points, sample,
};
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
    let frizz = frizz(73);
    group.bench_function("frizz", |b| b.iter(|| fit_strand(&frizz, &refined())));
    group.finish();
}

/// Segments of one length that turn by about a right angle at each point, in no plane.
fn frizz(points: u32) -> Vec<DVec3> {
    let heading = |i: u32| {
        let a = f64::from(i);
        DVec3::new((1.7 * a).cos(), (2.3 * a).sin(), (3.1 * a).cos() + 0.3).normalize_or(DVec3::X)
    };
    let walk = (0..points).scan(DVec3::ZERO, |at, i| {
        *at += heading(i);
        Some(*at)
    });
    walk.collect()
}

/// What a fit is made of.
fn parts(c: &mut Criterion) {
    let mut group = c.benchmark_group("parts");
    let points = coil(18, 0.0);
    group.throughput(Throughput::Elements(points.len() as u64));
    for rule in [TangentRule::Circle, TangentRule::Helix] {
        group.bench_function(format!("spline {rule:?}"), |b| {
            b.iter(|| Spline::through(black_box(&points), rule));
        });
    }
    let spline = Spline::through(&points, TangentRule::Helix);
    let tangents: Vec<DVec3> = spline.tangents().collect();
    group.bench_function("float points", |b| {
        b.iter(|| float_points(&mut points.clone(), black_box(&tangents)));
    });
    let fit = fit_strand(&points, &refined()).expect("a coil");
    group.bench_function("deviation", |b| {
        b.iter(|| deviation(&fit.super_helix(), black_box(&points), &fit.arc_lengths));
    });
    group.finish();
    let middle = 0.4321 * spline.length();
    c.bench_function("spline at", |b| b.iter(|| spline.at(black_box(middle))));
}

criterion_group!(benches, arcs, parts, strands, points);
criterion_main!(benches);
