use glam::DVec3;
use tress_geometry::{Attributes, Frame, Kept, Strands};

use super::*;

/// Strands of `counts` elements; the curvature of each says which strand and element it is.
fn groom(counts: &[usize]) -> HelixGroom {
    let mark = |i: usize, j: usize| Element {
        curvature: DVec3::new(i as f64, j as f64, 1.0),
        length: 1.0 + i as f64,
    };
    let elements = (0..).zip(counts).flat_map(|(i, &n)| (0..n).map(move |j| mark(i, j))).collect();
    let elements = Strands::from_counts(counts.iter().copied(), elements).expect("counts match");
    HelixGroom::new(vec![Frame::IDENTITY; counts.len()], elements).expect("a root each")
}

fn options(probability: f64, keep: usize) -> RuffleOptions {
    RuffleOptions { probability, keep, ..RuffleOptions::default() }
}

#[test]
fn elements_keep_their_index_and_their_pairing_of_curvature_and_length() {
    let groom = groom(&[50, 50, 50, 50]);
    let (ruffled, report) = ruffle(&groom, &[0, 0, 1, 1], &options(0.8, 5), 1).expect("options");
    for (i, strand) in ruffled.iter().enumerate() {
        for (j, element) in strand.elements.iter().enumerate() {
            let [donor, index, _] = element.curvature.to_array();
            assert!((index - j as f64).abs() < 1e-15, "element {j} came from {index}");
            assert!((element.length - 1.0 - donor).abs() < 1e-15, "length and curvature parted");
            assert!((donor < 2.0) == (i < 2), "strand {donor} is of another group than {i}");
            assert!(5 <= j || (donor - i as f64).abs() < 1e-15, "element {j} was to be kept");
        }
    }
    // 180 candidates, 0.8 replaced, half of those by the strand itself: 72, with deviation 6.6.
    assert_eq!((report.candidates, report.groups), (180, 2));
    assert!((50..95).contains(&report.replaced), "{} replaced", report.replaced);
}

#[test]
fn probability_0_and_blend_0_change_nothing() {
    let groom = groom(&[20, 20]);
    assert_eq!(ruffle(&groom, &[0, 0], &options(0.0, 0), 1).expect("options").0, groom);
    let none = RuffleOptions { blend: 0.0, ..options(1.0, 0) };
    assert_eq!(ruffle(&groom, &[0, 0], &none, 1).expect("options").0, groom);
}

#[test]
fn raising_the_probability_keeps_what_was_replaced() {
    let groom = groom(&[60; 8]);
    let some = ruffle(&groom, &[0; 8], &options(0.1, 0), 9).expect("options").0;
    let more = ruffle(&groom, &[0; 8], &options(0.4, 0), 9).expect("options").0;
    let all = groom.elements().points().iter().zip(some.elements().points());
    for ((was, some), more) in all.zip(more.elements().points()) {
        assert!(some == was || some == more);
    }
    assert_ne!(some, more);
}

#[test]
fn half_a_blend_lies_half_way() {
    let groom = groom(&[10, 10]);
    let whole = ruffle(&groom, &[0, 0], &options(1.0, 0), 2).expect("options").0;
    let half = RuffleOptions { blend: 0.5, ..options(1.0, 0) };
    let half = ruffle(&groom, &[0, 0], &half, 2).expect("options").0;
    let ends = groom.elements().points().iter().zip(whole.elements().points());
    for ((a, b), middle) in ends.zip(half.elements().points()) {
        assert!(middle.curvature.distance(0.5 * (a.curvature + b.curvature)) < 1e-15);
    }
}

#[test]
fn unequal_counts_are_kept_and_said() {
    let groom = groom(&[3, 30, 7, 0]);
    let (ruffled, report) = ruffle(&groom, &[0; 4], &options(1.0, 2), 4).expect("options");
    assert_eq!(ruffled.elements().offsets(), groom.elements().offsets());
    assert!(report.unequal && report.untouched == 1);
    // Beyond the second longest strand only the longest itself has elements.
    assert_eq!(ruffled.strand(1).elements[7..], groom.strand(1).elements[7..]);
}

#[test]
fn polylines_pass_through_and_give_nothing() {
    let plain = groom(&[5, 0, 5]);
    let polylines = Strands::from_counts([1], vec![DVec3::NAN]).expect("one point");
    let kept = Kept { strands: vec![1], polylines, point_attributes: Attributes::new(1) };
    let groom = HelixGroom::with_attributes(
        plain.roots().to_vec(),
        plain.elements().clone(),
        Attributes::new(3),
        Attributes::new(13),
        kept,
    )
    .expect("strand 1 is kept");
    let (ruffled, report) = ruffle(&groom, &[0; 3], &options(1.0, 0), 4).expect("options");
    assert_eq!(ruffled.kept().strands, [1]);
    assert_eq!((report.untouched, report.unequal), (1, false));
}

#[test]
fn groups_and_strands_without_company_are_counted() {
    let groom = groom(&[4, 4, 4, 4]);
    let (same, report) = ruffle(&groom, &[0, 3, 3, 5], &options(1.0, 0), 4).expect("options");
    assert_eq!((report.groups, report.alone, report.candidates), (3, 2, 16));
    // Who is alone gets its own elements, which is no replacement.
    assert_eq!(same.strand(0).elements, groom.strand(0).elements);
    assert!(report.replaced <= 8 && !report.unequal);
    let (far, _) = ruffle(&groom, &[7, u32::MAX, u32::MAX, 0], &options(1.0, 0), 4).expect("any");
    assert_eq!(far, same);
}

#[test]
fn threads_do_not_change_the_result() {
    let groom = groom(&[40; 100]);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| ruffle(&groom, &[0; 100], &options(0.3, 3), 11).expect("options"))
    };
    assert_eq!(on(1), on(4));
}

#[test]
fn options_out_of_range_are_refused() {
    let groom = groom(&[1]);
    for p in [-0.1, 1.1, f64::NAN] {
        let probability = ruffle(&groom, &[0], &options(p, 0), 0);
        assert!(matches!(probability, Err(RuffleError::Probability(_))));
        let blend = RuffleOptions { blend: p, ..RuffleOptions::default() };
        assert!(matches!(ruffle(&groom, &[0], &blend, 0), Err(RuffleError::Blend(_))));
    }
    let error = ruffle(&groom, &[0, 0], &RuffleOptions::default(), 0);
    assert_eq!(error, Err(RuffleError::Groups { groups: 2, strands: 1 }));
}
