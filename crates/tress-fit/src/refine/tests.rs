use super::motion::{Motion, moved};
use super::sweep::{LENGTH_DAMPING, SLIDE_DAMPING};
use super::*;
use crate::{Spline, TangentRule};

/// A coil that is no helix, so that drafts of it have gaps and misses.
fn coil(n: u32) -> Vec<DVec3> {
    let at = |i: u32| {
        let a = 1.2 * f64::from(i);
        let r = 0.1 + 0.02 * (2.3 * a).sin();
        DVec3::new(r * a.cos(), 0.7 * r * a.sin(), 0.02 * a + 0.01 * (0.9 * a).cos())
    };
    (0..n).map(at).collect()
}

/// What an element's controls do: changes of Darboux vector and length.
type Controls = Vec<(DVec3, f64)>;

/// The linear model that a sweep back minimises, evaluated by walking from the root.
fn model(
    refiner: &Refiner,
    points: &[DVec3],
    draft: &Draft,
    tangent: [f64; 2],
    controls: &Controls,
) -> f64 {
    let settings = Refine::default();
    let mut state = [0.0, 0.0, 0.0, tangent[0], tangent[1]];
    let mut cost = 0.0;
    let square = |slope: &[f64], value: f64, z: &[f64]| -> f64 {
        (value + slope.iter().zip(z).map(|(a, b)| a * b).sum::<f64>()).powi(2)
    };
    for (j, &(w, l)) in controls.iter().enumerate() {
        let (frame, element) = (&draft.joints[j], &draft.elements[j]);
        if 0 < j {
            let before = draft.elements[j - 1].curvature + controls[j - 1].0;
            let before = frame.axes.transpose() * (draft.joints[j - 1].axes * before);
            let tie = settings.prior * refiner.ties[j];
            cost += tie * (element.curvature + w - before).length_squared();
            cost += SLIDE_DAMPING * state[0] * state[0];
        }
        cost += FIRST_DAMPING * element.length.powi(4) * w.length_squared();
        cost += (LENGTH_DAMPING + FIRST_DAMPING) * l * l;
        let z = [state[0], state[1], state[2], state[3], state[4], w.x, w.y, w.z];
        for (point, &(_, s)) in points
            .iter()
            .zip(&draft.places)
            .take(points.len() - 1)
            .filter(|(_, place)| place.0 == j)
        {
            let miss = frame.axes.transpose() * (frame.position - *point);
            let rows = Motion::new(element, s).across(miss);
            cost += rows.iter().map(|row| square(&row.slope, row.value, &z)).sum::<f64>();
        }
        let gain = &refiner.gains[j];
        state = gain.transition.carry(&state, w, l);
        state.iter_mut().zip(&gain.gap).for_each(|(state, gap)| *state += gap);
    }
    let tip = moved(&draft.joints[controls.len()], &state);
    cost + tip.position.distance_squared(points[points.len() - 1])
}

/// The controls that a sweep back answers with, on the linear model.
fn answers(refiner: &Refiner, draft: &Draft, start: &[f64; 5]) -> Controls {
    let mut state = [0.0, 0.0, 0.0, start[0], start[1]];
    let mut first = Some(DVec3::new(start[2], start[3], start[4]));
    let mut before = DVec3::ZERO;
    let mut controls = Controls::new();
    for (gain, joint) in refiner.gains.iter().zip(&draft.joints) {
        let (w, l) = gain.answer(&state, joint, before, first.take());
        before = joint.axes * w;
        controls.push((w, l));
        state = gain.transition.carry(&state, w, l);
        state.iter_mut().zip(&gain.gap).for_each(|(state, gap)| *state += gap);
    }
    controls
}

#[test]
fn the_sweep_finds_the_minimum_of_the_linear_model() {
    let points = coil(90);
    let spline = Spline::through(&points, TangentRule::Circle);
    let n = 60;
    let along: Vec<f64> = (0..=n).map(|i| spline.length() * f64::from(i) / f64::from(n)).collect();
    let draft = Draft::on(&spline, &along);
    let settings = Refine::default();
    let mut refiner = Refiner::default();
    refiner.tie(&draft);
    let problem = Problem { points: &points, hold: Hold::Nearest, settings: &settings };
    let start = refiner.sweep_back(problem, &draft, FIRST_DAMPING);
    let controls = answers(&refiner, &draft, &start);
    let cost = |controls: &Controls, t: [f64; 2]| model(&refiner, &points, &draft, t, controls);
    let tangent = [start[0], start[1]];
    let least = cost(&controls, tangent);
    let untouched = cost(&vec![(DVec3::ZERO, 0.0); controls.len()], [0.0; 2]);
    assert!(least < 0.1 * untouched, "{least} {untouched}");
    for h in [1e-3, -1e-3] {
        assert!(least < cost(&controls, [start[0] + h, start[1]]));
        assert!(least < cost(&controls, [start[0], start[1] + h]));
        for j in 0..controls.len() {
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let mut other = controls.clone();
                other[j].0 += 10.0 * h * axis;
                assert!(least < cost(&other, tangent), "element {j}, {axis}");
            }
            let mut other = controls.clone();
            other[j].1 += h;
            assert!(least < cost(&other, tangent), "length {j}");
        }
    }
}

#[test]
fn held_joints_go_through_the_points_and_leave_no_gaps() {
    let points = coil(60);
    let spline = Spline::through(&points, TangentRule::Helix);
    let mut draft = Draft::on(&spline, spline.arc_lengths());
    let settings = Refine { prior: 1e-6, steps: 30, ..Refine::default() };
    let problem = Problem { points: &points, hold: Hold::Joints, settings: &settings };
    Refiner::default().refine(problem, &mut draft);
    for (j, element) in draft.elements.iter().enumerate() {
        let end = element.advance(&draft.joints[j]);
        assert!(end.position.distance(draft.joints[j + 1].position) < 1e-13);
        assert!(end.position.distance(points[j + 1]) < 1e-4);
    }
}

#[test]
fn near_is_a_tenth_of_the_coil_radius_in_the_mean() {
    let coil = Element { length: 9.0, ..Element::coil(0.5, 0.3) };
    let mut draft = Draft { elements: vec![coil; 3], ..Draft::default() };
    let cost = |rms: f64| 40.0 * rms * rms;
    assert!(is_near(cost(0.049), 40, &draft) && !is_near(cost(0.051), 40, &draft));
    // A strand that does not coil has no radius to be far from.
    draft.elements.iter_mut().for_each(|element| element.curvature = DVec3::ZERO);
    assert!(is_near(cost(1e3), 40, &draft));
}

#[test]
fn what_is_held_stays() {
    let points = coil(40);
    let spline = Spline::through(&points, TangentRule::Helix);
    let drafted = Draft::on(&spline, spline.arc_lengths());
    let mut draft = drafted.clone();
    let settings = Refine { lengths: false, root: false, ..Refine::default() };
    let problem = Problem { points: &points, hold: Hold::Joints, settings: &settings };
    Refiner::default().refine(problem, &mut draft);
    assert!(draft.joints[0].tangent().distance(drafted.joints[0].tangent()) < 1e-15);
    for (a, b) in draft.elements.iter().zip(&drafted.elements) {
        assert!((a.length - b.length).abs() < 1e-15);
    }
}
