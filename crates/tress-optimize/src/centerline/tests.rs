use tress_geometry::{Element, Frame};

use super::*;

/// A coil of 20 turns whose axis bends, since its curvature rises and falls once a turn.
fn bent_coil(radius: f64) -> HelixGroom {
    let base = Element::coil(radius, 0.6);
    let n = 240;
    let elements = (0..n)
        .map(|i| {
            let phase = TAU * f64::from(i) / 12.0;
            let curvature = base.curvature * (1.0 + 0.03 * phase.sin());
            let turn = TAU / base.curvature.length();
            Element { curvature, length: turn / 12.0 }
        })
        .collect();
    let elements = Strands::from_counts([240], elements).expect("240 elements");
    HelixGroom::new(vec![Frame::IDENTITY], elements).expect("one root")
}

fn greatest_offset(a: &HelixGroom, b: &HelixGroom) -> f64 {
    let (a, b) = (centerline(&a.strand(0)), centerline(&b.strand(0)));
    let whole = a.whole.start.max(b.whole.start)..a.whole.end.min(b.whole.end);
    whole.map(|i| a.points[i].distance(b.points[i])).fold(0.0, f64::max)
}

#[test]
fn the_centerline_of_a_helix_is_its_axis() {
    let coil = Element { length: 0.2, ..Element::coil(0.5, 0.6) };
    let elements = [coil; 120];
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    let axis = coil.curvature.normalize();
    let line = centerline(&strand).points;
    let middle = line[60];
    for point in &line[20..100] {
        let off = (*point - middle).reject_from(axis).length();
        assert!(off < 0.01, "{off} from the axis");
    }
}

#[test]
fn a_wider_coil_is_brought_back_to_its_line() {
    let before = bent_coil(0.5);
    // The same advance with a wider coil, bent otherwise.
    let mut wide = bent_coil(0.5);
    let mut coils = wide.elements_mut().iter_mut();
    for element in coils.next().expect("one strand") {
        element.curvature *= 0.9;
        element.length *= 1.1;
    }
    drop(coils);
    let off = greatest_offset(&before, &wide);
    let held = hold_centerlines(&before, &mut wide).expect("as many strands");
    let left = greatest_offset(&before, &wide);
    assert_eq!(held, 1);
    assert!(left < 0.25 * off, "off by {off} before and {left} after");
}

#[test]
fn straight_and_short_strands_stay() {
    let straight = vec![Element { length: 1.0, ..Element::default() }; 3];
    let elements = Strands::from_counts([3, 0], straight).expect("three elements");
    let groom = HelixGroom::new(vec![Frame::IDENTITY; 2], elements).expect("two roots");
    let mut same = groom.clone();
    assert_eq!(hold_centerlines(&groom, &mut same), Ok(0));
    assert_eq!(same, groom);
    let mut fewer = groom.select(&[0]);
    assert!(matches!(hold_centerlines(&groom, &mut fewer), Err(SculptError::Strands { .. })));
}
