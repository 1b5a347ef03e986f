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

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use tress_geometry::{Element, Frame, SuperHelix};

    use super::*;

    /// A plane curve whose curvature is `k(s)` in the middle of elements of unlike lengths.
    fn plane(lengths: &[f64], k: impl Fn(f64) -> f64) -> Draft {
        let mut s = 0.0;
        let elements = lengths.iter().map(|&length| {
            s += length;
            Element { curvature: k(s - 0.5 * length) * DVec3::Z, length }
        });
        let elements: Vec<Element> = elements.collect();
        let joints = SuperHelix { root: Frame::IDENTITY, elements: &elements }.joints().collect();
        Draft { joints, elements, ..Draft::default() }
    }

    #[test]
    fn where_curvature_changes_at_one_rate_elements_are_even() {
        let lengths: Vec<f64> = (0..40).map(|i| [0.05, 0.2, 0.1][i % 3]).collect();
        let draft = plane(&lengths, |s| 1.0 + 0.7 * s);
        let length: f64 = lengths.iter().sum();
        let joints = Spacing::of(&draft).joints(7);
        assert_eq!(joints.len(), 8);
        for (i, joint) in joints.iter().enumerate() {
            assert!((joint - length * i as f64 / 7.0).abs() < 1e-12, "{joints:?}");
        }
    }

    #[test]
    fn where_curvature_changes_eight_times_as_fast_elements_are_half_as_long() {
        let lengths: Vec<f64> = (0..4000).map(|i| [0.0004, 0.0006][i % 2]).collect();
        let draft = plane(&lengths, |s| if s < 1.0 { s } else { 1.0 + 8.0 * (s - 1.0) });
        let joints = Spacing::of(&draft).joints(12);
        // Four in the first half and eight in the second, but for what reaches over the middle.
        for (i, joint) in joints.iter().enumerate() {
            let expected = if i < 4 { 0.25 * i as f64 } else { 0.5 + 0.125 * i as f64 };
            assert!((joint - expected).abs() < 2e-3, "{joints:?}");
        }
    }
}
