//! Weights that made a strand come back, and no Adam ends lower.

use rand::RngExt;

use super::*;
use crate::Roots;

fn wandering(count: usize, seed: u64) -> EvenStrands {
    let mut points = Vec::new();
    for i in 0..count {
        let mut rng = tress_edit::strand_rng(seed, i);
        let mut number = || rng.random_range(-1.0..1.0);
        let mut x = DVec3::new(number(), number(), 0.0);
        for _ in 0..15 {
            points.push(x);
            x += DVec3::new(0.5 * number(), 0.5 * number(), 1.0 + 0.2 * number());
        }
    }
    EvenStrands::new(15, points).expect("whole strands")
}

fn instances(guides: &EvenStrands, strands: &EvenStrands) -> Instances {
    let roots = |strands: &EvenStrands| Roots { positions: strands.roots(), uv: None };
    Instances::by_distance(&roots(guides), &roots(strands), 8, 1.0)
}

#[test]
fn weights_that_made_the_strands_are_found() {
    let guides = wandering(20, 1);
    let seats = wandering(50, 2);
    let made = instances(&guides, &seats);
    let strands = made.instance(&guides, &seats.roots());
    let found = fit_weights(&guides, &strands, &made);
    for (found, made) in found.weights.iter().zip(&made.weights) {
        assert!((found - made).abs() < 1e-5, "{found} against {made}");
    }
}

#[test]
fn the_sigma_that_made_the_strands_is_found() {
    let guides = wandering(40, 1);
    let seats = wandering(200, 2);
    let roots = |strands: &EvenStrands| Roots { positions: strands.roots(), uv: None };
    let by_distance = |sigma| Instances::by_distance(&roots(&guides), &roots(&seats), 8, sigma);
    let strands = by_distance(0.6).instance(&guides, &seats.roots());
    let (sigma, found) = fit_sigma(&guides, &strands, 1.0, by_distance);
    assert_eq!((sigma, found), (0.6, by_distance(0.6)));
}

#[test]
fn weights_are_a_blend_and_satisfy_the_conditions_of_the_least() {
    let guides = wandering(20, 3);
    let targets = wandering(40, 4);
    let found = fit_weights(&guides, &targets, &instances(&guides, &targets));
    for i in 0..targets.len() {
        let weights: Vec<(usize, f64)> = found.strand(i).collect();
        assert!((weights.iter().map(|(_, w)| w).sum::<f64>() - 1.0).abs() < 1e-12);
        assert!(weights.iter().all(|&(_, w)| 0.0 <= w));
        // Moving weight between guides raises the loss: the gradient by a weight in use is the
        // least of all gradients (Karush, Kuhn, Tucker).
        let target = targets.strand(i);
        let relative = |g: usize, j: usize| guides.strand(g)[j] - guides.strand(g)[0];
        let residual: Vec<DVec3> = (0..15)
            .map(|j| {
                weights.iter().map(|&(g, w)| w * relative(g, j)).sum::<DVec3>()
                    - (target[j] - target[0])
            })
            .collect();
        let slope = |g: usize| -> f64 { (0..15).map(|j| residual[j].dot(relative(g, j))).sum() };
        let least = weights.iter().map(|&(g, _)| slope(g)).fold(f64::INFINITY, f64::min);
        for &(g, w) in &weights {
            assert!(w < 1e-9 || slope(g) - least < 1e-6, "strand {i}, guide {g}");
        }
    }
}

/// [IPG 5.3] as published: 2,000 steps of Adam on the logarithms of weights, from equal ones.
fn adam(guides: &EvenStrands, targets: &EvenStrands, instances: &Instances) -> Instances {
    let each = instances.each;
    let mut logs = vec![0.0; instances.weights.len()];
    let (mut first, mut second) = (logs.clone(), logs.clone());
    let mut found = instances.clone();
    let weigh = |logs: &[f64], found: &mut Instances| {
        for (weights, logs) in found.weights.chunks_mut(each).zip(logs.chunks(each)) {
            let most = logs.iter().copied().fold(f64::MIN, f64::max);
            let sum: f64 = logs.iter().map(|log| (log - most).exp()).sum();
            weights.iter_mut().zip(logs).for_each(|(w, log)| *w = (log - most).exp() / sum);
        }
    };
    for step in 1..=2000 {
        weigh(&logs, &mut found);
        let strands = found.instance(guides, &targets.roots());
        for i in 0..targets.len() {
            let slopes: Vec<f64> = found
                .strand(i)
                .map(|(g, _)| {
                    let guide = guides.strand(g);
                    let rows = strands.strand(i).iter().zip(targets.strand(i)).zip(guide);
                    rows.map(|((x, t), g)| (*x - *t).dot(*g - guide[0])).sum()
                })
                .collect();
            let weights = found.weights[i * each..(i + 1) * each].to_vec();
            let mean: f64 = weights.iter().zip(&slopes).map(|(w, s)| w * s).sum();
            for k in 0..each {
                let (at, gradient) = (i * each + k, weights[k] * (slopes[k] - mean));
                first[at] = 0.9 * first[at] + 0.1 * gradient;
                second[at] = 0.999 * second[at] + 0.001 * gradient * gradient;
                let first = first[at] / (1.0 - 0.9_f64.powi(step));
                let second = second[at] / (1.0 - 0.999_f64.powi(step));
                logs[at] -= 0.05 * first / (second.sqrt() + 1e-8);
            }
        }
    }
    weigh(&logs, &mut found);
    found
}

#[test]
fn adam_ends_no_lower() {
    let (guides, targets) = (wandering(12, 5), wandering(30, 6));
    let start = instances(&guides, &targets);
    let loss =
        |found: &Instances| vertex_loss(&found.instance(&guides, &targets.roots()), &targets);
    let (exact, adam) =
        (loss(&fit_weights(&guides, &targets, &start)), loss(&adam(&guides, &targets, &start)));
    assert!(exact <= adam * (1.0 + 1e-9), "{exact} against {adam}");
    assert!(exact < 0.9 * loss(&start));
}

#[test]
fn guides_that_are_all_alike_give_the_nearest_or_share() {
    let guide = wandering(1, 7);
    let guides = guide.select(&[0, 0, 0]);
    let found = fit_weights(&guides, &guide, &instances(&guides, &guide));
    assert!((found.weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
}
