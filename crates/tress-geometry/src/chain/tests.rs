use proptest::prelude::*;

use super::*;

fn chain() -> impl Strategy<Value = Vec<Element>> {
    let element = (prop::array::uniform3(-20.0..20.0), 0.0..0.5)
        .prop_map(|(q, length)| Element { curvature: DVec3::from_array(q), length });
    prop::collection::vec(element, 1..12)
}

proptest! {
    #[test]
    fn one_walk_gives_what_single_queries_give(elements in chain(), n in 2_usize..20) {
        let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
        let mut positions = vec![DVec3::ZERO; n];
        strand.sample_evenly(&mut positions);
        for (i, position) in positions.iter().enumerate() {
            let s = strand.length() * i as f64 / (n - 1) as f64;
            prop_assert!(position.distance(strand.position_at(s)) < 1e-12);
        }
        prop_assert_eq!(positions[n - 1], strand.position_at(strand.length()));
    }

    #[test]
    fn a_joint_has_one_position_and_one_frame(elements in chain()) {
        let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
        let mut s = 0.0;
        for (element, joint) in elements.iter().zip(strand.joints().skip(1)) {
            s += element.length;
            prop_assert!(strand.position_at(s).distance(joint.position) < 1e-12);
        }
        prop_assert_eq!(strand.joints().last(), Some(strand.tip()));
    }

    #[test]
    fn splitting_an_element_changes_nothing(elements in chain(), at in 0.0..1.0) {
        let whole = SuperHelix { root: Frame::IDENTITY, elements: &elements };
        let mut split = elements.clone();
        let first = Element { length: elements[0].length * at, ..elements[0] };
        split[0].length -= first.length;
        split.insert(0, first);
        let split = SuperHelix { root: Frame::IDENTITY, elements: &split };
        prop_assert!(whole.tip().position.distance(split.tip().position) < 1e-12);
    }
}

#[test]
fn the_first_turn_alone_says_where_the_frame_stands_about_the_tangent() {
    // A little more than a turn about v, or a little less, and then much more about u.
    let of = |length| {
        let first = Element { curvature: DVec3::Z, length };
        [first, Element { curvature: 5.0 * DVec3::Y, length: 9.0 }]
    };
    let (mut root, mut elements) = (Frame::IDENTITY, of(6.3));
    align_frame(&mut root, &mut elements);
    assert!(elements[1].curvature.distance(5.0 * DVec3::Y) < 1e-14);
    let mut elements = of(6.2);
    align_frame(&mut root, &mut elements);
    let bend: DVec3 = elements.iter().map(|element| element.curvature * element.length).sum();
    assert!(bend.distance(f64::hypot(6.2, 45.0) * DVec3::Z) < 1e-13, "{bend}");
}

#[test]
fn queries_outside_are_held_within_the_strand() {
    let elements = [Element { curvature: DVec3::Z, length: 1.0 }];
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    assert_eq!(strand.position_at(-1.0), DVec3::ZERO);
    assert_eq!(strand.position_at(7.0), strand.tip().position);
}

#[test]
fn no_elements_is_a_root_alone() {
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &[] };
    let mut positions = [DVec3::ONE; 3];
    strand.sample_evenly(&mut positions);
    assert_eq!(positions, [DVec3::ZERO; 3]);
    assert_eq!((strand.length(), strand.turns(), strand.joints().count()), (0.0, 0.0, 1));
}
