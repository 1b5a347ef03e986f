//! Tracing, filling and fitting: a hair at a time for the first, many for the others.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DMat3, DVec3};
use tress_geometry::{Frame, Strands};
use tress_helicoid::{
    FillOptions, FitOptions, Helicoid, HelicoidGroom, Method, PHelicoid, Piece, Roots, Tracing,
    fill, fit_strand, frechet,
};

/// Pieces that together turn by so many radians.
fn pieces(turning: f64) -> Vec<Piece> {
    let kt = turning / (4.0 * 0.5 * 1.25);
    let piece =
        |i: i32| Piece { k: Helicoid::new(kt, -0.1, 0.1 * f64::from(i), 0.75), length: 0.5 };
    (0..4).map(piece).collect()
}

fn points(turning: f64, n: usize) -> Vec<DVec3> {
    let mut points = vec![DVec3::ZERO; n];
    let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces(turning) };
    hair.sample_evenly(Tracing::default(), &mut points).expect("clear of singular lines");
    points
}

fn trace(c: &mut Criterion) {
    let mut group = c.benchmark_group("trace 30 points");
    for turning in [0.1, 1.0, 10.0, 40.0] {
        let pieces = pieces(turning);
        let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
        let mut points = [DVec3::ZERO; 30];
        for (name, tracing) in [
            ("1e-7", Tracing::Controlled(1e-7)),
            ("1e-5", Tracing::Controlled(1e-5)),
            ("Euler", Tracing::Euler(8)),
        ] {
            group.bench_function(BenchmarkId::new(name, turning), |b| {
                b.iter(|| hair.sample_evenly(tracing, black_box(&mut points)));
            });
        }
    }
    group.finish();
}

fn filling(c: &mut Criterion) {
    let root = |i: i32| Frame {
        position: DVec3::new(f64::from(i % 3), f64::from(i / 3), 0.0),
        axes: DMat3::from_rotation_x(0.1 * f64::from(i)),
    };
    let chains = (0..9).flat_map(|i| pieces(1.0 + 0.3 * f64::from(i))).collect();
    let strands = Strands::from_counts([4; 9], chains).expect("nine of four");
    let guides = HelicoidGroom::new((0..9).map(root).collect(), strands).expect("nine roots");
    let at = |i: i32| DVec3::new(f64::from(i % 30), f64::from(i / 30), 0.0) / 15.0;
    let roots: Vec<DVec3> = (0..900).map(at).collect();
    let mut group = c.benchmark_group("fill 900");
    group.throughput(Throughput::Elements(900));
    for hold in [0, 4] {
        let options = FillOptions { hold, ..FillOptions::default() };
        group.bench_with_input(BenchmarkId::new("hold", hold), &options, |b, options| {
            b.iter(|| fill(&guides, Roots::Points(&roots), options));
        });
    }
    group.finish();
}

fn fitting(c: &mut Criterion) {
    let mut group = c.benchmark_group("fit 30 points");
    for turning in [0.0, 1.0, 6.0] {
        let strand = points(turning, 30);
        for method in [Method::Newton, Method::Simplex] {
            let options = FitOptions { method, ..FitOptions::default() };
            group.bench_function(BenchmarkId::new(format!("{method:?}"), turning), |b| {
                b.iter(|| fit_strand(black_box(&strand), &options));
            });
        }
    }
    group.finish();
    let (p, q) = (points(1.0, 30), points(1.3, 30));
    c.bench_function("frechet 30 x 30", |b| b.iter(|| frechet(black_box(&p), black_box(&q))));
}

criterion_group!(benches, trace, filling, fitting);
criterion_main!(benches);
