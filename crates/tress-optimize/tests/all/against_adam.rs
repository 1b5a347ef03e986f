//! Levenberg-Marquardt against Adam as published, on seeded coils and targets.

use crate::common::{coil, targets};
use tress_geometry::SuperHelix;
use tress_optimize::{Adam, SculptOptions, Solver, Stiffness, Stop, solve};

#[test]
fn never_ends_above_adam() {
    let mut beyond = 0;
    let mut count = 0;
    for seed in 0..60 {
        let n = [5, 12, 30, 45][seed as usize % 4];
        let (root, elements) = coil(seed, n);
        let strand = SuperHelix { root, elements: &elements };
        for (m, far, c) in [(1, 0.1, 0.01), (1, 0.5, 1.0), (3, 0.3, 0.1), (2, 0.8, 1e-3)] {
            let controls = targets(&strand, m, far, 1000 + seed);
            let newton =
                SculptOptions { stiffness: Stiffness::Raw(c), ..SculptOptions::published(c) };
            let adam = SculptOptions { solver: Solver::Adam(Adam::default()), ..newton };
            let (_, ours) = solve(&strand, &controls, &newton).expect("good controls");
            let (_, theirs) = solve(&strand, &controls, &adam).expect("good controls");
            count += 1;
            assert!((ours.start.total() - theirs.start.total()).abs() < 1e-9 * ours.start.total());
            if ours.end.total() > theirs.end.total() * (1.0 + 1e-9) {
                beyond += 1;
                eprintln!("seed {seed} m {m} far {far} c {c}: {ours:?}\n   adam {theirs:?}");
            }
            if ours.stop != Stop::Converged {
                eprintln!("seed {seed} m {m} far {far} c {c}: {ours:?}");
            }
        }
    }
    eprintln!("{beyond} of {count}");
    assert_eq!(beyond, 0);
}
