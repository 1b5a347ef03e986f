//! Derivatives of chains against finite differences, and what chains refuse.

use std::f64::consts::TAU;

use proptest::prelude::*;
use tress_grow::SkipUnit;

use super::*;
use crate::{Bend, Clump, Curl, Frizz, Scale, Skip, SkipKeep, Straighten, Switchback, draw};

const POINTS: usize = 12;
const STRANDS: usize = 5;
const GUIDES: usize = 2;

/// Strands that wander, from a seed.
fn wandering(count: usize, seed: u64) -> EvenStrands {
    use rand::RngExt;
    let mut points = Vec::new();
    for i in 0..count {
        let mut rng = tress_edit::strand_rng(seed, i);
        let mut number = || rng.random_range(-0.5..0.5);
        let mut x = DVec3::new(number(), number(), number());
        for _ in 0..POINTS {
            points.push(x);
            x += DVec3::new(0.3 + 0.3 * number(), 0.6 * number(), 0.2 + 0.4 * number());
        }
    }
    EvenStrands::new(POINTS, points).expect("whole strands")
}

/// All that goes into a chain, in one list of numbers.
struct Case {
    chain: Chain,
    strands: EvenStrands,
    guides: EvenStrands,
    numbers: Vec<Vec<f64>>,
}

const OPERATOR_OF: [u32; STRANDS] = [0, 1, 1, 0, 1];

impl Case {
    fn new(operators: Vec<Operator>, convention: Convention, seed: u64) -> Self {
        let numbers = draw(&operators, STRANDS, GUIDES, seed);
        let chain = Chain { convention, operators };
        let (strands, guides) = (wandering(STRANDS, seed), wandering(GUIDES, seed + 1));
        Self { chain, strands, guides, numbers }
    }

    fn bound(&self) -> Bound<'_> {
        Bound { guides: &self.guides, operator_of: &OPERATOR_OF, numbers: &self.numbers }
    }

    /// A loss that weighs every coordinate differently, bent so that its gradient varies.
    fn loss_and_gradient(&self) -> (f64, EvenStrands) {
        let mut out = self.strands.clone();
        self.chain.apply(&mut out, &self.bound(), 0).expect("a sound chain");
        let mut loss = 0.0;
        let mut weight: f64 = 0.1;
        for x in out.points_mut() {
            let w = DVec3::new(weight.sin(), (1.7 * weight).cos(), (2.3 * weight).sin());
            weight += 0.37;
            loss += (w * *x).element_sum() + 0.5 * (w * *x * *x).element_sum();
            *x = w + w * *x;
        }
        (loss, out)
    }

    /// Every number that goes in, to be changed.
    fn inputs(&mut self) -> Vec<&mut f64> {
        let points = self.strands.points_mut().iter_mut().chain(self.guides.points_mut());
        let coordinates = points.flat_map(|x| {
            let [a, b, c] = x.as_mut();
            [a, b, c]
        });
        let parameters = self.chain.operators.iter_mut().flat_map(Operator::values_mut);
        coordinates.chain(parameters).chain(self.numbers.iter_mut().flatten()).collect()
    }

    fn check(&mut self) {
        let (_, gradient) = self.loss_and_gradient();
        let gradients =
            self.chain.pull_back(&self.strands, &self.bound(), &gradient).expect("derivatives");
        let points = gradients.strands.points().iter().chain(gradients.guides.points());
        let exact: Vec<f64> = points
            .flat_map(|g| g.to_array())
            .chain(gradients.parameters.into_iter().flatten())
            .chain(gradients.numbers.into_iter().flatten())
            .collect();
        let scale = exact.iter().fold(1.0, |most: f64, g| most.max(g.abs()));
        let names: Vec<&str> = self.chain.operators.iter().map(Operator::name).collect();
        for (i, exact) in exact.iter().enumerate() {
            let at = |case: &mut Self, step: f64| {
                *case.inputs()[i] += step;
                let loss = case.loss_and_gradient().0;
                *case.inputs()[i] -= step;
                loss
            };
            let h = 1e-5;
            // Fourth order: the error is about h^4 and 1e-16 / h.
            let near = at(self, h) - at(self, -h);
            let far = at(self, 2.0 * h) - at(self, -2.0 * h);
            let difference = (8.0 * near - far) / (12.0 * h);
            assert!(
                (difference - exact).abs() < 2e-8 * scale,
                "{names:?} input {i}: {exact} against {difference}"
            );
        }
    }
}

