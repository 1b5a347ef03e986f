//! The Wasserstein distance of order 1 of distributions on a line: the area between their
//! cumulative distribution functions, which is how far mass must be moved in the mean.

/// The distance of the distributions of two samples; `None` if one has no finite value.
///
/// ```
/// use tress_analysis::wasserstein;
///
/// assert_eq!(wasserstein(&[1.0, 2.0, 3.0], &[3.0, 1.0, 2.0]), Some(0.0));
/// assert_eq!(wasserstein(&[0.0, 0.0], &[1.0]), Some(1.0));
/// assert_eq!(wasserstein(&[0.0, 4.0], &[1.0]), Some(2.0));
/// assert_eq!(wasserstein(&[], &[1.0]), None);
/// ```
#[must_use]
pub fn wasserstein(a: &[f64], b: &[f64]) -> Option<f64> {
    let shares = |values: &[f64]| -> Vec<(f64, f64)> {
        values.iter().filter(|v| v.is_finite()).map(|&v| (v, 1.0)).collect()
    };
    wasserstein_of_shares(&shares(a), &shares(b))
}

/// The distance of two distributions given as values and their shares, which need not sum to 1;
/// `None` if one has no share.
///
/// ```
/// use tress_analysis::wasserstein_of_shares;
///
/// let (low, high) = ([(0.0, 3.0), (1.0, 1.0)], [(0.0, 1.0), (1.0, 3.0)]);
/// assert_eq!(wasserstein_of_shares(&low, &high), Some(0.5));
/// ```
#[must_use]
pub fn wasserstein_of_shares(a: &[(f64, f64)], b: &[(f64, f64)]) -> Option<f64> {
    let total = |shares: &[(f64, f64)]| shares.iter().map(|&(_, share)| share).sum::<f64>();
    let totals = (total(a), total(b));
    if !(0.0 < totals.0 && 0.0 < totals.1) {
        return None;
    }
    let of_a = a.iter().map(|&(value, share)| (value, share / totals.0));
    let of_b = b.iter().map(|&(value, share)| (value, -share / totals.1));
    let mut steps: Vec<(f64, f64)> = of_a.chain(of_b).collect();
    steps.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then(x.1.total_cmp(&y.1)));
    let (mut apart, mut moved) = (0.0, 0.0);
    for pair in steps.windows(2) {
        apart += pair[0].1;
        let gap = pair[1].0 - pair[0].0;
        moved += if 0.0 < gap { f64::abs(apart) * gap } else { 0.0 };
    }
    // What is left of rounding between distributions that are the same.
    Some(if moved < 1e-12 * (steps[steps.len() - 1].0 - steps[0].0) { 0.0 } else { moved })
}
