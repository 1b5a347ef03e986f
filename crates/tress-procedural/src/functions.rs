//! The transcendental functions of the operators, without branches and without calls.
//!
//! A loop over a slice that calls these is turned into vector instructions by the compiler; one
//! that calls the libraries' `exp` and `sin_cos` is not. Rounding to a whole number goes by adding
//! and taking away `1.5 * 2^52`, which leaves the whole number in the low bits of the sum; no
//! fused multiply-add is asked for. So the same bits come out on every machine.

/// `1.5 * 2^52`: a number that is added to it is rounded to a whole number, half to even.
const ROUND: f64 = 6755399441055744.0;

/// `e^x`, to 2 ulp; arguments beyond +-700 count as +-700.
///
/// `x = k ln 2 + r` with `|r| <= ln 2 / 2`, and the series of `e^r` to the 13th power, whose rest
/// is below `2^-57`.
#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    let x = if x > 700.0 { 700.0 } else { x };
    let x = if x < -700.0 { -700.0 } else { x };
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let r = (x - k * 6.931471803691238e-1) - k * 1.9082149292705877e-10;
    let mut sum = 1.0 / 6227020800.0;
    for term in [479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0, 720.0] {
        sum = sum * r + 1.0 / term;
    }
    for term in [120.0, 24.0, 6.0, 2.0, 1.0, 1.0] {
        sum = sum * r + 1.0 / term;
    }
    let power = (shifted.to_bits().wrapping_add(1023)) << 52;
    sum * f64::from_bits(power)
}

/// The logistic function `1 / (1 + e^-x)`.
#[inline(always)]
pub(crate) fn sigmoid(x: f64) -> f64 {
    1.0 / (1.0 + exp(-x))
}

/// Sine and cosine of an angle given in turns, to `4e-16`, for less than `2^50` turns.
///
/// The nearest quarter turn is taken away; what is left, at most an eighth, goes into the two
/// series, and the quarters are put back by exchanging them and changing signs.
#[inline(always)]
pub(crate) fn sin_cos_turns(turns: f64) -> (f64, f64) {
    let shifted = 4.0 * turns + ROUND;
    let quarters = shifted.to_bits();
    let x = (turns - (shifted - ROUND) * 0.25) * std::f64::consts::TAU;
    let y = x * x;
    let mut s = -1.0 / 1307674368000.0;
    for term in [6227020800.0, -39916800.0, 362880.0, -5040.0, 120.0, -6.0, 1.0] {
        s = s * y + 1.0 / term;
    }
    let s = s * x;
    let mut c = 1.0 / 20922789888000.0;
    for term in [-87178291200.0, 479001600.0, -3628800.0, 40320.0, -720.0, 24.0, -2.0, 1.0] {
        c = c * y + 1.0 / term;
    }
    let odd = 0_u64.wrapping_sub(quarters & 1);
    let (s, c) = (s.to_bits(), c.to_bits());
    let sine = (s & !odd) | (c & odd);
    let cosine = (c & !odd) | (s & odd);
    let sine_sign = (quarters & 2) << 62;
    let cosine_sign = (quarters.wrapping_add(1) & 2) << 62;
    (f64::from_bits(sine ^ sine_sign), f64::from_bits(cosine ^ cosine_sign))
}

/// The whole number at or below `x` (as bits to count with) and how far `x` is above it.
///
/// A whole `x` may be said to be 1 above the number below it.
#[inline(always)]
pub(crate) fn floor(x: f64) -> (u64, f64) {
    let shifted = x - 0.5 + ROUND;
    (shifted.to_bits(), x - (shifted - ROUND))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponentials_agree_with_the_library() {
        for i in -7000..=7000 {
            let x = f64::from(i) * 0.1;
            assert!((exp(x) / x.exp() - 1.0).abs() < 1e-15, "e^{x}");
        }
        assert!(exp(f64::NAN).is_nan());
        assert!((sigmoid(0.0) - 0.5).abs() < 1e-16);
        assert!(sigmoid(-1e9) < 1e-300);
    }

    #[test]
    fn sines_and_cosines_agree_with_the_library() {
        for i in -20000..=20000 {
            let turns = f64::from(i) * 0.00217;
            let (sine, cosine) = sin_cos_turns(turns);
            // The library rounds the angle, which is up to 280 radians.
            let (s, c) = (turns * std::f64::consts::TAU).sin_cos();
            assert!((sine - s).abs() < 1e-13 && (cosine - c).abs() < 1e-13, "{turns} turns");
            assert!((sine.hypot(cosine) - 1.0).abs() < 1e-15);
        }
        assert_eq!(sin_cos_turns(0.25), (1.0, 0.0));
        assert_eq!(sin_cos_turns(1e6), (0.0, 1.0));
    }

    #[test]
    fn floors_are_below() {
        for x in [-2.5, -2.0, -0.1, 0.0, 0.3, 1.0, 255.75] {
            let (bits, above) = floor(x);
            assert!((0.0..=1.0).contains(&above), "{x}");
            let whole = f64::from_bits(bits) - ROUND;
            assert!((whole + above - x).abs() < 1e-15, "{x}");
        }
    }
}
