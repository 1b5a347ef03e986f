//! `sin x / x` and its kin for a whole register, without a call into a library.
//!
//! With `y = x^2` the functions that rotations and displacements need,
//!
//! `a = sin x / x`, `b = (1 - cos x) / x^2`, `c = (x - sin x) / x^3`,
//!
//! and the slopes `b'(x) / x = 2 db/dy`, `c'(x) / x = 2 dc/dy`, are entire in `y`: one polynomial
//! and its derivative by Horner's rule, with no root, no division and no sine, give them up to
//! [`SERIES_UP_TO`]. An element that turns by more (a fitted coil rarely does) takes the closed
//! form, with a sine and cosine by Cody and Waite's reduction to an eighth of a turn and the
//! polynomials of fdlibm.

use pulp::Simd;
use tress_geometry::factorial_series;

use super::Lane;

/// The functions of a turning angle that an element and its derivatives need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ratios<S: Simd> {
    /// `sin x / x`
    pub(crate) a: Lane<S>,
    /// `(1 - cos x) / x^2`
    pub(crate) b: Lane<S>,
    /// `(x - sin x) / x^3`
    pub(crate) c: Lane<S>,
    /// `b'(x) / x`
    pub(crate) db: Lane<S>,
    /// `c'(x) / x`
    pub(crate) dc: Lane<S>,
}

/// Greatest `x^2` of the series: 4 radians an element, five eighths of a turn.
///
/// Beyond it the terms grow before they fall and digits cancel, and more than [`TERMS`] are needed.
const SERIES_UP_TO: f64 = 16.0;

/// At `x = 4` the first term left out is below `2e-17` of the sum, in the slopes below `4e-16`.
const TERMS: usize = 17;

const B: [f64; TERMS] = factorial_series(2);
const C: [f64; TERMS] = factorial_series(3);

/// The ratios of the angle whose square is `y`, which is not negative.
#[inline(always)]
pub(crate) fn ratios<S: Simd>(y: Lane<S>) -> Ratios<S> {
    let simd = y.simd();
    let one = Lane::splat(simd, 1.0);
    let ((b, db), (c, dc)) = (horner(&B, y), horner(&C, y));
    let near = Ratios { a: one - y * c, b, c, db: db + db, dc: dc + dc };
    let far = Lane::splat(simd, SERIES_UP_TO).below(y);
    if !far.any() {
        return near;
    }
    let beyond = closed_form(far.select(y, one));
    Ratios {
        a: far.select(beyond.a, near.a),
        b: far.select(beyond.b, near.b),
        c: far.select(beyond.c, near.c),
        db: far.select(beyond.db, near.db),
        dc: far.select(beyond.dc, near.dc),
    }
}

/// A polynomial and its derivative.
#[inline(always)]
fn horner<S: Simd>(terms: &[f64; TERMS], y: Lane<S>) -> (Lane<S>, Lane<S>) {
    let simd = y.simd();
    let mut value = Lane::splat(simd, terms[TERMS - 1]);
    let mut slope = Lane::splat(simd, 0.0);
    for &term in terms[..TERMS - 1].iter().rev() {
        slope = slope.mul_add(y, value);
        value = value.mul_add(y, Lane::splat(simd, term));
    }
    (value, slope)
}

#[inline(always)]
fn closed_form<S: Simd>(y: Lane<S>) -> Ratios<S> {
    let x = y.sqrt();
    let (sine, cosine) = sin_cos(x);
    let one = Lane::splat(y.simd(), 1.0);
    let (a, b, c) = (sine / x, (one - cosine) / y, (x - sine) / (x * y));
    Ratios { a, b, c, db: (a - b * 2.0) / y, dc: (b - c * 3.0) / y }
}

