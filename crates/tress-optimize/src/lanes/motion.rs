//! One helical element in lanes: what it moves and how that changes with its curvatures.
//!
//! The same formulas as [`Element`](tress_geometry::Element)'s, whose module derives them.

use pulp::Simd;

use super::ratios::{Ratios, ratios};
use super::{Lane, LaneMat3, LaneVec3};

/// An element's motion to an arc length `s` on it, in the frame where it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<S: Simd> {
    q: LaneVec3<S>,
    s: Lane<S>,
    // `A`, `B`, `C` of the rotation and its integral, and the slopes of `B` and `C` over `n`.
    a: Lane<S>,
    b: Lane<S>,
    c: Lane<S>,
    db: Lane<S>,
    dc: Lane<S>,
}

impl<S: Simd> Motion<S> {
    #[inline(always)]
    pub(crate) fn new(q: LaneVec3<S>, s: Lane<S>) -> Self {
        let s2 = s * s;
        let s3 = s2 * s;
        let Ratios { a, b, c, db, dc } = ratios(q.dot(q) * s2);
        Self { q, s, a: s * a, b: s2 * b, c: s3 * c, db: s2 * s2 * db, dc: s2 * s3 * dc }
    }

    /// The same element's motion to another arc length.
    #[inline(always)]
    pub(crate) fn to(&self, s: Lane<S>) -> Self {
        Self::new(self.q, s)
    }

    /// `V e0`.
    #[inline(always)]
    pub(crate) fn displacement(&self) -> LaneVec3<S> {
        let LaneVec3 { x, y, z } = self.q;
        let (b, c) = (self.b, self.c);
        LaneVec3::new(self.s - c * (y * y + z * z), b * z + c * x * y, c * x * z - b * y)
    }

    /// `R`.
    #[inline(always)]
    pub(crate) fn rotation(&self) -> LaneMat3<S> {
        polynomial(self.q, Lane::splat(self.s.simd(), 1.0), self.a, self.b)
    }

    /// `D^T f + L^T m`, without either matrix.
    #[inline(always)]
    pub(crate) fn pull(&self, f: LaneVec3<S>, m: LaneVec3<S>) -> LaneVec3<S> {
        let q = self.q;
        let square = q.dot(q);
        let turned = q * q.dot(m) - m * square;
        let turning = m * self.s - q.cross(m) * self.b + turned * self.c;
        let moving = self.pull_here(f);
        turning + moving
    }

    /// `D^T f`.
    #[inline(always)]
    pub(crate) fn pull_here(&self, f: LaneVec3<S>) -> LaneVec3<S> {
        let LaneVec3 { x, y, z } = self.q;
        let bending = y.mul_add(y, z * z);
        let across = y.mul_add(f.y, z * f.z);
        // c1 . f and c2 . f.
        let (first, second) = (z * f.y - y * f.z, x * across - bending * f.x);
        let slope = self.db.mul_add(first, self.dc * second);
        let (bx, cx, cf) = (self.b, self.c * x, self.c * f.x * 2.0);
        self.q * slope
            + LaneVec3::new(
                self.c * across,
                cx * f.y - cf * y - bx * f.z,
                cx * f.z - cf * z + bx * f.y,
            )
    }

    /// `L = V`: how the frame turns when `q` changes.
    #[inline(always)]
    pub(crate) fn turning(&self) -> LaneMat3<S> {
        polynomial(self.q, self.s, self.b, self.c)
    }

    /// `D = d(V e0)/dq`: how the position moves when `q` changes.
    #[inline(always)]
    pub(crate) fn moving(&self) -> LaneMat3<S> {
        let LaneVec3 { x, y, z } = self.q;
        let (b, c) = (self.b, self.c);
        let bending = y * y + z * z;
        // c1 dB/n + c2 dC/n, with c1 = (0, k2, -k1) and c2 = k0 q - |q|^2 e0.
        let along = x * self.dc;
        let slopes =
            LaneVec3::new(-bending * self.dc, z * self.db + y * along, z * along - y * self.db);
        let (cx, cy, cz) = (c * x, c * y, c * z);
        let zero = Lane::splat(self.s.simd(), 0.0);
        LaneMat3([
            slopes * x + LaneVec3::new(zero, cy, cz),
            slopes * y + LaneVec3::new(-(cy + cy), cx, -b),
            slopes * z + LaneVec3::new(-(cz + cz), b, cx),
        ])
    }
}

/// `f I + g [q]x + h [q]x^2`.
#[inline(always)]
fn polynomial<S: Simd>(q: LaneVec3<S>, f: Lane<S>, g: Lane<S>, h: Lane<S>) -> LaneMat3<S> {
    let LaneVec3 { x, y, z } = q;
    let (hx, hy, hz) = (h * x, h * y, h * z);
    let (xx, yy, zz) = (hx * x, hy * y, hz * z);
    let (xy, xz, yz) = (hx * y, hx * z, hy * z);
    let (gx, gy, gz) = (g * x, g * y, g * z);
    LaneMat3([
        LaneVec3::new(f - (yy + zz), xy + gz, xz - gy),
        LaneVec3::new(xy - gz, f - (xx + zz), yz + gx),
        LaneVec3::new(xz + gy, yz - gx, f - (xx + yy)),
    ])
}
