//! Dormand and Prince's embedded pair of orders 5 and 4, with interpolation between steps.
//!
//! Coefficients and interpolant as in Hairer, Norsett and Wanner, "Solving Ordinary Differential
//! Equations I", 2nd edition, II.5 and II.6.

use glam::DVec3;

use super::{Place, Singular};
use crate::Helicoid;

/// Rows of the tableau; the last is the solution of order 5, whose stage is the next step's first.
const A: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// The solution of order 5 less that of order 4.
const E: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// The interpolant's highest coefficient.
const D: [f64; 7] = [
    -12715105075.0 / 11282082432.0,
    0.0,
    87487479700.0 / 32700410799.0,
    -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0,
    -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0,
];

/// The flow may turn by this many radians in a step: well below pi, where cycles could no longer be
/// counted.
const GREATEST_TURN: f64 = 1.5;

/// Steps of a piece, at most: for two thousand turns, followed to a billionth.
const MOST_STEPS: usize = 200_000;

/// A step below this part of the length is stuck at the singular line.
const LEAST_STEP: f64 = 1e-9;

pub(super) fn walk(
    k: &Helicoid,
    start: Place,
    length: f64,
    error: f64,
    stops: &[f64],
    visit: &mut impl FnMut(usize, Place),
) -> Result<Place, Singular> {
    let mut here = start;
    let mut direction = k.direction(here.theta);
    let mut s = 0.0;
    let mut next = 0;
    while let Some(&stop) = stops.get(next)
        && stop <= 0.0
    {
        visit(next, here);
        next += 1;
    }
    let mut h = first_step(k, here, length);
    let mut steps = 0;
    while s < length {
        let ends = length <= s + h * (1.0 + 1e-12);
        if ends {
            h = length - s;
        }
        let tried = Step::take(k, here, direction, h);
        let ratio = if GREATEST_TURN < (tried.end.theta - here.theta).abs() {
            f64::INFINITY
        } else {
            tried.error / error
        };
        if ratio <= 1.0 {
            while let Some(&stop) = stops.get(next)
                && (ends || stop <= s + h)
            {
                let position = tried.at(((stop - s) / h).min(1.0));
                visit(next, Place { position, theta: here.theta });
                next += 1;
            }
            (here, direction) = (tried.end, tried.stages[6]);
            s = if ends { length } else { s + h };
        }
        steps += 1;
        h *= (0.9 * ratio.powf(-0.2)).clamp(0.2, 5.0);
        // A step that is not a number is no step either.
        let stuck = h.is_nan() || h <= LEAST_STEP * length || MOST_STEPS <= steps;
        if s < length && stuck {
            return Err(Singular(s));
        }
    }
    Ok(here)
}

/// A step in which the flow turns by a third of a radian, as far as one can tell at its start.
fn first_step(k: &Helicoid, here: Place, length: f64) -> f64 {
    let rate = k.curvatures(here.position, here.theta).map_or(f64::INFINITY, DVec3::length);
    (0.3 / rate).min(0.5 * length).max(10.0 * LEAST_STEP * length)
}

struct Step {
    from: DVec3,
    h: f64,
    stages: [DVec3; 7],
    end: Place,
    error: f64,
}

impl Step {
    fn take(k: &Helicoid, from: Place, direction: DVec3, h: f64) -> Self {
        let mut stages = [direction; 7];
        let mut end = from;
        for (i, row) in A.iter().enumerate() {
            let slope: DVec3 = row.iter().zip(&stages).map(|(&a, &stage)| a * stage).sum();
            let position = from.position + h * slope;
            end = Place { position, theta: k.theta_near(position, end.theta) };
            stages[i + 1] = k.direction(end.theta);
        }
        let difference: DVec3 = E.iter().zip(&stages).map(|(&e, &stage)| e * stage).sum();
        Self { from: from.position, h, stages, end, error: h * difference.length() }
    }

    /// The position at the part `t` of the step, 0 to 1.
    fn at(&self, t: f64) -> DVec3 {
        let whole = self.end.position - self.from;
        let first = self.h * self.stages[0] - whole;
        let second = whole - self.h * self.stages[6] - first;
        let third: DVec3 = D.iter().zip(&self.stages).map(|(&d, &stage)| d * stage).sum();
        let r = 1.0 - t;
        self.from + t * (whole + r * (first + t * (second + r * self.h * third)))
    }
}
