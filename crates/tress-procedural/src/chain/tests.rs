//! Derivatives of chains against finite differences, and what chains refuse.

use super::*;
use crate::{Bend, Clump, Curl, Frizz, Scale, Straighten, draw};
use proptest::prelude::*;

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

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let operators = vec![
        Operator::Clump(Clump { profile: 1.0 }),
        Operator::Curl(Curl { radius: 0.1, frequency: 0.5, random_frequency: 0.1, start: 0.2 }),
    ];
    let (strands, guides) = (wandering(500, 3), wandering(3, 4));
    let numbers = draw(&operators, 500, 3, 1);
    let chain = Chain { convention: Convention::Paper, operators };
    let operator_of: Vec<u32> = (0..500).map(|i| i % 3).collect();
    let bound = Bound { guides: &guides, operator_of: &operator_of, numbers: &numbers };
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mut out = strands.clone();
            chain.apply(&mut out, &bound, 0).expect("a sound chain");
            (chain.pull_back(&strands, &bound, &out).expect("derivatives"), out)
        })
    };
    assert_eq!(on(1), on(3));
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
    wild.operators[0] = Operator::Recoil(tress_edit::RecoilOptions::default());
    let none = Bound { numbers: &[vec![]], ..case.bound() };
    let error = wild.pull_back(&case.strands, &none, &case.strands);
    assert_eq!(error, Err(ChainError::NoDerivative("recoil")));
}

#[test]
fn operators_in_curvature_space_take_their_place_in_the_chain() {
    let options = tress_edit::RecoilOptions { radius: 0.5, ..Default::default() };
    let operators =
        vec![Operator::Recoil(options), Operator::Frizz(Frizz { frequency: 1.0, amplitude: 0.0 })];
    let case = Case::new(operators, Convention::Paper, 2);
    let mut out = case.strands.clone();
    case.chain.apply(&mut out, &case.bound(), 0).expect("a sound chain");
    assert_eq!(out.roots(), case.strands.roots());
    assert_ne!(out, case.strands);
}
