use std::f64::consts::TAU;

use super::*;
use crate::{Material, Profile, Switchback, material_curvature};
use tress_geometry::Frame;

fn strand(elements: &[Element]) -> SuperHelix<'_> {
    SuperHelix { root: Frame::along(DVec3::ONE, DVec3::new(1.0, 2.0, -0.5)).unwrap(), elements }
}

/// A coil in elements of a sixth of a turn or so.
fn coil(radius: f64, pitch: f64, turns: f64) -> Vec<Element> {
    let coil = Element::coil(radius, pitch);
    let length = TAU / coil.curvature.length() / 6.0;
    let mut left = turns * 6.0;
    let mut elements = Vec::new();
    while 0.0 < left {
        elements.push(Element { length: length * left.min(1.0), ..coil });
        left -= 1.0;
    }
    elements
}

/// A coil whose axis bends into an arc: curvature of the axis, seen from the winding frame.
fn bent(radius: f64, pitch: f64, turns: f64, axis_curvature: f64) -> Vec<Element> {
    let straight = coil(radius, pitch, turns);
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &straight };
    let joints: Vec<Frame> = strand.joints().collect();
    let axis = (straight[0].curvature * straight[0].curvature.x.signum()).normalize();
    let about = axis.any_orthonormal_vector() * axis_curvature;
    let add = |(element, joint): (&Element, &Frame)| {
        let middle = element.frame_at(joint, 0.5 * element.length);
        Element { curvature: element.curvature + middle.axes.transpose() * about, ..*element }
    };
    straight.iter().zip(&joints).map(add).collect()
}

/// Direction of the axis about an arc length: the mean of the tangent over two turns, those far
/// from the middle counting less, so that the winding leaves no ripple.
fn axis(strand: &SuperHelix<'_>, s: f64, turn: f64) -> DVec3 {
    let n = 64;
    let shares = (1..n).map(|i| f64::from(i) / f64::from(n));
    let places = shares.clone().map(|x| s + turn * (2.0 * x - 1.0));
    let weights = shares.map(|x| (x * std::f64::consts::PI).sin().powi(2));
    let tangents = strand.frames_at(places).map(|frame| frame.tangent());
    tangents.zip(weights).map(|(t, w)| t * w).sum::<DVec3>().normalize()
}

#[test]
fn a_straight_coil_keeps_all_it_should() {
    for (radius, pitch) in [(0.5, 0.6), (0.5, -0.6), (2.0, 8.0), (0.01, 0.04)] {
        let before = coil(radius, pitch, 40.0);
        let before = strand(&before);
        let length = before.length();
        let turn = length / 40.0;
        let place = 0.5 * length;
        let (elements, placed) =
            insert_at(&before, place, &InsertOptions::default()).expect("room for it");
        let after = strand(&elements);
        assert!((after.length() - length).abs() < 1e-12 * length);
        // Bit for bit before the room.
        let same = elements.iter().zip(before.elements).take_while(|(a, b)| a == b).count();
        let reach: f64 = elements[..=same].iter().map(|element| element.length).sum();
        assert!(place - placed.half_width <= reach + 1e-9 * length, "{same} elements");
        // Behind it the same bending and the other hand.
        let mut s = 0.0;
        for element in &elements {
            s += element.length;
            if place + placed.half_width < s - element.length {
                let q = before.elements[0];
                assert!((element.bending() / q.bending() - 1.0).abs() < 1e-9);
                assert!((element.twist() / q.twist() + 1.0).abs() < 1e-9);
            }
        }
        // The axis is the same line on both sides.
        let (root, tip) = (2.0 * turn, length - 2.0 * turn);
        let direction = axis(&before, root, turn);
        let off = direction.angle_between(axis(&after, tip, turn));
        assert!(off < 1e-6, "{radius} {pitch}: {off}");
        let on_axis = |strand: &SuperHelix<'_>, s: f64| {
            let n = 64;
            let points = (0..n).map(|i| strand.position_at(s + turn * i as f64 / n as f64));
            points.sum::<DVec3>() / n as f64
        };
        let across = on_axis(&after, tip - turn) - on_axis(&before, root);
        let aside = (across - direction * across.dot(direction)).length() / radius;
        assert!(aside < 0.15, "{radius} {pitch}: {aside} radii aside");
    }
}

#[test]
fn the_room_holds_the_switchback_of_the_coil() {
    // A coil of a frequency that is solved for: the room then is the exact switchback.
    let v: f64 = 0.5;
    let curvature = 2.0 * DVec3::new(v, 0.0, (1.0 - v * v).sqrt());
    let before = vec![Element { curvature, length: 0.5 }; 200];
    let options = InsertOptions { share: 1e-4, ..InsertOptions::default() };
    let (elements, placed) = insert_at(&strand(&before), 50.0, &options).expect("room for it");
    let exact = Switchback::new(v, &Material::default()).expect("within range");
    let rest = curvature.length() / exact.coil().turning();
    let mut s = 0.0;
    for element in &elements {
        let from_middle = s + 0.5 * element.length - placed.arc_length;
        s += element.length;
        if from_middle.abs() + element.length < placed.half_width {
            let expected = rest * material_curvature(exact.curvature(from_middle * rest));
            let off = element.curvature.distance(expected) / curvature.length();
            assert!(off < 5e-3, "{from_middle}: {off}");
        }
    }
}

