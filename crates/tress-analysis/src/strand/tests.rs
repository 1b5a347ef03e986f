use super::*;
use tress_geometry::{Element, Frame};

fn strand(elements: &[Element]) -> StrandMeasures {
    measure(&SuperHelix { root: Frame::IDENTITY, elements })
}

fn coil(pitch: f64, length: f64) -> Element {
    Element { length, ..Element::coil(0.5, pitch) }
}

#[test]
fn a_straight_strand_has_no_radius_and_no_hand() {
    let straight = strand(&[Element { length: 3.0, ..Element::default() }]);
    assert_eq!((straight.coil_radius, straight.hand), (None, Hand::Neither));
    assert_eq!((straight.length, straight.reach, straight.turns), (3.0, 3.0, 0.0));
    assert_eq!(strand(&[]).hand, Hand::Neither);
}

#[test]
fn a_circle_and_a_change_of_hand_have_no_hand() {
    let circle = strand(&[coil(0.0, 10.0)]);
    assert_eq!(circle.hand, Hand::Neither);
    assert!((circle.coil_radius.expect("it goes round") - 0.5).abs() < 1e-3);
    let switchback = strand(&[coil(1.0, 20.0), coil(-1.0, 19.0)]);
    assert_eq!((switchback.hand, switchback.switchbacks), (Hand::Neither, 1));
    assert_eq!(strand(&[coil(1.0, 10.0), coil(-1.0, 2.0)]).hand, Hand::Right);
}

#[test]
fn straight_stretches_have_no_say_in_the_radius() {
    let straight = Element { length: 20.0, ..Element::default() };
    let radius = strand(&[straight, coil(1.0, 30.0), straight]).coil_radius;
    assert!((radius.expect("it turns") - 0.5).abs() < 5e-3, "{radius:?}");
}
