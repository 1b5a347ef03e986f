//! Quadratic functions of eight and nine variables, and how they are carried along a chain.
//!
//! At a joint the variables are the deviation of the state, `x = (dp, a)`: three of position and
//! two of the tangent (its components along `u` and `v`), all in the axes of the joint's frame;
//! and the deviation `w` of the Darboux vector of an element, in the same axes.

#![expect(clippy::needless_range_loop, reason = "matrix products read by their indices")]

use glam::{DMat3, DVec3};

/// Variables of a joint: position 0 to 2, tangent 3 and 4, Darboux vector 5 to 7.
pub(super) const N: usize = 8;
/// Those of an element: the joint's before it, its own Darboux vector, and its length at 8.
const M: usize = 9;

/// `1/2 z^T H z + g^T z`; `H` is symmetric and held whole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quadratic<const D: usize> {
    pub(super) h: [[f64; D]; D],
    pub(super) g: [f64; D],
}

impl<const D: usize> Quadratic<D> {
    pub(super) const ZERO: Self = Self { h: [[0.0; D]; D], g: [0.0; D] };
}

/// A row of a least-squares problem: its derivative by the eight variables, and its value.
pub(super) struct Row {
    pub(super) slope: [f64; N],
    pub(super) value: f64,
}

impl Quadratic<M> {
    /// Adds half the square of `row`.
    pub(super) fn add_square(&mut self, row: &Row) {
        for i in 0..N {
            self.g[i] += row.slope[i] * row.value;
            for j in 0..N {
                self.h[i][j] += row.slope[i] * row.slope[j];
            }
        }
    }

    /// Adds `weight / 2` times the square of the Darboux vector's deviation.
    pub(super) fn damp_curvature(&mut self, weight: f64) {
        for i in 5..8 {
            self.h[i][i] += weight;
        }
    }

    /// Adds half the square of `value + slope` times the change of the length.
    pub(super) fn add_length_square(&mut self, slope: f64, value: f64) {
        self.h[8][8] += slope * slope;
        self.g[8] += slope * value;
    }

    /// Minimises over the length, which costs `weight / 2` times its square on top; returns what
    /// is left and the length as a function of the rest.
    pub(super) fn without_length(&self, weight: f64) -> (Quadratic<N>, LengthGain) {
        let inverse = 1.0 / (self.h[8][8] + weight);
        let mut rest = Quadratic::ZERO;
        let mut gain = LengthGain { slope: [0.0; N], value: -self.g[8] * inverse };
        for i in 0..N {
            gain.slope[i] = -self.h[8][i] * inverse;
        }
        for i in 0..N {
            rest.g[i] = self.g[i] + gain.slope[i] * self.g[8];
            for j in 0..N {
                rest.h[i][j] = self.h[i][j] + gain.slope[i] * self.h[8][j];
            }
        }
        (rest, gain)
    }

    /// The same where the length may not change.
    pub(super) fn with_length_held(&self) -> (Quadratic<N>, LengthGain) {
        let mut rest = Quadratic::ZERO;
        for i in 0..N {
            rest.g[i] = self.g[i];
            rest.h[i].copy_from_slice(&self.h[i][..N]);
        }
        (rest, LengthGain { slope: [0.0; N], value: 0.0 })
    }
}

/// The change of an element's length: `value + slope . (x, w)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct LengthGain {
    pub(super) slope: [f64; N],
    pub(super) value: f64,
}

/// The change of an element's Darboux vector: `value + slope (x, w_before)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvatureGain {
    pub(super) slope: [[f64; N]; 3],
    pub(super) value: [f64; 3],
}

impl LengthGain {
    pub(super) fn answer(&self, state: &[f64; N]) -> f64 {
        self.value + self.slope.iter().zip(state).map(|(k, z)| k * z).sum::<f64>()
    }
}

impl CurvatureGain {
    pub(super) fn answer(&self, state: &[f64; N]) -> DVec3 {
        let row = |i: usize| {
            let slope: &[f64; N] = &self.slope[i];
            self.value[i] + slope.iter().zip(state).map(|(k, z)| k * z).sum::<f64>()
        };
        DVec3::new(row(0), row(1), row(2))
    }
}

/// What an element does to deviations, to first order. With `B` from the axes at its start to
/// those of the joint behind it, `C` the same after the least rotation that brings the element's
/// end tangent to the joint's, and `t = R e0`,
/// `dp' = B (dp + V (0, a) + D w + t dl)`, `a' = C (R (0, a) + V w x t + q x t dl)` across the
/// tangent, `w' = B w`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transition {
    /// Rows of `(dp', a', w')` by the columns `(dp, a, w, dl)`.
    map: [[f64; M]; N],
}

