//! Drawing heads of coils: how the time grows with the strands, and what a picture costs by itself.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use tress_geometry::{Groom, Strands};
use tress_view::{Coloring, RenderOptions, Size, png, render};

const POINTS: usize = 160;
const TURNS: f64 = 18.0;

/// Coils that hang from a half sphere of radius 10, in wisps of a hundred.
fn head(n_strands: usize) -> Groom {
    let strand = |i: usize| {
        let wisp = (i / 100) as f64;
        let (azimuth, height) = (wisp * 2.399_963, (0.37 * wisp).fract());
        let ring = (1.0 - height * height).sqrt();
        let outward = DVec3::new(ring * azimuth.cos(), height, ring * azimuth.sin());
        let stray = (i as f64 * 0.754_877).fract() - 0.5;
        (0..POINTS).map(move |j| {
            let s = j as f64 / (POINTS - 1) as f64;
            let angle = std::f64::consts::TAU * TURNS * s + stray;
            let (sine, cosine) = angle.sin_cos();
            let hang = outward * (10.0 + 2.0 * s) + DVec3::NEG_Y * (14.0 * s);
            hang + DVec3::new(0.5 * cosine + stray, stray, 0.5 * sine - stray)
        })
    };
    let points = (0..n_strands).flat_map(strand).collect();
    let counts = vec![POINTS; n_strands];
    Groom::new(Strands::from_counts(counts, points).expect("the counts match"))
}

fn picture(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("render to png");
    group.sample_size(10);
    let options = RenderOptions { size: Size::new(1600, 1600), ..RenderOptions::default() };
    // No strand at all is the degenerate case: what the pixels cost.
    for n_strands in [0, 100, 1_000, 10_000] {
        let groom = head(n_strands);
        group.throughput(Throughput::Elements(n_strands as u64));
        group.bench_with_input(BenchmarkId::from_parameter(n_strands), &groom, |bencher, groom| {
            bencher.iter(|| {
                let image = render(black_box(groom), &Coloring::Natural, &options);
                png(&image.expect("a picture")).expect("a file")
            });
        });
    }
    group.finish();
}

criterion_group!(benches, picture);
criterion_main!(benches);
