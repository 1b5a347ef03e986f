//! From numbers to colours and back: ranges, colour maps and the ticks of a legend.

use colorgrad::Gradient;
use serde::{Deserialize, Serialize};

use crate::color::Rgb;
use crate::num::narrow;

/// A path through the colours along which equal steps look equal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum ColorMap {
    /// Violet over green to yellow, ever lighter: for a quantity with a natural order.
    #[default]
    Viridis,
    /// Blue over grey to yellow, the same to every kind of colour vision.
    Cividis,
    /// Blue over white to red: for a quantity with a sign.
    BlueRed,
    /// Violet over white to green: for one of two sides, as handedness.
    PurpleGreen,
    /// Around the colour circle: for angles, whose ends meet.
    Cyclic,
}

impl ColorMap {
    /// The colour at `t`, held to 0 to 1; `t` that is not a number is 0.
    ///
    /// ```
    /// use tress_view::ColorMap;
    ///
    /// assert_eq!(ColorMap::Cyclic.rgb(0.0), ColorMap::Cyclic.rgb(1.0));
    /// let [r, _, b] = ColorMap::BlueRed.rgb(0.1);
    /// assert!(r < b, "low is blue");
    /// ```
    #[must_use]
    pub fn rgb(self, t: f64) -> Rgb {
        use colorgrad::preset;
        let t = if t.is_nan() { 0.0 } else { narrow(t.clamp(0.0, 1.0)) };
        let color = match self {
            // The darkest shades are no longer seen in the shadow of other hair.
            Self::Viridis => preset::viridis().at(0.1 + 0.9 * t),
            Self::Cividis => preset::cividis().at(0.1 + 0.9 * t),
            // The outermost shades are near black, and hair has shadows of its own.
            Self::BlueRed => preset::rd_bu().at(0.92 - 0.84 * t),
            Self::PurpleGreen => preset::pr_gn().at(0.12 + 0.76 * t),
            Self::Cyclic => preset::sinebow().at(t),
        };
        let [r, g, b, _] = color.to_rgba8();
        [r, g, b]
    }

    /// Whether the middle of the map stands for zero.
    #[must_use]
    pub fn is_diverging(self) -> bool {
        matches!(self, Self::BlueRed | Self::PurpleGreen)
    }
}

/// What colours stand for: a range of numbers, with the words for its legend.
///
/// ```
/// use tress_view::{ColorMap, Scale};
///
/// let radius = [0.3, 0.5, f64::NAN, 0.4];
/// let scale = Scale { title: "coil radius".into(), unit: "mm".into(), ..Scale::spanning(radius) };
/// assert_eq!((scale.min, scale.max), (0.3, 0.5));
/// assert_eq!(scale.caption(), "coil radius (mm)");
/// assert!((scale.place(0.4).expect("a number") - 0.5).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scale {
    /// The number at the low end of the map.
    pub min: f64,
    /// The number at the high end.
    pub max: f64,
    /// What is shown.
    pub title: String,
    /// The unit it is in; empty for none.
    pub unit: String,
    /// The colours.
    pub map: ColorMap,
}

/// A number on a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The number.
    pub value: f64,
    /// How it is written.
    pub label: String,
}

impl Scale {
    /// From the least to the greatest of the finite values; 0 to 0 when there is none.
    #[must_use]
    pub fn spanning(values: impl IntoIterator<Item = f64>) -> Self {
        let finite = values.into_iter().filter(|v| v.is_finite());
        let (min, max) =
            finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        if min <= max { Self { min, max, ..Self::default() } } else { Self::default() }
    }

    /// Without the lowest and the highest `share` of the finite values (0 to 0.5), so that a few
    /// strays do not take the colours of all others.
    ///
    /// ```
    /// use tress_view::Scale;
    ///
    /// let values = (0..=100).map(|i| if i == 7 { 1e9 } else { f64::from(i) });
    /// let scale = Scale::without_strays(values, 0.02);
    /// assert_eq!((scale.min, scale.max), (2.0, 99.0));
    /// ```
    #[must_use]
    pub fn without_strays(values: impl IntoIterator<Item = f64>, share: f64) -> Self {
        let mut sorted: Vec<f64> = values.into_iter().filter(|v| v.is_finite()).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let share = if share.is_finite() { share.clamp(0.0, 0.5) } else { 0.0 };
        let within = |i: usize| i as f64 >= share * (sorted.len() as f64 - 1.0);
        let first = (0..sorted.len()).find(|&i| within(i)).unwrap_or(0);
        let last = sorted.len().saturating_sub(1 + first).max(first);
        Self::spanning([first, last].iter().filter_map(|&i| sorted.get(i).copied()))
    }

