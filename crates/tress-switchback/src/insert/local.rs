//! A strand's own coil: the strand straightened, and its mean about a place.
//!
//! Seen from a frame that winds, what bends the axis goes round once a turn; averaged over a turn
//! it vanishes and the coil is left. The average must be over a whole turn, neither more nor less:
//! what is left of the bending would be mirrored with the coil, and the axis would drift.

use std::f64::consts::TAU;

use glam::DVec3;
use tress_geometry::Element;

/// The elements with their curvatures averaged over the turn about the middle of each; near the
/// ends over the first and last turn, and over all of a strand that turns less than once.
pub(super) fn straighten(elements: &[Element]) -> Vec<Element> {
    let rough = tress_analysis::smoothed(elements);
    let integral = Integral::new(elements);
    let mut middle = 0.0;
    let mut straightened = Vec::with_capacity(elements.len());
    for (element, rough) in elements.iter().zip(&rough) {
        middle += 0.5 * element.length;
        let turn = (TAU / rough.curvature.length()).min(integral.length);
        let from = (middle - 0.5 * turn).clamp(0.0, integral.length - turn);
        let mean = (integral.at(from + turn) - integral.at(from)) / turn;
        let curvature = if mean.is_finite() { mean } else { element.curvature };
        straightened.push(Element { curvature, length: element.length });
        middle += 0.5 * element.length;
    }
    straightened
}

/// The integral of the curvature from the root.
struct Integral<'a> {
    elements: &'a [Element],
    /// Arc length and integral where each element begins.
    begins: Vec<(f64, DVec3)>,
    length: f64,
}

impl<'a> Integral<'a> {
    fn new(elements: &'a [Element]) -> Self {
        let (mut s, mut sum) = (0.0, DVec3::ZERO);
        let begins = elements.iter().map(|element| {
            let begins = (s, sum);
            s += element.length;
            sum += element.curvature * element.length;
            begins
        });
        Self { elements, begins: begins.collect(), length: s }
    }

    fn at(&self, s: f64) -> DVec3 {
        let behind = self.begins.partition_point(|(begins, _)| *begins <= s);
        let Some(i) = behind.checked_sub(1) else { return DVec3::ZERO };
        let (begins, sum) = self.begins[i];
        sum + self.elements[i].curvature * (s - begins)
    }
}

/// Mean curvature of the straightened strand from a turn before the place to a turn behind it, or
/// as far as the strand goes.
pub(super) fn coil(straightened: &[Element], place: f64) -> DVec3 {
    let mut begins = 0.0;
    let there = straightened.iter().find(|element| {
        begins += element.length;
        place <= begins
    });
    let turning = there.map_or(0.0, |element| element.curvature.length());
    let turn = if 0.0 < turning { TAU / turning } else { f64::INFINITY };
    let (mut sum, mut length, mut s) = (DVec3::ZERO, 0.0, 0.0);
    for element in straightened {
        let ends = s + element.length;
        let overlap = ends.min(place + turn) - s.max(place - turn);
        if 0.0 < overlap {
            sum += element.curvature * overlap;
            length += overlap;
        }
        s = ends;
    }
    if 0.0 < length { sum / length } else { DVec3::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_bends_the_axis_is_averaged_out_and_the_coil_is_not() {
        // 6.3 elements to a turn, with a bend that goes round once a turn.
        let coil = Element { length: 0.5, ..Element::coil(0.5, 0.2) };
        let angle = |i: u32| coil.curvature.length() * coil.length * (f64::from(i) + 0.5);
        let bent = |i| Element {
            curvature: coil.curvature + 0.1 * DVec3::new(0.0, angle(i).cos(), angle(i).sin()),
            ..coil
        };
        let elements: Vec<Element> = (0..60).map(bent).collect();
        for element in straighten(&elements) {
            let off = element.curvature.distance(coil.curvature);
            assert!(off < 3e-3, "{off}");
        }
        assert_eq!(straighten(&[]), []);
    }

    #[test]
    fn only_the_turns_about_the_place_count() {
        let coil_of = |radius, length| Element { length, ..Element::coil(radius, 0.3) };
        let strand = [coil_of(0.5, 40.0), coil_of(0.25, 40.0)];
        assert!(coil(&strand, 20.0).distance(strand[0].curvature) < 1e-14);
        assert!(coil(&strand, 60.0).distance(strand[1].curvature) < 1e-14);
        let between = coil(&strand, 40.0);
        assert!(strand[0].bending() < between.z && between.z < strand[1].bending());
        assert_eq!(coil(&[], 0.0), DVec3::ZERO);
    }
}
