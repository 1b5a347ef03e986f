//! Elements with the beat of their sampling averaged out.

use std::f64::consts::PI;

use glam::DVec3;
use tress_geometry::Element;

/// The elements with their curvatures averaged, by length, over the turn about each: from half a
/// turn of bending before its middle to half a turn behind it, or as far as the strand goes.
#[must_use]
pub fn smoothed(elements: &[Element]) -> Vec<Element> {
    // Bending angle at the middle of each element, and sums of q l and l before each.
    let mut middles = Vec::with_capacity(elements.len());
    let mut sums = vec![(DVec3::ZERO, 0.0)];
    let (mut angle, mut curvature, mut length) = (0.0, DVec3::ZERO, 0.0);
    for element in elements {
        let bend = element.bending() * element.length;
        middles.push(angle + 0.5 * bend);
        angle += bend;
        curvature += element.curvature * element.length;
        length += element.length;
        sums.push((curvature, length));
    }
    let (mut first, mut end) = (0, 0);
    let mut averages = Vec::with_capacity(elements.len());
    for (element, middle) in elements.iter().zip(&middles) {
        while middles[first] < middle - PI {
            first += 1;
        }
        while end < elements.len() && middles[end] <= middle + PI {
            end += 1;
        }
        let (before, behind) = (sums[first], sums[end]);
        let length = behind.1 - before.1;
        let mean = (behind.0 - before.0) / length;
        let curvature = if mean.is_finite() { mean } else { element.curvature };
        averages.push(Element { curvature, length: element.length });
    }
    averages
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twist_to_and_fro_is_averaged_out_and_a_coil_is_not() {
        let coil = Element { length: 0.5, ..Element::coil(0.5, 1.0) };
        let mut noisy = vec![coil; 60];
        for (i, element) in noisy.iter_mut().enumerate() {
            let off = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
            element.curvature.x += off * coil.bending();
        }
        // The window holds six or seven elements: one of an odd number is left over.
        for element in &smoothed(&noisy)[6..54] {
            assert!((element.radius() - 0.5).abs() < 0.05, "{element:?}");
        }
        for element in smoothed(&[coil; 60]) {
            assert!((element.curvature - coil.curvature).length() < 1e-12);
        }
    }

    #[test]
    fn a_steady_change_is_neither_hurried_nor_delayed() {
        let element = |i: u32| Element {
            curvature: DVec3::new(0.3, 2.0 + 0.002 * f64::from(i), 0.0),
            length: 0.2,
        };
        let elements: Vec<Element> = (0..100).map(element).collect();
        let smooth = smoothed(&elements);
        for (a, b) in elements[20..80].iter().zip(&smooth[20..80]) {
            assert!((a.curvature - b.curvature).length() < 1e-3, "{a:?} {b:?}");
        }
    }

    #[test]
    fn elements_without_length_keep_their_curvature() {
        let element = Element { curvature: DVec3::X, length: 0.0 };
        assert_eq!(smoothed(&[element]), [element]);
    }
}