#[test]
fn a_coil_that_tightens_is_met_at_both_ends_of_the_room() {
    let mean = 2.0 * DVec3::new(0.5, 0.0, 0.75_f64.sqrt());
    let tightening = |i: u32| {
        let s = 0.5 * f64::from(i) + 0.25;
        Element { curvature: mean * (1.0 + 0.004 * (s - 50.0)), length: 0.5 }
    };
    let before: Vec<Element> = (0..200).map(tightening).collect();
    let options = InsertOptions { share: 1e-3, ..InsertOptions::default() };
    let (elements, placed) = insert_at(&strand(&before), 50.0, &options).expect("room for it");
    let mut s = 0.0;
    let mut met = 0;
    for pair in elements.windows(2) {
        s += pair[0].length;
        let from_middle = (s - placed.arc_length).abs();
        if (from_middle - placed.half_width).abs() < 1e-9 {
            let jump = pair[0].curvature.distance(pair[1].curvature) / mean.length();
            assert!(jump < 1e-2, "{s}: {jump}");
            met += 1;
        }
    }
    assert_eq!(met, 2);
}

#[test]
fn a_bent_axis_stays_bent_as_it_was() {
    let before = bent(0.5, 0.8, 40.0, 0.02);
    let before = strand(&before);
    let length = before.length();
    let turn = length / 40.0;
    let (elements, placed) = insert_at(&before, 0.4 * length, &InsertOptions::default()).unwrap();
    let after = strand(&elements);
    assert!((after.length() - length).abs() < 1e-12 * length);
    let mut s = placed.arc_length + placed.half_width + turn;
    while s < length - turn {
        let off = axis(&before, s, turn).angle_between(axis(&after, s, turn));
        assert!(off < 0.01, "{s}: {off}");
        s += 0.3 * turn;
    }
    let measured = local::straighten(&elements);
    let last = &measured[measured.len() - 12];
    assert!((last.radius() - 0.5).abs() < 0.01, "{}", last.radius());
    assert!((last.pitch() + 0.8).abs() < 0.02, "{}", last.pitch());
}

#[test]
fn elements_of_many_turns_are_no_harder() {
    let one = [Element { length: 150.0, ..Element::coil(0.5, 0.6) }];
    let (elements, _) = insert_at(&strand(&one), 75.0, &InsertOptions::default()).unwrap();
    let last = elements[elements.len() - 1];
    assert!((last.twist() + one[0].twist()).abs() < 1e-9);
    assert!((last.bending() - one[0].bending()).abs() < 1e-9);
}

#[test]
fn how_the_frame_stands_about_the_tangent_does_not_matter() {
    let plain = coil(0.5, 0.6, 40.0);
    let turned: Vec<Element> = plain
        .iter()
        .map(|e| {
            let q = e.curvature;
            Element { curvature: DVec3::new(q.x, 0.6 * q.z, 0.8 * q.z), ..*e }
        })
        .collect();
    let s = 60.0;
    let shape = |elements: &[Element]| {
        let strand = SuperHelix { root: Frame::IDENTITY, elements };
        let (elements, _) = insert_at(&strand, s, &InsertOptions::default()).unwrap();
        let tip = SuperHelix { root: Frame::IDENTITY, elements: &elements }.tip().position;
        (tip.x, tip.length(), elements.len())
    };
    let (a, b) = (shape(&plain), shape(&turned));
    assert!((a.0 - b.0).abs() < 1e-9 && (a.1 - b.1).abs() < 1e-9 && a.2 == b.2);
}

#[test]
fn refusals_say_why() {
    let short = coil(0.5, 0.6, 4.0);
    let short = strand(&short);
    let options = InsertOptions::default();
    let Err(InsertError::NoRoom { needed, .. }) = insert_at(&short, 0.5 * short.length(), &options)
    else {
        panic!("four turns are too few")
    };
    // With as much room as it says it needs, it fits.
    let turns = 4.0 * 2.0 * (needed + 1e-6) / short.length();
    let enough = coil(0.5, 0.6, turns);
    let enough = strand(&enough);
    assert!(insert_at(&enough, 0.5 * enough.length(), &options).is_ok());
    let off = insert_at(&short, -1.0, &options);
    assert!(matches!(off, Err(InsertError::OffStrand { .. })));
    let off = insert_at(&short, f64::NAN, &options);
    assert!(matches!(off, Err(InsertError::OffStrand { .. })));
    let flat = coil(0.5, 0.0, 40.0);
    let flat = insert_at(&strand(&flat), 10.0, &options);
    assert!(matches!(flat, Err(InsertError::NoCoil { .. })));
    let nothing = insert_at(&strand(&[]), 0.0, &options);
    assert!(matches!(nothing, Err(InsertError::NoCoil { .. })));
    for bad in [
        InsertOptions { poisson_ratio: 0.7, ..options },
        InsertOptions { share: 0.0, ..options },
        InsertOptions { share: f64::NAN, ..options },
        InsertOptions { elements_per_turn: 1, ..options },
    ] {
        let error = insert_at(&short, 1.0, &bad);
        assert!(matches!(error, Err(InsertError::Option { .. })), "{error:?}");
    }
}
