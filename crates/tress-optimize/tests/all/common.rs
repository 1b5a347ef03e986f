//! Seeded strands and targets that several tests share.

use glam::{DMat3, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tress_geometry::{Element, Frame, SuperHelix};
use tress_optimize::Control;

/// A coil of varying radius and bent axis, in centimetres, its root frame turned at random.
pub(crate) fn coil(seed: u64, n_elements: usize) -> (Frame, Vec<Element>) {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let radius = rng.random_range(0.1..0.8);
    let pitch = rng.random_range(0.3..1.5) * if rng.random_bool(0.5) { 1.0 } else { -1.0 };
    let per_turn = rng.random_range(4.0..16.0);
    let phase = rng.random_range(0.0..6.0);
    let elements = (0..n_elements).map(|j| {
        let along = j as f64 / n_elements as f64;
        let coil = Element::coil(radius * (1.0 - 0.5 * along), pitch);
        let bend = DVec3::new(0.0, (4.0 * along + phase).sin(), (3.0 * along).cos()) * 0.05;
        let length = std::f64::consts::TAU / coil.curvature.length() / per_turn;
        Element { curvature: coil.curvature + bend, length }
    });
    let turn = DVec3::from_array([0; 3].map(|_| rng.random_range(-1.0..1.0)));
    let axes = DMat3::from_axis_angle(turn.normalize(), rng.random_range(0.0..6.0));
    let position = DVec3::from_array([0; 3].map(|_| rng.random_range(-10.0..10.0)));
    (Frame { position, axes }, elements.collect())
}

/// Anchors for `m` evenly spaced points, each moved by up to `far` of the strand's length but
/// no farther from the one before than 0.9 of the arc between them.
pub(crate) fn targets(strand: &SuperHelix<'_>, m: usize, far: f64, seed: u64) -> Vec<Control> {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let length = strand.length();
    let shift = DVec3::from_array([0; 3].map(|_| rng.random_range(-1.0..1.0))) * far * length;
    let mut before = strand.root.position;
    let control = |k: usize| {
        let arc_length = length * k as f64 / m as f64;
        let part = k as f64 / m as f64;
        let to = strand.position_at(arc_length) + shift * part * part - before;
        before += to.clamp_length_max(0.9 * length / m as f64);
        Control::new(arc_length, before)
    };
    (1..=m).map(control).collect()
}
