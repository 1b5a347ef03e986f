//! Levenberg-Marquardt for a register of strands, with a factorisation the size of the controls.
//!
//! In the scaled unknowns `y` (see [`chain`](crate::chain)) the energy is `|r|^2 + c |y|^2` with
//! `3M` residuals `r_k = sqrt(w_k) (S_k - a_k)`. A step `d` solves, with `h = c + mu`,
//! `(J^T J + h I) d = -(J^T r + c y)`; by Woodbury's identity, and without a difference of nearly
//! equal numbers,
//!
//! `d = -(c/h) y - J^T rho`, `(J J^T + h I) rho = r - (c/h) J y`:
//!
//! one Cholesky factorisation of `3M x 3M` and one walk back along the strand. At `mu = 0` the new
//! `y` is `-J^T rho`, the shape of a rod under the forces `rho` at its control points.
//!
//! Anchors start where the points are and move on to their places by a fixed part after each
//! step (continuation), so that a strand morphs. A step that raises the energy is quartered until
//! it does not, and `mu` grows. Every lane decides for itself, and one that is done no longer
//! changes: lanes share the walks and nothing else.

use pulp::Simd;

use crate::chain::Chain;
use crate::lanes::{Lane, LaneVec3, MAX_LANES, Mask};
use crate::newton::Newton;
use crate::normal::Normal;
use crate::{Energy, Stop};

/// Anchors are moved to their places in no more steps than this.
const MAX_STAGES: f64 = 64.0;

/// Least `h`, in parts of the trace of `J J^T`: what rounding makes of a singular `J J^T`
/// stays below it, and a strand with `c = 0` is led by it.
const LEAST_DAMPING: f64 = 1e-12;

/// What `mu` starts from when a step fails, in the same parts.
const FIRST_DAMPING: f64 = 1e-3;

/// Steps that fail one after the other before a strand gives up: by then the step has been
/// quartered to a ten-millionth of itself.
const MAX_FAILURES: f64 = 12.0;

/// After this many failures the direction is given up: the next step is Levenberg-Marquardt's,
/// with all the damping that the failures brought.
const TURN_AFTER: f64 = 5.0;

/// A gradient no greater than what this part of the strand's extent pulls, were it the residual, is
/// nothing: rounding makes as much.
const NOTHING: f64 = 1e-13;

/// A rise of the energy by this part of it is rounding, not a failure; with 0, strands that are
/// all but done would be held up by it.
const ROUNDING: f64 = 1e-13;

/// A lane whose gradient falls by less than this in a step takes Newton's steps from then on: they
/// cost as much again.
const SLOW: f64 = 0.25;

/// An anchor this far off, in parts of the strand's extent, is still away.
const AWAY: f64 = 1e-3;

/// When the gradient of the anchors' term is this part of what it is for residuals in general,
/// forces on the controls balance.
const BALANCED: f64 = 1e-3;

/// When to stop and how far to go at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) tolerance: f64,
    /// Walks at most, at least one.
    pub(crate) walks: usize,
    pub(crate) continuation: f64,
}

/// What became of one lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub(crate) start: Energy,
    pub(crate) end: Energy,
    pub(crate) iterations: u32,
    pub(crate) stop: Stop,
    pub(crate) slow: bool,
    /// Length of the gradient at the end, and what it was measured by.
    pub(crate) gradient: f64,
    pub(crate) reference: f64,
    pub(crate) c: f64,
}

