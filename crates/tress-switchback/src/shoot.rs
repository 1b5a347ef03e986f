//! Shooting from the middle of a symmetric solution out to its coil.
//!
//! The symmetry, the pull, the torque and the energy leave one number open in the middle. Out of
//! all middles the right one leads into the coil: its deviation has no growing part
//! ([`crate::tail`]). A wrong one is found out exponentially: an error of the start has grown by
//! `e^n` after `n` e-foldings while the solution has decayed by as much. So Newton's method is run
//! at a short distance first and at ever longer ones from there, each start as good as the last
//! distance could tell.
//!
//! At the longest distance what rounding has grown to and what the linearized tail leaves out are
//! alike, `1e-16 e^12` and `(e^-12)^2`: 1e-10 of the coil. The tail takes over from there.

use crate::Material;
use crate::rod::State;
use crate::tail::{Deviation, Tail};
use crate::taylor::Step;

/// Distances in e-foldings; the first must be short for poor starts, but long
/// enough for the growing part to mean something; the last is where rounding
/// meets the tail.
const DISTANCES: [f64; 4] = [3.0, 5.0, 8.0, 12.0];

/// Growing next to decaying part below which the next distance is tried.
const FURTHER: f64 = 0.2;

/// Change of the number by which its effect is measured.
const NUDGE: f64 = 1e-7;

/// Iterations at the last distance that make do with the response of the distance before.
const CARRIED: u32 = 3;

/// Growing part at the last distance, next to a decaying one of `e^-12` (6e-6).
const DONE: f64 = 1e-8;

/// Newton's iterations before a start is given up; good ones take 5 to 8.
const MOST_ITERATIONS: usize = 20;

/// How finely [`Half::settled`] looks, in e-foldings.
const SPACING: f64 = 0.02;

/// No walk takes as many steps (a `v` of 0.005 takes 1,000).
const MOST_STEPS: usize = 5_000;

/// Half of a symmetric solution, from the middle at 0 out to the coil.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Half {
    tail: Tail,
    /// The deviation from the coil where the steps end and the tail takes over.
    deviation: Deviation,
    length: f64,
    /// From the middle to the tail: centers ascend.
    steps: Vec<Step>,
}

impl Half {
    /// The number near to `start` whose middle leads into the coil, and what it leads along.
    pub(crate) fn shoot(
        material: &Material,
        tail: Tail,
        middle: impl Fn(f64) -> State,
        start: f64,
    ) -> Option<(f64, Self)> {
        let mut half = Self { tail, deviation: [0.0; 2], length: 0.0, steps: Vec::new() };
        let mut number = start;
        let mut response = [0.0; 2];
        let mut iterations = 0;
        for (i, folds) in DISTANCES.iter().enumerate() {
            let distance = folds / tail.decay();
            let last = i + 1 == DISTANCES.len();
            // So far out the equations are linear: the response grows as a deviation does.
            response = tail.grow_by(response, distance - half.length);
            let mut carried = if last { CARRIED } else { 0 };
            loop {
                let end = half.walk(material, &middle(number), distance)?;
                let (grown, decaying) = (tail.growing(&end), tail.decaying(&end));
                if last && size(grown) < DONE {
                    half.deviation = decaying;
                    return Some((number, half));
                }
                if carried == 0 {
                    let nudged = half.walk(material, &middle(number + NUDGE), distance)?;
                    let nudged = tail.growing(&nudged);
                    response = [0, 1].map(|i| (nudged[i] - grown[i]) / NUDGE);
                }
                carried = carried.saturating_sub(1);
                number -= dot(grown, response) / dot(response, response);
                iterations += 1;
                if MOST_ITERATIONS < iterations {
                    return None;
                }
                if !last && size(grown) < FURTHER * size(decaying) {
                    break;
                }
            }
        }
        None
    }

    /// The state at `0 <= s`.
    pub(crate) fn at(&self, s: f64) -> State {
        if self.length <= s {
            return self.tail.state(self.tail.decay_by(self.deviation, s - self.length));
        }
        let behind = self.steps.partition_point(|step| step.center <= s);
        self.steps[behind.max(1) - 1].at(s)
    }

    /// The distance beyond which the curvature stays within `threshold` of the coil's.
    pub(crate) fn settled(&self, threshold: f64) -> f64 {
        let coil = self.tail.state([0.0; 2]);
        let off = |s: f64| {
            let y = self.at(s);
            (0..3).map(|i| (y[i] - coil[i]).powi(2)).sum::<f64>().sqrt()
        };
        // Past the steps the linearized tail goes on; its envelope ends the search from outside.
        let envelope = size(self.deviation) * 10.0 / threshold;
        let farthest = self.length + envelope.max(1.0).ln() / self.tail.slowest();
        let spacing = SPACING / self.tail.decay();
        let mut s = farthest;
        while 0.0 < s && off(s) <= threshold {
            s -= spacing;
        }
        (s + spacing).min(farthest)
    }

    /// The state at a distance from the middle, and the steps that lead there; `None` where the
    /// rod runs away.
    fn walk(&mut self, material: &Material, middle: &State, distance: f64) -> Option<State> {
        self.steps.clear();
        self.length = distance;
        let (mut s, mut y) = (0.0, *middle);
        while self.steps.len() < MOST_STEPS {
            let step = Step::new(material, s, &y)?;
            self.steps.push(step);
            s += step.reach;
            if distance <= s {
                return Some(step.at(distance));
            }
            y = step.at(s);
        }
        None
    }
}

fn dot(a: Deviation, b: Deviation) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn size(a: Deviation) -> f64 {
    dot(a, a).sqrt()
}
