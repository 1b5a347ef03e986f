//! The step's equations in the space of the controls: `(J J^T + h I) rho = side`.
//!
//! All of it is small, `3M` unknowns for `M` controls, and every entry is a [`Lane`].

use pulp::Simd;

use crate::chain::Chain;
use crate::lanes::{Lane, LaneVec3};

/// Residuals `r_k = sqrt(w_k) (S_k - a_k)` and what is made of them.
#[derive(Debug)]
pub(crate) struct Normal<S: Simd> {
    /// Roots of the controls' weights.
    pub(crate) root_weights: Vec<Lane<S>>,
    /// `r_k`.
    pub(crate) residuals: Vec<LaneVec3<S>>,
    /// The solution times the roots of the weights: forces at the control points.
    pub(crate) loads: Vec<LaneVec3<S>>,
    /// `J J^T`, weighted, the lower triangle by rows; then its Cholesky factor.
    matrix: Vec<Lane<S>>,
    rho: Vec<Lane<S>>,
}

impl<S: Simd> Normal<S> {
    pub(crate) fn new() -> Self {
        Self {
            root_weights: Vec::new(),
            residuals: Vec::new(),
            loads: Vec::new(),
            matrix: Vec::new(),
            rho: Vec::new(),
        }
    }

    /// Memory for `m` controls.
    #[inline(always)]
    pub(crate) fn resize(&mut self, simd: S, m: usize) {
        let zero = LaneVec3::zero(simd);
        self.residuals.clear();
        self.residuals.resize(m, zero);
        self.loads.clear();
        self.loads.resize(m, zero);
        self.matrix.clear();
        self.matrix.resize(9 * m * m, zero.x);
        self.rho.clear();
        self.rho.resize(3 * m, zero.x);
    }

    /// `J J^T` of the chain's last walk.
    #[inline(always)]
    pub(crate) fn assemble(&mut self, chain: &Chain<S>) {
        let m = chain.points.len();
        for l in 0..m {
            for k in 0..=l {
                let weight = self.root_weights[k] * self.root_weights[l];
                let block = chain.gram(k, l);
                // Rows of `l` and columns of `k`: the block's transpose.
                for (row, entries) in block.0.into_iter().enumerate() {
                    let place = (3 * l + row) * 3 * m + 3 * k;
                    for column in 0..3 {
                        self.matrix[place + column] = entries.get(column) * weight;
                    }
                }
            }
        }
    }

    /// Lengths of the gradient `J^T r + c y` and of `J^T r` alone, without either: the first
    /// squared is `r^T J J^T r + 2 c r^T J y + c^2 |y|^2`.
    #[inline(always)]
    pub(crate) fn gradients(
        &self,
        chain: &Chain<S>,
        c: Lane<S>,
        square: Lane<S>,
    ) -> (Lane<S>, Lane<S>) {
        let zero = Lane::splat(chain.simd, 0.0);
        let n = self.rho.len();
        let r = |i: usize| self.residuals[i / 3].get(i % 3);
        let mut pull = zero;
        for i in 0..n {
            let mut row = r(i) * self.matrix[i * n + i];
            for j in 0..i {
                row += r(j) * self.matrix[i * n + j] * 2.0;
            }
            pull += r(i) * row;
        }
        let mut mixed = zero;
        for ((point, &r), &root_weight) in
            chain.points.iter().zip(&self.residuals).zip(&self.root_weights)
        {
            mixed += r.dot(point.drift) * root_weight;
        }
        let whole = pull + c * mixed * 2.0 + c * c * square;
        (whole.max(zero).sqrt(), pull.max(zero).sqrt())
    }

    /// `sum |r_k|^2`.
    #[inline(always)]
    pub(crate) fn square(&self) -> Lane<S> {
        let mut sum = self.residuals[0].dot(self.residuals[0]);
        for r in &self.residuals[1..] {
            sum += r.dot(*r);
        }
        sum
    }

    /// Trace of `J J^T`, before it is factorised.
    #[inline(always)]
    pub(crate) fn trace(&self) -> Lane<S> {
        let n = self.rho.len();
        let mut sum = self.matrix[0];
        for i in 1..n {
            sum += self.matrix[i * n + i];
        }
        sum
    }

    /// Solves `(J J^T + h I) rho = r - (c/h) J y` for the loads.
    #[inline(always)]
    pub(crate) fn solve(&mut self, chain: &Chain<S>, c: Lane<S>, h: Lane<S>) {
        let kept = c / h;
        for (k, point) in chain.points.iter().enumerate() {
            let side = self.residuals[k] - point.drift * (kept * self.root_weights[k]);
            for i in 0..3 {
                self.rho[3 * k + i] = side.get(i);
            }
        }
        self.factorise(h);
        self.substitute();
        for (k, &root_weight) in self.root_weights.iter().enumerate() {
            let rho = LaneVec3::new(self.rho[3 * k], self.rho[3 * k + 1], self.rho[3 * k + 2]);
            self.loads[k] = rho * root_weight;
        }
    }

    /// Replaces the lower triangle of `J J^T` by the factor of `J J^T + h I`, its diagonal by the
    /// inverse of the factor's.
    ///
    /// A pivot is at least `h`; rounding makes it less, and then it is taken to be `h`.
    #[inline(always)]
    fn factorise(&mut self, h: Lane<S>) {
        let n = self.rho.len();
        let one = Lane::splat(h.simd(), 1.0);
        let a = &mut self.matrix;
        for j in 0..n {
            let mut pivot = a[j * n + j] + h;
            for k in 0..j {
                pivot = (-a[j * n + k]).mul_add(a[j * n + k], pivot);
            }
            let inverse = one / pivot.max(h).sqrt();
            a[j * n + j] = inverse;
            for i in j + 1..n {
                let mut entry = a[i * n + j];
                for k in 0..j {
                    entry = (-a[i * n + k]).mul_add(a[j * n + k], entry);
                }
                a[i * n + j] = entry * inverse;
            }
        }
    }

    /// Forward and back substitution with the factor.
    #[inline(always)]
    fn substitute(&mut self) {
        let n = self.rho.len();
        let (a, x) = (&self.matrix, &mut self.rho);
        for i in 0..n {
            let mut sum = x[i];
            for k in 0..i {
                sum = (-a[i * n + k]).mul_add(x[k], sum);
            }
            x[i] = sum * a[i * n + i];
        }
        for i in (0..n).rev() {
            let mut sum = x[i];
            for k in i + 1..n {
                sum = (-a[k * n + i]).mul_add(x[k], sum);
            }
            x[i] = sum * a[i * n + i];
        }
    }
}