/// The solver: what it is asked, its memory, and each lane's progress.
#[derive(Debug)]
pub(crate) struct Levenberg<S: Simd> {
    /// Stiffness; a negative one is minus the stiffness in parts of the tip's mean compliance at
    /// the start.
    pub(crate) c: Lane<S>,
    /// Anchors relative to the roots, by control.
    pub(crate) anchors: Vec<LaneVec3<S>>,
    /// A gradient's length to measure by where it is greater than that at the start.
    pub(crate) reference: Lane<S>,
    /// The unknowns; in: where to start, out: the result.
    pub(crate) y: Vec<LaneVec3<S>>,
    /// Positions of the controls at `y`.
    pub(crate) positions: Vec<LaneVec3<S>>,
    pub(crate) normal: Normal<S>,
    newton: Newton<S>,
    trial: Vec<LaneVec3<S>>,
    step: Vec<LaneVec3<S>>,
    /// Positions of the controls at the start.
    begun: Vec<LaneVec3<S>>,
    /// Part of their way that the anchors have moved, and by how much they move on.
    way: Lane<S>,
    stride: Lane<S>,
    energy: Lane<S>,
    square: Lane<S>,
    /// `mu`.
    damping: Lane<S>,
    failures: Lane<S>,
    /// Walks of each lane.
    walks: [u32; MAX_LANES],
    gradient: Lane<S>,
    active: Mask<S>,
    /// Where the gradient falls too slowly for what the steps leave out; in and out.
    pub(crate) slow: Mask<S>,
    converged: Mask<S>,
    balanced: Mask<S>,
}

impl<S: Simd> Levenberg<S> {
    pub(crate) fn new(simd: S) -> Self {
        let zero = Lane::splat(simd, 0.0);
        let none = zero.below(zero);
        Self {
            c: zero,
            anchors: Vec::new(),
            reference: zero,
            y: Vec::new(),
            positions: Vec::new(),
            normal: Normal::new(),
            newton: Newton::new(),
            trial: Vec::new(),
            step: Vec::new(),
            begun: Vec::new(),
            way: zero,
            stride: zero,
            energy: zero,
            square: zero,
            damping: zero,
            failures: zero,
            walks: [0; MAX_LANES],
            gradient: zero,
            active: none,
            slow: none,
            converged: none,
            balanced: none,
        }
    }

