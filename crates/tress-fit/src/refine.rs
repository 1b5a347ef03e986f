//! Refinement of a chain against points: Gauss-Newton on curvatures, lengths and root tangent.
//!
//! What is minimised is
//!
//! `sum_k |n_k|^2 + |r_tip|^2 + sum_j c_j |Omega_j - Omega_{j-1}|^2`:
//!
//! `n_k` is the part of `S(lambda_k) - p_k` across the curve, so that points slide along it and
//! arc length is no hidden error; only the last point holds the tip. The prior ties the Darboux
//! vectors of neighbours. With `h` the neighbours' mean length and `d` the distance of points
//! there, `c = w d^5 / h`, which makes the weight `w` a pure number: 1 weighs the shift that a
//! jump of curvature brings about from one point to the next as much as a point missed by that
//! shift, however finely elements are cut.
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
//! The sweep back is done on the true, nonlinear chain, and the controls answer where it departs
//! from the linear one (as in differential dynamic programming). So an error near the root does
//! not swing the tip, and the start need not be a chain at all: joints may be where the points
//! say, with gaps between an element's end and the next joint. This is what keeps the step out of
//! the local minima that a plain step on curvatures ends in.

mod motion;
mod place;
mod quadratic;

use glam::DVec3;
use tress_geometry::{Element, Frame};

use crate::Refine;
use crate::draft::Draft;
use crate::measure::coil_radius;
use motion::{Motion, gap, moved};
use place::slide;
use quadratic::{CurvatureGain, LengthGain, Quadratic, Transition};

/// How points hold the chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hold {
    /// Point `k` holds joint `k`; there is one joint a point.
    Joints,
    /// A point holds the place of the chain nearest to it.
    Nearest,
}

/// Memory that the refinement of one strand after the other works in.
#[derive(Debug, Default)]
pub(crate) struct Refiner {
    gains: Vec<Gain>,
    /// `c_j / w` of the joints between elements; the first is not used.
    ties: Vec<f64>,
    trial: Draft,
}

/// How an element answers, and what it does to deviations.
#[derive(Clone, Copy, Debug)]
struct Gain {
    curvature: CurvatureGain,
    length: LengthGain,
    transition: Transition,
    gap: [f64; 5],
}

/// The least part of the cost that a step must gain for another to be worth its time.
const WORTHWHILE: f64 = 3e-2;

/// Below this, for a strand of size 1, cost is rounding.
const ROUNDING: f64 = 1e-28;

/// What holds a length to what it was, against the square of a distance: without it, joints
/// between like elements would wander.
const LENGTH_DAMPING: f64 = 1e-2;

/// What holds a joint from sliding along the curve with its points, likewise.
const SLIDE_DAMPING: f64 = 1e-1;

/// First damping of curvatures, as a part of what a point at an element's end asks; it falls with
/// every step that gains and rises with every one that does not.
const FIRST_DAMPING: f64 = 1e-3;

/// A step that gains little under less damping than this has arrived.
const UNDAMPED: f64 = 1e-3;

/// First and last weights of the prior, in units of the one asked for, one pair an attempt; from
/// the first the weight falls by [`EASING`] a step. Nearly every strand needs the first attempt
/// only. A stiff chain first finds the run of a strand and only then its turns one by one.
const ATTEMPTS: [(f64, f64); 5] = [(1.0, 1.0), (1e2, 1.0), (10.0, 10.0), (1e2, 10.0), (1e4, 1e2)];

/// See [`ATTEMPTS`].
const EASING: f64 = 0.1;

/// When gaps are closed the cost may grow by this; more, and the chain has left the points.
const CLOSED: f64 = 1.5;

/// A root mean square distance beyond this part of the coil radius may be a local minimum.
const STUCK: f64 = 0.1;

/// An element keeps at least and grows at most to these parts of its length in one step.
const LENGTH_BOUNDS: (f64, f64) = (0.3, 2.5);

impl Refiner {
    /// Refines a draft of `points`; it becomes a true chain. Returns its cost.
    pub(crate) fn refine(
        &mut self,
        points: &[DVec3],
        draft: &mut Draft,
        hold: Hold,
        settings: &Refine,
    ) -> f64 {
        let mut best = (f64::INFINITY, Draft::default());
        for weights in ATTEMPTS {
            let mut attempt = draft.clone();
            let open = self.approach(points, &mut attempt, hold, settings, weights);
            let closed = self.close(points, &mut attempt, hold, weights.1, settings);
            if closed < best.0 || best.1.elements.is_empty() {
                best = (closed, attempt);
            }
            if is_near(closed, points.len(), draft) && closed <= CLOSED * open + ROUNDING {
                break;
            }
        }
        *draft = best.1;
        best.0
    }

