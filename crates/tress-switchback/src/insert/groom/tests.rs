use super::*;
use tress_analysis::Hand;
use tress_geometry::{Column, Frame};

/// Two wisps of three strands, radii and pitches a few percent apart.
fn groom() -> (HelixGroom, Vec<u32>) {
    let mut elements = Strands::default();
    let mut roots = Vec::new();
    for i in 0..6 {
        let share = f64::from(i % 3) * 0.01;
        let coil = Element::coil(0.5 + 0.5 * share, -0.7 - share);
        elements.push(vec![Element { length: 0.4, ..coil }; 200 + 5 * i as usize]).unwrap();
        roots.push(Frame::IDENTITY);
    }
    (HelixGroom::new(roots, elements).unwrap(), vec![0, 0, 0, 1, 1, 1])
}

#[test]
fn strands_of_a_wisp_get_theirs_at_the_same_places() {
    let (groom, groups) = groom();
    let density = Placing::Density(0.05);
    let (_, report) = insert(&groom, &groups, &density, &InsertOptions::default(), 3).unwrap();
    let places = |strand: u32| -> Vec<f64> {
        let of_strand = report.placed.iter().filter(|(i, _)| *i == strand);
        of_strand.map(|(_, placed)| placed.arc_length).collect()
    };
    assert!(!places(0).is_empty() && !places(3).is_empty());
    assert_eq!(places(0), places(1));
    assert_eq!(places(3), places(4));
    assert_ne!(places(0), places(3));
    // Any number names a wisp.
    let far: Vec<u32> = groups.iter().map(|group| group * u32::MAX).collect();
    let (_, same) = insert(&groom, &far, &density, &InsertOptions::default(), 3).unwrap();
    assert_eq!(same.placed[..3], report.placed[..3]);
    assert_eq!(report.asked, report.placed.len() + report.no_room + report.no_coil);
}

#[test]
fn a_density_is_how_many_there_are_in_a_unit_of_length() {
    let places = |density| Placing::Density(density).places(1600.0, strand_rng(5, 0));
    assert_eq!(places(0.0).expect("few"), [0.0; 0]);
    let places = places(0.5).expect("few");
    assert!(places.is_sorted() && places.iter().all(|s| (0.0..1600.0).contains(s)));
    // 800 are expected, with a deviation of 28.
    assert!((690..910).contains(&places.len()), "{}", places.len());
}

#[test]
fn two_switchbacks_give_the_first_hand_back() {
    let (groom, groups) = groom();
    let placing = Placing::Shares(vec![0.75, 0.25]);
    let (changed, report) =
        insert(&groom, &groups, &placing, &InsertOptions::default(), 3).unwrap();
    assert_eq!((report.strands, report.placed.len(), report.no_room), (6, 12, 0));
    assert_eq!(report.placed[0].1.hand_before, Hand::Left);
    assert_eq!(report.placed[1].1.hand_before, Hand::Right);
    // The middle one of a wisp's strands has 205 elements in the one and 220 in the other.
    let placed = |i: usize| report.placed[i].1.arc_length;
    assert!((placed(0) - 0.25 * 82.0).abs() < 1e-9 && (placed(5) - 0.75 * 82.0).abs() < 1e-9);
    assert!((placed(6) - 0.25 * 88.0).abs() < 1e-9 && (placed(11) - 0.75 * 88.0).abs() < 1e-9);
    for (before, after) in groom.iter().zip(changed.iter()) {
        let last = after.elements[after.elements.len() - 1];
        assert!((last.twist() - before.elements[0].twist()).abs() < 1e-6);
        assert!((after.length() - before.length()).abs() < 1e-9);
    }
}

#[test]
fn the_same_seed_gives_the_same_groom_on_one_thread_as_on_many() {
    let (groom, groups) = groom();
    let work = || {
        let placing = Placing::Density(0.05);
        insert(&groom, &groups, &placing, &InsertOptions::default(), 7).unwrap()
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(pool.install(work), work());
}

#[test]
fn attributes_follow_by_arc_length() {
    let (mut groom, groups) = groom();
    let joints = groom.iter().flat_map(|strand| joint_arc_lengths(strand.elements)).collect();
    groom.insert_joint_attribute("s", Column::scalar(joints)).unwrap();
    groom.insert_strand_attribute("id", Column::scalar(vec![7.0; 6])).unwrap();
    let placing = Placing::ArcLengths(vec![40.0]);
    let (changed, _) = insert(&groom, &groups, &placing, &InsertOptions::default(), 0).unwrap();
    let column = changed.joint_attributes().get("s").expect("it was there");
    let expected = changed.iter().flat_map(|strand| joint_arc_lengths(strand.elements));
    for (a, b) in column.first_components().zip(expected) {
        assert!((a - b).abs() < 1e-9);
    }
    assert!(changed.strand_attributes().get("id").is_some());
}

#[test]
fn what_does_not_fit_is_left_out_and_counted() {
    let (groom, groups) = groom();
    let placing = Placing::ArcLengths(vec![0.5, 40.0, 41.0, 500.0]);
    let (changed, report) =
        insert(&groom, &groups, &placing, &InsertOptions::default(), 0).unwrap();
    assert_eq!((report.asked, report.placed.len(), report.no_room), (24, 6, 18));
    assert!(0.5 < report.most_needed);
    assert_eq!(changed.len(), groom.len());
    let none = Placing::Density(0.0);
    let (same, _) = insert(&groom, &groups, &none, &InsertOptions::default(), 0).unwrap();
    assert_eq!(same, groom);
}

#[test]
fn bad_input_is_refused() {
    let (groom, groups) = groom();
    let options = InsertOptions::default();
    let wrong = insert(&groom, &groups[1..], &Placing::Density(1.0), &options, 0);
    assert_eq!(wrong, Err(InsertGroomError::Groups { groups: 5, strands: 6 }));
    for placing in [
        Placing::Density(-1.0),
        Placing::Density(f64::NAN),
        Placing::Density(1e9),
        Placing::Shares(vec![0.5, 1.5]),
        Placing::ArcLengths(vec![f64::INFINITY]),
    ] {
        let error = insert(&groom, &groups, &placing, &options, 0);
        assert!(matches!(error, Err(InsertGroomError::Options(_))), "{error:?}");
    }
}

#[test]
fn an_empty_groom_stays_one() {
    let empty = HelixGroom::new(Vec::new(), Strands::default()).unwrap();
    let placing = Placing::Shares(vec![0.5]);
    let (same, report) = insert(&empty, &[], &placing, &InsertOptions::default(), 0).unwrap();
    assert_eq!((same, report), (empty, InsertReport::default()));
}
