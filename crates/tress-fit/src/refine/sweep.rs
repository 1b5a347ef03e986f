//! One step of the refinement: the sweep from the tip, and the two ways back from the root.

use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};
use tress_geometry::{Element, Frame};

use super::motion::{Motion, gap, lean, moved};
use super::quadratic::{CurvatureGain, LengthGain, Quadratic, Transition};
use super::{Hold, Problem, Refiner, length_excess};
use crate::draft::Draft;

/// How an element answers, and what it does to deviations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gain {
    curvature: CurvatureGain,
    length: LengthGain,
    pub(super) transition: Transition,
    pub(super) gap: [f64; 5],
}

/// What a linear step changes: the state at a joint, and the element behind it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) state: [f64; 5],
    /// Of the Darboux vector, in the axes of the joint.
    pub(super) curvature: DVec3,
    pub(super) length: f64,
}

/// What holds a length to what it was, against the square of a distance: without it, joints
/// between like elements would wander.
pub(super) const LENGTH_DAMPING: f64 = 1e-2;

/// What holds a joint from sliding along the curve with its points, likewise.
pub(super) const SLIDE_DAMPING: f64 = 1e-1;

/// An element keeps at least and grows at most to these parts of its length in one step.
const LENGTH_BOUNDS: (f64, f64) = (0.3, 2.5);

impl Refiner {
    /// From tip to root: the best answer of every element to deviations of the state before it,
    /// and the best change of the first state and curvature.
    pub(super) fn sweep_back(
        &mut self,
        problem: Problem<'_>,
        draft: &Draft,
        damping: f64,
    ) -> [f64; 5] {
        Arch::new().dispatch(SweepBack { refiner: self, problem, draft, damping })
    }

    #[inline(always)]
    fn sweep_back_in_registers<S: Simd>(
        &mut self,
        simd: S,
        problem: Problem<'_>,
        draft: &Draft,
        damping: f64,
    ) -> [f64; 5] {
        let Problem { points, hold, settings } = problem;
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
            let mut cost = transition.pull_back(simd, &beyond, &gap);
            while hold == Hold::Nearest && 0 < left && draft.places[left - 1].0 == j {
                left -= 1;
                let motion = Motion::new(element, draft.places[left].1);
                let miss = frame.axes.transpose() * (frame.position - points[left]);
                for row in motion.across(miss) {
                    cost.add_square(simd, &row);
                }
            }
            cost.damp_curvature(damping * element.length.powi(4));
            let (cost, length) = if settings.lengths {
                let (excess, slope) = length_excess(element.length, self.drafted[j]);
                cost.add_length_square(slope, excess);
                cost.without_length(simd, LENGTH_DAMPING + damping)
            } else {
                cost.with_length_held()
            };
            self.gains[j] = Gain { length, transition, gap, ..Gain::STAY };
            if j == 0 {
                return cost.minimum(settings.root);
            }
            let before = draft.joints[j - 1].axes * draft.elements[j - 1].curvature;
            let jump = element.curvature - frame.axes.transpose() * before;
            let tie = settings.prior * self.ties[j];
            (beyond, self.gains[j].curvature) = cost.without_curvature(simd, tie, jump);
            if hold == Hold::Joints && 0 < left && draft.places[left - 1].0 == j {
                left -= 1;
                hold_joint(&mut beyond, frame, points[left]);
            } else {
                beyond.h[0][0] += SLIDE_DAMPING;
            }
        }
        [0.0; 5]
    }

    /// The linear step, from root to tip.
    pub(super) fn step_linearly(&mut self, draft: &Draft, start: &[f64; 5]) {
        self.steps.clear();
        let mut state = [0.0, 0.0, 0.0, start[0], start[1]];
        let mut first = Some(DVec3::new(start[2], start[3], start[4]));
        let mut before = DVec3::ZERO;
        for (nominal, gain) in draft.joints.iter().zip(&self.gains) {
            let (curvature, length) = gain.answer(&state, nominal, before, first.take());
            before = nominal.axes * curvature;
            self.steps.push(Step { state, curvature, length });
            state = gain.transition.carry(&state, curvature, length);
            for (state, gap) in state.iter_mut().zip(&gain.gap) {
                *state += gap;
            }
        }
        self.steps.push(Step { state, curvature: DVec3::ZERO, length: 0.0 });
    }

    /// Makes the trial of a part of the linear step: joints and elements move each by itself, and
    /// gaps that a whole step leaves are of second order.
    pub(super) fn take_part(&mut self, draft: &Draft, part: f64) {
        self.trial.joints.clear();
        self.trial.elements.clear();
        for (j, (nominal, step)) in draft.joints.iter().zip(&self.steps).enumerate() {
            let frame = moved(nominal, &step.state.map(|change| part * change));
            if let Some(old) = draft.elements.get(j) {
                let (curvature, length) = (part * step.curvature, part * step.length);
                self.trial.elements.push(changed(old, nominal, curvature, length, &frame));
            }
            self.trial.joints.push(frame);
        }
    }

    /// Makes the trial of the step on the true chain, from root to tip: each element answers the
    /// true state before it, and no gaps are left.
    pub(super) fn sweep_forth(&mut self, draft: &Draft, start: &[f64; 5]) {
        self.trial.joints.clear();
        self.trial.elements.clear();
        let mut frame = moved(&draft.joints[0], &[0.0, 0.0, 0.0, start[0], start[1]]);
        let mut first = Some(DVec3::new(start[2], start[3], start[4]));
        let mut before = DVec3::ZERO;
        self.trial.joints.push(frame);
        for (j, (old, nominal)) in draft.elements.iter().zip(&draft.joints).enumerate() {
            let into_axes = nominal.axes.transpose();
            let off = into_axes * (frame.position - nominal.position);
            let lean = lean(into_axes * frame.tangent());
            let state = [off.x, off.y, off.z, lean.x, lean.y];
            let (curvature, length) = self.gains[j].answer(&state, nominal, before, first.take());
            before = nominal.axes * curvature;
            let element = changed(old, nominal, curvature, length, &frame);
            frame = element.advance(&frame);
            self.trial.elements.push(element);
            self.trial.joints.push(frame);
        }
    }
}

/// The sweep from the tip, compiled for the registers of the machine that runs it: they are as wide
/// as rows of matrices. No result depends on their width.
struct SweepBack<'a> {
    refiner: &'a mut Refiner,
    problem: Problem<'a>,
    draft: &'a Draft,
    damping: f64,
}

impl WithSimd for SweepBack<'_> {
    type Output = [f64; 5];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; 5] {
        self.refiner.sweep_back_in_registers(simd, self.problem, self.draft, self.damping)
    }
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
    pub(super) fn answer(
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
    curvature: DVec3,
    length: f64,
    frame: &Frame,
) -> Element {
    let (least, most) = LENGTH_BOUNDS;
    let world = nominal.axes * (old.curvature + curvature);
    Element {
        curvature: frame.axes.transpose() * world,
        length: (old.length + length).max(least * old.length).min(most * old.length),
    }
}

/// Adds half the square of a joint's distance from a point, by the joint's deviations.
#[inline(always)]
fn hold_joint(cost: &mut Quadratic, joint: &Frame, point: DVec3) {
    let miss = joint.axes.transpose() * (joint.position - point);
    for (i, miss) in miss.to_array().into_iter().enumerate() {
        cost.h[i][i] += 1.0;
        cost.g[i] += miss;
    }
}
