//! Quadratic functions of eight and nine variables, and how they are carried along a chain.
//!
//! At a joint the variables are the deviation of the state, `x = (dp, a)`: three of position and
//! two of the tangent (its components along `u` and `v`), all in the axes of the joint's frame;
//! and the deviation `w` of the Darboux vector of an element, in the same axes. An element adds the
//! change of its length as a ninth, which is kept apart: rows of eight numbers fill registers.
//!
//! What is hot takes the registers of the machine, `simd`, and is inlined always, so that it is
//! compiled for them (see the sweep).

#![expect(clippy::needless_range_loop, reason = "matrix products read by their indices")]

use glam::{DMat3, DVec3};
use pulp::Simd;

/// Variables of a joint: position 0 to 2, tangent 3 and 4, Darboux vector 5 to 7.
pub(super) const N: usize = 8;

type Vector = [f64; N];
type Matrix = [[f64; N]; N];

/// `sum += factor * row`, in registers. Products are rounded before they are added, whatever the
/// machine could do, so that results are alike everywhere.
#[inline(always)]
fn add_multiple<S: Simd>(simd: S, sum: &mut Vector, factor: f64, row: &Vector) {
    let factor = simd.splat_f64s(factor);
    // Eight is a multiple of every register's width: there is no rest.
    let (sum, _) = S::as_mut_simd_f64s(sum);
    let (row, _) = S::as_simd_f64s(row);
    for (sum, row) in sum.iter_mut().zip(row) {
        *sum = simd.add_f64s(*sum, simd.mul_f64s(factor, *row));
    }
}

/// `1/2 z^T H z + g^T z`; `H` is symmetric and held whole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quadratic {
    pub(super) h: Matrix,
    pub(super) g: Vector,
}

/// A quadratic of an element's variables: those of the joint before it with the element's own
/// Darboux vector, and the change `l` of its length,
/// `1/2 z^T H z + g^T z + l (cross . z) + 1/2 square l^2 + slope l`.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElementCost {
    rest: Quadratic,
    cross: Vector,
    square: f64,
    slope: f64,
}

/// A row of a least-squares problem: its derivative by the eight variables, and its value.
pub(super) struct Row {
    pub(super) slope: Vector,
    pub(super) value: f64,
}

impl ElementCost {
    /// Adds half the square of `row`.
    #[inline(always)]
    pub(super) fn add_square<S: Simd>(&mut self, simd: S, row: &Row) {
        add_multiple(simd, &mut self.rest.g, row.value, &row.slope);
        for (h, slope) in self.rest.h.iter_mut().zip(&row.slope) {
            add_multiple(simd, h, *slope, &row.slope);
        }
    }

    /// Adds `weight / 2` times the square of the Darboux vector's deviation.
    #[inline(always)]
    pub(super) fn damp_curvature(&mut self, weight: f64) {
        for i in 5..N {
            self.rest.h[i][i] += weight;
        }
    }

    /// Adds half the square of `value + slope l`.
    #[inline(always)]
    pub(super) fn add_length_square(&mut self, slope: f64, value: f64) {
        self.square += slope * slope;
        self.slope += slope * value;
    }

    /// Minimises over the length, which costs `weight / 2` times its square on top; returns what
    /// is left and the length as a function of the rest.
    #[inline(always)]
    pub(super) fn without_length<S: Simd>(&self, simd: S, weight: f64) -> (Quadratic, LengthGain) {
        let inverse = 1.0 / (self.square + weight);
        let gain = LengthGain {
            slope: self.cross.map(|cross| -cross * inverse),
            value: -self.slope * inverse,
        };
        let mut rest = self.rest;
        add_multiple(simd, &mut rest.g, self.slope, &gain.slope);
        for (h, slope) in rest.h.iter_mut().zip(&gain.slope) {
            add_multiple(simd, h, *slope, &self.cross);
        }
        (rest, gain)
    }

    /// The same where the length may not change.
    #[inline(always)]
    pub(super) fn with_length_held(&self) -> (Quadratic, LengthGain) {
        (self.rest, LengthGain { slope: [0.0; N], value: 0.0 })
    }
}

/// The change of an element's length: `value + slope . (x, w)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct LengthGain {
    pub(super) slope: Vector,
    pub(super) value: f64,
}

