//! The coil about a place on a strand.

use std::f64::consts::TAU;

use glam::DVec3;
use tress_geometry::Element;

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
