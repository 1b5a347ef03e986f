//! Refinement of a chain against points: Gauss-Newton on curvatures, lengths and root tangent.
//!
//! What is minimised is
//!
//! `sum_k |n_k|^2 + |r_tip|^2 + sum_j c_j |Omega_j - Omega_{j-1}|^2 + sum_j e_j^2`:
//!
//! `n_k` is the part of `S(lambda_k) - p_k` across the curve, so that points slide along it and
//! arc length is no hidden error; only the last point holds the tip. The prior ties the Darboux
//! vectors of neighbours. With `h` the neighbours' mean length and `d` the distance of points
//! there, `c = w d^5 / h`, which makes the weight `w` a pure number: 1 weighs the shift that a
//! jump of curvature brings about from one point to the next as much as a point missed by that
//! shift, however finely elements are cut. The last sum keeps elements from winding up between
//! points: an element drafted with the length `l0` costs `e = sqrt(v) (l - l0)^2 / l0`, next to
//! nothing while it moves by a tenth and a point's worth when it grows a loop.
//!
//! # The solver
//!
//! The Jacobian of a chain is block lower triangular, so normal equations by the unknowns are
//! dense. But the chain is a control problem: a joint's state is `x` (position and tangent),
//! an element's curvature and length are controls, and each residual knows one state and one
//! control only. Gauss-Newton's step then comes from dynamic programming (a Riccati recursion):
//! one sweep from the tip, carrying the cost of all that lies beyond as a quadratic of eight
//! variables, and one sweep back from the root. That is `O(N + K)` for `N` elements and `K`
//! points, and the same step as the dense one.
//!
//! The start need not be a chain at all: joints may be where the points say, with gaps between an
//! element's end and the next joint, which each step closes to first order (multiple shooting).
//! So an error near the root does not swing the tip, and this is what keeps the step out of the
//! local minima that a plain step on curvatures ends in. Of a step that gains nothing a part is
//! taken, and after that the damping rises. The last sweep is done on the true, nonlinear chain,
//! and the controls answer where it departs from the linear one (as in differential dynamic
//! programming): it leaves no gaps.

mod motion;
mod place;
mod quadratic;
mod sweep;

use glam::DVec3;
use tress_geometry::{Element, Frame};

use crate::Refine;
use crate::draft::Draft;
use crate::measure::coil_radius;
use motion::tan_square;
use place::slide;
use sweep::{Gain, Step};

/// How points hold the chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hold {
    /// Each point holds the joint where the draft has its place.
    Joints,
    /// A point holds the place of the chain nearest to it.
    Nearest,
}

/// What is refined, and against what.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Problem<'a> {
    pub(crate) points: &'a [DVec3],
    pub(crate) hold: Hold,
    pub(crate) settings: &'a Refine,
}

/// Memory that the refinement of one strand after the other works in.
#[derive(Debug, Default)]
pub(crate) struct Refiner {
    gains: Vec<Gain>,
    steps: Vec<Step>,
    /// `c_j / w` of the joints between elements; the first is not used.
    ties: Vec<f64>,
    /// The lengths that elements were drafted with.
    drafted: Vec<f64>,
    trial: Draft,
}

/// The least part of the cost that a step must gain for another to be worth its time.
const WORTHWHILE: f64 = 3e-2;

/// Below this, for a strand of size 1, cost is rounding.
const ROUNDING: f64 = 1e-28;

/// The weight `v` of the lengths that elements were drafted with. A tenth of it, and elements of
/// frizzy strands wind up between points; ten times, and they cannot go where curvature changes.
const LENGTH_WEIGHT: f64 = 1e-2;

/// First damping of curvatures, as a part of what a point at an element's end asks; it falls with
/// every whole step that gains and rises with every one of which no part does.
const FIRST_DAMPING: f64 = 1e-3;

/// A step that gains little under less damping than this has arrived.
const UNDAMPED: f64 = 1e-3;

/// Parts of a step that are tried before it is damped more. A part costs a third of a new step.
const PARTS: [f64; 3] = [1.0, 0.4, 0.16];

/// When gaps are closed the cost may grow by this; more, and the chain has left the points.
const CLOSED: f64 = 1.5;

/// Dampings under which closing is tried: a stiffer chain follows where a limp one swings.
const CLOSING: [f64; 3] = [UNDAMPED, 1e-1, 1e-5];

/// A root mean square distance beyond this part of the coil radius may be a local minimum.
const STUCK: f64 = 0.1;

impl Refiner {
    /// Refines a draft; it becomes a true chain. Returns its cost.
    pub(crate) fn refine(&mut self, problem: Problem<'_>, draft: &mut Draft) -> f64 {
        let open = self.approach(problem, draft);
        self.close(problem, draft, open)
    }