fn operators() -> impl Strategy<Value = Vec<Operator>> {
    let bend = (5.0..170.0, 0.1..0.9);
    let curl = (0.05..0.5, 0.1..0.8, 0.01..0.09, 0.1..0.9);
    (0.1..0.9, 0.2..4.0, bend, curl, (0.3..2.0, 0.1..0.6), 0.1..0.8).prop_map(
        |(random, profile, bend, curl, frizz, amount)| {
            vec![
                Operator::Scale(Scale { random }),
                Operator::Clump(Clump { profile }),
                Operator::Bend(Bend { angle_degrees: bend.0, start: bend.1 }),
                Operator::Curl(Curl {
                    radius: curl.0,
                    frequency: curl.1,
                    random_frequency: curl.2,
                    start: curl.3,
                }),
                Operator::Frizz(Frizz { frequency: frizz.0, amplitude: frizz.1 }),
                // The span counts points: it has no derivative, and a step changes nothing.
                Operator::Straighten(Straighten { amount, span: 0.4 }),
            ]
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn every_operator_agrees_with_finite_differences(all in operators(), seed in 0_u64..1000) {
        for operator in all {
            for convention in [Convention::Paper, Convention::PublishedProgram] {
                Case::new(vec![operator.clone()], convention, seed).check();
            }
        }
    }

    #[test]
    fn chains_agree_with_finite_differences(all in operators(), seed in 0_u64..1000) {
        Case::new(all, Convention::Paper, seed).check();
    }
}

/// Coils of eight turns, a point every 15 degrees, that hang side by side.
fn coils(count: u32) -> EvenStrands {
    let point = |i: u32, j: u32| {
        let (sine, cosine) = (f64::from(j) * TAU / 24.0 + 0.3 * f64::from(i)).sin_cos();
        DVec3::new(f64::from(i) + 0.3 * cosine, -0.02 * f64::from(j), 0.3 * sine)
    };
    let points = (0..count).flat_map(|i| (0..193).map(move |j| point(i, j))).collect();
    EvenStrands::new(193, points).expect("whole strands")
}

fn length(strand: &[DVec3]) -> f64 {
    tress_geometry::polyline::length(strand)
}

/// Coils in groups of four, put through operators that have no derivative.
fn run(operators: &[Operator], strands: &EvenStrands, seed: u64) -> EvenStrands {
    let chain = Chain { convention: Convention::Paper, operators: operators.to_vec() };
    let groups = u32::try_from(strands.len().div_ceil(4)).expect("few");
    let operator_of: Vec<u32> = (0..groups).flat_map(|group| [group; 4]).collect();
    let guides = EvenStrands::zeros(strands.len().div_ceil(4), strands.points_each());
    let numbers = draw(operators, strands.len(), guides.len(), seed);
    let operator_of = &operator_of[..strands.len()];
    let bound = Bound { guides: &guides, operator_of, numbers: &numbers };
    let mut out = strands.clone();
    chain.apply(&mut out, &bound, seed).expect("a sound chain");
    out
}

/// One of each operator that has no derivative, set to keep lengths.
fn without_derivative() -> Vec<Operator> {
    let (each, keep) = (SkipUnit::Turns, SkipKeep::Length);
    vec![
        Operator::Recoil(tress_edit::RecoilOptions { radius: 0.8, ..Default::default() }),
        Operator::Ruffle(tress_edit::RuffleOptions { probability: 0.3, ..Default::default() }),
        Operator::Switchback(Switchback::default()),
        Operator::Skip(Skip { probability: 0.4, each, keep }),
    ]
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let mut operators = vec![
        Operator::Scale(Scale { random: 0.2 }),
        Operator::Clump(Clump { profile: 1.0 }),
        Operator::Bend(Bend { angle_degrees: 40.0, start: 0.3 }),
        Operator::Curl(Curl { radius: 0.1, frequency: 0.5, random_frequency: 0.1, start: 0.2 }),
        Operator::Frizz(Frizz { frequency: 3.0, amplitude: 0.2 }),
        Operator::Straighten(Straighten { amount: 0.3, span: 0.2 }),
    ];
    let (strands, guides) = (wandering(500, 3), wandering(3, 4));
    let operator_of: Vec<u32> = (0..500).map(|i| i % 3).collect();
    let on = |threads, operators: &[Operator]| {
        let numbers = draw(operators, 500, 3, 1);
        let chain = Chain { convention: Convention::Paper, operators: operators.to_vec() };
        let bound = Bound { guides: &guides, operator_of: &operator_of, numbers: &numbers };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mut out = strands.clone();
            chain.apply(&mut out, &bound, 0).expect("a sound chain");
            (chain.pull_back(&strands, &bound, &out).ok(), out)
        })
    };
    assert_eq!(on(1, &operators), on(3, &operators));
    operators.extend(without_derivative());
    let (gradients, out) = on(1, &operators);
    assert_eq!(gradients, None);
    assert_eq!((None, out), on(3, &operators));
}

#[test]
fn operators_without_derivative_keep_roots_and_lengths_and_say_the_same_again() {
    let coils = coils(8);
    for operator in without_derivative() {
        let chain = [operator.clone()];
        let out = run(&chain, &coils, 5);
        let name = operator.name();
        assert_eq!(out.roots(), coils.roots(), "{name}");
        assert_ne!(out, coils, "{name}");
        assert_eq!(out, run(&chain, &coils, 5), "{name}");
        let draws = matches!(operator, Operator::Ruffle(_) | Operator::Skip(_));
        assert_eq!(out != run(&chain, &coils, 6), draws, "{name}");
        for (before, after) in coils.iter().zip(out.iter()) {
            let change = length(after) / length(before) - 1.0;
            assert!(change.abs() < 0.01, "{name}: length changes by {change}");
        }
        // Twice in a chain, each draws its own numbers.
        if draws {
            let twice = run(&[operator.clone(), operator.clone()], &coils, 5);
            assert_ne!(twice, run(&chain, &out, 5), "{name}");
        }
    }
}

