//! What sculpting promises, on seeded strands and on bad input.

use crate::common::{coil, targets};
use glam::DVec3;
use tress_geometry::{Attributes, Element, Frame, HelixGroom, Kept, Strands, SuperHelix};
use tress_optimize::{
    Control, ControlError, OptionsError, SculptError, SculptOptions, Sculptor, Stiffness, Stop,
    sculpt, solve,
};

/// Coils of 3 to 40 elements with 0 to 3 controls.
fn groom(strands: impl IntoIterator<Item = u32>) -> (HelixGroom, Strands<Control>) {
    let (mut roots, mut elements, mut controls) = (vec![], Strands::default(), Strands::default());
    for seed in strands {
        let (n, m) = (3 + seed * 7 % 38, seed % 4);
        let seed = u64::from(seed);
        let (root, strand) = coil(seed, n as usize);
        let helix = SuperHelix { root, elements: &strand };
        controls.push(targets(&helix, m as usize, 0.3, seed)).expect("few points");
        roots.push(root);
        elements.push(strand).expect("few points");
    }
    (HelixGroom::new(roots, elements).expect("a root a strand"), controls)
}

/// Straight along x, of length 2.
fn straight() -> [Element; 4] {
    [Element { curvature: DVec3::ZERO, length: 0.5 }; 4]
}

#[test]
fn a_strand_has_one_result_in_any_company_and_on_any_number_of_threads() {
    let options = SculptOptions::default();
    let (mut whole, controls) = groom(0..150);
    let alone: Vec<_> = (0..150)
        .map(|i| solve(&whole.strand(i), controls.strand(i), &options).expect("good controls"))
        .collect();
    let threads = |n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("threads");
    let (mut shuffled, mixed) = groom((0..150).map(|i| i * 77 % 150));
    threads(1).install(|| sculpt(&mut whole, &controls, &options)).expect("good controls");
    threads(5).install(|| sculpt(&mut shuffled, &mixed, &options)).expect("good controls");
    for (i, (alone, _)) in alone.iter().enumerate() {
        assert_eq!(whole.strand(i).elements, alone, "strand {i} alone");
        let elsewhere = (0..150).position(|j: usize| j * 77 % 150 == i).expect("a permutation");
        assert_eq!(whole.strand(i).elements, shuffled.strand(elsewhere).elements, "strand {i}");
    }
}

#[test]
fn anchors_are_reached_and_lengths_kept_to_the_bit() {
    let (rest, controls) = groom(0..80);
    let mut pose = rest.clone();
    let options = SculptOptions { stiffness: Stiffness::Relative(1e-8), ..Default::default() };
    let sculpted = sculpt(&mut pose, &controls, &options).expect("good controls");
    let mut reached = 0;
    for (i, report) in sculpted.reports.iter().enumerate() {
        let (before, after) = (rest.strand(i), pose.strand(i));
        let lengths = |s: &SuperHelix<'_>| s.elements.iter().map(|e| e.length).collect::<Vec<_>>();
        assert_eq!(lengths(&before), lengths(&after));
        assert_eq!(before.root, after.root);
        let Some(report) = report else {
            assert_eq!(before, after, "a strand without controls");
            continue;
        };
        assert!(report.end.total() <= report.start.total(), "strand {i}: {report:?}");
        // The report says what the strand does.
        let worst = controls
            .strand(i)
            .iter()
            .map(|control| after.position_at(control.arc_length).distance(control.anchor));
        let worst = worst.fold(0.0, f64::max);
        assert!((worst - report.anchor_distance).abs() < 1e-9, "strand {i}: {worst}");
        reached += usize::from(worst < 1e-3 * after.length());
    }
    assert_eq!(sculpted.free, 20);
    let summary = sculpted.summary();
    assert_eq!((summary.strands, summary.stops.values().sum::<usize>()), (60, 60));
    assert!(summary.end.total() < 0.01 * summary.start.total());
    let (strand, worst) = summary.worst.expect("60 strands");
    assert_eq!(sculpted.reports[strand].map(|r| r.anchor_distance), Some(worst));
    assert!(54 <= reached, "{reached} of 60: anchors may be too far from each other");
}

#[test]
fn stiffness_means_the_same_in_another_unit_and_with_twice_the_elements() {
    let (root, elements) = coil(3, 30);
    let strand = SuperHelix { root, elements: &elements };
    let controls = targets(&strand, 2, 0.1, 5);
    let options = SculptOptions { stiffness: Stiffness::Relative(0.3), ..Default::default() };
    let (plain, _) = solve(&strand, &controls, &options).expect("good controls");
    let tip = |elements: &[Element], root| SuperHelix { root, elements }.tip().position;

    let k = 1000.0;
    let large: Vec<_> = elements
        .iter()
        .map(|e| Element { curvature: e.curvature / k, length: e.length * k })
        .collect();
    let big_root = Frame { position: root.position * k, ..root };
    let far: Vec<_> =
        controls.iter().map(|c| Control::new(c.arc_length * k, c.anchor * k)).collect();
    let strand = SuperHelix { root: big_root, elements: &large };
    let (scaled, _) = solve(&strand, &far, &options).expect("good controls");
    let off = tip(&scaled, big_root).distance(k * tip(&plain, root));
    assert!(off < 1e-5 * strand.length(), "{off}");

    let halves: Vec<_> =
        elements.iter().flat_map(|e| [Element { length: 0.5 * e.length, ..*e }; 2]).collect();
    let strand = SuperHelix { root, elements: &halves };
    let (cut, _) = solve(&strand, &controls, &options).expect("good controls");
    let off = tip(&cut, root).distance(tip(&plain, root));
    let moved = tip(&plain, root).distance(tip(&elements, root));
    assert!(off < 0.02 * moved, "{off} of {moved}");
}

