//! Integration by Taylor series of the rod's equations.
//!
//! Each product on the right-hand side has as its `n`-th coefficient the convolution of the
//! coefficients of its factors up to `n`; from these follows coefficient `n + 1` of the state. A
//! step is as long as the series is exact to rounding, so steps are long (about 3 in units of the
//! rest radius) and every step leaves a polynomial that gives the state anywhere on it.
//!
//! Jorba and Zou, "A software package for the numerical integration of ODEs by means of high-order
//! Taylor methods", Experimental Mathematics 14(1), 2005: how long a step may be.

use crate::Material;
use crate::rod::State;

/// Order of the series. Higher orders take longer steps, but each coefficient costs as many
/// products as its order: 16 to 28 take about the same time.
const ORDER: usize = 22;

/// What a step may be off, next to a state of size 1. Smaller only meets rounding.
const TOLERANCE: f64 = 1e-15;

/// No rod bends this sharply: beyond it a trajectory is running away and is stopped.
const LARGEST: f64 = 1e3;

/// One step: the state as a polynomial of the arc length from one of its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    /// Arc length about which the series is.
    pub(crate) center: f64,
    /// How far to either side it holds.
    pub(crate) reach: f64,
    /// Coefficients in ascending order.
    series: [State; ORDER + 1],
}

impl Step {
    /// The step about arc length `s`, where the state is `y`; `None` where it has run away.
    pub(crate) fn new(material: &Material, s: f64, y: &State) -> Option<Self> {
        if !y.iter().all(|value| value.abs() < LARGEST) {
            return None;
        }
        let series = series(material, y);
        let size = |n: usize| series[n].iter().fold(0.0, |m: f64, value| m.max(value.abs()));
        let scale = size(0).max(1e-3) * TOLERANCE;
        let reach = |n: usize| (scale / size(n).max(1e-300)).powf(1.0 / n as f64);
        Some(Self { center: s, reach: reach(ORDER).min(reach(ORDER - 1)), series })
    }

    /// The state at arc length `s`.
    pub(crate) fn at(&self, s: f64) -> State {
        let offset = s - self.center;
        let mut y = self.series[ORDER];
        for term in self.series[..ORDER].iter().rev() {
            for (value, coefficient) in y.iter_mut().zip(term) {
                *value = *value * offset + coefficient;
            }
        }
        y
    }
}

/// Coefficients of the solution through `y`.
fn series(material: &Material, y: &State) -> [State; ORDER + 1] {
    let gamma = material.torsional();
    let rest = gamma * material.rest_twist;
    let mut c = [[0.0; 6]; ORDER + 1];
    c[0] = *y;
    for n in 0..ORDER {
        let mut p = [0.0; 8];
        for j in 0..=n {
            let [k1, k2, _, f1, f2, f3] = c[j];
            let [l1, l2, l3, ..] = c[n - j];
            let products = [k2 * l3, k1 * l3, f2 * l3, f3 * l2, f3 * l1, f1 * l3, f1 * l2, f2 * l1];
            for (sum, product) in p.iter_mut().zip(products) {
                *sum += product;
            }
        }
        let [k1, k2, k3, f1, f2, _] = c[n];
        let slope = [
            f2 - (gamma - 1.0) * p[0] + rest * k2,
            -f1 + (gamma - 1.0) * p[1] + k3 - rest * k1,
            -k2 / gamma,
            p[2] - p[3],
            p[4] - p[5],
            p[6] - p[7],
        ];
        c[n + 1] = slope.map(|value| value / (n + 1) as f64);
    }
    c
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rod::{derivative, invariants};

    const START: State = [0.9, 0.2, -0.3, 0.1, -0.2, 0.4];

    fn material() -> Material {
        Material { poisson_ratio: 0.3, rest_twist: 0.2 }
    }

    #[test]
    fn the_polynomial_obeys_the_equations_over_its_reach() {
        let step = Step::new(&material(), 5.0, &START).expect("a tame state");
        assert!(0.3 < step.reach, "{}", step.reach);
        let h = 1e-4;
        for i in -8..=8 {
            let s = 5.0 + step.reach * f64::from(i) / 8.0;
            let (up, down) = (step.at(s + h), step.at(s - h));
            let rate = derivative(&material(), &step.at(s));
            for (k, rate) in rate.iter().enumerate() {
                assert!((rate - (up[k] - down[k]) / (2.0 * h)).abs() < 1e-7, "{s} {k}");
            }
        }
    }

    #[test]
    fn what_does_not_change_does_not_change() {
        let before = invariants(&material(), &START);
        let (mut s, mut y) = (0.0, START);
        while s < 200.0 {
            let step = Step::new(&material(), s, &y).expect("a tame state");
            s += step.reach;
            y = step.at(s);
        }
        let after = invariants(&material(), &y);
        for (a, b) in before.iter().zip(after) {
            assert!((a - b).abs() < 1e-13, "{before:?} {after:?}");
        }
    }

    #[test]
    fn runaways_are_stopped() {
        assert_eq!(Step::new(&material(), 0.0, &[1e4; 6]), None);
        assert_eq!(Step::new(&material(), 0.0, &[f64::NAN; 6]), None);
    }
}
