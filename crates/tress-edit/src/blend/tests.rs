use tress_geometry::{Attributes, Kept, Strands};

use super::*;

fn coil(radius: f64, pitch: f64, root: Frame, n: usize) -> HelixGroom {
    let element = Element { length: 0.3, ..Element::coil(radius, pitch) };
    let elements = Strands::from_counts([n], vec![element; n]).expect("n elements");
    HelixGroom::new(vec![root], elements).expect("one root")
}

fn turned() -> Frame {
    let axes = DMat3::from_rotation_z(2.0) * DMat3::from_rotation_x(0.7);
    Frame { position: DVec3::new(1.0, 2.0, 3.0), axes }
}

fn near(a: &HelixGroom, b: &HelixGroom) -> bool {
    a.iter().zip(b.iter()).all(|(a, b)| {
        a.joints().zip(b.joints()).all(|(a, b)| a.position.distance(b.position) < 1e-12)
    })
}

#[test]
fn the_ends_of_a_blend_are_the_two_grooms() {
    let (a, b) = (coil(0.5, 1.0, Frame::IDENTITY, 20), coil(0.8, -0.5, turned(), 20));
    for space in [BlendSpace::Curvature, BlendSpace::Darboux] {
        assert!(near(&blend(&a, &b, 0.0, space).expect("same counts"), &a), "{space:?}");
        assert!(near(&blend(&a, &b, 1.0, space).expect("same counts"), &b), "{space:?}");
    }
}

#[test]
fn between_a_groom_and_its_rigid_motion_curvature_space_moves_rigidly() {
    let (a, b) = (coil(0.5, 1.0, Frame::IDENTITY, 40), coil(0.5, 1.0, turned(), 40));
    let middle = blend(&a, &b, 0.5, BlendSpace::Curvature).expect("same counts");
    assert_eq!(middle.elements(), a.elements());
    assert!(middle.roots()[0].is_valid());
}

#[test]
fn roots_move_straight_and_turn_the_short_way() {
    // 200 degrees one way are 160 the other: a quarter of the way is 40 degrees back.
    let degrees = |angle: f64| DMat3::from_rotation_z(angle.to_radians());
    let to = Frame { position: 4.0 * DVec3::Y, axes: degrees(200.0) };
    let (a, b) = (coil(0.5, 1.0, Frame::IDENTITY, 3), coil(0.5, 1.0, to, 3));
    for (amount, angle) in [(0.25, -40.0), (0.5, -80.0), (2.0, -320.0), (-0.5, 80.0)] {
        let root = blend(&a, &b, amount, BlendSpace::Curvature).expect("same counts").roots()[0];
        let off = root.axes - degrees(angle);
        assert!(off.to_cols_array().iter().all(|entry| entry.abs() < 1e-14), "{amount}");
        assert_eq!(root.position, 4.0 * amount * DVec3::Y);
    }
}

#[test]
fn strands_kept_in_either_groom_stay_as_in_the_first() {
    let coils = coil(0.5, 1.0, Frame::IDENTITY, 6).elements().points().to_vec();
    let with_kept = |kept: u32, counts: [usize; 3], root: Frame| {
        let elements = Strands::from_counts(counts, coils.clone()).expect("six elements");
        let polylines = Strands::from_counts([1], vec![DVec3::ONE]).expect("one point");
        let point_attributes = Attributes::new(1);
        let kept = Kept { strands: vec![kept], polylines, point_attributes };
        let tables = (Attributes::new(3), Attributes::new(9));
        HelixGroom::with_attributes(vec![root; 3], elements, tables.0, tables.1, kept)
            .expect("rows match")
    };
    // The first groom keeps strand 0, the other strand 1: only strand 2 has elements in both.
    let (a, b) = (with_kept(0, [0, 3, 3], Frame::IDENTITY), with_kept(1, [3, 0, 3], turned()));
    let middle = blend(&a, &b, 0.5, BlendSpace::Curvature).expect("kept strands need not match");
    for i in 0..2 {
        assert_eq!(middle.strand(i), a.strand(i), "strand {i}");
    }
    assert!(middle.roots()[2].position.distance(0.5 * turned().position) < 1e-15);
}

#[test]
fn only_curvature_space_keeps_the_coil_half_way() {
    // The same coil, unwound by half a turn at its root: in world space the bends oppose.
    let about_t = DMat3::from_rotation_x(std::f64::consts::PI);
    let half_turn = Frame { position: DVec3::ZERO, axes: about_t };
    let (a, b) = (coil(0.5, 0.5, Frame::IDENTITY, 60), coil(0.5, 0.5, half_turn, 60));
    let radius = |groom: &HelixGroom| {
        groom.strand(0).elements.iter().map(Element::radius).sum::<f64>() / 60.0
    };
    let curvature = blend(&a, &b, 0.5, BlendSpace::Curvature).expect("same counts");
    assert!((radius(&curvature) - 0.5).abs() < 1e-12);
    let darboux = blend(&a, &b, 0.5, BlendSpace::Darboux).expect("same counts");
    assert!(0.1 < (radius(&darboux) - 0.5).abs(), "radius {}", radius(&darboux));
}

#[test]
fn grooms_that_do_not_correspond_are_refused() {
    let one = coil(0.5, 1.0, Frame::IDENTITY, 3);
    let two = HelixGroom::new(
        vec![Frame::IDENTITY; 2],
        Strands::from_counts([3, 0], one.elements().points().to_vec()).expect("3 elements"),
    )
    .expect("two roots");
    let strands = blend(&one, &two, 0.5, BlendSpace::Curvature);
    assert_eq!(strands, Err(BlendError::Strands { a: 1, b: 2 }));
    let counts = blend(&one, &coil(0.5, 1.0, Frame::IDENTITY, 4), 0.5, BlendSpace::Curvature);
    assert_eq!(counts, Err(BlendError::Counts { strand: 0, a: 3, b: 4 }));
    let amount = blend(&one, &one, f64::NAN, BlendSpace::Curvature);
    assert!(matches!(amount, Err(BlendError::Amount(_))));
}

#[test]
fn points_are_mixed_one_by_one() {
    let groom = |x: f64| {
        let points = vec![DVec3::ZERO, DVec3::X * x];
        Groom::new(Strands::from_counts([2], points).expect("two points"))
    };
    let middle = blend_positions(&groom(1.0), &groom(3.0), 0.25).expect("same counts");
    assert_eq!(middle, groom(1.5));
}
