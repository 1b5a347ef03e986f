//! A distribution in five numbers.

use serde::{Deserialize, Serialize};

/// Least, quartiles and greatest of a set of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantiles {
    /// The least value.
    pub min: f64,
    /// A quarter of the values lie below.
    pub lower: f64,
    /// Half of the values lie below.
    pub median: f64,
    /// Three quarters of the values lie below.
    pub upper: f64,
    /// The greatest value.
    pub max: f64,
}

impl Quantiles {
    /// The quantiles of the finite ones among `values`; `None` if there are none.
    ///
    /// ```
    /// use tress_analysis::Quantiles;
    ///
    /// let q = Quantiles::of([4.0, 1.0, f64::NAN, 2.0, 3.0, 5.0]).expect("five numbers");
    /// assert_eq!((q.min, q.lower, q.median, q.upper, q.max), (1.0, 2.0, 3.0, 4.0, 5.0));
    /// assert_eq!(Quantiles::of([]), None);
    /// ```
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values.into_iter().filter(|v| v.is_finite()).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let last = sorted.len().checked_sub(1)?;
        let at = |quarters: usize| {
            let (index, rest) = (quarters * last / 4, quarters * last % 4);
            let above = sorted[(index + 1).min(last)];
            sorted[index] + (above - sorted[index]) * (rest as f64 / 4.0)
        };
        Some(Self { min: at(0), lower: at(1), median: at(2), upper: at(3), max: at(4) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_lie_between_values_where_there_are_few() {
        let q = Quantiles::of([3.0, 1.0]).expect("two numbers");
        let expected = Quantiles { min: 1.0, lower: 1.5, median: 2.0, upper: 2.5, max: 3.0 };
        assert_eq!(q, expected);
    }
}
