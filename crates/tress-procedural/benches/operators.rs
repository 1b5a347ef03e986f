//! The five operators over many strands, alone and in a chain, and the chain's derivative; tress's
//! own operators over coils.

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use tress_edit::{RecoilOptions, RuffleOptions};
use tress_procedural::{
    Bend, Bound, Chain, Clump, Convention, Curl, EvenStrands, Frizz, Operator, Scale, Skip,
    Straighten, Switchback, draw,
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

/// Each chain over the same strands.
fn chains(c: &mut Criterion, name: &str, given: &EvenStrands, cases: Vec<(&str, Vec<Operator>)>) {
    let (count, guides) = (given.len(), strands(500));
    let operator_of: Vec<u32> = (0..).take(count).map(|i: u32| i % 500).collect();
    let mut group = c.benchmark_group(name);
    group.sample_size(10).throughput(Throughput::Elements(count as u64));
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

fn named(operators: Vec<Operator>) -> Vec<(&'static str, Vec<Operator>)> {
    operators.into_iter().map(|operator| (operator.name(), vec![operator])).collect()
}

fn published(c: &mut Criterion) {
    let mut cases = named(five());
    cases.push(("all five", five()));
    chains(c, "operators", &strands(100_000), cases);
}

fn own(c: &mut Criterion) {
    let count = 2_000;
    let operators = vec![Operator::Curl(Curl { radius: 0.3, frequency: 0.4, ..Curl::default() })];
    let numbers = draw(&operators, count, 1, 1);
    let chain = Chain { convention: Convention::Paper, operators };
    let guides = strands(1);
    let bound = Bound { guides: &guides, operator_of: &vec![0; count], numbers: &numbers };
    let mut coils = strands(count);
    chain.apply(&mut coils, &bound, 0).expect("a sound chain");
    let operators = vec![
        Operator::Straighten(Straighten { amount: 0.5, span: 0.25 }),
        Operator::Skip(Skip { probability: 0.3, ..Skip::default() }),
        Operator::Recoil(RecoilOptions { radius: 0.8, ..RecoilOptions::default() }),
        Operator::Ruffle(RuffleOptions { probability: 0.1, ..RuffleOptions::default() }),
        Operator::Switchback(Switchback::default()),
    ];
    chains(c, "own", &coils, named(operators));
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

criterion_group!(benches, published, own, derivative);
criterion_main!(benches);