#[test]
fn a_small_pull_is_followed_to_the_part_that_stiffness_says() {
    // On the average over directions: the sum over three axes of what each is followed to.
    for stiffness in [0.01, 1.0, 10.0] {
        let (root, elements) = coil(11, 40);
        let strand = SuperHelix { root, elements: &elements };
        let options =
            SculptOptions { stiffness: Stiffness::Relative(stiffness), ..Default::default() };
        let mut least: f64 = 1.0;
        let mut most: f64 = 0.0;
        for axis in DVec3::AXES {
            let step = 1e-5 * strand.length() * axis;
            let tip = strand.tip().position;
            let pull = [Control::new(strand.length(), tip + step)];
            let (sculpted, _) = solve(&strand, &pull, &options).expect("good controls");
            let moved = SuperHelix { root, elements: &sculpted }.tip().position - tip;
            let part = moved.dot(step) / step.length_squared();
            least = least.min(part);
            most = most.max(part);
        }
        let expected = 1.0 / (1.0 + stiffness);
        assert!(least <= expected && expected <= most, "{stiffness}: {least} to {most}");
    }
}

#[test]
fn an_anchor_out_of_reach_stretches_the_strand_and_is_counted() {
    let (root, elements) = coil(8, 30);
    let strand = SuperHelix { root, elements: &elements };
    let length = strand.length();
    let direction = DVec3::new(0.6, 0.0, 0.8);
    let far = [Control::new(length, root.position + 5.0 * length * direction)];
    let options = SculptOptions { stiffness: Stiffness::Relative(1e-9), ..Default::default() };
    let (sculpted, report) = solve(&strand, &far, &options).expect("a far anchor is no error");
    assert_eq!(report.unreachable, 1);
    let tip = SuperHelix { root, elements: &sculpted }.tip().position - root.position;
    assert!(0.95 * length < tip.dot(direction), "{} of {length}: {report:?}", tip.dot(direction));
    assert!((report.anchor_distance - (5.0 * length * direction).distance(tip)).abs() < 1e-9);
}

#[test]
fn anchors_too_far_from_each_other_are_a_compromise() {
    let elements = straight();
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    let apart = [
        Control::new(1.0, DVec3::new(0.0, 0.9, 0.0)),
        Control::new(2.0, DVec3::new(0.0, -0.9, 0.0)),
    ];
    let (_, report) = solve(&strand, &apart, &SculptOptions::default()).expect("within reach");
    assert_eq!(report.unreachable, 0);
    assert!(report.end.total() < 0.5 * report.start.total());
    assert!(0.3 < report.anchor_distance && report.anchor_distance < 0.9, "{report:?}");
}

#[test]
fn a_straight_strand_pushed_along_itself_says_so() {
    let elements = straight();
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    let push = [Control::new(2.0, DVec3::new(1.0, 0.0, 0.0))];
    let (same, report) = solve(&strand, &push, &SculptOptions::default()).expect("good control");
    assert_eq!((report.stop, report.anchor_distance), (Stop::LocalMinimum, 1.0));
    assert_eq!(same, elements);
}

#[test]
fn no_stiffness_at_all_is_allowed() {
    let (root, elements) = coil(21, 25);
    let strand = SuperHelix { root, elements: &elements };
    let controls = targets(&strand, 2, 0.1, 9);
    for stiffness in [Stiffness::Raw(0.0), Stiffness::Relative(0.0)] {
        let options = SculptOptions { stiffness, ..Default::default() };
        let (_, report) = solve(&strand, &controls, &options).expect("zero is a stiffness");
        assert!(report.anchor_distance < 1e-5 * strand.length(), "{report:?}");
    }
}

#[test]
fn controls_at_the_root_of_no_weight_or_none_change_nothing() {
    let (root, elements) = coil(2, 10);
    let strand = SuperHelix { root, elements: &elements };
    let options = SculptOptions::default();
    let at_root = Control::new(0.0, root.position + DVec3::X);
    let idle = Control { weight: 0.0, ..Control::new(strand.length(), DVec3::ZERO) };
    for controls in [&[][..], &[at_root], &[idle]] {
        let (same, report) = solve(&strand, controls, &options).expect("good controls");
        assert_eq!(same, elements);
        assert!(report.iterations <= 1);
    }
}

