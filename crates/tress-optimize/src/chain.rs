//! The chain and its derivatives for a register of strands at once, without a Jacobian.
//!
//! The unknowns are scaled, `y = W^(1/2) (q - q0)`, so that the energy's second term is `c |y|^2`.
//! With the world matrices of element `j`, columns scaled by `W_j^(-1/2)`,
//!
//! `B_j = F_j L_j` (turning) and `M_j = F_j D_j + [p_{j+1}]x B_j` (moving, about the root),
//!
//! the derivative of a point `S_k` beyond the element is `J_kj = M_j - [S_k]x B_j`, and the one
//! element that holds the point has `P_k = F D(q, s)`. What Levenberg-Marquardt needs of `J` then
//! are sums along the strand that know nothing of the points:
//!
//! `sum J_kj J_lj^T = U + V [S_l]x - [S_k]x V^T - [S_k]x W [S_l]x`,
//! `U = sum M M^T`, `V = sum M B^T`, `W = sum B B^T`,
//!
//! so the cost of `J J^T` is that of one walk, `O(N + M^2)`, whatever the number `M` of points.
//! Positions are relative to the root, where a strand's own size bounds the rounding.

use pulp::Simd;

use crate::lanes::{Lane, LaneMat3, LaneVec3, Mask, Motion};

/// Strands that share a register.
#[derive(Debug)]
pub(crate) struct Chain<S: Simd> {
    pub(crate) simd: S,
    /// Root frames.
    pub(crate) axes: LaneMat3<S>,
    /// By element; strands with fewer are filled up with elements of no length.
    pub(crate) elements: Vec<LaneElement<S>>,
    /// By control; strands with fewer are filled up with controls of no weight.
    pub(crate) points: Vec<Point<S>>,
    /// Which elements hold which controls in any lane, as `(element, control)`, ascending.
    pub(crate) holds: Vec<(usize, usize)>,
    /// By element, as of the last walk.
    pub(crate) blocks: Vec<Block<S>>,
    /// The joint farthest from the root, at the last walk.
    pub(crate) extent: Lane<S>,
    /// `tr(J W^-1 J^T)` of the tip at the last walk.
    pub(crate) tip_compliance: Lane<S>,
    /// `|y|^2` of the last walk.
    pub(crate) square: Lane<S>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneElement<S: Simd> {
    pub(crate) rest: LaneVec3<S>,
    pub(crate) length: Lane<S>,
    /// The diagonal of `W^(-1/2)`.
    pub(crate) softness: LaneVec3<S>,
}

/// World matrices of an element, columns scaled by its softness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block<S: Simd> {
    /// `B`.
    pub(crate) turning: LaneMat3<S>,
    /// `M`.
    pub(crate) moving: LaneMat3<S>,
}

/// A control, and what the last walk found there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<S: Simd> {
    /// Index of the element that holds it, as a number.
    pub(crate) element: Lane<S>,
    /// Arc length on that element.
    pub(crate) local: Lane<S>,
    /// `S_k`, relative to the root.
    pub(crate) position: LaneVec3<S>,
    /// `P_k`.
    pub(crate) held: LaneMat3<S>,
    /// `P_k M^T` and `P_k B^T` of the element that holds it.
    held_moving: LaneMat3<S>,
    held_turning: LaneMat3<S>,
    /// Sums over the elements before that one.
    sums: Sums<S>,
    /// `J_k y`.
    pub(crate) drift: LaneVec3<S>,
}

/// Sums along the strand.
#[derive(Clone, Copy, Debug)]
struct Sums<S: Simd> {
    moving: Gram<S>,
    turning: Gram<S>,
    /// `sum M B^T`.
    mixed: LaneMat3<S>,
    /// `sum M y` and `sum B y`.
    moved: LaneVec3<S>,
    turned: LaneVec3<S>,
}

/// `sum M M^T`: the diagonal, and the entries `yz`, `zx`, `xy`.
#[derive(Clone, Copy, Debug)]
struct Gram<S: Simd> {
    diagonal: LaneVec3<S>,
    mixed: LaneVec3<S>,
}