    /// Steps towards the least cost, which leave gaps that vanish with them; returns the cost.
    pub(crate) fn approach(
        &mut self,
        points: &[DVec3],
        draft: &mut Draft,
        hold: Hold,
        settings: &Refine,
        (first, last): (f64, f64),
    ) -> f64 {
        self.tie(draft);
        let mut damping = FIRST_DAMPING;
        let mut prior = first * settings.prior;
        let last = last * settings.prior;
        let mut cost = self.cost(points, draft, hold, prior);
        // Whoever is eased in has been in trouble, and gets time.
        let (steps, worthwhile) = if last < prior {
            (3 * settings.steps, 0.1 * WORTHWHILE)
        } else {
            (settings.steps, WORTHWHILE)
        };
        for _ in 0..steps {
            let start = self.sweep_back(points, draft, hold, prior, damping, settings);
            self.step_joints(draft, &start);
            let reached = self.cost_of_trial(points, draft, hold, prior);
            if reached.is_nan() || cost <= reached {
                damping *= 10.0;
                continue;
            }
            let arrived = cost - reached <= worthwhile * cost && damping <= UNDAMPED;
            std::mem::swap(draft, &mut self.trial);
            cost = reached;
            damping *= 0.1;
            if last < prior {
                prior = f64::max(EASING * prior, last);
                cost = self.cost(points, draft, hold, prior);
            } else if arrived || cost < ROUNDING {
                break;
            }
        }
        cost
    }

    /// A last step that leaves no gaps; returns the cost.
    fn close(
        &mut self,
        points: &[DVec3],
        draft: &mut Draft,
        hold: Hold,
        weight: f64,
        settings: &Refine,
    ) -> f64 {
        let prior = weight * settings.prior;
        let start = self.sweep_back(points, draft, hold, prior, UNDAMPED, settings);
        self.sweep_forth(draft, &start);
        let cost = self.cost_of_trial(points, draft, hold, prior);
        std::mem::swap(draft, &mut self.trial);
        cost
    }

    /// The cost of a draft; its points are brought to their places.
    fn cost(&mut self, points: &[DVec3], draft: &mut Draft, hold: Hold, prior: f64) -> f64 {
        self.trial.clone_from(draft);
        let cost = self.cost_of_trial(points, draft, hold, prior);
        std::mem::swap(draft, &mut self.trial);
        cost
    }

    /// The cost of the trial, whose points are brought to their places from those of `draft`.
    fn cost_of_trial(&mut self, points: &[DVec3], draft: &Draft, hold: Hold, prior: f64) -> f64 {
        let Draft { joints, elements, places } = &mut self.trial;
        let n = elements.len();
        if !joints[n].position.is_finite() {
            return f64::INFINITY;
        }
        let tip = points.len() - 1;
        let mut cost = joints[n].position.distance_squared(points[tip]);
        places.clear();
        match hold {
            Hold::Joints => {
                let pairs = joints.iter().zip(points).take(tip);
                cost += pairs.map(|(j, p)| j.position.distance_squared(*p)).sum::<f64>();
                places.extend((0..tip).map(|k| (k, 0.0)));
            }
            Hold::Nearest => {
                let mut floor = (0, 0.0);
                for (&point, &start) in points.iter().zip(&draft.places).take(tip) {
                    let (place, square) = slide(joints, elements, point, start, floor);
                    places.push(place);
                    floor = place;
                    cost += square;
                }
            }
        }
        places.push((n - 1, elements[n - 1].length));
        for (j, element) in elements.iter().enumerate() {
            if 0 < j {
                let before = joints[j - 1].axes * elements[j - 1].curvature;
                let jump = joints[j].axes * element.curvature - before;
                cost += prior * self.ties[j] * jump.length_squared();
            }
            let end = element.advance(&joints[j]);
            let lean = end.tangent().distance_squared(joints[j + 1].tangent());
            cost += end.position.distance_squared(joints[j + 1].position);
            cost += element.length * element.length * lean;
        }
        cost
    }

