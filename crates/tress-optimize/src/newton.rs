//! Newton's step for the chain in `O(N)`, by dynamic programming from the tip.
//!
//! Levenberg-Marquardt leaves out `sum_k w_k r_k . d2S_k/dq2`, which is what stiffens a taut strand
//! against bending, and converges slowly where strands are pulled straight or anchors stay away.
//! With the world matrices `B_j`, `M_j` of the [`chain`](crate::chain), small changes `u_j` of the
//! unknowns before an element add up to one twist `(b, m) = sum (B u, M u)` of all that lies
//! beyond: a point `S` moves by `m + b x S`. To second order the loads `rho_k = w_k r_k` add
//!
//! `b^T T_j u_j`, `T_j = -[f]x M_j + N B_j`, `f = sum rho_k`, `N = sum [rho_k]x [S_k]x`,
//!
//! (sums over the controls beyond `j`) and for an element itself, to the order of its length,
//! `u^T B_j^T T_j u / 2`. The energy of the rest of the strand is therefore a quadratic form in the
//! twist alone, `P` and `p`, and each element is eliminated in turn (Riccati's recursion, as in
//! differential dynamic programming):
//!
//! `Q_uu = h + G^T P G + sym(B^T T)`, `Q_ux = G^T P + (T^T, 0)`, `G = (B, M)`,
//! `P <- P - Q_ux^T Q_uu^-1 Q_ux`.
//!
//! The step is Newton's (within the order of an element's own curvature), whatever the number of
//! controls. Where some `Q_uu` is not positive the energy is not convex there, and there is none.

use pulp::Simd;

use crate::chain::{Block, Chain};
use crate::lanes::{Lane, LaneMat3, LaneVec3, Mask};
use crate::normal::Normal;

/// The answer of one element to what lies before it: `u = at + by_turn b + by_move m`.
#[derive(Clone, Copy, Debug)]
struct Answer<S: Simd> {
    at: LaneVec3<S>,
    by_turn: LaneMat3<S>,
    by_move: LaneMat3<S>,
}

/// Memory of the recursion.
#[derive(Debug)]
pub(crate) struct Newton<S: Simd> {
    answers: Vec<Answer<S>>,
}

/// The energy of all that lies beyond, by the twist `(b, m)` that it is given.
#[derive(Clone, Copy)]
struct Beyond<S: Simd> {
    /// `P` in blocks; `turn_move` stands between `b` on the left and `m` on the right.
    turn: LaneMat3<S>,
    turn_move: LaneMat3<S>,
    moved: LaneMat3<S>,
    /// `p`.
    moment: LaneVec3<S>,
    force: LaneVec3<S>,
    /// `f` and `N`.
    load: LaneVec3<S>,
    lever: LaneMat3<S>,
}

/// `Q` of one element.
struct Stage<S: Simd> {
    own: LaneMat3<S>,
    by_turn: LaneMat3<S>,
    by_move: LaneMat3<S>,
    slope: LaneVec3<S>,
}

impl<S: Simd> Newton<S> {
    pub(crate) fn new() -> Self {
        Self { answers: Vec::new() }
    }

    /// Newton's step at `y`, where the chain was last walked; gives the step of each element in
    /// turn and says in which lanes it is one.
    #[inline(always)]
    pub(crate) fn step(
        &mut self,
        chain: &Chain<S>,
        normal: &Normal<S>,
        y: &[LaneVec3<S>],
        (c, h): (Lane<S>, Lane<S>),
        mut give: impl FnMut(usize, LaneVec3<S>),
    ) -> Mask<S> {
        let simd = chain.simd;
        let mut beyond = Beyond::nothing(simd);
        let mut convex = h.is(0.0).not();
        let mut held = chain.holds.len();
        let none = LaneVec3::zero(simd);
        let nothing = LaneMat3::zero(simd);
        self.answers.resize(y.len(), Answer { at: none, by_turn: nothing, by_move: nothing });
        for (j, (&y, answer)) in y.iter().zip(&mut self.answers).enumerate().rev() {
            let mut stage = beyond.stage(&chain.blocks[j], y * c, h);
            while 0 < held && chain.holds[held - 1].0 == j {
                held -= 1;
                let k = chain.holds[held].1;
                let point = &chain.points[k];
                let here = point.element.is(j as f64);
                let root_weight = here.keep(normal.root_weights[k]);
                let weight = root_weight * root_weight;
                let rho = normal.residuals[k] * root_weight;
                stage.hold(&point.held, point.position, rho, weight);
                beyond.hold(point.position, rho, weight);
            }
            let (inverse, positive) = stage.own.inverse_positive();
            convex = convex.and(positive);
            *answer = Answer {
                at: -inverse.apply(stage.slope),
                by_turn: inverse.times(&stage.by_turn).negated(),
                by_move: inverse.times(&stage.by_move).negated(),
            };
            beyond.eliminate(&stage, answer);
        }
        let (mut turn, mut moved) = (none, none);
        for (j, (answer, block)) in self.answers.iter().zip(&chain.blocks).enumerate() {
            let u = answer.at + answer.by_turn.apply(turn) + answer.by_move.apply(moved);
            turn += block.turning.apply(u);
            moved += block.moving.apply(u);
            give(j, u);
        }
        convex
    }
}

