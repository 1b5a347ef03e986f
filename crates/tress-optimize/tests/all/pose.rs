//! Armatures and poses: affine motion, partial weights, and everything that can be wrong.

use crate::common::coil;
use glam::{DMat3, DVec3};
use tress_analysis::ClusterError;
use tress_geometry::{Attributes, Column, Element, Frame, HelixGroom, Kept, Strands};
use tress_optimize::{
    ArmatureOptions, Clustering, Fingerprint, Group, Joint, Pose, PoseAnchor, PoseError, Select,
    apply_pose, armature, sculpt,
};

/// Two tufts of ten coils, far apart, grouped 1 and 2, and a kept strand.
fn tufts() -> HelixGroom {
    let (mut roots, mut elements) = (vec![], Strands::default());
    for i in 0..20 {
        let (mut root, strand) = coil(i, 12);
        root.position = root.position / 40.0 + DVec3::X * if i < 10 { 0.0 } else { 50.0 };
        roots.push(root);
        elements.push(strand).expect("few elements");
    }
    roots.push(Frame::IDENTITY);
    elements.push([]).expect("few elements");
    let mut strand_attributes = Attributes::new(21);
    let group = (0..21).map(|i| 1 + i64::from(i >= 10)).collect();
    strand_attributes.insert("group", Column::Int(group)).expect("a row a strand");
    let joints = Attributes::new(elements.points().len() + 21);
    let polylines = Strands::from_counts([1], vec![DVec3::ZERO]).expect("one point");
    let kept = Kept { strands: vec![20], polylines, point_attributes: Attributes::new(1) };
    HelixGroom::with_attributes(roots, elements, strand_attributes, joints, kept).expect("rows")
}

fn two() -> ArmatureOptions {
    let clusters = Clustering { count: 2, ..Clustering::default() };
    ArmatureOptions { clusters, ..Default::default() }
}

fn joint(at: f64) -> Joint {
    let (center, axes, scale) = (DVec3::ZERO, DVec3::AXES, DVec3::ONE);
    Joint { at, center, axes, translate: DVec3::ZERO, rotate: DVec3::ZERO, scale }
}

fn pose(select: Select, joints: Vec<Joint>) -> Pose {
    Pose { groups: vec![Group { select, joints }], ..Pose::default() }
}

#[test]
fn the_rest_pose_moves_nothing_and_survives_ron() {
    let groom = tufts();
    let rest = armature(&groom, &two()).expect("two tufts");
    assert_eq!(rest.groups.len(), 2);
    for joint in rest.groups.iter().flat_map(|group| &group.joints) {
        let axes = DMat3::from_cols_array_2d(&joint.axes.map(|axis| axis.to_array()));
        assert!((axes.determinant() - 1.0).abs() < 1e-12, "right-handed");
    }
    let text = ron::ser::to_string_pretty(&rest, Default::default()).expect("plain data");
    let read: Pose = ron::from_str(&text).expect("what was written is read");
    assert_eq!(read, rest);
    let controls = apply_pose(&groom, &read).expect("the same groom");
    assert_eq!(controls.points().len(), 0);
}

#[test]
fn moving_one_tuft_leaves_the_other_and_the_kept_strand() {
    let groom = tufts();
    let mut pose = armature(&groom, &two()).expect("two tufts");
    let near = |group: &Group| group.joints[0].center.x < 25.0;
    let left = pose.groups.iter_mut().find(|group| near(group)).expect("the tuft at 0");
    left.joints[2].translate = DVec3::new(0.0, 0.1, 0.0);
    let controls = apply_pose(&groom, &pose).expect("a good pose");
    for i in 0..21 {
        assert_eq!(controls.strand(i).len(), if i < 10 { 3 } else { 0 }, "strand {i}");
    }
    let tip = controls.strand(4)[2];
    let moved = tip.anchor - groom.strand(4).tip().position;
    assert!(moved.distance(DVec3::new(0.0, 0.1, 0.0)) < 1e-12);
    let mut sculpted = groom.clone();
    sculpt(&mut sculpted, &controls, &Default::default()).expect("good controls");
    assert!(sculpted.strand(4).tip().position.distance(tip.anchor) < 0.01);
    assert_eq!(sculpted.strand(12), groom.strand(12));
}

#[test]
fn joints_map_points_affinely_and_carry_on_what_lies_beyond() {
    let groom = tufts();
    let turned = Joint { rotate: DVec3::new(0.0, 0.0, 90.0), center: DVec3::X, ..joint(0.5) };
    let scaled = Joint { scale: DVec3::splat(2.0), ..joint(1.0) };
    let mut pose = pose(Select::All, vec![turned, scaled]);
    let quarter = |p: DVec3| DVec3::new(1.0 - p.y, p.x - 1.0, p.z);
    for chained in [false, true] {
        pose.chained = chained;
        let controls = apply_pose(&groom, &pose).expect("a good pose");
        let strand = groom.strand(3);
        let middle = quarter(strand.position_at(0.5 * strand.length()));
        assert!(controls.strand(3)[0].anchor.distance(middle) < 1e-12);
        let twice = 2.0 * strand.tip().position;
        let expected = if chained { quarter(twice) } else { twice };
        assert!(controls.strand(3)[1].anchor.distance(expected) < 1e-12);
    }
}

