use tress_geometry::UpAxis;

use super::*;
use crate::camera::{Size, View};

/// Points at one pixel a unit from the middle of a picture of 200 pixels, `y` down.
fn flat(strands: &[Vec<DVec3>]) -> Strands<Vertex> {
    let corners = [DVec3::splat(-100.0), DVec3::splat(100.0)];
    let camera = Camera::fit(corners, UpAxis::Y, View::Front, Size::new(200, 200), 0.0);
    let points: Vec<DVec3> = strands.iter().flatten().copied().collect();
    let values = (0..points.len()).map(|i| i as f32).collect();
    let dress = Dress { radii: vec![0.5; points.len()], values };
    let strands = Strands::from_counts(strands.iter().map(Vec::len), points).expect("they match");
    flatten(&strands, &dress, &camera).expect("few pieces")
}

fn there(strand: &[Vertex]) -> Vec<Vertex> {
    strand.iter().copied().filter(|vertex| vertex.position.is_finite()).collect()
}

#[test]
fn straight_hair_costs_what_its_points_cost() {
    let strand = (0..16).map(|i| DVec3::new(f64::from(i) * 5.0, 0.0, 0.0)).collect();
    let flat = flat(&[strand]);
    assert_eq!(flat.points().len(), 17, "the points and a gap");
    for (i, vertex) in there(flat.strand(0)).iter().enumerate() {
        let expected = Vec3::new(100.0 + 5.0 * i as f32, 100.0, 0.0);
        assert!(vertex.position.distance(expected) < 1e-4, "{vertex:?}");
        assert!((vertex.value - i as f32).abs() < 1e-6);
    }
}

#[test]
fn five_points_a_turn_make_a_circle() {
    let radius = 40.0;
    let turn = std::f64::consts::TAU / 5.0;
    let point = |i: i32| (f64::from(i) * turn).sin_cos();
    let circle = (0..11).map(|i| DVec3::new(point(i).0, point(i).1, 0.0) * radius).collect();
    let strand = flat(&[circle]);
    let vertices = there(strand.strand(0));
    assert!(60 < vertices.len(), "{} vertices on two turns", vertices.len());
    for vertex in &vertices {
        let r = (vertex.position - Vec3::new(100.0, 100.0, 0.0)).length();
        assert!((r - 40.0).abs() < 0.05, "{r}");
    }
    for ends in vertices.windows(2) {
        let middle = 0.5 * (ends[0].position + ends[1].position) - Vec3::new(100.0, 100.0, 0.0);
        assert!(40.0 - middle.length() < 0.25, "a chord strays by {}", 40.0 - middle.length());
    }
}

#[test]
fn long_segments_are_cut_for_the_order_of_depth() {
    let strand = vec![DVec3::new(-90.0, 0.0, -90.0), DVec3::new(90.0, 0.0, 90.0)];
    let flat = flat(&[strand]);
    let vertices = there(flat.strand(0));
    let longest = vertices.windows(2).map(|v| v[0].position.distance(v[1].position));
    assert!(longest.fold(0.0, f32::max) <= 24.1);
    assert_eq!((vertices[0].value, vertices[vertices.len() - 1].value), (0.0, 1.0));
}

#[test]
fn broken_strands_have_gaps_and_short_ones_nothing_to_draw() {
    let line = |x: f64| DVec3::new(x, 0.0, 0.0);
    let broken = vec![line(0.0), line(1.0), DVec3::NAN, line(3.0), DVec3::X * 1e300, line(5.0)];
    let flat = flat(&[broken, vec![], vec![line(1.0)], vec![line(1.0); 4]]);
    let seen: Vec<bool> = flat.strand(0).iter().map(|v| v.position.is_finite()).collect();
    assert_eq!(seen, [true, true, false, true, false, true, false]);
    for i in 0..flat.len() {
        let last = flat.strand(i).last().expect("a gap");
        assert!(last.position.is_nan(), "strand {i} ends with a gap");
    }
}