/// Which way a strand winds over some of its segments: above 0 to the right.
fn winding(points: &[DVec3]) -> f64 {
    let e: Vec<DVec3> = points.windows(2).map(|ends| ends[1] - ends[0]).collect();
    e.windows(3).map(|e| e[0].cross(e[1]).dot(e[2])).sum()
}

#[test]
fn coils_change_hands_where_they_are_told_to() {
    let coils = coils(4);
    let places = tress_switchback::Placing::Shares(vec![0.5]);
    let operator = Operator::Switchback(Switchback { places, ..Switchback::default() });
    let out = run(&[operator], &coils, 1);
    for (before, after) in coils.iter().zip(out.iter()) {
        let (hand, root, tip) =
            (winding(before).signum(), winding(&after[..40]), winding(&after[153..]));
        assert!(0.0 < hand * root && hand * tip < 0.0, "{root} at the root, {tip} at the tip");
    }
}

#[test]
fn strands_that_leave_turns_out_come_back_to_their_coil() {
    let coils = coils(4);
    let skip = Skip { probability: 0.5, ..Skip::default() };
    let out = run(&[Operator::Skip(skip)], &coils, 2);
    let mut patterns = Vec::new();
    for (before, after) in coils.iter().zip(out.iter()) {
        assert_eq!(before[192], after[192]);
        let stay: Vec<bool> = before.iter().zip(after).map(|(a, b)| a == b).collect();
        let same = stay.iter().filter(|stay| **stay).count();
        assert!((20..180).contains(&same), "{same} points stay");
        assert!(!patterns.contains(&stay), "every strand leaves out others");
        patterns.push(stay);
        assert!(length(after) < 0.95 * length(before));
    }
    // What keeps its length hangs lower; a strand without turns has none to leave out.
    let keep = SkipKeep::Length;
    let longer = run(&[Operator::Skip(Skip { keep, ..skip })], &coils, 2);
    for (strand, longer) in coils.iter().zip(longer.iter()) {
        assert!((length(longer) / length(strand) - 1.0).abs() < 1e-12);
        assert!(longer[192].y < strand[192].y - 0.5);
    }
    let lines = EvenStrands::new(9, (0..9).map(|j| f64::from(j) * DVec3::Z).collect());
    let lines = lines.expect("one strand");
    assert_eq!(run(&[Operator::Skip(Skip { probability: 1.0, ..skip })], &lines, 1), lines);
    let nowhere = EvenStrands::new(4, vec![DVec3::ONE; 4]).expect("one strand");
    for operator in without_derivative() {
        assert_eq!(run(&[operator], &nowhere, 1), nowhere);
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let operators = vec![Operator::Scale(Scale { random: 0.5 })];
    let case = Case::new(operators, Convention::Paper, 0);
    let mut strands = case.strands.clone();
    let mut apply = |bound: &Bound<'_>| case.chain.apply(&mut strands, bound, 0).unwrap_err();
    let short = EvenStrands::zeros(2, 3);
    let error = apply(&Bound { guides: &short, ..case.bound() });
    assert_eq!(error, ChainError::Points { guides: 3, strands: POINTS });
    let error = apply(&Bound { operator_of: &[0], ..case.bound() });
    assert_eq!(error, ChainError::Assigned { given: 1, strands: STRANDS });
    let error = apply(&Bound { operator_of: &[0, 0, 0, 9, 0], ..case.bound() });
    assert_eq!(error, ChainError::NoGuide { strand: 3, guide: 9, guides: GUIDES });
    let error = apply(&Bound { numbers: &[], ..case.bound() });
    assert_eq!(error, ChainError::Numbers { operator: 0, given: 0, expected: STRANDS });

    let mut wild = case.chain.clone();
    wild.operators[0] = Operator::Scale(Scale { random: 2.0 });
    assert!(matches!(wild.apply(&mut strands, &case.bound(), 0), Err(ChainError::Parameter(_))));
    let none = Bound { numbers: &[vec![]], ..case.bound() };
    for operator in without_derivative() {
        let name = operator.name();
        wild.operators[0] = operator;
        let error = wild.pull_back(&case.strands, &none, &case.strands);
        assert_eq!(error, Err(ChainError::NoDerivative(name)));
    }
    let places = tress_switchback::Placing::Shares(vec![1.5]);
    wild.operators[0] = Operator::Switchback(Switchback { places, ..Switchback::default() });
    let error = wild.apply(&mut strands, &none, 0).expect_err("beyond the tip");
    assert_eq!(error.to_string(), "switchback 0: a share of the strand is 1.5, expected 0 to 1");
}
