use tress_geometry::{Element, Frame, Kept};

use super::*;

/// Two coils with a kept polyline between them; a column over joints and kept points.
fn helices() -> HelixGroom {
    let coil = Element { length: 2.0, ..Element::coil(0.5, 0.3) };
    let elements = Strands::from_counts([2, 0, 1], vec![coil; 3]).unwrap();
    let mut joints = Attributes::new(6);
    joints.insert("w", Column::scalar(vec![1.0, 2.0, 3.0, 0.0, 5.0, 7.0])).unwrap();
    let mut points = Attributes::new(3);
    points.insert("w", Column::scalar(vec![-1.0, -2.0, -3.0])).unwrap();
    let polylines = Strands::from_counts([3], vec![DVec3::NAN, DVec3::ONE, DVec3::X]).unwrap();
    let kept = Kept { strands: vec![1], polylines, point_attributes: points };
    let mut ids = Attributes::new(3);
    ids.insert("id", Column::Int(vec![4, 5, 6])).unwrap();
    HelixGroom::with_attributes(vec![Frame::IDENTITY; 3], elements, ids, joints, kept).unwrap()
}

fn column(groom: &Groom, name: &str) -> Vec<f64> {
    groom.point_attributes().get(name).expect("the column").first_components().collect()
}

#[test]
fn kept_strands_come_back_bit_for_bit() {
    let groom = sample(&helices(), &Sampling::Points(5)).expect("five points");
    assert_eq!(groom.strands().counts().collect::<Vec<_>>(), [5, 3, 5]);
    let bits = |p: &DVec3| p.to_array().map(f64::to_bits);
    let kept: Vec<_> = groom.strands().strand(1).iter().map(bits).collect();
    assert_eq!(kept, [DVec3::NAN, DVec3::ONE, DVec3::X].iter().map(bits).collect::<Vec<_>>());
    assert_eq!(column(&groom, "w")[5..8], [-1.0, -2.0, -3.0]);
}

#[test]
fn attributes_are_interpolated_and_carried() {
    let groom = sample(&helices(), &Sampling::Counts(&[5, 9, 3])).expect("three counts");
    let expected = [1.0, 1.5, 2.0, 2.5, 3.0, -1.0, -2.0, -3.0, 5.0, 6.0, 7.0];
    assert_eq!(column(&groom, "w"), expected);
    assert_eq!(groom.strand_attributes().get("id"), Some(&Column::Int(vec![4, 5, 6])));
}

#[test]
fn spacing_and_points_per_turn_make_the_counts() {
    let counts = |how| -> Vec<usize> {
        sample(&helices(), &how).expect("positive").strands().counts().collect()
    };
    assert_eq!(counts(Sampling::Spacing(0.5)), [9, 3, 5]);
    assert_eq!(counts(Sampling::Spacing(0.3)), [15, 3, 8]);
    assert_eq!(counts(Sampling::Spacing(1e9)), [2, 3, 2]);
    // 1.2667 turns of a coil of radius 0.5 and pitch 0.3 in a length of 4.
    assert_eq!(counts(Sampling::PerTurn(10.0))[0], 14);
    assert_eq!(counts(Sampling::Counts(&[0, 7, 1])), [0, 3, 1]);
}

#[test]
fn neighbours_are_evenly_apart() {
    let groom = sample(&helices(), &Sampling::Points(30)).expect("points");
    let chords: Vec<f64> =
        groom.strands().strand(0).windows(2).map(|ends| ends[0].distance(ends[1])).collect();
    assert!(chords.iter().all(|chord| (chord / chords[0] - 1.0).abs() < 1e-12));
}

#[test]
fn a_column_only_one_side_has_is_left_out() {
    let helices = helices().with_elements(helices().elements().clone()).unwrap();
    let groom = sample(&helices, &Sampling::Points(4)).expect("points");
    assert!(groom.point_attributes().is_empty());
}

#[test]
fn a_column_of_joints_is_interpolated_where_nothing_is_kept() {
    let elements =
        Strands::from_counts([2], vec![Element { length: 2.0, ..Element::default() }; 2]);
    let mut helices = HelixGroom::new(vec![Frame::IDENTITY], elements.unwrap()).unwrap();
    helices.insert_joint_attribute("w", Column::scalar(vec![1.0, 2.0, 6.0])).unwrap();
    let groom = sample(&helices, &Sampling::Points(5)).expect("points");
    assert_eq!(column(&groom, "w"), [1.0, 1.5, 2.0, 4.0, 6.0]);
}

#[test]
fn bad_numbers_are_refused() {
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for how in [Sampling::Spacing(value), Sampling::PerTurn(value)] {
            assert!(matches!(sample(&helices(), &how), Err(SampleError::NotPositive { .. })));
        }
    }
    let huge = [usize::MAX, 1, usize::MAX];
    assert!(matches!(sample(&helices(), &Sampling::Counts(&huge)), Err(SampleError::TooMany(_))));
}