/// The change of an element's Darboux vector: `value + slope (x, w_before)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvatureGain {
    pub(super) slope: [Vector; 3],
    pub(super) value: [f64; 3],
}

impl LengthGain {
    pub(super) fn answer(&self, state: &Vector) -> f64 {
        self.value + dot(&self.slope, state)
    }
}

impl CurvatureGain {
    pub(super) fn answer(&self, state: &Vector) -> DVec3 {
        let row = |i: usize| self.value[i] + dot(&self.slope[i], state);
        DVec3::new(row(0), row(1), row(2))
    }
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// What an element does to deviations, to first order. With `B` from the axes at its start to
/// those of the joint behind it, `C` the same after the least rotation that brings the element's
/// end tangent to the joint's, and `t = R e0`,
/// `dp' = B (dp + V (0, a) + D w + t l)`, `a' = C (R (0, a) + V w x t + q x t l)` across the
/// tangent, `w' = B w`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transition {
    /// Rows of `(dp', a', w')` by the columns `(dp, a, w)`.
    map: Matrix,
    /// The column of `l`.
    by_length: Vector,
}

impl Transition {
    pub(super) const NONE: Self = Self { map: [[0.0; N]; N], by_length: [0.0; N] };

    /// Of an element of curvature `q` whose rotation, turning and moving are `R`, `V` and `D`.
    #[inline(always)]
    pub(super) fn new(
        b: &DMat3,
        c: &DMat3,
        rotation: &DMat3,
        turning: &DMat3,
        moving: &DMat3,
        q: DVec3,
    ) -> Self {
        let t = rotation.x_axis;
        let nothing = [0.0; N];
        let column = |p: DVec3, a: DVec3, w: DVec3| [p.x, p.y, p.z, a.y, a.z, w.x, w.y, w.z];
        let position = |j: usize| column(b.col(j), DVec3::ZERO, DVec3::ZERO);
        let tangent = |j: usize| column(*b * turning.col(j), *c * rotation.col(j), DVec3::ZERO);
        let darboux = |j: usize| column(*b * moving.col(j), *c * turning.col(j).cross(t), b.col(j));
        let columns = [
            position(0),
            position(1),
            position(2),
            tangent(1),
            tangent(2),
            darboux(0),
            darboux(1),
            darboux(2),
        ];
        let mut map = [nothing; N];
        for (j, column) in columns.iter().enumerate() {
            for i in 0..N {
                map[i][j] = column[i];
            }
        }
        Self { map, by_length: column(*b * t, *c * q.cross(t), DVec3::ZERO) }
    }

    /// The state's deviation at the end, for one before, a change of the Darboux vector and one of
    /// the length; without the gap.
    pub(super) fn carry(&self, state: &[f64; 5], curvature: DVec3, length: f64) -> [f64; 5] {
        let [a, b, c, d, e] = *state;
        let all = [a, b, c, d, e, curvature.x, curvature.y, curvature.z];
        std::array::from_fn(|i| dot(&self.map[i], &all) + self.by_length[i] * length)
    }

    /// The quadratic `beyond` of the deviations at the element's end, off by `gap` there, as a
    /// quadratic of the element's variables.
    #[inline(always)]
    pub(super) fn pull_back<S: Simd>(
        &self,
        simd: S,
        beyond: &Quadratic,
        gap: &[f64; 5],
    ) -> ElementCost {
        let mut g = beyond.g;
        let mut by_length = [0.0; N];
        for (gap, h) in gap.iter().zip(&beyond.h) {
            add_multiple(simd, &mut g, *gap, h);
        }
        for (factor, h) in self.by_length[..5].iter().zip(&beyond.h) {
            add_multiple(simd, &mut by_length, *factor, h);
        }
        let mut product = [[0.0; N]; N];
        for (row, h) in product.iter_mut().zip(&beyond.h) {
            for (factor, map) in h.iter().zip(&self.map) {
                add_multiple(simd, row, *factor, map);
            }
        }
        let mut pulled =
            ElementCost { rest: Quadratic::ZERO, cross: [0.0; N], square: 0.0, slope: 0.0 };
        for k in 0..N {
            let map = &self.map[k];
            add_multiple(simd, &mut pulled.rest.g, g[k], map);
            add_multiple(simd, &mut pulled.cross, by_length[k], map);
            for (h, factor) in pulled.rest.h.iter_mut().zip(map) {
                add_multiple(simd, h, *factor, &product[k]);
            }
            pulled.square += self.by_length[k] * by_length[k];
            pulled.slope += self.by_length[k] * g[k];
        }
        pulled
    }
}

