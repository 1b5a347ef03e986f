//! Vectors and 3 x 3 matrices of [`Lane`]s, as much of them as the chain needs.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use glam::DVec3;
use pulp::Simd;

use super::{Lane, MAX_LANES, Mask};

/// One vector a strand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneVec3<S: Simd> {
    pub(crate) x: Lane<S>,
    pub(crate) y: Lane<S>,
    pub(crate) z: Lane<S>,
}

/// One matrix a strand, as columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneMat3<S: Simd>(pub(crate) [LaneVec3<S>; 3]);

impl<S: Simd> LaneVec3<S> {
    #[inline(always)]
    pub(crate) fn new(x: Lane<S>, y: Lane<S>, z: Lane<S>) -> Self {
        Self { x, y, z }
    }

    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        let zero = Lane::splat(simd, 0.0);
        Self::new(zero, zero, zero)
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Lane<S> {
        self.x.mul_add(other.x, self.y.mul_add(other.y, self.z * other.z))
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Self::new(
            self.y.mul_add(other.z, -(self.z * other.y)),
            self.z.mul_add(other.x, -(self.x * other.z)),
            self.x.mul_add(other.y, -(self.y * other.x)),
        )
    }

    /// `self * factor + other`.
    #[inline(always)]
    pub(crate) fn mul_add(self, factor: Lane<S>, other: Self) -> Self {
        Self::new(
            self.x.mul_add(factor, other.x),
            self.y.mul_add(factor, other.y),
            self.z.mul_add(factor, other.z),
        )
    }

    /// Component by component.
    #[inline(always)]
    pub(crate) fn scale(self, other: Self) -> Self {
        Self::new(self.x * other.x, self.y * other.y, self.z * other.z)
    }

    #[inline(always)]
    pub(crate) fn select(mask: Mask<S>, yes: Self, no: Self) -> Self {
        Self::new(mask.select(yes.x, no.x), mask.select(yes.y, no.y), mask.select(yes.z, no.z))
    }

    #[inline(always)]
    pub(crate) fn keep(mask: Mask<S>, v: Self) -> Self {
        Self::new(mask.keep(v.x), mask.keep(v.y), mask.keep(v.z))
    }

    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> Lane<S> {
        [self.x, self.y, self.z][i]
    }

    /// The vector of each lane.
    #[inline(always)]
    pub(crate) fn to_array(self) -> [DVec3; MAX_LANES] {
        let (x, y, z) = (self.x.to_array(), self.y.to_array(), self.z.to_array());
        std::array::from_fn(|i| DVec3::new(x[i], y[i], z[i]))
    }
}

