//! Grooms come back bit for bit, and what is wrong in a file is said with its place.

use glam::DVec3;
use tempfile::TempDir;

use super::*;
use crate::{Bend, Curl, EvenStrands, Roots, Scale};

fn groom() -> ProceduralGroom {
    let point = |i: u32, j: u32| {
        DVec3::new(f64::from(i), 0.7 * f64::from(j), (0.1 * f64::from(i * j)).sin())
    };
    let points = (0..4).flat_map(|i| (0..9).map(move |j| point(i, j))).collect();
    let guides = EvenStrands::new(9, points).expect("four strands");
    let positions = (0..30).map(|i| DVec3::new(0.1 * f64::from(i), 0.01, 0.0)).collect();
    let uv = Some((0..30).map(|i| [0.03 * f64::from(i), 0.5]).collect());
    let mut groom = ProceduralGroom::new(guides, Roots { positions, uv }).expect("sound guides");
    groom.seed = 3;
    groom.unit = Some(0.01);
    groom.widths = vec![0.008, 0.007, 0.002];
    groom.up = Some(tress_geometry::UpAxis::Y);
    groom.chain.operators = vec![
        Operator::Scale(Scale { random: 0.3 }),
        Operator::Bend(Bend { angle_degrees: 40.0, start: 0.25 }),
        Operator::Curl(Curl { radius: 0.3, frequency: 0.2, random_frequency: 0.01, start: 0.1 }),
    ];
    groom.draw_missing();
    groom.instances = Some(groom.instances().expect("a sound sigma"));
    groom.instancing = Instancing::Stored;
    groom
}

/// A folder with the groom in it, the RON file's text changed.
fn written(change: impl Fn(&str) -> String) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("groom.ron");
    groom().write(&path).expect("a writable folder");
    let text = std::fs::read_to_string(&path).expect("the file");
    std::fs::write(&path, change(&text)).expect("a writable folder");
    (folder, path)
}

#[test]
fn a_groom_comes_back_and_is_built_bit_for_bit() {
    let (_folder, path) = written(str::to_owned);
    let read = ProceduralGroom::read(&path).expect("what was written");
    assert_eq!(read, groom());
    assert_eq!(read.build(), groom().build());
}

#[test]
fn an_operator_added_by_hand_draws_numbers_and_leaves_the_others_theirs() {
    let (_folder, path) = written(|text| {
        text.replace("operators: [", "operators: [ Frizz(frequency: 2.0, amplitude: 0.1),")
    });
    let read = ProceduralGroom::read(&path).expect("an edited groom");
    assert_eq!(read.numbers[1..], groom().numbers[..]);
    assert_eq!(read.numbers[0].len(), 30);
    assert_ne!(read.build(), groom().build());
}

#[test]
fn every_operator_is_written_and_read() {
    let text = "operators: [
        Straighten(amount: 0.5),
        Recoil(radius: 0.5, keep: Turns),
        Ruffle(probability: 0.1),
        Switchback(places: shares([0.25, 0.75]), shape: (poisson_ratio: 0.3)),
        Skip(probability: 0.2, each: Points, keep: Length),";
    let (folder, path) = written(|given| given.replace("operators: [", text));
    let read = ProceduralGroom::read(&path).expect("an edited groom");
    let names: Vec<&str> = read.chain.operators.iter().map(Operator::name).collect();
    assert_eq!(names[..5], ["straighten", "recoil", "ruffle", "switchback", "skip"]);
    let again = folder.path().join("again.ron");
    read.write(&again).expect("a writable folder");
    assert_eq!(ProceduralGroom::read(&again).expect("what was written"), read);
}

#[test]
fn an_unknown_operator_is_named_with_its_place() {
    let (_folder, path) = written(|text| text.replace("Bend(", "Bent("));
    let error = ProceduralGroom::read(&path).expect_err("no such operator").to_string();
    let text = std::fs::read_to_string(&path).expect("the file");
    let line = 1 + text.lines().position(|line| line.contains("Bent")).expect("the operator");
    assert!(error.contains("Bent") && error.contains(&format!("line {line}, column")), "{error}");
}

