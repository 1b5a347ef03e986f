//! Analyses of coils: how the time grows with turns, with frizz and with the number of strands, and
//! what comparing two grooms costs.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use tress_analysis::{
    Analysis, Winding, Wisps, discrete_frechet, k_means, nearest_distances, switchbacks,
    wasserstein,
};
use tress_geometry::{Groom, Strands};

/// A coil at a place on a grid, nine points a turn, whose axis sways; `frizz` shakes every point.
fn coil(i: u32, turns: u32, frizz: f64) -> Vec<DVec3> {
    let place = DVec3::new(0.4 * f64::from(i % 64), 0.0, 0.4 * f64::from(i / 64));
    let at = |k: u32| {
        let a = f64::from(k) * std::f64::consts::TAU / 9.0;
        let (sine, cosine) = (a + 0.3 * f64::from(i)).sin_cos();
        let shake = |by: f64| frizz * ((a * by + f64::from(i)) * 97.3).sin();
        let coil = DVec3::new(0.5 * cosine, -0.1 * a, 0.5 * sine);
        place + coil + DVec3::new(shake(1.0), (0.05 * a).sin(), shake(1.7))
    };
    (0..9 * turns).map(at).collect()
}

fn groom(strands: u32) -> Groom {
    let mut coils = Strands::default();
    for i in 0..strands {
        coils.push(coil(i, 18, 0.0)).expect("offsets reach so far");
    }
    Groom::new(coils)
}

fn one_strand(c: &mut Criterion) {
    let mut group = c.benchmark_group("winding");
    for turns in [2, 8, 32, 128] {
        let strand = coil(0, turns, 0.0);
        group.throughput(Throughput::Elements(strand.len() as u64));
        group.bench_with_input(BenchmarkId::new("coil of turns", turns), &strand, |b, strand| {
            b.iter(|| Winding::of_polyline(black_box(strand)));
        });
    }
    // Frizz bends more than the coil does, and so asks for more stations.
    let frizzy = coil(0, 32, 0.1);
    group.bench_function("frizz", |b| b.iter(|| Winding::of_polyline(black_box(&frizzy))));
    let straight: Vec<DVec3> = (0..288).map(|i| DVec3::X * f64::from(i)).collect();
    group.bench_function("straight", |b| b.iter(|| Winding::of_polyline(black_box(&straight))));
    group.finish();
    let winding = Winding::of_polyline(&coil(0, 32, 0.0)).expect("it winds");
    c.bench_function("switchbacks", |b| b.iter(|| switchbacks(black_box(&winding), 0)));
}

fn whole_grooms(c: &mut Criterion) {
    let mut group = c.benchmark_group("groom");
    group.sample_size(10);
    for strands in [100, 1_000, 4_000] {
        let groom = groom(strands);
        group.throughput(Throughput::Elements(u64::from(strands)));
        group.bench_with_input(BenchmarkId::new("analysis", strands), &groom, |b, groom| {
            b.iter(|| Analysis::of(black_box(groom)));
        });
        let analysis = Analysis::of(&groom);
        group.bench_with_input(BenchmarkId::new("wisps", strands), &groom, |b, groom| {
            b.iter(|| Wisps::of(black_box(groom), &analysis));
        });
    }
    group.finish();
}

fn comparisons(c: &mut Criterion) {
    let (a, b) = (coil(0, 18, 0.0), coil(1, 18, 0.05));
    c.bench_function("discrete Frechet, 162 points", |bench| {
        bench.iter(|| discrete_frechet(black_box(&a), &b));
    });
    let lengths =
        |by: f64| -> Vec<f64> { (0..10_000).map(|i| (by * f64::from(i)).sin()).collect() };
    let (x, y) = (lengths(0.37), lengths(0.91));
    c.bench_function("Wasserstein, 10,000 values", |bench| {
        bench.iter(|| wasserstein(black_box(&x), &y));
    });
    let (one, other) = (groom(1_000), groom(900));
    c.bench_function("nearest distances, 162,000 points", |bench| {
        bench.iter(|| nearest_distances(black_box(&one), &other));
    });
    let tips: Vec<[f64; 3]> = one.strands().iter().map(|strand| strand[161].to_array()).collect();
    c.bench_function("k-means, 1,000 rows in 30", |bench| {
        bench.iter(|| k_means(black_box(&tips), 30, 1));
    });
}

criterion_group!(benches, one_strand, whole_grooms, comparisons);
criterion_main!(benches);