impl<S: Simd> Beyond<S> {
    #[inline(always)]
    fn nothing(simd: S) -> Self {
        let (v, m) = (LaneVec3::zero(simd), LaneMat3::zero(simd));
        Self { turn: m, turn_move: m, moved: m, moment: v, force: v, load: v, lever: m }
    }

    /// `Q` of an element before all this; `bent` is `c y`.
    #[inline(always)]
    fn stage(&self, block: &Block<S>, bent: LaneVec3<S>, h: Lane<S>) -> Stage<S> {
        let Block { turning, moving } = block;
        let by_turn = self.turn.times(turning).plus(&self.turn_move.times(moving));
        let by_move = self.turn_move.transposed_times(turning).plus(&self.moved.times(moving));
        let bending = self.lever.times(turning).minus(&moving.crossed_by(self.load));
        let own = turning.transposed_times(&by_turn).plus(&moving.transposed_times(&by_move));
        let loaded = turning.transposed_times(&bending);
        let own = own.plus(&loaded.plus(&loaded.transposed()).scaled(0.5)).plus_diagonal(h);
        Stage {
            own,
            by_turn: by_turn.plus(&bending).transposed(),
            by_move: by_move.transposed(),
            slope: bent
                + turning.apply_transposed(self.moment)
                + moving.apply_transposed(self.force),
        }
    }

    /// A control with its load joins what lies beyond.
    #[inline(always)]
    fn hold(&mut self, s: LaneVec3<S>, rho: LaneVec3<S>, weight: Lane<S>) {
        let spin = LaneMat3::cross(s * weight);
        self.moved = self.moved.plus_diagonal(weight);
        self.turn_move = self.turn_move.plus(&spin);
        // [S]^T [S] = -[S] [S].
        self.turn = self.turn.minus(&spin.crossed_by(s));
        self.moment += s.cross(rho);
        self.force += rho;
        self.load += rho;
        self.lever = self.lever.plus(&LaneMat3::cross(s).crossed_by(rho));
    }

    /// The element joins what lies beyond, having given its best answer.
    #[inline(always)]
    fn eliminate(&mut self, stage: &Stage<S>, answer: &Answer<S>) {
        self.turn = self.turn.plus(&stage.by_turn.transposed_times(&answer.by_turn));
        self.turn_move = self.turn_move.plus(&stage.by_turn.transposed_times(&answer.by_move));
        self.moved = self.moved.plus(&stage.by_move.transposed_times(&answer.by_move));
        self.moment += stage.by_turn.apply_transposed(answer.at);
        self.force += stage.by_move.apply_transposed(answer.at);
    }
}

impl<S: Simd> Stage<S> {
    /// A control on the element itself, which moves with `m + b x S + P u`.
    #[inline(always)]
    fn hold(&mut self, held: &LaneMat3<S>, s: LaneVec3<S>, rho: LaneVec3<S>, weight: Lane<S>) {
        let transposed = held.transposed();
        self.own = self.own.plus(&held.transposed_times(held).times_lane(weight));
        self.by_move = self.by_move.plus(&transposed.times_lane(weight));
        let turn = LaneMat3::cross(rho - s * weight);
        self.by_turn = self.by_turn.plus(&transposed.times(&turn));
        self.slope += transposed.apply(rho);
    }
}