#[test]
fn elements_of_no_length_are_carried_along() {
    let (root, mut elements) = coil(5, 20);
    elements.insert(7, Element { curvature: DVec3::ONE, length: 0.0 });
    elements.push(Element { curvature: DVec3::ONE, length: 0.0 });
    let strand = SuperHelix { root, elements: &elements };
    let controls = targets(&strand, 2, 0.1, 9);
    let (moved, report) = solve(&strand, &controls, &SculptOptions::default()).expect("good");
    assert_eq!((moved[7], moved[21]), (elements[7], elements[21]));
    assert_eq!(report.stop, Stop::Converged);
}

#[test]
fn a_groom_with_a_bad_control_is_not_touched() {
    let (rest, good) = groom(0..9);
    let mut pose = rest.clone();
    let mut bad = good.clone();
    bad.strand_mut(6)[1].anchor.y = f64::NAN;
    let error = sculpt(&mut pose, &bad, &SculptOptions::default()).unwrap_err();
    assert_eq!(
        error,
        SculptError::Control { strand: 6, source: ControlError::NotFinite { control: 1 } }
    );
    assert_eq!(error.to_string(), "strand 6: control 1 is not finite");
    let stiffness = Stiffness::Raw(-1.0);
    let negative = SculptOptions { stiffness, ..Default::default() };
    let error = sculpt(&mut pose, &good, &negative).unwrap_err();
    assert_eq!(error, SculptError::Options(OptionsError::Stiffness(-1.0)));
    assert_eq!(pose, rest);
}

#[test]
fn strands_that_cannot_be_bent_are_left_and_counted() {
    let tip = || Control::new(0.0, DVec3::ONE);
    let broken = Element { curvature: DVec3::NAN, length: 1.0 };
    let elements = Strands::from_counts([0, 1, 1], vec![broken, straight()[0]]).expect("counts");
    let polylines = Strands::from_counts([1], vec![DVec3::ZERO]).expect("counts");
    let kept = Kept { strands: vec![0], polylines, point_attributes: Attributes::new(1) };
    let tables = (Attributes::new(3), Attributes::new(5));
    let roots = vec![Frame::IDENTITY; 3];
    let mut groom =
        HelixGroom::with_attributes(roots, elements, tables.0, tables.1, kept).expect("rows match");
    let controls = Strands::from_counts([1, 1, 0], vec![tip(), tip()]).expect("counts");
    let options = SculptOptions::default();
    let sculpted = sculpt(&mut groom, &controls, &options).expect("nothing to do is no error");
    assert_eq!((sculpted.kept, sculpted.not_finite, sculpted.free), (1, 1, 1));
    assert_eq!(sculpted.reports, [None; 3]);
    let error = solve(&groom.strand(1), &[tip()], &options).unwrap_err();
    assert_eq!(error, SculptError::NotFinite { strand: 0 });
}

#[test]
fn a_sculptor_follows_a_drag_and_comes_back_to_rest() {
    let (rest, controls) = groom(1..40);
    let options = SculptOptions { stiffness: Stiffness::Relative(1e-3), ..Default::default() };
    let mut sculptor = Sculptor::new(rest.clone(), options).expect("good options");
    let mut frames = vec![];
    for frame in 0..10 {
        let mut dragged = controls.clone();
        for i in 0..dragged.len() {
            for control in dragged.strand_mut(i) {
                let start = rest.strand(i).position_at(control.arc_length);
                control.anchor = start.lerp(control.anchor, 0.03 * f64::from(frame));
            }
        }
        frames.push(sculptor.sculpt(&dragged).expect("good controls"));
    }
    let walks = |f: usize| frames[f].reports.iter().flatten().map(|r| r.iterations).sum::<u32>();
    assert_eq!(walks(0), 30, "one walk a strand to see that nothing moves");
    assert!(walks(9) < 6 * 30, "{}", walks(9));
    // The same energy as from rest: one minimum, two roads.
    let mut dragged = controls.clone();
    for i in 0..dragged.len() {
        for control in dragged.strand_mut(i) {
            let start = rest.strand(i).position_at(control.arc_length);
            control.anchor = start.lerp(control.anchor, 0.27);
        }
    }
    let mut cold = rest.clone();
    let once = sculpt(&mut cold, &dragged, &options).expect("good controls");
    for (warm, cold) in frames[9].reports.iter().zip(&once.reports) {
        if let (Some(warm), Some(cold)) = (warm, cold) {
            let (warm, cold) = (warm.end.total(), cold.end.total());
            assert!((warm - cold).abs() <= 1e-6 * cold, "{warm} {cold}");
        }
    }
    let none = Strands::from_counts(vec![0; rest.len()], vec![]).expect("counts");
    sculptor.sculpt(&none).expect("no controls");
    assert_eq!(sculptor.pose(), &rest);
}

#[test]
fn an_empty_groom_is_sculpted() {
    let mut empty = HelixGroom::new(vec![], Strands::default()).expect("nothing");
    let sculpted = sculpt(&mut empty, &Strands::default(), &SculptOptions::default());
    assert_eq!(sculpted.map(|s| s.reports.len()), Ok(0));
}
