//! Where elements of a strand should begin, for any number of them.

use tress_geometry::polyline::place;

use crate::draft::Draft;

/// Shares of a curve.
///
/// An element of length `h` on a curve whose curvature changes by `q'` a unit of length is off by
/// `|q'| h^3`; elements are equally far off when the integral of `|q'|^(1/3)` is shared out evenly.
pub(crate) struct Spacing {
    /// Arc lengths, and that integral up to them.
    arc_lengths: Vec<f64>,
    shares: Vec<f64>,
}

/// Where curvature changes less than this part of its greatest change, elements grow no longer.
const LEAST_SHARE: f64 = 0.1;

impl Spacing {
    pub(crate) fn of(draft: &Draft) -> Self {
        let elements = &draft.elements;
        let jumps: Vec<f64> = (1..elements.len())
            .map(|j| {
                let before = draft.joints[j - 1].axes * elements[j - 1].curvature;
                let jump = draft.joints[j].axes * elements[j].curvature - before;
                jump.length() / (0.5 * (elements[j - 1].length + elements[j].length))
            })
            .collect();
        let densities = (0..elements.len()).map(|j| {
            let near = jumps.get(j.saturating_sub(2)..(j + 2).min(jumps.len())).unwrap_or(&[]);
            near.iter().copied().fold(0.0, f64::max).cbrt()
        });
        let densities: Vec<f64> = densities.collect();
        let greatest = densities.iter().copied().fold(0.0, f64::max);
        let floor = if 0.0 < greatest { LEAST_SHARE * greatest } else { 1.0 };
        let (mut s, mut share) = (0.0, 0.0);
        let (mut arc_lengths, mut shares) = (vec![0.0], vec![0.0]);
        for (element, density) in elements.iter().zip(&densities) {
            s += element.length;
            share += element.length * density.max(floor);
            arc_lengths.push(s);
            shares.push(share);
        }
        Self { arc_lengths, shares }
    }

    /// In the shares that elements between these joints have: one each.
    pub(crate) fn like(joints: Vec<f64>) -> Self {
        let shares = (0..joints.len()).map(|i| i as f64).collect();
        Self { arc_lengths: joints, shares }
    }

    /// Arc lengths of the joints of `n` elements.
    pub(crate) fn joints(&self, n: usize) -> Vec<f64> {
        let total = self.shares.last().copied().unwrap_or(0.0);
        let length = self.arc_lengths.last().copied().unwrap_or(0.0);
        let at = |i: usize| {
            if i == n {
                return length;
            }
            let (j, beyond) = place(&self.shares, total * (i as f64 / n as f64));
            let next = self.arc_lengths.get(j + 1).copied().unwrap_or(length);
            self.arc_lengths[j] + (next - self.arc_lengths[j]) * beyond
        };
        (0..=n).map(at).collect()
    }
}
