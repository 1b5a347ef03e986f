//! Perlin's gradient noise in one dimension.
//!
//! Between the whole numbers `i` and `i + 1`, with `t = x - i` and Perlin's fade
//! `f = t^3 (6 t^2 - 15 t + 10)`,
//!
//! `n(x) = 2 ((1 - f) g_i t + f g_{i+1} (t - 1))`,
//!
//! `g` drawn evenly from -1 to 1 once and for all, repeating after 256. It is 0 at whole numbers
//! and twice smooth; the factor 2 lets it reach from -1 to 1. (Perlin, "Improving noise", 2002, for
//! the fade.)

use crate::functions::floor;

const PERIOD: usize = 256;

/// The slopes at whole numbers; the first stands at the end again.
static SLOPES: [f64; PERIOD + 1] = slopes();

/// Numbers from -1 to 1, by `SplitMix64`.
const fn slopes() -> [f64; PERIOD + 1] {
    let mut slopes = [0.0; PERIOD + 1];
    let mut state = 0x7e55_u64;
    let mut i = 0;
    while i < PERIOD {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let x = x ^ (x >> 31);
        slopes[i] = (x >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        i += 1;
    }
    slopes[PERIOD] = slopes[0];
    slopes
}

/// The two slopes about `x`, and how far `x` is from the first.
#[inline(always)]
fn cell(x: f64) -> (f64, f64, f64) {
    let (bits, t) = floor(x);
    #[expect(clippy::cast_possible_truncation, reason = "below the period")]
    let i = (bits & (PERIOD as u64 - 1)) as usize;
    (SLOPES[i], SLOPES[i + 1], t)
}

/// The noise at `x`.
#[inline(always)]
pub(crate) fn perlin(x: f64) -> f64 {
    let (a, b, t) = cell(x);
    let fade = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let (left, right) = (a * t, b * (t - 1.0));
    2.0 * (left + fade * (right - left))
}

/// The noise at `x` and its derivative.
#[inline(always)]
pub(crate) fn perlin_and_slope(x: f64) -> (f64, f64) {
    let (a, b, t) = cell(x);
    let fade = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let steep = 30.0 * t * t * (t - 1.0) * (t - 1.0);
    let (left, right) = (a * t, b * (t - 1.0));
    let noise = 2.0 * (left + fade * (right - left));
    (noise, 2.0 * (a + fade * (b - a) + steep * (right - left)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_smooth_bounded_and_repeats() {
        let mut greatest: f64 = 0.0;
        for i in 0..40_000 {
            let x = f64::from(i) * 0.01 - 130.0;
            let (noise, slope) = perlin_and_slope(x);
            let difference = (perlin(x + 1e-6) - perlin(x - 1e-6)) / 2e-6;
            assert!((slope - difference).abs() < 1e-6, "slope at {x}");
            assert!((noise - perlin(x + 256.0)).abs() < 1e-12, "period at {x}");
            greatest = greatest.max(noise.abs());
        }
        assert!(0.6 < greatest && greatest <= 1.0, "{greatest}");
        assert!(perlin(17.0).abs() < 1e-15);
        // Grooms that are stored count on these numbers.
        let stored = [
            (0.25, 0.39957135372330754),
            (100.5, 0.13609172398144087),
            (255.75, -0.3041027772148208),
        ];
        assert!(stored.iter().all(|(x, noise)| (perlin(*x) - noise).abs() < 1e-15));
    }
}