    /// The weights that tie neighbouring elements.
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
    }

    /// From tip to root: the best answer of every element to deviations of the state before it,
    /// and the best change of the first state and curvature.
    fn sweep_back(
        &mut self,
        points: &[DVec3],
        draft: &Draft,
        hold: Hold,
        prior: f64,
        damping: f64,
        settings: &Refine,
    ) -> [f64; 5] {
        let n = draft.elements.len();
        self.gains.resize(n, Gain::STAY);
        let mut beyond = Quadratic::ZERO;
        // The last point holds the tip.
        let mut left = points.len() - 1;
        hold_joint(&mut beyond, &draft.joints[n], points[left]);
        for j in (0..n).rev() {
            let (frame, element) = (&draft.joints[j], &draft.elements[j]);
            let whole = Motion::new(element, element.length);
            let gap = gap(frame, &whole, &draft.joints[j + 1]);
            let transition = whole.transition(frame, element.curvature, &draft.joints[j + 1]);
            let mut cost = transition.pull_back(&beyond, &gap);
            while hold == Hold::Nearest && 0 < left && draft.places[left - 1].0 == j {
                left -= 1;
                let motion = Motion::new(element, draft.places[left].1);
                let miss = frame.axes.transpose() * (frame.position - points[left]);
                for row in motion.across(miss) {
                    cost.add_square(&row);
                }
            }
            cost.damp_curvature(damping * element.length.powi(4));
            let (cost, length) = if settings.lengths {
                cost.without_length(LENGTH_DAMPING + damping)
            } else {
                cost.with_length_held()
            };
            self.gains[j] = Gain { length, transition, gap, ..Gain::STAY };
            if j == 0 {
                return cost.minimum(settings.root);
            }
            let before = draft.joints[j - 1].axes * draft.elements[j - 1].curvature;
            let jump = element.curvature - frame.axes.transpose() * before;
            (beyond, self.gains[j].curvature) = cost.without_curvature(prior * self.ties[j], jump);
            match hold {
                Hold::Joints => hold_joint(&mut beyond, frame, points[j]),
                Hold::Nearest => beyond.h[0][0] += SLIDE_DAMPING,
            }
        }
        [0.0; 5]
    }

    /// The linear step from root to tip: joints and elements move each by itself, and gaps that are
    /// left are of second order.
    fn step_joints(&mut self, draft: &Draft, start: &[f64; 5]) {
        self.trial.joints.clear();
        self.trial.elements.clear();
        let mut state = [0.0, 0.0, 0.0, start[0], start[1]];
        let mut first = Some(DVec3::new(start[2], start[3], start[4]));
        let mut world_change = DVec3::ZERO;
        for (j, (old, nominal)) in draft.elements.iter().zip(&draft.joints).enumerate() {
            let gain = &self.gains[j];
            let frame = moved(nominal, &state);
            let (change, change_length) = gain.answer(&state, nominal, world_change, first.take());
            world_change = nominal.axes * change;
            self.trial.elements.push(changed(old, nominal, change, change_length, &frame));
            self.trial.joints.push(frame);
            state = gain.transition.carry(&state, change, change_length);
            for (state, gap) in state.iter_mut().zip(&gain.gap) {
                *state += gap;
            }
        }
        self.trial.joints.push(moved(&draft.joints[draft.elements.len()], &state));
    }

    /// The step on the true chain, from root to tip: each element answers the true state before
    /// it, and no gaps are left.
    fn sweep_forth(&mut self, draft: &Draft, start: &[f64; 5]) {
        self.trial.joints.clear();
        self.trial.elements.clear();
        let mut frame = moved(&draft.joints[0], &[0.0, 0.0, 0.0, start[0], start[1]]);
        let mut first = Some(DVec3::new(start[2], start[3], start[4]));
        let mut world_change = DVec3::ZERO;
        self.trial.joints.push(frame);
        for (j, (old, nominal)) in draft.elements.iter().zip(&draft.joints).enumerate() {
            let into_axes = nominal.axes.transpose();
            let off = into_axes * (frame.position - nominal.position);
            let lean = into_axes * frame.tangent();
            let state = [off.x, off.y, off.z, lean.y, lean.z];
            let (change, change_length) =
                self.gains[j].answer(&state, nominal, world_change, first.take());
            world_change = nominal.axes * change;
            let element = changed(old, nominal, change, change_length, &frame);
            frame = element.advance(&frame);
            self.trial.elements.push(element);
            self.trial.joints.push(frame);
        }
    }
}

/// Whether a cost is that of a chain that follows the points round their coil.
pub(crate) fn is_near(cost: f64, n_points: usize, draft: &Draft) -> bool {
    let stuck = STUCK * coil_radius(&draft.elements);
    stuck <= 0.0 || cost <= stuck * stuck * n_points as f64
}

impl Gain {
    /// No answer.
    const STAY: Self = Self {
        curvature: CurvatureGain { slope: [[0.0; 8]; 3], value: [0.0; 3] },
        length: LengthGain { slope: [0.0; 8], value: 0.0 },
        transition: Transition::NONE,
        gap: [0.0; 5],
    };

    /// The changes of Darboux vector and length: `given` for the first, and else the best for this
    /// state and the change `before` of the element before, a vector of the world.
    fn answer(
        &self,
        &[x, y, z, u, v]: &[f64; 5],
        nominal: &Frame,
        before: DVec3,
        given: Option<DVec3>,
    ) -> (DVec3, f64) {
        let w = nominal.axes.transpose() * before;
        let change =
            given.unwrap_or_else(|| self.curvature.answer(&[x, y, z, u, v, w.x, w.y, w.z]));
        let w = change;
        (change, self.length.answer(&[x, y, z, u, v, w.x, w.y, w.z]))
    }
}

/// An element with its changes, which are in the axes of the nominal frame, in those of `frame`.
fn changed(
    old: &Element,
    nominal: &Frame,
    change: DVec3,
    change_length: f64,
    frame: &Frame,
) -> Element {
    let (least, most) = LENGTH_BOUNDS;
    let world = nominal.axes * (old.curvature + change);
    Element {
        curvature: frame.axes.transpose() * world,
        length: (old.length + change_length).max(least * old.length).min(most * old.length),
    }
}

/// Adds half the square of a joint's distance from a point, by the joint's deviations.
fn hold_joint(cost: &mut Quadratic<8>, joint: &Frame, point: DVec3) {
    let miss = joint.axes.transpose() * (joint.position - point);
    for (i, miss) in miss.to_array().into_iter().enumerate() {
        cost.h[i][i] += 1.0;
        cost.g[i] += miss;
    }
}

#[cfg(test)]
mod tests;
