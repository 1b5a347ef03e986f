//! Growing hairs on guides: `cargo bench -p tress-grow`.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use tress_fixtures::{PatchOptions, coily_patch};
use tress_grow::{Assignment, Coils, GrowOptions, Plan, Skip, SkipUnit, assign};

fn roots_near(guides: &[DVec3], each: u32) -> Vec<DVec3> {
    let aside = |i: u32| (f64::from(i) * 12.9898).sin() * 0.3;
    let near = |p: &DVec3, i| *p + DVec3::new(aside(i), aside(i + 71), aside(i + 1001));
    guides.iter().flat_map(|p| (0..each).map(move |i| near(p, i))).collect()
}

fn growing(c: &mut Criterion) {
    let options = PatchOptions { wisps: 100, strands_per_wisp: 1, ..PatchOptions::default() };
    let guides = coily_patch(&options, 1).strands().clone();
    let firsts: Vec<DVec3> = guides.iter().map(|g| g[0]).collect();
    let roots = roots_near(&firsts, 30);
    let coils = Coils::shipped().expect("a whole file");
    let assigned = assign(&roots, &firsts, Assignment::Noisy(3), 1).expect("guides");

    let mut group = c.benchmark_group("grow");
    group.throughput(Throughput::Elements(roots.len() as u64));
    for probability in [0.0, 0.5] {
        let skip = Skip { probability, each: SkipUnit::Points };
        let options = GrowOptions { skip, ..GrowOptions::default() };
        group.bench_function(format!("plan_{probability}"), |b| {
            b.iter(|| Plan::new(&guides, &roots, &assigned, coils.clone(), &options, 1));
        });
        let plan = Plan::new(&guides, &roots, &assigned, coils.clone(), &options, 1);
        let plan = plan.expect("sound options");
        group.bench_function(format!("lay_{probability}"), |b| {
            b.iter(|| plan.grow(black_box(&guides), black_box(&roots)));
        });
    }
    group.finish();

    let mut group = c.benchmark_group("assign");
    let many = roots_near(&firsts, 1000);
    group.throughput(Throughput::Elements(many.len() as u64));
    for rule in [Assignment::Nearest, Assignment::Noisy(3), Assignment::NoisyByDistance(3)] {
        group.bench_function(format!("{rule:?}"), |b| {
            b.iter(|| assign(black_box(&many), &firsts, rule, 1));
        });
    }
    group.finish();
}

criterion_group!(benches, growing);
criterion_main!(benches);