impl<S: Simd> Add for LaneVec3<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<S: Simd> Sub for LaneVec3<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<S: Simd> Neg for LaneVec3<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<S: Simd> Mul<Lane<S>> for LaneVec3<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: Lane<S>) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<S: Simd> AddAssign for LaneVec3<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> LaneMat3<S> {
    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        Self([LaneVec3::zero(simd); 3])
    }

    /// `M v`.
    #[inline(always)]
    pub(crate) fn apply(&self, v: LaneVec3<S>) -> LaneVec3<S> {
        let [a, b, c] = self.0;
        a.mul_add(v.x, b.mul_add(v.y, c * v.z))
    }

    /// `M^T v`.
    #[inline(always)]
    pub(crate) fn apply_transposed(&self, v: LaneVec3<S>) -> LaneVec3<S> {
        let [a, b, c] = self.0;
        LaneVec3::new(a.dot(v), b.dot(v), c.dot(v))
    }

    /// `M N`.
    #[inline(always)]
    pub(crate) fn times(&self, other: &Self) -> Self {
        let [a, b, c] = other.0;
        Self([self.apply(a), self.apply(b), self.apply(c)])
    }

    /// Column `i` times component `i` of `v`.
    #[inline(always)]
    pub(crate) fn scale_columns(&self, v: LaneVec3<S>) -> Self {
        let [a, b, c] = self.0;
        Self([a * v.x, b * v.y, c * v.z])
    }

    /// `M N^T`.
    #[inline(always)]
    pub(crate) fn times_transposed(&self, other: &Self) -> Self {
        let mut product = [other.0[0]; 3];
        for (i, column) in product.iter_mut().enumerate() {
            let [a, b, c] = other.0.map(|column| column.get(i));
            *column = self.0[0].mul_add(a, self.0[1].mul_add(b, self.0[2] * c));
        }
        Self(product)
    }

    /// `M^T`.
    #[inline(always)]
    pub(crate) fn transposed(&self) -> Self {
        let [a, b, c] = self.0;
        Self([
            LaneVec3::new(a.x, b.x, c.x),
            LaneVec3::new(a.y, b.y, c.y),
            LaneVec3::new(a.z, b.z, c.z),
        ])
    }

    /// `M^T N`.
    #[inline(always)]
    pub(crate) fn transposed_times(&self, other: &Self) -> Self {
        let [a, b, c] = other.0;
        Self([self.apply_transposed(a), self.apply_transposed(b), self.apply_transposed(c)])
    }

    /// `[a]x`.
    #[inline(always)]
    pub(crate) fn cross(a: LaneVec3<S>) -> Self {
        let zero = Lane::splat(a.x.simd(), 0.0);
        Self([
            LaneVec3::new(zero, a.z, -a.y),
            LaneVec3::new(-a.z, zero, a.x),
            LaneVec3::new(a.y, -a.x, zero),
        ])
    }

    #[inline(always)]
    pub(crate) fn times_lane(&self, factor: Lane<S>) -> Self {
        let [a, b, c] = self.0;
        Self([a * factor, b * factor, c * factor])
    }

    #[inline(always)]
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        self.times_lane(Lane::splat(self.0[0].x.simd(), factor))
    }

    #[inline(always)]
    pub(crate) fn negated(&self) -> Self {
        let [a, b, c] = self.0;
        Self([-a, -b, -c])
    }

    /// `M + d I`.
    #[inline(always)]
    pub(crate) fn plus_diagonal(&self, d: Lane<S>) -> Self {
        let [mut a, mut b, mut c] = self.0;
        a.x += d;
        b.y += d;
        c.z += d;
        Self([a, b, c])
    }

    /// The inverse of a symmetric matrix, and whether it is positive definite.
    #[inline(always)]
    pub(crate) fn inverse_positive(&self) -> (Self, Mask<S>) {
        let [a, b, c] = self.0;
        // Rows of the adjugate are crossed columns.
        let (x, y, z) = (b.cross(c), c.cross(a), a.cross(b));
        let determinant = a.dot(x);
        let zero = Lane::splat(determinant.simd(), 0.0);
        let positive = zero.below(a.x).and(zero.below(z.z)).and(zero.below(determinant));
        let inverse = Lane::splat(determinant.simd(), 1.0) / determinant;
        (Self([x * inverse, y * inverse, z * inverse]).transposed(), positive)
    }

    /// `[a]x M`.
    #[inline(always)]
    pub(crate) fn crossed_by(&self, a: LaneVec3<S>) -> Self {
        let [x, y, z] = self.0;
        Self([a.cross(x), a.cross(y), a.cross(z)])
    }

    #[inline(always)]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([a + d, b + e, c + f])
    }

    #[inline(always)]
    pub(crate) fn minus(&self, other: &Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([a - d, b - e, c - f])
    }

    #[inline(always)]
    pub(crate) fn select(mask: Mask<S>, yes: &Self, no: &Self) -> Self {
        let ([a, b, c], [d, e, f]) = (yes.0, no.0);
        Self([
            LaneVec3::select(mask, a, d),
            LaneVec3::select(mask, b, e),
            LaneVec3::select(mask, c, f),
        ])
    }

    /// Becomes `new` where the answer is yes.
    #[inline(always)]
    pub(crate) fn overwrite(&mut self, mask: Mask<S>, new: &Self) {
        for (column, new) in self.0.iter_mut().zip(new.0) {
            *column = LaneVec3::select(mask, new, *column);
        }
    }
}