#[test]
fn rotations_go_about_x_then_y_then_z() {
    let groom = tufts();
    let rotate = DVec3::new(90.0, 90.0, 0.0);
    let pose = pose(Select::All, vec![Joint { rotate, ..joint(1.0) }]);
    let controls = apply_pose(&groom, &pose).expect("a good pose");
    // About x: (x, -z, y). Then about y: (z, y, -x) of that.
    let p = groom.strand(0).tip().position;
    assert!(controls.strand(0)[0].anchor.distance(DVec3::new(p.y, -p.z, -p.x)) < 1e-12);
}

#[test]
fn strands_between_clusters_follow_both_in_part() {
    let straight = Element { length: 1.0, ..Element::default() };
    let xs = [0.0, 0.1, 4.0, 9.9, 10.0];
    let roots = xs.map(|x| Frame::along(DVec3::X * x, DVec3::NEG_Y).expect("a direction"));
    let elements = Strands::from_counts([1; 5], vec![straight; 5]).expect("counts");
    let groom = HelixGroom::new(roots.to_vec(), elements).expect("a root a strand");
    for (blend, shared) in [(0.0, false), (3.0, true)] {
        let clusters = Clustering { count: 2, seed: 1, blend };
        let mut pose = armature(&groom, &ArmatureOptions { clusters, ..Default::default() })
            .expect("two clusters");
        for group in &mut pose.groups {
            let side = if group.joints[2].center.x < 5.0 { -1.0 } else { 1.0 };
            group.joints[2].translate = DVec3::Z * side;
        }
        let controls = apply_pose(&groom, &pose).expect("a good pose");
        let z = controls.strand(2)[2].anchor.z;
        assert_eq!(-1.0 + 1e-3 < z, shared, "{z}");
        assert!(z < 0.0 && controls.strand(0)[2].anchor.z < z.max(-0.99));
    }
}

#[test]
fn attributes_pick_strands_and_anchors_stand_above_groups() {
    let groom = tufts();
    let select = Select::Attribute { name: "group".into(), value: 2.0 };
    let translate = DVec3::new(0.0, 1.0, 0.0);
    let mut pose = pose(select, vec![Joint { translate, ..joint(1.0) }]);
    pose.anchors.push(PoseAnchor { strand: 11, at: 1.0, position: DVec3::ONE });
    pose.anchors.push(PoseAnchor { strand: 2, at: 0.25, position: DVec3::ONE });
    let controls = apply_pose(&groom, &pose).expect("a good pose");
    assert_eq!(controls.counts().collect::<Vec<_>>()[..11], [0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1]);
    assert_eq!((controls.strand(11).len(), controls.strand(11)[0].anchor), (1, DVec3::ONE));
    assert_eq!(controls.strand(20).len(), 0, "a kept strand");
}

#[test]
fn every_pose_that_does_not_fit_is_refused() {
    let groom = tufts();
    let error = |pose: Pose| apply_pose(&groom, &pose).unwrap_err();
    let other = Fingerprint { strands: 20, ..Fingerprint::of(&groom) };
    let found = error(Pose { groom: Some(other), ..Pose::default() });
    assert!(matches!(found, PoseError::AnotherGroom { .. }));
    assert!(found.to_string().contains("a groom of 20 strands"), "{found}");

    let found = error(pose(Select::Cluster(8), vec![joint(1.0)]));
    assert_eq!(found.to_string(), "group 0 (cluster 8) names no strand");
    let select = Select::Attribute { name: "group".into(), value: 7.0 };
    assert_eq!(error(pose(select, vec![])).to_string(), "group 0 (group = 7) names no strand");
    let select = Select::Attribute { name: "grupp".into(), value: 1.0 };
    let name = "grupp".to_owned();
    assert_eq!(error(pose(select, vec![])), PoseError::NoAttribute { group: 0, name });

    for joints in [vec![joint(0.0)], vec![joint(1.5)], vec![joint(f64::NAN)]] {
        let found = error(pose(Select::All, joints));
        assert!(matches!(found, PoseError::Joint { group: 0, joint: 0, .. }));
    }
    let falling = error(pose(Select::All, vec![joint(0.5), joint(0.5)]));
    assert_eq!(falling, PoseError::Joint { group: 0, joint: 1, at: 0.5 });
    let wild = Joint { translate: DVec3::NAN, ..joint(1.0) };
    let found = error(pose(Select::All, vec![wild]));
    assert_eq!(found, PoseError::NotFinite { group: 0, joint: 0 });

    for (strand, at) in [(21, 1.0), (0, -0.1), (0, 1.1)] {
        let anchors = vec![PoseAnchor { strand, at, position: DVec3::ZERO }];
        let found = error(Pose { anchors, ..Pose::default() });
        assert_eq!(found, PoseError::Anchor { anchor: 0, strand, at });
    }
    let clusters = Clustering { blend: -1.0, ..Clustering::default() };
    assert_eq!(error(Pose { clusters, ..Pose::default() }), PoseError::Blend(-1.0));
    let clusters = Clustering { count: 0, ..Clustering::default() };
    let none = armature(&groom, &ArmatureOptions { clusters, ..Default::default() });
    let count = ClusterError::Count { clusters: 0, rows: 21 };
    assert_eq!(none, Err(PoseError::Clusters(count)));
}

#[test]
fn the_pose_in_the_documentation_can_be_read() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/sculpt.md");
    let page = std::fs::read_to_string(path).expect("the page is part of the project");
    let block = page.lines().skip_while(|line| *line != "    (");
    let text: Vec<&str> = block.take_while(|line| line.starts_with("    ")).collect();
    let pose: Pose = ron::from_str(&text.join("\n")).expect("a pose");
    assert_eq!((pose.groups.len(), pose.anchors.len(), pose.clusters.count), (2, 1, 8));
}
