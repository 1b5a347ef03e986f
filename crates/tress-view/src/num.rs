//! Narrowing of numbers, each said once: pictures are drawn in 32-bit floats and whole pixels.

/// The nearest 32-bit float.
#[expect(clippy::cast_possible_truncation, reason = "the rounding is what is asked for")]
pub(crate) fn narrow(x: f64) -> f32 {
    x as f32
}

/// The whole number below; the nearest there is outside of the range, 0 for NaN.
///
/// Not `f32::floor`, which is a call into the C library on processors of the common baseline.
#[expect(clippy::cast_possible_truncation, reason = "`as` saturates")]
pub(crate) fn floor(x: f32) -> i32 {
    let whole = x as i32;
    if x < whole as f32 { whole.saturating_sub(1) } else { whole }
}

/// The whole number above, held to 0 to `most`; 0 for NaN.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
pub(crate) fn ceil_to_count(x: f64, most: u32) -> u32 {
    (x.ceil() as u32).min(most)
}

/// The nearest byte; 0 for NaN.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
pub(crate) fn byte(v: f32) -> u8 {
    v.round() as u8
}

/// A pixel count or place as an index.
#[expect(clippy::cast_sign_loss, reason = "held to what is not negative")]
pub(crate) fn index(x: i32) -> usize {
    x.max(0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_out_of_range() {
        assert_eq!((floor(-0.5), floor(f32::INFINITY), floor(f32::NAN)), (-1, i32::MAX, 0));
        assert_eq!(
            (ceil_to_count(2.1, 9), ceil_to_count(1e99, 9), ceil_to_count(-3.0, 9)),
            (3, 9, 0)
        );
        assert_eq!((byte(-1.0), byte(254.6), byte(1e9), byte(f32::NAN)), (0, 255, 255, 0));
        assert_eq!((index(-3), index(7)), (0, 7));
    }
}