    /// Minimises the energy of the first `used` lanes from `y` on.
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        chain: &mut Chain<S>,
        used: usize,
        limits: &Limits,
    ) -> [Outcome; MAX_LANES] {
        let simd = chain.simd;
        let one = Lane::splat(simd, 1.0);
        self.reset(chain, used);
        let mut start = [Energy::default(); MAX_LANES];
        for iteration in 0..limits.walks.max(1) {
            for ((trial, &y), &step) in self.trial.iter_mut().zip(&self.y).zip(&self.step) {
                *trial = y + LaneVec3::keep(self.active, step);
            }
            chain.walk(&self.trial);
            self.normal.assemble(chain);
            let active = self.active.keep(one).to_array();
            for (walks, active) in self.walks.iter_mut().zip(active) {
                *walks += u32::from(0.5 < active);
            }
            if iteration == 0 {
                start = self.start(chain, limits);
            }
            let better = self.judge(chain);
            self.advance(chain, better, limits);
            if !self.active.any() {
                break;
            }
            self.plan(chain, better);
        }
        self.outcomes(chain, start)
    }

    #[inline(always)]
    fn reset(&mut self, chain: &Chain<S>, used: usize) {
        let (simd, m) = (chain.simd, chain.points.len());
        let (zero, none) = (Lane::splat(simd, 0.0), LaneVec3::zero(simd));
        self.trial.clone_from(&self.y);
        self.step.clear();
        self.step.resize(self.y.len(), none);
        self.positions.clear();
        self.positions.resize(m, none);
        self.normal.resize(simd, m);
        self.energy = Lane::splat(simd, f64::INFINITY);
        (self.way, self.damping, self.failures) = (zero, zero, zero);
        self.walks = [0; MAX_LANES];
        self.active = Lane::from_fn(simd, |i| if i < used { 1.0 } else { 0.0 }).is(1.0);
        self.converged = zero.below(zero);
        self.balanced = self.converged;
    }

    /// After the first walk: the stiffness, how the anchors will move, and where it all starts.
    #[inline(always)]
    fn start(&mut self, chain: &Chain<S>, limits: &Limits) -> [Energy; MAX_LANES] {
        let simd = chain.simd;
        let zero = Lane::splat(simd, 0.0);
        self.c = zero.below(-self.c).select(-self.c * chain.tip_compliance * (1.0 / 3.0), self.c);
        self.begun.clear();
        self.begun.extend(chain.points.iter().map(|point| point.position));
        self.positions.clone_from(&self.begun);
        self.set_residuals(Lane::splat(simd, 1.0));
        let (gradient, _) = self.normal.gradients(chain, self.c, chain.square);
        self.reference = self.reference.max(gradient);
        let mut far = zero;
        for (k, &root_weight) in self.normal.root_weights.iter().enumerate() {
            let off = self.anchors[k] - self.begun[k];
            far = far.max(zero.below(root_weight).keep(off.dot(off)));
        }
        let (far, extent) = (far.sqrt().to_array(), chain.extent.to_array());
        self.stride = Lane::from_fn(simd, |i| {
            let stages = (far[i] / (limits.continuation * extent[i])).ceil();
            1.0 / if stages.is_finite() { stages.clamp(1.0, MAX_STAGES) } else { 1.0 }
        });
        let anchors = self.normal.square().to_array();
        let bending = (self.c * chain.square).to_array();
        std::array::from_fn(|i| Energy { anchors: anchors[i], bending: bending[i] })
    }

    /// Takes the trial over in the lanes where it is better, and says which.
    #[inline(always)]
    fn judge(&mut self, chain: &Chain<S>) -> Mask<S> {
        let mut anchors = Lane::splat(chain.simd, 0.0);
        for (k, point) in chain.points.iter().enumerate() {
            let off = (point.position - self.target(k, self.way)) * self.normal.root_weights[k];
            anchors += off.dot(off);
        }
        let energy = anchors + self.c * chain.square;
        let bound = self.energy * (1.0 + ROUNDING);
        let better = energy.at_most(bound).and(self.active);
        for (y, &trial) in self.y.iter_mut().zip(&self.trial) {
            *y = LaneVec3::select(better, trial, *y);
        }
        for (position, point) in self.positions.iter_mut().zip(&chain.points) {
            *position = LaneVec3::select(better, point.position, *position);
        }
        self.square = better.select(chain.square, self.square);
        better
    }

    /// Moves the anchors on where the step was good, and sees which lanes are done.
    #[inline(always)]
    fn advance(&mut self, chain: &Chain<S>, better: Mask<S>, limits: &Limits) {
        let simd = chain.simd;
        let (zero, one) = (Lane::splat(simd, 0.0), Lane::splat(simd, 1.0));
        let scale = self.normal.trace();
        let at_once = better.and(self.failures.is(0.0));
        let grown = (self.damping * 4.0).max(scale * FIRST_DAMPING);
        self.damping = at_once.select(self.damping * 0.25, better.select(self.damping, grown));
        let turned = self.failures.is(TURN_AFTER);
        self.failures = better.select(zero, self.failures + one);
        self.way = better.and(turned.not()).select((self.way + self.stride).min(one), self.way);
        self.set_residuals(self.way);
        let anchors = self.normal.square();
        self.energy = better.select(anchors + self.c * self.square, self.energy);
        let (gradient, pull) = self.normal.gradients(chain, self.c, self.square);
        let (arrived, failed) = (self.way.is(1.0).and(better), better.not());
        let slow = (self.gradient * SLOW).below(gradient).and(arrived);
        self.slow = self.slow.or(slow.and(turned.not())).or(failed);
        self.gradient = better.select(gradient, self.gradient);
        let nothing = chain.extent * scale.sqrt() * NOTHING;
        let small = gradient.at_most((self.reference * limits.tolerance).max(nothing));
        let done = small.and(self.way.is(1.0)).and(better);
        self.converged = self.converged.or(done);
        let away = (chain.extent * AWAY).below(anchors.sqrt());
        let balanced = pull.at_most((anchors * scale).sqrt() * BALANCED).and(away);
        self.balanced = self.balanced.or(done.and(balanced));
        let patient = self.failures.below(Lane::splat(simd, MAX_FAILURES));
        self.active = self.active.and(done.not()).and(patient);
    }

    /// The next step: a new one where the last was good, else a quarter of it.
    #[inline(always)]
    fn plan(&mut self, chain: &Chain<S>, better: Mask<S>) {
        let quarter = Lane::splat(chain.simd, 0.25);
        let least = self.normal.trace() * LEAST_DAMPING;
        let h = (self.c + self.damping).max(least);
        let (step, y) = (&mut self.step, &self.y);
        let fresh = better.and(self.active);
        // A step of nothing is taken, and the walk is back where the next one can be planned.
        let turn = self.failures.is(TURN_AFTER);
        let shorter = turn.select(Lane::splat(chain.simd, 0.0), quarter);
        self.slow = self.slow.and(turn.not());
        for step in step.iter_mut() {
            *step = *step * shorter;
        }
        let mut left = fresh;
        let slow = fresh.and(self.slow);
        if slow.any() {
            let trial = &mut self.trial;
            let convex = self.newton.step(chain, &self.normal, y, (self.c, h), |j, u| trial[j] = u);
            let good = slow.and(convex);
            for (step, &u) in step.iter_mut().zip(trial.iter()) {
                *step = LaneVec3::select(good, u, *step);
            }
            left = fresh.and(good.not());
        }
        if left.any() {
            self.normal.solve(chain, self.c, h);
            let kept = self.c / h;
            chain.pull(&self.normal.loads, |j, pulled| {
                step[j] = LaneVec3::select(left, -(y[j] * kept) - pulled, step[j]);
            });
        }
    }

    #[inline(always)]
    fn outcomes(&mut self, chain: &Chain<S>, start: [Energy; MAX_LANES]) -> [Outcome; MAX_LANES] {
        self.set_residuals(Lane::splat(chain.simd, 1.0));
        let one = Lane::splat(chain.simd, 1.0);
        let anchors = self.normal.square().to_array();
        let bending = (self.c * self.square).to_array();
        let (converged, balanced) = (self.converged.keep(one), self.balanced.keep(one));
        let (converged, balanced) = (converged.to_array(), balanced.to_array());
        let gradient = self.gradient.to_array();
        let (active, reference) = (self.active.keep(one).to_array(), self.reference.to_array());
        let (c, slow) = (self.c.to_array(), self.slow.keep(one).to_array());
        let counted = self.walks;
        let yes = |answer: f64| 0.5 < answer;
        std::array::from_fn(|i| Outcome {
            start: start[i],
            end: Energy { anchors: anchors[i], bending: bending[i] },
            iterations: counted[i],
            stop: match (yes(converged[i]), yes(balanced[i]), yes(active[i])) {
                (true, true, _) => Stop::LocalMinimum,
                (true, false, _) => Stop::Converged,
                (false, _, true) => Stop::MaxIterations,
                (false, _, false) => Stop::NoDescent,
            },
            slow: yes(slow[i]),
            gradient: gradient[i],
            reference: reference[i],
            c: c[i],
        })
    }

    /// Where anchor `k` is when it has come this part of its way.
    #[inline(always)]
    fn target(&self, k: usize, way: Lane<S>) -> LaneVec3<S> {
        let (begun, anchor) = (self.begun[k], self.anchors[k]);
        // At the end it is the anchor to the last bit.
        LaneVec3::select(way.is(1.0), anchor, begun + (anchor - begun) * way)
    }

    /// Residuals at `y` with the anchors this far on their way.
    #[inline(always)]
    fn set_residuals(&mut self, way: Lane<S>) {
        for k in 0..self.anchors.len() {
            let off = self.positions[k] - self.target(k, way);
            self.normal.residuals[k] = off * self.normal.root_weights[k];
        }
    }
}
