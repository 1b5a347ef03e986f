//! Levenberg-Marquardt against Adam as published, on seeded coils and targets.

use tress_geometry::SuperHelix;
use tress_optimize::{Adam, SculptOptions, Solver, Stop, solve};

use crate::common::{coil, targets};

#[test]
fn never_ends_above_adam_even_in_a_fraction_of_its_steps() {
    let (mut ours_steps, mut adam_steps, mut converged) = (0, 0, 0);
    for (seed, n) in (0..60).zip([5, 12, 30, 45].into_iter().cycle()) {
        let (root, elements) = coil(seed, n);
        let strand = SuperHelix { root, elements: &elements };
        for (m, far, c) in [(1, 0.1, 0.01), (1, 0.5, 1.0), (3, 0.3, 0.1), (2, 0.8, 1e-3)] {
            let controls = targets(&strand, m, far, 1000 + seed);
            let newton = SculptOptions::published(c);
            let adam = SculptOptions { solver: Solver::Adam(Adam::default()), ..newton };
            let (_, ours) = solve(&strand, &controls, &newton).expect("good controls");
            let (_, theirs) = solve(&strand, &controls, &adam).expect("good controls");
            let start = ours.start.total();
            assert!((start - theirs.start.total()).abs() < 1e-9 * start, "one energy");
            assert!(
                ours.end.total() <= theirs.end.total() * (1.0 + 1e-9),
                "seed {seed}, {m} controls, c {c}: {ours:?}, Adam {theirs:?}",
            );
            ours_steps += ours.iterations;
            adam_steps += theirs.iterations;
            converged += u32::from(ours.stop == Stop::Converged);
        }
    }
    assert!(50 * ours_steps < adam_steps, "{ours_steps} steps against {adam_steps}");
    assert!(230 <= converged, "{converged} of 240 to a millionth of the gradient");
}

#[test]
fn adam_stops_for_the_reasons_that_were_published() {
    let (root, elements) = coil(1, 20);
    let strand = SuperHelix { root, elements: &elements };
    let with = |adam| SculptOptions { solver: Solver::Adam(adam), ..SculptOptions::published(0.0) };
    let near = targets(&strand, 1, 0.02, 3);
    let stop = |adam| solve(&strand, &near, &with(adam)).expect("good controls").1.stop;
    assert_eq!(stop(Adam::default()), Stop::Residual);
    assert_eq!(stop(Adam { max_steps: 3, ..Adam::default() }), Stop::MaxIterations);
    assert_eq!(stop(Adam { step: 10.0, ..Adam::default() }), Stop::NoImprovement);
}
