//! The five operators over many strands, alone and in a chain, and the chain's derivative.

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use tress_procedural::{
    Bend, Bound, Chain, Clump, Convention, Curl, EvenStrands, Frizz, Operator, Scale, draw,
};

const POINTS: usize = 100;

fn line(root: DVec3) -> impl Iterator<Item = DVec3> {
    (0..POINTS).map(move |j| {
        let s = 0.1 * j as f64;
        root + DVec3::new(0.2 * s.sin(), -s, 0.1 * s * s.cos())
    })
}

fn strands(count: usize) -> EvenStrands {
    let roots = (0..count).map(|i| DVec3::new((i % 317) as f64 * 0.03, 0.0, i as f64 * 1e-4));
    EvenStrands::new(POINTS, roots.flat_map(line).collect()).expect("whole strands")
}

fn five() -> Vec<Operator> {
    vec![
        Operator::Scale(Scale { random: 0.2 }),
        Operator::Clump(Clump { profile: 1.0 }),
        Operator::Bend(Bend { angle_degrees: 30.0, start: 0.4 }),
        Operator::Curl(Curl { radius: 0.3, frequency: 0.4, random_frequency: 0.05, start: 0.2 }),
        Operator::Frizz(Frizz { frequency: 1.0, amplitude: 0.2 }),
    ]
}

fn chains(c: &mut Criterion) {
    let (count, guides) = (100_000, 500);
    let (given, guides) = (strands(count), strands(guides));
    let operator_of: Vec<u32> = (0..).take(count).map(|i: u32| i % 500).collect();
    let mut group = c.benchmark_group("operators");
    group.sample_size(10).throughput(Throughput::Elements(count as u64));
    let mut cases: Vec<(&str, Vec<Operator>)> =
        five().into_iter().map(|operator| (operator.name(), vec![operator])).collect();
    cases.push(("all five", five()));
    for (name, operators) in cases {
        let numbers = draw(&operators, count, guides.len(), 1);
        let chain = Chain { convention: Convention::Paper, operators };
        let bound = Bound { guides: &guides, operator_of: &operator_of, numbers: &numbers };
        let run = |strands: &mut EvenStrands| chain.apply(black_box(strands), &bound, 0);
        group.bench_function(name, |b| {
            b.iter_batched_ref(|| given.clone(), run, BatchSize::LargeInput);
        });
    }
    group.finish();
}

fn derivative(c: &mut Criterion) {
    let count = 10_000;
    let (given, guides, operators) = (strands(count), strands(500), five());
    let operator_of: Vec<u32> = (0..).take(count).map(|i: u32| i % 500).collect();
    let numbers = draw(&operators, count, guides.len(), 1);
    let chain = Chain { convention: Convention::Paper, operators };
    let bound = Bound { guides: &guides, operator_of: &operator_of, numbers: &numbers };
    let mut group = c.benchmark_group("derivative");
    group.sample_size(10).throughput(Throughput::Elements(count as u64));
    group.bench_function("all five", |b| b.iter(|| chain.pull_back(&given, &bound, &given)));
    group.finish();
}

criterion_group!(benches, chains, derivative);
criterion_main!(benches);
