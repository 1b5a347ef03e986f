//! Numbers of several strands side by side: one SIMD register, or a single number on a machine
//! that has none.
//!
//! The arithmetic of a lane does not know its neighbours: a strand's result is the same to the bit
//! in any lane and beside any other strand. Machines with and without fused products and sums
//! differ in the last digits.
//!
//! Every function is inlined, because `pulp` compiles what is inlined into its dispatched function
//! for the instruction set it finds at run time, and nothing else.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use glam::DVec3;
use pulp::Simd;

mod motion;
mod ratios;
mod vector;

pub(crate) use motion::Motion;
pub(crate) use vector::{LaneMat3, LaneVec3};

/// The widest register, in numbers: AVX-512.
pub(crate) const MAX_LANES: usize = 8;

/// One number a strand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lane<S: Simd> {
    simd: S,
    value: S::f64s,
}

/// One answer a strand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mask<S: Simd> {
    simd: S,
    value: S::m64s,
}

impl<S: Simd> Lane<S> {
    /// The same number for every strand.
    #[inline(always)]
    pub(crate) fn splat(simd: S, x: f64) -> Self {
        Self { simd, value: simd.splat_f64s(x) }
    }

    /// A number for each of the first lanes, 0 for the rest.
    #[inline(always)]
    pub(crate) fn from_fn(simd: S, mut of: impl FnMut(usize) -> f64) -> Self {
        let mut all = [0.0; MAX_LANES];
        for (i, x) in all.iter_mut().enumerate().take(S::F64_LANES) {
            *x = of(i);
        }
        let (registers, _) = S::as_simd_f64s(&all);
        Self { simd, value: registers[0] }
    }

    /// All lanes, those that the register does not have as 0.
    #[inline(always)]
    pub(crate) fn to_array(self) -> [f64; MAX_LANES] {
        let mut all = [0.0; MAX_LANES];
        let (registers, _) = S::as_mut_simd_f64s(&mut all);
        registers[0] = self.value;
        all
    }

    #[inline(always)]
    pub(crate) fn simd(self) -> S {
        self.simd
    }

    /// `self * b + c`, in one rounding where the machine has that.
    #[inline(always)]
    pub(crate) fn mul_add(self, b: Self, c: Self) -> Self {
        Self { value: self.simd.mul_add_e_f64s(self.value, b.value, c.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        Self { value: self.simd.sqrt_f64s(self.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        Self { value: self.simd.abs_f64s(self.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        Self { value: self.simd.max_f64s(self.value, other.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        Self { value: self.simd.min_f64s(self.value, other.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn at_most(self, other: Self) -> Mask<S> {
        let value = self.simd.less_than_or_equal_f64s(self.value, other.value);
        Mask { simd: self.simd, value }
    }

    #[inline(always)]
    pub(crate) fn below(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_f64s(self.value, other.value) }
    }

    #[inline(always)]
    pub(crate) fn is(self, x: f64) -> Mask<S> {
        let value = self.simd.equal_f64s(self.value, self.simd.splat_f64s(x));
        Mask { simd: self.simd, value }
    }
}

impl<S: Simd> Mask<S> {
    /// `yes` where the answer is yes, else `no`.
    #[inline(always)]
    pub(crate) fn select(self, yes: Lane<S>, no: Lane<S>) -> Lane<S> {
        let value = self.simd.select_f64s(self.value, yes.value, no.value);
        Lane { simd: self.simd, value }
    }

    /// `x` where the answer is yes, else 0, whatever `x` is.
    #[inline(always)]
    pub(crate) fn keep(self, x: Lane<S>) -> Lane<S> {
        self.select(x, Lane::splat(self.simd, 0.0))
    }

    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        Self { value: self.simd.and_m64s(self.value, other.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn or(self, other: Self) -> Self {
        Self { value: self.simd.or_m64s(self.value, other.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn not(self) -> Self {
        Self { value: self.simd.not_m64s(self.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        self.simd.first_true_m64s(self.value) < S::F64_LANES
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $simd:ident) => {
        impl<S: Simd> $trait for Lane<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { value: self.simd.$simd(self.value, other.value), ..self }
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Simd> Mul<f64> for Lane<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self * Self::splat(self.simd, factor)
    }
}

impl<S: Simd> Neg for Lane<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: self.simd.neg_f64s(self.value), ..self }
    }
}

impl<S: Simd> AddAssign for Lane<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> SubAssign for Lane<S> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

/// The vectors of the first lanes, zero for the rest.
#[inline(always)]
pub(crate) fn vectors<S: Simd>(simd: S, mut of: impl FnMut(usize) -> DVec3) -> LaneVec3<S> {
    let mut all = [DVec3::ZERO; MAX_LANES];
    for (i, v) in all.iter_mut().enumerate().take(S::F64_LANES) {
        *v = of(i);
    }
    LaneVec3::new(
        Lane::from_fn(simd, |i| all[i].x),
        Lane::from_fn(simd, |i| all[i].y),
        Lane::from_fn(simd, |i| all[i].z),
    )
}