impl<S: Simd> Chain<S> {
    pub(crate) fn new(simd: S) -> Self {
        let zero = Lane::splat(simd, 0.0);
        Self {
            simd,
            axes: LaneMat3::zero(simd),
            elements: Vec::new(),
            points: Vec::new(),
            holds: Vec::new(),
            blocks: Vec::new(),
            extent: zero,
            tip_compliance: zero,
            square: zero,
        }
    }

    /// Walks from the root with the unknowns `y`, one an element.
    #[inline(always)]
    pub(crate) fn walk(&mut self, y: &[LaneVec3<S>]) {
        let simd = self.simd;
        let mut position = LaneVec3::zero(simd);
        let mut axes = self.axes;
        let mut sums = Sums::zero(simd);
        let mut extent = Lane::splat(simd, 0.0);
        let mut square = Lane::splat(simd, 0.0);
        let mut held = 0;
        let none = LaneMat3::zero(simd);
        self.blocks.resize(self.elements.len(), Block { turning: none, moving: none });
        let walked = self.elements.iter().zip(y).zip(&mut self.blocks);
        for (j, ((element, &y), block)) in walked.enumerate() {
            let q = element.rest + element.softness.scale(y);
            let motion = Motion::new(q, element.length);
            let end = position + axes.apply(motion.displacement());
            let turning = axes.times(&motion.turning()).scale_columns(element.softness);
            let moving = axes.times(&motion.moving()).scale_columns(element.softness);
            block.turning = turning;
            block.moving = moving.plus(&turning.crossed_by(end));
            while let Some(&(element_held, k)) = self.holds.get(held)
                && element_held == j
            {
                let point = &mut self.points[k];
                let here = point.element.is(j as f64);
                let motion = Motion::new(q, here.keep(point.local));
                let found = position + axes.apply(motion.displacement());
                let moving = axes.times(&motion.moving()).scale_columns(element.softness);
                point.record(here, (found, &moving), block, &sums, y);
                held += 1;
            }
            sums.add(block, y);
            square += y.dot(y);
            axes = axes.times(&motion.rotation());
            position = end;
            extent = extent.max(end.dot(end));
        }
        self.extent = extent.sqrt();
        self.square = square;
        let tip = sums.product(position, position);
        self.tip_compliance = tip.0[0].x + tip.0[1].y + tip.0[2].z;
    }

    /// `J_k J_l^T` at the last walk, `k` not behind `l`.
    #[inline(always)]
    pub(crate) fn gram(&self, k: usize, l: usize) -> LaneMat3<S> {
        let (point, other) = (&self.points[k], &self.points[l]);
        let before = point.sums.product(point.position, other.position);
        let apart = cross_behind(&point.held_turning, other.position).plus(&point.held_moving);
        let together = point.held.times_transposed(&other.held);
        let same = (point.element - other.element).is(0.0);
        before.plus(&LaneMat3::select(same, &together, &apart))
    }

    /// `J^T rho` at the last walk, one vector an element.
    #[inline(always)]
    pub(crate) fn pull(&self, rho: &[LaneVec3<S>], mut give: impl FnMut(usize, LaneVec3<S>)) {
        let (mut force, mut moment) = (LaneVec3::zero(self.simd), LaneVec3::zero(self.simd));
        let mut held = self.holds.len();
        for (j, block) in self.blocks.iter().enumerate().rev() {
            let beyond =
                block.moving.apply_transposed(force) + block.turning.apply_transposed(moment);
            let mut sum = beyond;
            while 0 < held && self.holds[held - 1].0 == j {
                held -= 1;
                let k = self.holds[held].1;
                let point = &self.points[k];
                let load = LaneVec3::keep(point.element.is(j as f64), rho[k]);
                sum += point.held.apply_transposed(load);
                force += load;
                moment += point.position.cross(load);
            }
            give(j, sum);
        }
    }
}

impl<S: Simd> Point<S> {
    /// A point at an arc length of an element.
    #[inline(always)]
    pub(crate) fn new(element: Lane<S>, local: Lane<S>) -> Self {
        let simd = local.simd();
        let (v, m) = (LaneVec3::zero(simd), LaneMat3::zero(simd));
        Self {
            element,
            local,
            position: v,
            held: m,
            held_moving: m,
            held_turning: m,
            sums: Sums::zero(simd),
            drift: v,
        }
    }

