//! Values sorted into bars.

/// One bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// How high it is.
    pub height: f64,
}

/// How many of the finite values lie in each of `bars` bins of equal width, from the least value to
/// the greatest; none without a value or a bar.
///
/// ```
/// use tress_view::plot::histogram;
///
/// let bars = histogram(&[0.0, 1.0, 1.5, 4.0, f64::NAN], 2);
/// assert_eq!((bars[0].to, bars[0].height, bars[1].height), (2.0, 3.0, 1.0));
/// ```
#[must_use]
pub fn histogram(values: &[f64], bars: usize) -> Vec<Bar> {
    let finite = values.iter().copied().filter(|v| v.is_finite());
    let (low, high) =
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    if low <= high { histogram_within(values, bars, [low, high]) } else { vec![] }
}

/// The same within given ends, for histograms that are to be compared; values beyond an end count
/// in the bar at that end, so that none is lost.
#[must_use]
pub fn histogram_within(values: &[f64], bars: usize, [low, high]: [f64; 2]) -> Vec<Bar> {
    let width = (high - low) / bars as f64;
    let ends = |i: usize| (low + width * i as f64, low + width * (i + 1) as f64);
    let mut all: Vec<Bar> =
        (0..bars).map(ends).map(|(from, to)| Bar { from, to, height: 0.0 }).collect();
    for value in values.iter().filter(|v| v.is_finite()) {
        let place = if 0.0 < width { (value - low) / width } else { 0.0 };
        let place = place.max(0.0).min(bars.saturating_sub(1) as f64);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held above")]
        if let Some(bar) = all.get_mut(place as usize) {
            bar.height += 1.0;
        }
    }
    all
}
