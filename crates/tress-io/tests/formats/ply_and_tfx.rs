//! The dialects of `.ply` and the versions of `.tfx`, by small files made here.

use glam::DVec3;
use tress_geometry::{Column, names};
use tress_io::{ply, tfx};

fn ply_header(format: &str, vertices: usize, rest: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment made here\nelement vertex {vertices}\n\
         property float x\nproperty float y\nproperty float z\n{rest}end_header\n"
    )
}

#[test]
fn ply_in_either_byte_order() {
    let rest = "element strand 2\nproperty ushort nsegs\n";
    let points = [[1.0_f32, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];
    let mut little = ply_header("binary_little_endian", 3, rest).into_bytes();
    let mut big = ply_header("binary_big_endian", 3, rest).into_bytes();
    for value in points.as_flattened() {
        little.extend(value.to_le_bytes());
        big.extend(value.to_be_bytes());
    }
    for segments in [1_u16, 0] {
        little.extend(segments.to_le_bytes());
        big.extend(segments.to_be_bytes());
    }
    let (little, big) = (ply::read(&little).expect("whole"), ply::read(&big).expect("whole"));
    assert_eq!(little, big);
    assert_eq!(little.strands().offsets(), [0, 2, 3]);
    assert_eq!(little.strands().points()[2], DVec3::new(7.0, 8.0, 9.0));
}

#[test]
fn ply_with_edges_alone_is_joined_and_colours_follow() {
    let rest = "property uchar red\nproperty uchar green\nproperty uchar blue\n\
                element edge 3\nproperty int vertex1\nproperty int vertex2\n";
    let text = ply_header("ascii", 5, rest)
        + "0 0 0 0 0 0\n1 0 0 51 0 0\n2 0 0 102 0 0\n3 0 0 153 0 0\n4 0 0 204 0 0\n\
           3 4\n1 0\n1 2\n";
    let groom = ply::read(text.as_bytes()).expect("whole");
    let xs: Vec<Vec<f64>> =
        groom.strands().iter().map(|s| s.iter().map(|p| p.x).collect()).collect();
    assert_eq!(xs, [vec![3.0, 4.0], vec![2.0, 1.0, 0.0]]);
    let red: Vec<_> =
        groom.point_attributes().get(names::COLOR).expect("colours").first_components().collect();
    assert_eq!(red, [0.6, 0.8, 0.4, 0.2, 0.0]);
}

#[test]
fn ply_with_lists_and_windows_lines() {
    let rest = "element face 0\nproperty list uchar int vertex_indices\n\
                element strand 1\nproperty list uchar float unused\nproperty uint nsegs\n";
    let text = ply_header("ascii", 2, rest) + "0 0 0\n1 1 1\n2 0.5 0.5 1\n";
    assert_eq!(ply::read(text.as_bytes()).expect("whole").strands().len(), 1);
    let windows = text.replace('\n', "\r\n");
    assert_eq!(ply::read(windows.as_bytes()).expect("whole").strands().len(), 1);
}

/// `NeuralHaircut`: 100 points a strand, told by colour.
fn neural_haircut(strands: u8, points: usize) -> Vec<u8> {
    let rest = "property uchar red\nproperty uchar green\nproperty uchar blue\n\
                property uchar alpha\n";
    let n = usize::from(strands) * points;
    let mut bytes = ply_header("binary_little_endian", n, rest).into_bytes();
    for i in 0..n {
        for value in [i as f32, 0.0, 1.0] {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend([u8::try_from(i / points).expect("few strands"), 0, 255, 255]);
    }
    bytes
}

#[test]
fn ply_of_neural_haircut() {
    let groom = ply::read(&neural_haircut(3, 100)).expect("whole");
    assert_eq!(groom.strands().offsets(), [0, 100, 200, 300]);
    assert_eq!(groom.point_attributes().get(names::OPACITY), Some(&Column::scalar(vec![1.0; 300])));
    let error = ply::read(&neural_haircut(100, 3)).expect_err("colours change within a hundred");
    assert!(error.to_string().starts_with("strand 0: expected an element strand"), "{error}");
    let error = ply::read(&neural_haircut(3, 99)).expect_err("no hundreds");
    assert!(error.to_string().ends_with("found 297 vertices"), "{error}");
}

const TFX_2: &str = "version 2.0\nscale 1.0\nrotation 0 0 0\ntranslation 0.0 0.0 0.0\n\
    bothEndsImmovable 0\nmaxNumVerticesInStrand 3\nnumFollowHairsPerGuideHair 4\n\
    maxRadiusAroundGuideHair 0.5\nnumStrands 2\nis sorted 1\n\
    strand 0 numVerts 3 texcoord 0.25 0.5\n0 0 0\n1 -1.#INF 0\n2 0 0\n\
    strand 1 numVerts 1 texcoord 0 0\n3, 4, 5\n";

#[test]
fn tfx_text() {
    for text in [TFX_2.to_owned(), TFX_2.replace('\n', "\r\n")] {
        let groom = tfx::read(text.as_bytes()).expect("whole");
        assert_eq!(groom.strands().offsets(), [0, 3, 4]);
        assert_eq!(groom.strands().points()[1], DVec3::new(1.0, f64::NEG_INFINITY, 0.0));
        assert_eq!(groom.strands().points()[3], DVec3::new(3.0, 4.0, 5.0));
        let uv = Column::Float { components: 2, values: vec![0.25, 0.5, 0.0, 0.0] };
        assert_eq!(groom.strand_attributes().get(names::ROOT_UV), Some(&uv));
    }
    // Version 1 begins with what is the end of version 2's header.
    let (_, version_1) = TFX_2.split_once("0.5\n").expect("a header");
    assert_eq!(tfx::read(version_1.as_bytes()).expect("whole").strands().len(), 2);
}

#[test]
fn tfx_text_that_is_moved_or_at_odds_with_itself() {
    for (good, bad, error) in [
        ("scale 1.0", "scale 2.0", "line 2: expected 1, which leaves the hair as it is"),
        ("rotation 0", "rotation 90", "line 3: expected 0, which leaves the hair as it is"),
        ("numStrands 2", "numStrands 3", "line 16: expected 3 strands, found 2"),
        ("numStrands 2", "numStrands 1", "line 16: expected 1 strands, found 2"),
        ("numVerts 1", "numVerts 2", "line 16, strand 1: expected 2 points, found 1"),
        ("numVerts 3", "numVerts 2", "line 14: expected a line of a TressFX text, found \"2\""),
        ("1 -1.#INF 0", "1 x 0", "line 13, strand 0: expected a number, found \"x\""),
        ("numVerts", "verts", "line 11, strand 0: expected \"strand I numVerts N"),
    ] {
        let text = TFX_2.replace(good, bad);
        let found = tfx::read(text.as_bytes()).expect_err(bad).to_string();
        assert!(found.starts_with(error), "{bad}: {found}");
    }
}

#[test]
fn tfx_version_3() {
    let mut bytes = vec![0; 296];
    bytes[..4].copy_from_slice(&3.0_f32.to_le_bytes());
    for (at, value) in [(4, 2_u32), (8, 2), (12, 1), (16, 1), (144, 296), (148, 344), (152, 352)] {
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    }
    for i in 0..12_u8 {
        bytes.extend(f32::from(i).to_le_bytes());
    }
    for value in [0.5_f32, 0.25, 0.1, 0.2, 0.3, 0.4] {
        bytes.extend(value.to_le_bytes());
    }
    let groom = tfx::read(&bytes).expect("whole");
    assert_eq!(groom.strands().offsets(), [0, 2, 4]);
    assert_eq!(groom.strands().points()[3], DVec3::new(9.0, 10.0, 11.0));
    let widths = Column::scalar(vec![0.5, 0.25]);
    assert_eq!(groom.strand_attributes().get(names::WIDTH), Some(&widths));
    let uv = groom.strand_attributes().get(names::ROOT_UV).expect("texture coordinates");
    assert_eq!(uv.components(), 2);
}
