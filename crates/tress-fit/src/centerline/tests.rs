use std::f64::consts::TAU;

use super::*;

/// A coil about an arc of so many radians, and the axis under each of its points.
struct Coil {
    turns: f64,
    per_turn: f64,
    pitch: f64,
    bend: f64,
    phase: f64,
    radius: fn(f64) -> f64,
}

impl Coil {
    const PLAIN: Self =
        Self { turns: 5.0, per_turn: 8.0, pitch: 1.5, bend: 0.0, phase: 0.3, radius: |_| 1.0 };

    fn points(&self) -> (Vec<DVec3>, Vec<DVec3>) {
        let n = (self.turns * self.per_turn).ceil();
        let length = self.turns * self.pitch;
        let mut both = (Vec::new(), Vec::new());
        let mut i = 0.0;
        while i <= n {
            let t = i / n;
            let (sine, cosine) = (self.bend * t).sin_cos();
            let on = if self.bend > 0.0 {
                DVec3::new(sine, 1.0 - cosine, 0.0) * (length / self.bend)
            } else {
                DVec3::X * (t * length)
            };
            let angle = self.phase + TAU * self.turns * t;
            let across = DVec3::new(-sine, cosine, 0.0) * angle.cos() + DVec3::Z * angle.sin();
            both.0.push(on + (self.radius)(t) * across);
            both.1.push(on);
            i += 1.0;
        }
        both
    }

    /// Greatest distance of a line from the axis: away from the last half turns, and there.
    fn errors(&self, of: fn(&[DVec3]) -> Result<Centerline, Defect>) -> (f64, f64) {
        let (points, axis) = self.points();
        let line = of(&points).expect("a strand");
        let n = (axis.len() - 1) as f64;
        let mut worst = (0.0, 0.0);
        for (i, (p, q)) in line.points().zip(&axis).enumerate() {
            let from_end = (i as f64).min(n - i as f64) / n * self.turns;
            let error = if from_end < 0.5 { &mut worst.1 } else { &mut worst.0 };
            *error = f64::max(*error, p.distance(*q));
        }
        worst
    }
}

fn turn_counts() -> impl Iterator<Item = f64> {
    let few = (0..40).map(|i| 2.0 + 0.1 * f64::from(i));
    few.chain((0..26).map(|i| 6.0 + 1.36 * f64::from(i)))
}

#[test]
fn every_turn_count_on_straight_and_bent_axes() {
    for turns in turn_counts() {
        for (per_turn, pitch) in [(5.0, 0.6), (5.0, 3.0), (9.0, 1.5), (20.0, 3.0)] {
            // A quarter circle in all, and a circle of five radii of the coil.
            for bend in [0.0, 0.25 * TAU, TAU.min(turns * pitch / 5.0)] {
                for phase in [0.0, 1.0, 2.5] {
                    let coil = Coil { turns, per_turn, pitch, bend, phase, ..Coil::PLAIN };
                    let (inside, ends) = coil.errors(centerline);
                    let what = format!("{turns} turns, {per_turn} points, {pitch} a turn, {bend}");
                    assert!(inside < 0.1, "{what}: {inside}");
                    assert!(ends < 0.3, "{what}, at the ends: {ends}");
                    if bend <= 0.0 {
                        assert!(inside.max(ends) < 0.01, "{what}, straight: {inside} {ends}");
                    }
                }
            }
        }
    }
}

#[test]
fn coils_of_four_turns_or_more_that_open_and_close_keep_their_axis() {
    for radius in [|t: f64| 0.5 + 0.5 * t, |t: f64| 1.0 - 0.5 * t] {
        for turns in turn_counts().skip(20).step_by(5) {
            let (inside, ends) = Coil { turns, radius, ..Coil::PLAIN }.errors(centerline);
            assert!(inside < 0.1 && ends < 0.3, "{turns}: {inside} {ends}");
        }
    }
}

#[test]
fn the_published_line_is_right_for_whole_turns_only() {
    let error = |turns| {
        let (inside, ends) = Coil { turns, ..Coil::PLAIN }.errors(fourier_centerline);
        inside.max(ends)
    };
    assert!(error(20.0) < 0.02);
    assert!(0.5 < error(20.37) && 0.9 < error(4.5) && 1.2 < error(2.5));
}