#[test]
fn an_unknown_field_is_named_with_its_place() {
    let (_folder, path) = written(|text| text.replace("radius:", "radios:"));
    let error = ProceduralGroom::read(&path).expect_err("no such field").to_string();
    assert!(
        error.contains("radios") && error.contains("line") && error.contains("column"),
        "{error}"
    );
}

#[test]
fn a_parameter_out_of_range_is_named() {
    let (_folder, path) = written(|text| text.replace("start: 0.25", "start: -0.25"));
    let error = ProceduralGroom::read(&path).expect_err("a start before the root").to_string();
    assert!(error.ends_with("bend 1: start is -0.25, expected 0 to 1"), "{error}");
}

#[test]
fn arrays_that_are_missing_cut_short_or_not_there_are_refused() {
    let (folder, path) = written(str::to_owned);
    let beside = folder.path().join("groom.safetensors");
    let bytes = std::fs::read(&beside).expect("the arrays");
    std::fs::write(&beside, &bytes[..bytes.len() - 9]).expect("a writable folder");
    assert!(matches!(ProceduralGroom::read(&path), Err(FileError::Data { .. })));
    std::fs::remove_file(&beside).expect("it is there");
    assert!(matches!(ProceduralGroom::read(&path), Err(FileError::Io { .. })));
}

#[test]
fn guides_over_a_scalp_are_stored_with_the_groom() {
    use tress_geometry::Mesh;
    let corners = [(-1.0, -1.0), (9.0, -1.0), (-1.0, 9.0)].map(|(x, z)| DVec3::new(x, 0.0, z));
    let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).expect("corners");
    let scalp = crate::Surface::new(&mesh).expect("a mesh");
    let mut groom = groom();
    groom.instance_over(&scalp, 3, 0.5).expect("a sound sigma");
    // On one flat triangle, the way over it is the way in space.
    let roots = Roots { uv: None, ..groom.roots.clone() };
    let in_space = crate::Instances::by_distance(&groom.guide_roots(), &roots, 3, 0.5);
    let stored = groom.instances.clone().expect("stored");
    assert_eq!(stored.guides, in_space.guides);
    assert!(stored.weights.iter().zip(&in_space.weights).all(|(a, b)| (a - b).abs() < 1e-3));
    assert_eq!(groom.instancing, Instancing::Stored);
    let nearest: Vec<u32> = stored.guides.iter().step_by(3).copied().collect();
    assert_eq!(groom.operator_of, nearest);
    assert_eq!(groom.build(), groom.build());
    assert!(matches!(groom.instance_over(&scalp, 3, 0.0), Err(BuildError::Sigma(_))));
}

#[test]
fn strands_of_no_guides_are_refused() {
    let mut groom = groom();
    let strands = groom.roots.len();
    let guides = vec![0; strands];
    groom.instances = Some(crate::Instances { each: 0, guides, weights: vec![1.0; strands] });
    let error = BuildError::Count { what: "guides a strand", given: 0, expected: 1 };
    assert_eq!(groom.build(), Err(error));
}

#[test]
fn parts_that_do_not_fit_are_refused() {
    let mut wrong = groom();
    wrong.operator_of[7] = 40;
    let error = wrong.build().expect_err("no such guide");
    let what = "strand";
    assert_eq!(error, BuildError::NoGuide { what, index: 7, guide: 40, guides: 4 });
    let mut wrong = groom();
    wrong.instances = None;
    assert_eq!(wrong.build(), Err(BuildError::NoWeights));
    wrong.instancing = Instancing::Gaussian { neighbors: 3, sigma: f64::NAN };
    assert!(matches!(wrong.build(), Err(BuildError::Sigma(_))));
    wrong.roots.positions[2].x = f64::INFINITY;
    assert_eq!(wrong.build(), Err(BuildError::NotFinite { what: "root", index: 2 }));
}