/// `sin x`, `cos x` to `2e-16` for `|x|` up to `1e5`; beyond it digits are lost in proportion.
#[inline(always)]
fn sin_cos<S: Simd>(x: Lane<S>) -> (Lane<S>, Lane<S>) {
    // A quarter turn in three parts; the products of the first two with a count are exact.
    const QUARTER: [f64; 3] = [1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21];
    const SINE: [f64; 6] = [
        -1.66666666666666324348e-01,
        8.33333333332248946124e-03,
        -1.98412698298579493134e-04,
        2.75573137070700676789e-06,
        -2.50507602534068634195e-08,
        1.58969099521155010221e-10,
    ];
    const COSINE: [f64; 6] = [
        4.16666666666666019037e-02,
        -1.38888888888741095749e-03,
        2.48015872894767294178e-05,
        -2.75573143513906633035e-07,
        2.08757232129817482790e-09,
        -1.13596475577881948265e-11,
    ];
    let quarters = nearest_integer(x * std::f64::consts::FRAC_2_PI);
    let part = |p: f64| Lane::splat(x.simd(), -p);
    let r = quarters.mul_add(part(QUARTER[0]), x);
    let r = quarters.mul_add(part(QUARTER[1]), r);
    let r = quarters.mul_add(part(QUARTER[2]), r);
    let z = r * r;
    let one = Lane::splat(x.simd(), 1.0);
    let sine = r + r * z * polynomial(&SINE, z);
    let cosine = one - z * 0.5 + z * z * polynomial(&COSINE, z);
    // Which of the four quarters: -2, -1, 0, 1 or 2.
    let quarter = quarters - nearest_integer(quarters * 0.25) * 4.0;
    let odd = quarter.abs().is(1.0);
    let half_turn = quarter.abs().is(2.0);
    let (s, c) = (odd.select(cosine, sine), odd.select(sine, cosine));
    (half_turn.or(quarter.is(-1.0)).select(-s, s), half_turn.or(quarter.is(1.0)).select(-c, c))
}

#[inline(always)]
fn polynomial<S: Simd, const N: usize>(terms: &[f64; N], z: Lane<S>) -> Lane<S> {
    let mut value = Lane::splat(z.simd(), 0.0);
    for &term in terms.iter().rev() {
        value = value.mul_add(z, Lane::splat(z.simd(), term));
    }
    value
}

/// Adding and taking off 1.5 times two to the 52 leaves no digit behind the point.
#[inline(always)]
fn nearest_integer<S: Simd>(x: Lane<S>) -> Lane<S> {
    let magic = Lane::splat(x.simd(), 6755399441055744.0);
    (x + magic) - magic
}

#[cfg(test)]
mod tests {
    use pulp::Scalar;

    use super::*;

    fn one(x: f64) -> Lane<Scalar> {
        Lane::splat(Scalar::new(), x)
    }

    fn value(lane: Lane<Scalar>) -> f64 {
        lane.to_array()[0]
    }

    #[test]
    fn sine_and_cosine_are_those_of_the_library() {
        for i in 0..200_000 {
            let x = 1e5 * (f64::from(i) / 2e5).powi(3);
            let (s, c) = sin_cos(one(x));
            let worst = (value(s) - x.sin()).abs().max((value(c) - x.cos()).abs());
            assert!(worst < 2.3e-16, "{x}: {worst:e}");
        }
    }

    #[test]
    fn series_and_closed_form_meet_where_one_takes_over() {
        let series = ratios(one(SERIES_UP_TO));
        let closed = closed_form(one(SERIES_UP_TO));
        for (p, q) in [
            (series.a, closed.a),
            (series.b, closed.b),
            (series.c, closed.c),
            (series.db, closed.db),
            (series.dc, closed.dc),
        ] {
            assert!((value(p) - value(q)).abs() < 3e-15, "{p:?} against {q:?}");
        }
    }

    #[test]
    fn ratios_are_those_of_an_element() {
        use glam::DVec3;
        use tress_geometry::Element;
        // An element about the tangent and one about v read off all five.
        for i in 0..2_000 {
            let x = 30.0 * (f64::from(i) / 2e3).powi(2);
            let r = ratios(one(x * x));
            let plane = Element { curvature: DVec3::new(0.0, 0.0, x), length: 1.0 };
            let rotation = plane.rotation(1.0);
            let (turning, moving) = plane.derivatives(1.0);
            assert!((value(r.a) * x - rotation.x_axis.y).abs() < 4e-15 * (1.0 + x));
            assert!(
                (value(r.b) - plane.displacement(1.0).y / x.max(1e-300)).abs() < 1e-14 || x == 0.0
            );
            assert!((1.0 - value(r.c) * x * x - turning.x_axis.x).abs() < 1e-14);
            let by_v = moving.z_axis;
            let slope = value(r.b) + value(r.db) * x * x;
            assert!((slope - by_v.y).abs() < 2e-14, "{x}: {slope} against {}", by_v.y);
            let along = -x * (value(r.dc) * x * x + 2.0 * value(r.c));
            assert!((along - by_v.x).abs() < 5e-14, "{x}: {along} against {}", by_v.x);
        }
    }
}
