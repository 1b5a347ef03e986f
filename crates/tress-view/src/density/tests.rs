use proptest::prelude::*;

use super::*;

fn strand(points: &[Vec3], radius: f32) -> Vec<Vertex> {
    points.iter().map(|&position| Vertex { position, radius, value: 0.0 }).collect()
}

/// A grid of `n` cubed cells of edge 1, with the same extinction in all.
fn fog(n: usize, sigma: f32) -> Grid {
    Grid { origin: Vec3::ZERO, cell: 1.0, cells: [n; 3], values: vec![sigma; n * n * n] }
}

#[test]
fn all_hair_is_counted_once() {
    let ends = [Vec3::ZERO, Vec3::new(30.0, 10.0, -5.0), Vec3::new(60.0, 50.0, 20.0)];
    let length = ends[0].distance(ends[1]) + ends[1].distance(ends[2]);
    let vertices = strand(&ends, 0.25);
    let strands = Strands::from_counts([3], vertices).expect("three points");
    let grid = Grid::of_hair(&strands, 50);
    let area: f32 = grid.values.iter().sum::<f32>() * grid.cell.powi(3);
    let expected = std::f32::consts::FRAC_PI_4 * length * 0.5;
    assert!((area / expected - 1.0).abs() < 1e-4, "{area} {expected}");
    let coarse = grid.coarser();
    let again: f32 = coarse.values.iter().sum::<f32>() * coarse.cell.powi(3);
    assert!((again / expected - 1.0).abs() < 1e-4, "{again} {expected}");
}

#[test]
fn no_hair_and_broken_hair_give_a_grid_of_nothing() {
    for vertices in [vec![], strand(&[Vec3::NAN, Vec3::NAN], 1.0), strand(&[Vec3::ONE], 1.0)] {
        let strands = Strands::from_counts([vertices.len()], vertices).expect("they match");
        let grid = Grid::of_hair(&strands, 100);
        assert!(grid.values.iter().all(|&sigma| sigma == 0.0));
        assert!(grid.optical_depth(Vec3::X).at(Vec3::NEG_ONE).abs() < 1e-6);
        assert!((grid.visibility(&[(Vec3::Y, 1.0)]).at(Vec3::ONE) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn depth_in_fog_is_the_way_through_it() {
    let grid = fog(24, 0.1);
    for axis in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
        let depth = grid.optical_depth(axis);
        for inside in [0.5, 3.5, 20.5] {
            // `inside` cells below the side of the grid that faces the light.
            let centre = Vec3::splat(12.0);
            let place = centre + axis * (12.0 - inside);
            let tau = depth.at(place);
            assert!((tau - 0.1 * inside).abs() < 1e-4, "{axis} {inside}: {tau}");
        }
    }
}

proptest! {
    #[test]
    fn slanting_light_goes_the_longer_way(x in -1.0_f32..1.0, z in -1.0_f32..1.0) {
        // Fog that is wide and flat, light from above: the way grows as 1 / cosine.
        let mut grid = fog(40, 0.0);
        for (i, sigma) in grid.values.iter_mut().enumerate() {
            if (i / 40) % 40 < 6 {
                *sigma = 0.2;
            }
        }
        let towards = Vec3::new(x, 1.0, z);
        let above = Vec3::new(x, -1.0, z);
        let way = towards.length();
        let centre = |y| Vec3::new(20.0, y, 20.0);
        let up = grid.optical_depth(towards).at(centre(0.5));
        let down = grid.optical_depth(above).at(centre(5.5));
        prop_assert!((up / (0.2 * 5.5 * way) - 1.0).abs() < 1e-3, "{up}");
        prop_assert!((down / (0.2 * 5.5 * way) - 1.0).abs() < 1e-3, "{down}");
    }
}

#[test]
fn the_sky_is_seen_through_a_hole() {
    let mut grid = fog(21, 1.0);
    for y in 0..21 {
        let i = grid.index(10, y, 10);
        grid.values[i] = 0.0;
    }
    let sky = grid.visibility(&[(Vec3::Y, 3.0), (Vec3::X, 1.0)]);
    let seen = sky.at(Vec3::new(10.5, 0.5, 10.5));
    assert!((seen - 0.75).abs() < 1e-3, "{seen}");
}