#[test]
fn strands_without_a_coil_are_their_own_centerline() {
    let bow: Vec<_> =
        (0..30).map(|i| DVec3::new(f64::from(i), f64::from(i * i) / 40.0, 0.0)).collect();
    for points in [&bow[..], &bow[..2], &bow[..3]] {
        let line = centerline(points).expect("a strand");
        assert!(line.points().eq(points.iter().copied()));
        assert!(line.turns() <= 0.0);
        assert!(line.offsets(points).iter().all(|offset| *offset == DVec3::ZERO));
    }
}

#[test]
fn few_turns_and_few_points_stay_near() {
    for turns in [1.3, 1.5, 1.8] {
        for per_turn in [2.6, 3.0, 4.0, 30.0] {
            let (inside, ends) = Coil { turns, per_turn, ..Coil::PLAIN }.errors(centerline);
            assert!(inside.max(ends) < 1.5, "{turns} {per_turn}: {inside} {ends}");
        }
    }
}

#[test]
fn rigid_motion_and_scale_move_the_line_along() {
    let (points, _) = Coil { turns: 7.3, bend: 1.0, ..Coil::PLAIN }.points();
    let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -1.0, 2.0);
    let moved = |p: DVec3| 100.0 * (turn * p) + DVec3::new(1e4, -2e4, 5e3);
    let line = centerline(&points).expect("a strand");
    let there: Vec<_> = points.iter().map(|p| moved(*p)).collect();
    let other = centerline(&there).expect("a strand");
    for (p, q) in line.points().zip(other.points()) {
        assert!(moved(p).distance(q) < 1e-6);
    }
}

#[test]
fn offsets_rebuild_the_strand() {
    let (points, _) = Coil { bend: 1.0, ..Coil::PLAIN }.points();
    for line in [centerline(&points), fourier_centerline(&points)] {
        let line = line.expect("a strand");
        for ((frame, offset), p) in line.frames().iter().zip(line.offsets(&points)).zip(&points) {
            assert!((frame.position + frame.axes * offset).distance(*p) < 1e-12);
        }
        for (frame, &s) in line.frames().iter().zip(line.arc_lengths()) {
            let at = line.at(s);
            assert!(at.position.distance(frame.position) < 1e-12 && at.is_valid());
        }
        assert!(line.at(-1.0).position == line.frames()[0].position);
        assert!(line.at(1e9).position == line.frames()[points.len() - 1].position);
    }
}

#[test]
fn frames_do_not_jump_where_the_tangent_meets_an_axis() {
    let circle =
        (0..=64).map(|i| f64::from(i) * TAU / 64.0).map(|a| DVec3::new(a.cos(), a.sin(), 0.1 * a));
    let frames = rotation_minimizing_frames(&circle.collect::<Vec<_>>());
    for pair in frames.windows(2) {
        assert!(pair[0].axes.y_axis.angle_between(pair[1].axes.y_axis) < 0.11);
        assert!(pair[1].orthonormality_error() < 1e-12);
    }
}

#[test]
fn tangents_of_a_parabola_are_exact_to_its_ends() {
    let parabola: Vec<_> = (0..6).map(f64::from).map(|x| DVec3::new(x, 0.3 * x * x, 0.0)).collect();
    for (frame, p) in rotation_minimizing_frames(&parabola).iter().zip(&parabola) {
        let tangent = DVec3::new(1.0, 0.6 * p.x, 0.0).normalize();
        assert!(frame.tangent().distance(tangent) < 1e-14, "{p}");
    }
}

#[test]
fn what_is_no_strand_is_refused() {
    for of in [centerline, fourier_centerline] {
        assert_eq!(of(&[]), Err(Defect::Empty));
        assert_eq!(of(&[DVec3::ONE]), Err(Defect::SinglePoint));
        assert_eq!(of(&[DVec3::ONE; 9]), Err(Defect::ZeroLength));
        assert_eq!(of(&[DVec3::ONE, DVec3::NAN]), Err(Defect::NotFinite));
    }
    // Repeated points, a doubling back: odd, but strands.
    let odd = [DVec3::ZERO, DVec3::ZERO, DVec3::X, DVec3::X, DVec3::ZERO, DVec3::Y];
    let line = centerline(&odd).expect("a strand");
    assert!(line.frames().iter().all(Frame::is_valid));
}