    /// Steps towards the least cost, which leave gaps that vanish with them; returns the cost.
    pub(crate) fn approach(&mut self, problem: Problem<'_>, draft: &mut Draft) -> f64 {
        self.tie(draft);
        let mut damping = FIRST_DAMPING;
        let mut cost = self.cost(problem, draft);
        let mut little_before = false;
        for _ in 0..problem.settings.steps {
            let start = self.sweep_back(problem, draft, damping);
            self.step_linearly(draft, &start);
            let Some((reached, part)) = self.best_part(problem, draft, cost) else {
                damping *= 10.0;
                continue;
            };
            let gained = cost - reached;
            std::mem::swap(draft, &mut self.trial);
            cost = reached;
            if cost < ROUNDING {
                break;
            }
            let whole = part == PARTS[0];
            let little = whole && gained <= WORTHWHILE * cost && damping <= UNDAMPED;
            // Far from the points one small gain may be a pass, not the valley's floor.
            if little && (little_before || is_near(cost, problem.points.len(), draft)) {
                break;
            }
            little_before = little;
            if whole {
                damping *= 0.1;
            }
        }
        cost
    }

    /// Makes the trial of the largest part of the step that gains; its cost and that part.
    fn best_part(&mut self, problem: Problem<'_>, draft: &Draft, cost: f64) -> Option<(f64, f64)> {
        PARTS.into_iter().find_map(|part| {
            self.take_part(draft, part);
            let reached = self.cost_of_trial(problem, draft);
            (reached < cost).then_some((reached, part))
        })
    }

    /// A last step that leaves no gaps; returns the cost. `open` is that before it.
    fn close(&mut self, problem: Problem<'_>, draft: &mut Draft, open: f64) -> f64 {
        let mut best = (f64::INFINITY, Draft::default());
        for damping in CLOSING {
            let start = self.sweep_back(problem, draft, damping);
            self.sweep_forth(draft, &start);
            let cost = self.cost_of_trial(problem, draft);
            if cost < best.0 || best.1.elements.is_empty() {
                best.0 = cost;
                std::mem::swap(&mut best.1, &mut self.trial);
            }
            if best.0 <= CLOSED * open + ROUNDING {
                break;
            }
        }
        *draft = best.1;
        best.0
    }

    /// The cost of a draft; its points are brought to their places.
    fn cost(&mut self, problem: Problem<'_>, draft: &mut Draft) -> f64 {
        self.trial.clone_from(draft);
        let cost = self.cost_of_trial(problem, draft);
        std::mem::swap(draft, &mut self.trial);
        cost
    }

    /// The cost of the trial, whose points are brought to their places from those of `draft`.
    fn cost_of_trial(&mut self, problem: Problem<'_>, draft: &Draft) -> f64 {
        let Draft { joints, elements, places } = &mut self.trial;
        let n = elements.len();
        if !joints[n].position.is_finite() {
            return f64::INFINITY;
        }
        let points = problem.points;
        let tip = points.len() - 1;
        let mut cost = joints[n].position.distance_squared(points[tip]);
        places.clear();
        let mut floor = (0, 0.0);
        for (&point, &start) in points.iter().zip(&draft.places).take(tip) {
            if problem.hold == Hold::Joints {
                cost += joints[start.0].position.distance_squared(point);
                places.push(start);
                continue;
            }
            let (place, square) = slide(joints, elements, point, start, floor);
            places.push(place);
            floor = place;
            cost += square;
        }
        places.push((n - 1, elements[n - 1].length));
        for (j, element) in elements.iter().enumerate() {
            if 0 < j {
                let before = joints[j - 1].axes * elements[j - 1].curvature;
                let jump = joints[j].axes * element.curvature - before;
                cost += problem.settings.prior * self.ties[j] * jump.length_squared();
            }
            let (excess, _) = length_excess(element.length, self.drafted[j]);
            cost += excess * excess + gap_square(element, &joints[j], &joints[j + 1]);
        }
        cost
    }

    /// The weights that tie neighbouring elements, and the lengths that are kept to.
    fn tie(&mut self, draft: &Draft) {
        let mut held = vec![0.0; draft.elements.len()];
        for &(i, _) in &draft.places {
            held[i] += 1.0;
        }
        self.ties.clear();
        self.ties.push(0.0);
        for (pair, held) in draft.elements.windows(2).zip(held.windows(2)) {
            let both = pair[0].length + pair[1].length;
            let (h, d) = (0.5 * both, both / f64::max(1.0, held[0] + held[1]));
            self.ties.push(d.powi(5) / h);
        }
        self.drafted.clear();
        self.drafted.extend(draft.elements.iter().map(|element| element.length));
    }
}

/// How far the end of an element is from the joint behind it, squared.
fn gap_square(element: &Element, start: &Frame, joint: &Frame) -> f64 {
    let end = element.advance(start);
    let lean = tan_square(end.tangent(), joint.tangent());
    end.position.distance_squared(joint.position) + element.length * element.length * lean
}

/// The residual `e` of an element's length, and its derivative by the length.
fn length_excess(length: f64, drafted: f64) -> (f64, f64) {
    if drafted <= 0.0 {
        return (0.0, 0.0);
    }
    let weight = LENGTH_WEIGHT.sqrt();
    let change = (length - drafted) / drafted;
    (weight * drafted * change * change, 2.0 * weight * change)
}

/// Whether a cost is that of a chain that follows the points round their coil.
pub(crate) fn is_near(cost: f64, n_points: usize, draft: &Draft) -> bool {
    let stuck = STUCK * coil_radius(&draft.elements);
    stuck <= 0.0 || cost <= stuck * stuck * n_points as f64
}

#[cfg(test)]
mod tests;
