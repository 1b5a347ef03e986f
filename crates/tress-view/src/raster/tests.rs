use proptest::prelude::*;

use super::*;

fn vertices(points: &[(f32, f32)], radius: f32) -> Vec<Vertex> {
    let vertex =
        |&(x, y): &(f32, f32)| Vertex { position: Vec3::new(x, y, 0.0), radius, value: 0.0 };
    points.iter().map(vertex).collect()
}

/// Coverage of all pixels by all pieces, and the greatest of one pixel.
fn covered(vertices: &[Vertex], size: i32) -> (f32, f32) {
    let mut pixels = vec![0.0_f32; (size * size).cast_unsigned() as usize];
    for i in 0..vertices.len() {
        let Some(piece) = Piece::new(vertices, i) else { continue };
        piece.cover(0..size, 0..size, |f| {
            assert!((0.0..=1.0).contains(&f.along) && 0.0 < f.coverage && f.coverage <= 1.0);
            pixels[(f.y * size + f.x).cast_unsigned() as usize] += f.coverage;
        });
    }
    (pixels.iter().sum(), pixels.iter().copied().fold(0.0, f32::max))
}

proptest! {
    #[test]
    fn coverage_is_length_times_width(
        angle in 0.0_f32..std::f32::consts::TAU,
        shift in (0.0_f32..1.0, 0.0_f32..1.0),
        radius in 0.02_f32..3.0,
    ) {
        let (y, x) = angle.sin_cos();
        let (cx, cy) = (50.0 + shift.0, 50.0 + shift.1);
        let ends = [(cx - 40.0 * x, cy - 40.0 * y), (cx + 40.0 * x, cy + 40.0 * y)];
        let (sum, _) = covered(&vertices(&ends, radius), 101);
        let area = 80.0 * 2.0 * radius;
        // Filters across and along a slanting hair, sampled at pixels, are a little off: thin
        // ones by some percent.
        prop_assert!((sum / area - 1.0).abs() < 0.08, "{sum} for {area}");
    }

    #[test]
    fn a_curve_in_pieces_is_drawn_once(radius in 0.05_f32..2.0, turns in 0.2_f32..1.0) {
        let point = |i: u8| {
            let a = turns * std::f32::consts::TAU * f32::from(i) / 60.0;
            (50.0 + 30.0 * a.cos(), 50.0 + 30.0 * a.sin())
        };
        let points: Vec<_> = (0..=60).map(point).collect();
        let (sum, most) = covered(&vertices(&points, radius), 101);
        let area = turns * std::f32::consts::TAU * 30.0 * 2.0 * radius;
        prop_assert!((sum / area - 1.0).abs() < 0.03, "{sum} for {area}");
        // The ends meet on a full turn and may share pixels.
        prop_assert!(most <= 1.0 + 1e-3 || 0.97 < turns, "{most}");
    }
}

#[test]
fn the_tents_of_all_pixels_add_up_to_one() {
    for x in [0.0, 0.1, 0.5, 0.77] {
        let sum: f32 = (-3_i8..=3)
            .map(|i| {
                tent_integral(f32::from(i) + x + 0.005) - tent_integral(f32::from(i) + x - 0.005)
            })
            .sum();
        assert!((sum - 0.01).abs() < 1e-6, "{x}: {sum}");
    }
}

#[test]
fn a_hair_towards_the_viewer_and_a_gap_are_not_drawn() {
    let mut hair = vertices(&[(5.0, 5.0), (5.0, 5.0), (9.0, 5.0)], 0.5);
    hair[1].position.z = 8.0;
    assert!(Piece::new(&hair, 0).is_none() && Piece::new(&hair, 1).is_some());
    hair[1].position = Vec3::NAN;
    assert!(Piece::new(&hair, 0).is_none() && Piece::new(&hair, 1).is_none());
    assert!(Piece::new(&hair, 2).is_none(), "nothing behind the last vertex");
    assert_eq!(tangent(&hair, 2), Vec3::ZERO);
}

#[test]
fn a_hair_that_turns_back_ends_for_itself() {
    let (sum, most) = covered(&vertices(&[(10.0, 20.5), (30.0, 20.5), (10.2, 21.5)], 0.4), 41);
    assert!((sum / (2.0 * 20.0 * 0.8) - 1.0).abs() < 0.05, "{sum}");
    assert!(most < 1.5, "{most}");
}
