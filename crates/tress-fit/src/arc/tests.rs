use glam::{DQuat, DVec3};
use proptest::prelude::*;
use tress_geometry::{Element, Frame};

use super::*;

/// An element, its chord and its end tangents, seen from a turned root.
fn ends(element: &Element, turn: DQuat) -> (DVec3, DVec3, DVec3) {
    let tip = element.advance(&Frame::IDENTITY);
    (turn * tip.position, turn * DVec3::X, turn * tip.tangent())
}

fn tip_of(arc: &HelixArc, t0: DVec3) -> Frame {
    let root = Frame::along(DVec3::ZERO, t0).expect("a unit tangent");
    let q = root.axes.transpose() * arc.darboux;
    Element { curvature: q, length: arc.length }.advance(&root)
}

proptest! {
    #[test]
    fn random_arcs_come_back(
        q in prop::array::uniform3(-1.0..1.0_f64),
        turning in 0.01..6.0_f64,
        length in 0.1..10.0_f64,
        axis in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let q = DVec3::from(q);
        prop_assume!(0.05 < q.length() && 0.05 * q.length() < q.y.hypot(q.z));
        let element = Element { curvature: q * (turning / (length * q.length())), length };
        let (chord, t0, t1) = ends(&element, DQuat::from_scaled_axis(axis.into()));
        // Where the tangents close up after a whole turn, the arc is not told apart any more.
        prop_assume!(0.02 < t0.distance(t1));
        let arc = HelixArc::joining(chord, t0, t1).expect("an arc");
        let tip = tip_of(&arc, t0);
        let off = tip.position.distance(chord) / length;
        prop_assert!(off < 3e-14, "{off:e}");
        prop_assert!(tip.tangent().distance(t1) < 1e-13);
    }
}

#[test]
fn straight_and_circular_limits() {
    let straight = HelixArc::joining(2.0 * DVec3::Y, DVec3::Y, DVec3::Y);
    assert_eq!(straight, Some(HelixArc { darboux: DVec3::ZERO, length: 2.0 }));
    for angle in [1e-12, 1e-8, 1e-4, 0.1, 1.0, 3.0_f64] {
        let (s, c) = angle.sin_cos();
        let chord = DVec3::new(s, 2.0 * (0.5 * angle).sin().powi(2), 0.0);
        let arc = HelixArc::joining(chord, DVec3::X, DVec3::new(c, s, 0.0)).expect("a circle");
        assert!((arc.length - angle).abs() < 1e-14 * angle.max(1.0), "{angle}: {}", arc.length);
        let tip = tip_of(&arc, DVec3::X).position;
        assert!(tip.distance(chord) < 1e-14 * angle.max(1.0), "{angle}");
    }
}

#[test]
fn both_hands_are_told_apart() {
    for twist in [0.7, -0.7] {
        let element = Element { curvature: DVec3::new(twist, 0.3, 1.0), length: 2.0 };
        let (chord, t0, t1) = ends(&element, DQuat::IDENTITY);
        let arc = HelixArc::joining(chord, t0, t1).expect("an arc");
        assert!(arc.darboux.distance(element.curvature) < 1e-12, "{}", arc.darboux);
    }
}

#[test]
fn where_no_arc_is_none_is_given() {
    assert_eq!(HelixArc::joining(DVec3::X, DVec3::X, DVec3::NEG_X), None);
    assert_eq!(HelixArc::joining(DVec3::Y, DVec3::X, DVec3::X), None);
    assert_eq!(HelixArc::joining(DVec3::NEG_X, DVec3::X, DVec3::X), None);
    assert_eq!(HelixArc::joining(DVec3::ZERO, DVec3::X, DVec3::Y), None);
    assert_eq!(HelixArc::joining(DVec3::NAN, DVec3::X, DVec3::Y), None);
    // So short a quarter circle that its curvature is no number.
    assert_eq!(HelixArc::joining(DVec3::new(1e-310, 1e-310, 0.0), DVec3::X, DVec3::Y), None);
}