impl Quadratic {
    pub(super) const ZERO: Self = Self { h: [[0.0; N]; N], g: [0.0; N] };

    /// Minimises over the element's own Darboux vector, tied to that of the element before by
    /// `weight / 2 |w - w_before + jump|^2`; returns what is left as a quadratic of the state and
    /// `w_before`, and the minimum as a function of them.
    #[inline(always)]
    pub(super) fn without_curvature<S: Simd>(
        &self,
        simd: S,
        weight: f64,
        jump: DVec3,
    ) -> (Self, CurvatureGain) {
        let jump = jump.to_array();
        let mut own = [[0.0; 3]; 3];
        let mut cross = [[0.0; N]; 3];
        let mut right = [0.0; 3];
        for i in 0..3 {
            own[i].copy_from_slice(&self.h[5 + i][5..]);
            own[i][i] += weight;
            cross[i][..5].copy_from_slice(&self.h[5 + i][..5]);
            cross[i][5 + i] = -weight;
            right[i] = self.g[5 + i] + weight * jump[i];
        }
        let inverse = DMat3::from_cols_array_2d(&own).inverse().to_cols_array_2d();
        let mut gain = CurvatureGain { slope: [[0.0; N]; 3], value: [0.0; 3] };
        for i in 0..3 {
            for k in 0..3 {
                gain.value[i] -= inverse[i][k] * right[k];
                add_multiple(simd, &mut gain.slope[i], -inverse[i][k], &cross[k]);
            }
        }
        let mut left = Self::ZERO;
        for i in 0..5 {
            left.g[i] = self.g[i];
            left.h[i][..5].copy_from_slice(&self.h[i][..5]);
        }
        for i in 0..3 {
            left.g[5 + i] = -weight * jump[i];
            left.h[5 + i][5 + i] = weight;
        }
        for k in 0..3 {
            add_multiple(simd, &mut left.g, gain.value[k], &cross[k]);
            for (h, factor) in left.h.iter_mut().zip(&cross[k]) {
                add_multiple(simd, h, *factor, &gain.slope[k]);
            }
        }
        left.make_symmetric();
        (left, gain)
    }

    /// Rounding makes the halves differ, and the recursion lets the difference grow without bound.
    #[inline(always)]
    fn make_symmetric(&mut self) {
        for i in 0..N {
            for j in 0..i {
                let mean = 0.5 * (self.h[i][j] + self.h[j][i]);
                self.h[i][j] = mean;
                self.h[j][i] = mean;
            }
        }
    }

    /// The minimum over tangent and Darboux vector, the position held; with the tangent held too,
    /// over the Darboux vector alone. Index 0 and 1 are the tangent.
    pub(super) fn minimum(&self, tangent_moves: bool) -> [f64; 5] {
        let mut a = [[0.0; 5]; 5];
        let mut x = [0.0; 5];
        for i in 0..5 {
            a[i].copy_from_slice(&self.h[3 + i][3..]);
            x[i] = -self.g[3 + i];
        }
        if !tangent_moves {
            for i in 0..2 {
                a.iter_mut().for_each(|row| row[i] = 0.0);
                a[i] = [0.0; 5];
                a[i][i] = 1.0;
                x[i] = 0.0;
            }
        }
        solve(&mut a, &mut x);
        x
    }
}

/// Solves a symmetric positive definite system by Cholesky's factorisation; a direction without
/// curvature is not moved along.
fn solve(a: &mut [[f64; 5]; 5], x: &mut [f64; 5]) {
    for i in 0..5 {
        let greatest = a[i][i];
        for j in 0..=i {
            let dot: f64 = (0..j).map(|k| a[i][k] * a[j][k]).sum();
            let rest = a[i][j] - dot;
            a[i][j] = if i == j {
                if greatest * 1e-14 < rest { rest.sqrt() } else { f64::INFINITY }
            } else {
                rest / a[j][j]
            };
        }
        x[i] = (x[i] - (0..i).map(|k| a[i][k] * x[k]).sum::<f64>()) / a[i][i];
    }
    for i in (0..5).rev() {
        x[i] = (x[i] - (i + 1..5).map(|k| a[k][i] * x[k]).sum::<f64>()) / a[i][i];
    }
}