    /// Takes over what was found, `S_k` and `P_k`, in the lanes where the element under way holds
    /// the point.
    #[inline(always)]
    fn record(
        &mut self,
        here: Mask<S>,
        (position, held): (LaneVec3<S>, &LaneMat3<S>),
        block: &Block<S>,
        before: &Sums<S>,
        y: LaneVec3<S>,
    ) {
        let drift = before.moved + before.turned.cross(position) + held.apply(y);
        self.position = LaneVec3::select(here, position, self.position);
        self.drift = LaneVec3::select(here, drift, self.drift);
        self.held.overwrite(here, held);
        self.held_moving.overwrite(here, &held.times_transposed(&block.moving));
        self.held_turning.overwrite(here, &held.times_transposed(&block.turning));
        self.sums.overwrite(here, before);
    }
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        let v = LaneVec3::zero(simd);
        let gram = Gram { diagonal: v, mixed: v };
        Self { moving: gram, turning: gram, mixed: LaneMat3::zero(simd), moved: v, turned: v }
    }

    #[inline(always)]
    fn add(&mut self, block: &Block<S>, y: LaneVec3<S>) {
        self.moving.add(&block.moving);
        self.turning.add(&block.turning);
        self.mixed = self.mixed.plus(&block.moving.times_transposed(&block.turning));
        self.moved += block.moving.apply(y);
        self.turned += block.turning.apply(y);
    }

    #[inline(always)]
    fn overwrite(&mut self, mask: Mask<S>, new: &Self) {
        self.moving.overwrite(mask, &new.moving);
        self.turning.overwrite(mask, &new.turning);
        self.mixed.overwrite(mask, &new.mixed);
        self.moved = LaneVec3::select(mask, new.moved, self.moved);
        self.turned = LaneVec3::select(mask, new.turned, self.turned);
    }

    /// `sum (M - [a]x B) (M - [b]x B)^T`.
    #[inline(always)]
    fn product(&self, a: LaneVec3<S>, b: LaneVec3<S>) -> LaneMat3<S> {
        let forces = self.moving.matrix().plus(&cross_behind(&self.mixed, b));
        let moments = self.mixed.transposed().plus(&cross_behind(&self.turning.matrix(), b));
        forces.minus(&moments.crossed_by(a))
    }
}

impl<S: Simd> Gram<S> {
    #[inline(always)]
    fn add(&mut self, m: &LaneMat3<S>) {
        for column in m.0 {
            let LaneVec3 { x, y, z } = column;
            let (d, m) = (self.diagonal, self.mixed);
            let square = |of: Lane<S>, onto| of.mul_add(of, onto);
            self.diagonal = LaneVec3::new(square(x, d.x), square(y, d.y), square(z, d.z));
            let mixed = (y.mul_add(z, m.x), z.mul_add(x, m.y), x.mul_add(y, m.z));
            self.mixed = LaneVec3::new(mixed.0, mixed.1, mixed.2);
        }
    }

    #[inline(always)]
    fn overwrite(&mut self, mask: Mask<S>, new: &Self) {
        self.diagonal = LaneVec3::select(mask, new.diagonal, self.diagonal);
        self.mixed = LaneVec3::select(mask, new.mixed, self.mixed);
    }

    #[inline(always)]
    fn matrix(&self) -> LaneMat3<S> {
        let (d, m) = (self.diagonal, self.mixed);
        LaneMat3([
            LaneVec3::new(d.x, m.z, m.y),
            LaneVec3::new(m.z, d.y, m.x),
            LaneVec3::new(m.y, m.x, d.z),
        ])
    }
}

/// `N [a]x`.
#[inline(always)]
fn cross_behind<S: Simd>(n: &LaneMat3<S>, a: LaneVec3<S>) -> LaneMat3<S> {
    // N (a x e_i), by columns.
    let [x, y, z] = n.0;
    LaneMat3([y * a.z - z * a.y, z * a.x - x * a.z, x * a.y - y * a.x])
}

#[cfg(test)]
mod tests;