    /// The same with 0 in the middle, as a diverging map wants it.
    #[must_use]
    pub fn symmetric(self) -> Self {
        let most = self.min.abs().max(self.max.abs());
        Self { min: -most, max: most, ..self }
    }

    /// Title and unit.
    #[must_use]
    pub fn caption(&self) -> String {
        if self.unit.is_empty() {
            self.title.clone()
        } else {
            format!("{} ({})", self.title, self.unit)
        }
    }

    /// Where a number lies between the ends, held to 0 to 1; none for NaN.
    ///
    /// On a range without width, the number itself lies in the middle.
    #[must_use]
    pub fn place(&self, value: f64) -> Option<f64> {
        if value.is_nan() {
            return None;
        }
        // Halves, because the width of a range that spans the numbers would not be a number.
        let (low, high) = (0.5 * self.min, 0.5 * self.max);
        let place = (0.5 * value - low) / (high - low);
        Some(if place.is_nan() { 0.5 } else { place.clamp(0.0, 1.0) })
    }

    /// The colour of a number; none for NaN.
    #[must_use]
    pub fn color(&self, value: f64) -> Option<Rgb> {
        self.place(value).map(|t| self.map.rgb(t))
    }

    /// Round numbers between the ends, `most` of them at most (two at least where that is 5 or
    /// more), written with as many decimals as tell them apart.
    ///
    /// A range without width has its number alone; one with an end that is not finite has none.
    ///
    /// ```
    /// use tress_view::Scale;
    ///
    /// let labels = |min, max| {
    ///     let scale = Scale { min, max, ..Scale::default() };
    ///     scale.ticks(6).into_iter().map(|tick| tick.label).collect::<Vec<_>>()
    /// };
    /// assert_eq!(labels(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    /// assert_eq!(labels(-3.0, 3.0), ["\u{2212}2", "0", "2"]);
    /// assert_eq!(labels(0.7, 0.7), ["0.7"]);
    /// assert_eq!(labels(0.0, 4.5e-6)[..3], ["0", "1e\u{2212}6", "2e\u{2212}6"]);
    /// ```
    #[must_use]
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        let (low, high) = (self.min.min(self.max), self.min.max(self.max));
        let span = high - low;
        if self.min.is_nan() || self.max.is_nan() || !span.is_finite() {
            return Vec::new();
        }
        if span <= 1e-12 * high.abs().max(low.abs()) {
            return vec![Tick { value: low, label: sign(format!("{low}")) }];
        }
        let steps = (-1..=3).flat_map(|decade| [1.0, 2.0, 5.0].map(|digit| (digit, decade)));
        let base = (span / most.max(2) as f64).log10().floor();
        for (digit, decade) in steps {
            let exponent = base + f64::from(decade);
            let step = digit * 10_f64.powf(exponent);
            let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
            if last - first < most.max(2) as f64 && 0.0 < step {
                return ticks(first, last, digit, exponent, low.abs().max(high.abs()));
            }
        }
        Vec::new()
    }
}

/// The multiples `first` to `last` of `digit * 10^exponent`.
fn ticks(first: f64, last: f64, digit: f64, exponent: f64, greatest: f64) -> Vec<Tick> {
    let scientific = !(1e-3..1e5).contains(&greatest);
    let count = crate::num::ceil_to_count(last - first, 1000);
    (0..=count)
        .map(|i| {
            let multiple = (first + f64::from(i)) * digit;
            let value = multiple * 10_f64.powf(exponent);
            let label = if multiple == 0.0 && (scientific || 0.0 <= exponent) {
                "0".into()
            } else if scientific {
                // The digits that the multiple itself has, through its own exponent.
                let (digits, own) = split(multiple);
                format!("{digits}e{}", own + exponent)
            } else {
                let decimals = crate::num::ceil_to_count(-exponent, 15) as usize;
                format!("{value:.decimals$}")
            };
            Tick { value, label: sign(label) }
        })
        .collect()
}

/// A whole number as digits in 1 to 10 and an exponent.
fn split(multiple: f64) -> (f64, f64) {
    let exponent = multiple.abs().log10().floor();
    (multiple / 10_f64.powf(exponent), exponent)
}

/// A hyphen is not a minus.
fn sign(label: String) -> String {
    label.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests;
