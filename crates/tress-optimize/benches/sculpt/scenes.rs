//! Grooms and controls that are measured: coils all over a scalp, lengthened.

use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tress_geometry::{Element, Frame, HelixGroom, Strands, SuperHelix};
use tress_optimize::Control;

/// Coils of 18 turns and a radius of about 0.57 on a scalp of radius 10, each perturbed by its own
/// random numbers; in centimetres.
pub(crate) fn coils(strands: usize, n_elements: usize) -> HelixGroom {
    let (mut roots, mut elements) = (Vec::with_capacity(strands), Strands::default());
    for i in 0..strands {
        let mut rng = Pcg64Mcg::seed_from_u64(i as u64);
        let radius = 0.57 * rng.random_range(0.8..1.2);
        let coil = Element::coil(radius, 0.6 * rng.random_range(0.8..1.2));
        let turn = std::f64::consts::TAU / coil.curvature.length();
        let length = 18.0 * turn / n_elements as f64;
        let element = |_| {
            let frizz = DVec3::from_array([0; 3].map(|_| rng.random_range(-0.1..0.1)));
            Element { curvature: coil.curvature + frizz, length }
        };
        let strand: Vec<Element> = (0..n_elements).map(element).collect();
        let out = DVec3::from_array([
            rng.random_range(-1.0..1.0),
            rng.random_range(0.1..1.0),
            rng.random_range(-1.0..1.0),
        ]);
        let root = Frame::along(10.0 * out.normalize(), out).unwrap_or(Frame::IDENTITY);
        roots.push(root);
        elements.push(strand).expect("fewer elements than offsets hold");
    }
    HelixGroom::new(roots, elements).expect("a root a strand")
}

/// Controls at `m` even places of each strand, moved down by `amount` of their distance to the
/// root, in proportion to how far along they are.
pub(crate) fn pulled_down(groom: &HelixGroom, m: usize, amount: f64) -> Strands<Control> {
    let mut controls = Strands::default();
    for strand in groom.iter() {
        let length = strand.length();
        let control = |k: usize| pulled(&strand, length, k as f64 / m as f64, amount);
        controls.push((1..=m).map(control)).expect("fewer controls than offsets hold");
    }
    controls
}

fn pulled(strand: &SuperHelix<'_>, length: f64, at: f64, amount: f64) -> Control {
    let position = strand.position_at(at * length);
    let down = amount * at * position.distance(strand.root.position);
    Control::new(at * length, position - DVec3::Y * down)
}
