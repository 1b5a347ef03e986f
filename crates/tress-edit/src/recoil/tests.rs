use tress_geometry::Strands;

use super::*;

fn strand(elements: Vec<Element>) -> HelixGroom {
    let elements = Strands::from_counts([elements.len()], elements).expect("one strand");
    HelixGroom::new(vec![Frame::IDENTITY], elements).expect("one root")
}

fn coil(n: usize) -> HelixGroom {
    strand(vec![Element { length: 0.4, ..Element::coil(0.5, -0.8) }; n])
}

fn options(radius: f64, frequency: f64, keep: RecoilKeep) -> RecoilOptions {
    RecoilOptions { radius, frequency, keep }
}

#[test]
fn factors_of_one_change_nothing() {
    for keep in [RecoilKeep::Length, RecoilKeep::Turns, RecoilKeep::Advance] {
        let same = recoil(&coil(30), &options(1.0, 1.0, keep)).expect("good factors");
        let (a, b) = (same.strand(0).tip().position, coil(30).strand(0).tip().position);
        assert!(a.distance(b) < 1e-12, "{keep:?}");
    }
}

#[test]
fn what_is_kept_is_kept() {
    let before = coil(30);
    let measure = |groom: &HelixGroom| {
        let strand = groom.strand(0);
        let advance: f64 = strand.elements.iter().map(|e| e.turns() * e.pitch()).sum();
        (strand.length(), strand.turns(), advance)
    };
    let change = |keep| recoil(&before, &options(1.7, 0.6, keep)).expect("good factors");
    let was = measure(&before);
    assert!((measure(&change(RecoilKeep::Length)).0 - was.0).abs() < 1e-12);
    assert!((measure(&change(RecoilKeep::Turns)).1 - was.1).abs() < 1e-12);
    assert!((measure(&change(RecoilKeep::Advance)).2 - was.2).abs() < 1e-12);
    for keep in [RecoilKeep::Length, RecoilKeep::Turns, RecoilKeep::Advance] {
        let element = change(keep).strand(0).elements[7];
        assert!((element.radius() - 0.85).abs() < 1e-12);
        assert!((element.pitch() + 0.8 / 0.6).abs() < 1e-12, "the hand stays, the pitch grows");
    }
}

#[test]
fn the_strand_keeps_its_direction() {
    // Long enough that the tip's place on its last turn does not matter.
    let before = coil(4000);
    let direction = |groom: &HelixGroom| {
        let strand = groom.strand(0);
        (strand.tip().position - strand.root.position).normalize()
    };
    for (radius, frequency) in [(2.0, 1.0), (0.5, 1.0), (1.0, 3.0), (1.5, 0.5)] {
        let keep = RecoilKeep::Length;
        let after = recoil(&before, &options(radius, frequency, keep)).expect("good factors");
        let cosine = direction(&before).dot(direction(&after));
        assert!(0.995 < cosine, "radius x {radius}, frequency x {frequency}: cosine {cosine}");
    }
}

#[test]
fn the_axis_of_the_first_turn_stays_whatever_follows() {
    // A little more than a turn, and then a coil of the other hand about another axis.
    let first = vec![Element { length: 0.4, ..Element::coil(0.5, -0.8) }; 9];
    assert!((1.0..1.2).contains(&first.iter().map(Element::turns).sum::<f64>()));
    let rest = Element { curvature: DVec3::new(1.5, 2.0, -0.3), length: 0.4 };
    let before = strand([first, vec![rest; 200]].concat());
    let after = recoil(&before, &options(1.6, 0.7, RecoilKeep::Turns)).expect("good factors");
    let axis = |groom: &HelixGroom| {
        let strand = groom.strand(0);
        (strand.root.axes * strand.elements[0].curvature).normalize()
    };
    assert!(axis(&before).distance(axis(&after)) < 1e-14);
}

#[test]
fn a_planar_arc_that_advances_nowhere_keeps_its_turns() {
    let arc = Element { curvature: 2.0 * DVec3::Z, length: 3.0 };
    let options = options(1.5, 4.0, RecoilKeep::Advance);
    let wider = recoil(&strand(vec![arc]), &options).expect("good factors").strand(0).elements[0];
    assert!((wider.turns() - arc.turns()).abs() < 1e-15);
    assert!((wider.radius() - 0.75).abs() < 1e-15);
}

#[test]
fn there_and_back_is_where_it_was() {
    for keep in [RecoilKeep::Length, RecoilKeep::Turns, RecoilKeep::Advance] {
        let there = recoil(&coil(20), &options(2.0, 3.0, keep)).expect("good factors");
        let back = recoil(&there, &options(0.5, 1.0 / 3.0, keep)).expect("good factors");
        for (a, b) in back.strand(0).elements.iter().zip(coil(20).strand(0).elements) {
            assert!(a.curvature.distance(b.curvature) < 1e-12 * b.curvature.length());
            assert!((a.length - b.length).abs() < 1e-12);
        }
    }
}

#[test]
fn straight_twisted_and_planar_elements_are_no_trouble() {
    let odd = [DVec3::ZERO, DVec3::X, DVec3::Z, DVec3::Y * 1e-200, DVec3::splat(1e-160)];
    let elements = odd.map(|curvature| Element { curvature, length: 1.0 }).to_vec();
    for keep in [RecoilKeep::Length, RecoilKeep::Turns, RecoilKeep::Advance] {
        let changed = recoil(&strand(elements.clone()), &options(2.0, 2.0, keep)).expect("factors");
        for element in changed.strand(0).elements {
            assert!(element.curvature.is_finite() && element.length.is_finite(), "{element:?}");
        }
        assert_eq!(changed.strand(0).elements[0], elements[0]);
        assert!(changed.roots()[0].is_valid());
    }
}

#[test]
fn factors_must_be_positive() {
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (radius, frequency) in [(factor, 1.0), (1.0, factor)] {
            let error = recoil(&coil(1), &options(radius, frequency, RecoilKeep::Length));
            assert!(matches!(error, Err(RecoilError::Factor { .. })));
        }
    }
}
