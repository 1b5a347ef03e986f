//! The ways in which `.obj` files say what a strand is.

use glam::DVec3;
use tress_geometry::Groom;
use tress_io::obj;

fn xs(text: &str) -> Vec<Vec<f64>> {
    let groom = obj::read(text.as_bytes()).expect("an .obj of strands");
    groom.strands().iter().map(|strand| strand.iter().map(|p| p.x).collect()).collect()
}

const FIVE: &str = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\n";

#[test]
fn indices_count_from_one_or_back_from_the_last_vertex() {
    assert_eq!(xs(&format!("{FIVE}l 1 2 3\nl 5 4 1\n")), [[0.0, 1.0, 2.0], [4.0, 3.0, 0.0]]);
    assert_eq!(xs(&format!("{FIVE}l -1 -2 -5\n")), [[4.0, 3.0, 0.0]]);
    assert_eq!(xs("v 7 0 0\nv 8 0 0\nv 9 0 0\nl -3 -2 -1\nv 1 0 0\nl 1 2 -1\n").len(), 2);
    // Named before they are there.
    assert_eq!(xs("l 1 2 3\nv 1 0 0\nv 2 0 0\nv 3 0 0\n"), [[1.0, 2.0, 3.0]]);
}

#[test]
fn what_is_no_strand_is_passed_over() {
    let text = "# comment\n\nmtllib a.mtl\no hair\ng a b\nvt 0 0\nvn 0 0 1\n\
                v 1 0 0 1.0\nv 2 0 0 0.5 0.5 0.5\nv 3 0 0\ns off\nusemtl m\n\
                l 1/1 2/1 3/1\nf 1 2 3\n";
    assert_eq!(xs(text), [[1.0, 2.0, 3.0]]);
    assert_eq!(xs(&text.replace('\n', "\r\n")), [[1.0, 2.0, 3.0]]);
    assert_eq!(xs(&text.replace(' ', "\t ")), [[1.0, 2.0, 3.0]]);
    assert_eq!(xs(&format!("\u{feff}{text}")), [[1.0, 2.0, 3.0]]);
    assert_eq!(xs("v 1 0 0\nv 2 0 0\nv 3 0 0\nl 1 \\\n2 3"), [[1.0, 2.0, 3.0]]);
}

#[test]
fn segments_that_share_a_vertex_are_one_strand() {
    let text = format!("{FIVE}l 1 2\nl 2 3\nl 4 5\n");
    assert_eq!(xs(&text), [vec![0.0, 1.0, 2.0], vec![3.0, 4.0]]);
    // A longer line says that lines are strands.
    let text = format!("{FIVE}l 1 2\nl 2 3\nl 3 4 5\n");
    assert_eq!(xs(&text).len(), 3);
}

#[test]
fn single_points_are_strands_too() {
    assert_eq!(xs(&format!("{FIVE}l 1 2 3\np 4 5\n")), [vec![0.0, 1.0, 2.0], vec![3.0], vec![4.0]]);
    assert_eq!(xs("v 1 0 0\nv 2 0 0\n"), [[1.0], [2.0]]);
    assert_eq!(xs(""), Vec::<Vec<f64>>::new());
}

#[test]
fn repeated_points_and_strands_that_share_vertices_stay() {
    assert_eq!(xs(&format!("{FIVE}l 1 1 1\nl 1 2 2\n")), [[0.0, 0.0, 0.0], [0.0, 1.0, 1.0]]);
}

#[test]
fn numbers_that_are_not_finite_are_numbers() {
    let groom: Groom =
        obj::read(&b"v nan -inf 1.#INF\nv -1.#IND 1e999 0\nl 1 2\n"[..]).expect("data");
    let [a, b] = groom.strands().strand(0) else { panic!("two points") };
    assert!(a.x.is_nan() && b.x.is_nan());
    let infinite = DVec3::new(0.0, f64::NEG_INFINITY, f64::INFINITY);
    assert_eq!((a.with_x(0.0), b.y), (infinite, f64::INFINITY));
}