impl Transition {
    pub(super) const NONE: Self = Self { map: [[0.0; M]; N] };

    /// Of an element of curvature `q` whose rotation, turning and moving are `R`, `V` and `D`.
    pub(super) fn new(
        b: &DMat3,
        c: &DMat3,
        rotation: &DMat3,
        turning: &DMat3,
        moving: &DMat3,
        q: DVec3,
    ) -> Self {
        let mut map = [[0.0; M]; N];
        let mut set = |rows: std::ops::Range<usize>, column: usize, values: DVec3| {
            let values = values.to_array();
            let skip = 3 - rows.len();
            for (row, value) in map[rows].iter_mut().zip(&values[skip..]) {
                row[column] = *value;
            }
        };
        let t = rotation.x_axis;
        for j in 0..3 {
            set(0..3, j, b.col(j));
            set(0..3, 5 + j, *b * moving.col(j));
            set(3..5, 5 + j, *c * turning.col(j).cross(t));
            set(5..8, 5 + j, b.col(j));
        }
        for (column, j) in [(3, 1), (4, 2)] {
            set(0..3, column, *b * turning.col(j));
            set(3..5, column, *c * rotation.col(j));
        }
        set(0..3, 8, *b * t);
        set(3..5, 8, *c * q.cross(t));
        Self { map }
    }

    /// The state's deviation at the end, for one before, a change of the Darboux vector and one of
    /// the length; without the gap.
    pub(super) fn carry(&self, state: &[f64; 5], curvature: DVec3, length: f64) -> [f64; 5] {
        let [a, b, c, d, e] = *state;
        let all = [a, b, c, d, e, curvature.x, curvature.y, curvature.z, length];
        std::array::from_fn(|i| self.map[i].iter().zip(&all).map(|(m, z)| m * z).sum())
    }

    /// The quadratic `beyond` of the deviations at the element's end, off by `gap` there, as a
    /// quadratic of the element's variables.
    pub(super) fn pull_back(&self, beyond: &Quadratic<N>, gap: &[f64; 5]) -> Quadratic<M> {
        let mut g = beyond.g;
        for (g, row) in g.iter_mut().zip(&beyond.h) {
            *g += gap.iter().zip(row).map(|(gap, h)| gap * h).sum::<f64>();
        }
        let mut product = [[0.0; M]; N];
        for (row, h) in product.iter_mut().zip(&beyond.h) {
            for (h, map) in h.iter().zip(&self.map) {
                for (sum, m) in row.iter_mut().zip(map) {
                    *sum += h * m;
                }
            }
        }
        let mut pulled = Quadratic::ZERO;
        for (k, (map, product)) in self.map.iter().zip(&product).enumerate() {
            for i in 0..M {
                pulled.g[i] += map[i] * g[k];
                for (sum, p) in pulled.h[i].iter_mut().zip(product) {
                    *sum += map[i] * p;
                }
            }
        }
        pulled
    }
}

impl Quadratic<N> {
    /// Minimises over the element's own Darboux vector, tied to that of the element before by
    /// `weight / 2 |w - w_before + jump|^2`; returns what is left as a quadratic of the state and
    /// `w_before`, and the minimum as a function of them.
    pub(super) fn without_curvature(&self, weight: f64, jump: DVec3) -> (Self, CurvatureGain) {
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
        let inverse = inverse(&own);
        let mut gain = CurvatureGain { slope: [[0.0; N]; 3], value: [0.0; 3] };
        for i in 0..3 {
            for k in 0..3 {
                gain.value[i] -= inverse[i][k] * right[k];
                for j in 0..N {
                    gain.slope[i][j] -= inverse[i][k] * cross[k][j];
                }
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
            for i in 0..N {
                left.g[i] += cross[k][i] * gain.value[k];
                for j in 0..N {
                    left.h[i][j] += cross[k][i] * gain.slope[k][j];
                }
            }
        }
        left.make_symmetric();
        (left, gain)
    }

    /// Rounding makes the halves differ, and the recursion lets the difference grow without bound.
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

/// Inverse of a symmetric positive definite matrix by cofactors.
fn inverse(a: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let m = DMat3::from_cols_array_2d(a).inverse();
    m.to_cols_array_2d()
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
