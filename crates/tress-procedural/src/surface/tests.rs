//! Distances over meshes whose distances are known.

use super::*;

/// A grid of `n` by `n` squares of side `1 / n`, each cut in two, bent by `shape`.
fn grid(n: u32, shape: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let at = |i: u32| f64::from(i) / f64::from(n);
    let positions =
        (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))).map(|(i, j)| shape(at(i), at(j)));
    let square = |i: u32, j: u32| {
        let a = i * (n + 1) + j;
        let (b, c, d) = (a + 1, a + n + 1, a + n + 2);
        [[a, b, d], [a, d, c]]
    };
    let triangles = (0..n).flat_map(|i| (0..n).flat_map(move |j| square(i, j)));
    Mesh::new(positions.collect(), triangles.collect()).expect("corners that are there")
}

fn flat(u: f64, v: f64) -> DVec3 {
    DVec3::new(u, 0.0, v)
}

/// Places that stand on no node.
fn scattered(n: u32, shape: impl Fn(f64, f64) -> DVec3) -> Vec<DVec3> {
    let part = |i: u32, ratio: f64| (0.05 + f64::from(i) * ratio).fract();
    (0..n).map(|i| shape(part(i, 0.618034), part(i, 0.414214))).collect()
}

#[test]
fn ways_over_a_plane_are_nearly_straight() {
    let surface = Surface::new(&grid(8, flat)).expect("a mesh");
    let places = scattered(67, flat);
    let (guides, roots) = places.split_at(7);
    let near = surface.nearest(guides, roots, 7);
    let mut ratios = Vec::new();
    for (root, near) in roots.iter().zip(&near) {
        assert_eq!(near.len(), 7);
        assert!(near.windows(2).all(|pair| pair[0].0 <= pair[1].0), "nearest first");
        for (square, guide) in near {
            let ratio = square.sqrt() / root.distance(guides[*guide as usize]);
            assert!((1.0 - 1e-9..1.15).contains(&ratio), "{ratio}");
            ratios.push(ratio);
        }
    }
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    assert!(mean < 1.05, "{mean}");
}

#[test]
fn ways_over_a_sheet_that_is_folded_go_around_the_fold() {
    // A sheet folded over on itself: both halves are 0.1 apart.
    let folded = |u: f64, v: f64| {
        let (height, x) = if u < 0.5 { (0.0, u) } else { (0.1, 1.0 - u) };
        DVec3::new(x, height, v)
    };
    let mesh = grid(16, folded);
    let surface = Surface::new(&mesh).expect("a mesh");
    let guides = [folded(0.95, 0.5), folded(0.3, 0.5)];
    let root = folded(0.05, 0.5);
    assert!(root.distance(guides[0]) < root.distance(guides[1]), "in space");
    let near = surface.nearest(&guides, &[root], 2);
    assert_eq!((near[0][0].1, near[0][1].1), (1, 0), "on the sheet");
    assert!((near[0][1].0.sqrt() - 1.0).abs() < 0.05, "{near:?}");
}

#[test]
fn pieces_without_a_guide_reach_none() {
    let (a, b) = (grid(2, flat), grid(2, |u, v| flat(u + 5.0, v)));
    let shift = u32::try_from(a.positions().len()).expect("few");
    let moved = b.triangles().iter().map(|corners| corners.map(|corner| corner + shift));
    let triangles = a.triangles().iter().copied().chain(moved).collect();
    let mesh = Mesh::new([a.positions(), b.positions()].concat(), triangles).expect("corners");
    let surface = Surface::new(&mesh).expect("a mesh");
    let near = surface.nearest(&[flat(0.3, 0.3)], &[flat(0.9, 0.9), flat(5.5, 0.5)], 3);
    assert_eq!((near[0].len(), near[1].len()), (1, 0));
}

#[test]
fn the_nearest_point_of_a_triangle_is_no_farther_than_any_of_its_points() {
    let corners = [DVec3::ZERO, DVec3::new(2.0, 0.0, 0.5), DVec3::new(0.3, 1.0, -0.4)];
    let [a, b, c] = corners;
    for x in scattered(40, |u, v| DVec3::new(4.0 * u - 1.0, 3.0 * v - 1.0, u - v)) {
        let nearest = nearest_point(corners, x);
        let on_plane = (nearest - a).dot((b - a).cross(c - a)).abs();
        assert!(on_plane < 1e-12, "{nearest}");
        for (u, v) in (0..=10).flat_map(|i| (0..=10 - i).map(move |j| (i, j))) {
            let point = a + 0.1 * (f64::from(u) * (b - a) + f64::from(v) * (c - a));
            assert!(nearest.distance(x) <= point.distance(x) + 1e-12, "{x}");
        }
    }
}

#[test]
fn triangles_of_no_area_do_no_harm() {
    let mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::X], vec![[0, 1, 2], [0, 0, 0]]);
    let surface = Surface::new(&mesh.expect("corners")).expect("a mesh");
    let near = surface.nearest(&[DVec3::X], &[DVec3::new(0.25, 1.0, 0.0)], 1);
    assert!((near[0][0].0 - 0.75 * 0.75).abs() < 1e-12);
    let wild = Mesh::new(vec![DVec3::ZERO, DVec3::NAN, DVec3::X], vec![[0, 1, 2]]);
    let error = Surface::new(&wild.expect("corners")).expect_err("no number");
    assert_eq!(error, SurfaceError::NotFinite(1));
}
