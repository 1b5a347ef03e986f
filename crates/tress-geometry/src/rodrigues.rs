//! Rodrigues' formula and its integral, without cancellation at any curvature.
//!
//! For a constant curvature vector `q`, with `n = |q|` and `x = n s` [CSE 2-3]:
//!
//! `R(q,s) = I + A [q]x + B [q]x^2`, `V(q,s) = s I + B [q]x + C [q]x^2`,
//! `A = sin x / n`, `B = (1 - cos x) / n^2`, `C = (x - sin x) / n^3`.
//!
//! `V` is the integral of `R`. Written with powers of `s` in front, what is left are entire
//! functions of `x` alone, so a straight element (`x = 0`) is like any other.

/// The functions of the turning angle `x` that rotations and displacements need.
///
/// `a = sin x / x`, `b = (1 - cos x) / x^2`, `c = (x - sin x) / x^3`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ratios {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
}

/// Below this angle the series is used.
///
/// Above it the closed forms lose at most two digits (`dc` the most); raising it would need more
/// terms than [`TERMS`].
const SERIES_BELOW: f64 = 1.0;

/// Terms of each series: at `x = 1` the first one left out is below `1e-19` of the first.
const TERMS: usize = 9;

/// The first coefficients `(-1)^k / (2k + m)!` of a series in `x^2`.
///
/// For `m` = 1, 2, 3 it is `sin x / x`, `(1 - cos x) / x^2` and `(x - sin x) / x^3`: the functions
/// of an element's turning angle that its rotation and displacement are made of.
///
/// ```
/// const SINC: [f64; 10] = tress_geometry::factorial_series(1);
/// let at = |x: f64| SINC.iter().rev().fold(0.0, |sum, term| sum * x * x + term);
/// assert!((at(0.7) - 0.7_f64.sin() / 0.7).abs() < 1e-16);
/// ```
#[must_use]
pub const fn factorial_series<const TERMS: usize>(m: u32) -> [f64; TERMS] {
    let mut terms = [0.0; TERMS];
    let mut factorial = 1.0;
    let mut n = 1;
    while n <= m {
        factorial *= n as f64;
        n += 1;
    }
    let mut k = 0;
    let mut sign = 1.0;
    while k < TERMS {
        terms[k] = sign / factorial;
        let next = m as f64 + 2.0 * k as f64;
        factorial *= (next + 1.0) * (next + 2.0);
        sign = -sign;
        k += 1;
    }
    terms
}

/// The series of `f'(x) / x` for the series of `f(x)` in `x^2`.
const fn derivative_over_x(f: [f64; TERMS]) -> [f64; TERMS] {
    let mut terms = [0.0; TERMS];
    let mut k = 1;
    while k < TERMS {
        terms[k - 1] = 2.0 * k as f64 * f[k];
        k += 1;
    }
    terms
}

const A: [f64; TERMS] = factorial_series(1);
const B: [f64; TERMS] = factorial_series(2);
const C: [f64; TERMS] = factorial_series(3);
const DB: [f64; TERMS] = derivative_over_x(B);
const DC: [f64; TERMS] = derivative_over_x(C);

fn horner(coefficients: &[f64; TERMS], y: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, &term| sum * y + term)
}

/// `sin x` and `1 - cos x` for any `x`, the latter without cancellation.
fn sine_and_versine(x: f64) -> (f64, f64) {
    let (half_sine, half_cosine) = (0.5 * x).sin_cos();
    (2.0 * half_sine * half_cosine, 2.0 * half_sine * half_sine)
}

/// The ratios a position or a frame needs.
pub(crate) fn ratios(x: f64) -> Ratios {
    let y = x * x;
    if x < SERIES_BELOW {
        return Ratios { a: horner(&A, y), b: horner(&B, y), c: horner(&C, y) };
    }
    let (sine, versine) = sine_and_versine(x);
    Ratios { a: sine / x, b: versine / y, c: (x - sine) / (x * y) }
}

/// The ratios, and `b'(x) / x` and `c'(x) / x`, which derivatives need.
pub(crate) fn ratios_and_slopes(x: f64) -> (Ratios, f64, f64) {
    let y = x * x;
    let r = ratios(x);
    if x < SERIES_BELOW {
        return (r, horner(&DB, y), horner(&DC, y));
    }
    // From b' = (sin x - 2 x b) / x^2 and c' = (1 - cos x - 3 x^2 c) / x^3.
    (r, (r.a - 2.0 * r.b) / y, (r.b - 3.0 * r.c) / y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_meets_closed_form() {
        let below = ratios_and_slopes(SERIES_BELOW * (1.0 - 1e-15));
        let above = ratios_and_slopes(SERIES_BELOW);
        for (p, q) in [
            (below.0.a, above.0.a),
            (below.0.b, above.0.b),
            (below.0.c, above.0.c),
            (below.1, above.1),
            (below.2, above.2),
        ] {
            assert!((p - q).abs() < 3e-14 * p.abs(), "{p} against {q}");
        }
    }

    #[test]
    fn limits_at_zero_are_those_of_a_straight_element() {
        let (r, db, dc) = ratios_and_slopes(0.0);
        assert_eq!((r.a, r.b, r.c), (1.0, 0.5, 1.0 / 6.0));
        assert!((db + 1.0 / 12.0).abs() < 1e-17 && (dc + 1.0 / 60.0).abs() < 1e-17);
    }

    #[test]
    fn slopes_are_derivatives() {
        for x in [0.3, 0.99, 1.01, 2.0, 7.0, 40.0] {
            let h = 1e-5 * x;
            let (_, db, dc) = ratios_and_slopes(x);
            let up = ratios(x + h);
            let down = ratios(x - h);
            assert!(((up.b - down.b) / (2.0 * h) - db * x).abs() < 1e-9);
            assert!(((up.c - down.c) / (2.0 * h) - dc * x).abs() < 1e-9);
        }
    }
}
