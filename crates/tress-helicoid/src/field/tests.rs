use proptest::prelude::*;

use super::*;

fn helicoid() -> impl Strategy<Value = Helicoid> {
    (-2.0..2.0_f64, -1.0..1.0_f64, -2.0..2.0_f64, -3.0..3.0_f64)
        .prop_map(|(kt, kn, kb, alpha)| Helicoid::new(kt, kn, kb, alpha))
}

fn place() -> impl Strategy<Value = DVec3> {
    (-0.3..0.3_f64, -0.3..0.3_f64, -0.3..0.3_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

proptest! {
    #[test]
    fn frames_are_orthonormal(h in helicoid(), p in place()) {
        let axes = h.frame(h.theta(p));
        let frame = tress_geometry::Frame { position: p, axes };
        prop_assert!(frame.orthonormality_error() < 1e-14 && 0.0 < axes.determinant());
        prop_assert!(axes.x_axis.distance(h.direction(h.theta(p))) < 1e-15);
    }

    #[test]
    fn gradient_is_the_derivative_of_theta(h in helicoid(), p in place()) {
        let gradient = h.gradient(p).expect("the box is clear of the singular line");
        let e = 1e-6;
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let slope = (h.theta(p + e * axis) - h.theta(p - e * axis)) / (2.0 * e);
            let scale = 1.0 + gradient.length_squared() / h.clearance(p);
            prop_assert!((slope - gradient.dot(axis)).abs() < 1e-8 * scale);
        }
    }

    #[test]
    fn theta_and_phi_are_minimal_surfaces(h in helicoid(), p in place()) {
        // The mean curvature of the graph (x, y, z, theta) vanishes when theta is harmonic and
        // |grad theta| does not change along grad theta.
        let e = 1e-4;
        let around: f64 = [DVec3::X, DVec3::Y, DVec3::Z]
            .map(|axis| h.theta(p + e * axis) + h.theta(p - e * axis) - 2.0 * h.theta(p))
            .into_iter()
            .sum();
        let fourth = ((h.kt.hypot(h.kn)) / h.clearance(p)).powi(4);
        prop_assert!((around / (e * e)).abs() < 1e-6 + 100.0 * e * e * fourth);
        let gradient = h.gradient(p).expect("the box is clear of the singular line");
        let steep = |p| h.gradient(p).map_or(f64::NAN, DVec3::length_squared);
        let along = e * gradient.normalize_or_zero();
        let change = (steep(p + along) - steep(p - along)) / (2.0 * e);
        prop_assert!(change.abs() < 1e-6 + 100.0 * e * e * fourth);
    }

    #[test]
    fn a_half_turn_about_the_tangent_undoes_the_mirror(h in helicoid(), p in place()) {
        let turned = |v: DVec3| DVec3::new(v.x, -v.y, -v.z);
        let there = h.direction(h.theta(p));
        let m = h.mirrored();
        let mirrored = m.direction(m.theta(turned(p)));
        prop_assert!(turned(mirrored).distance(there) < 1e-14);
    }
}

#[test]
fn curvatures_are_those_of_the_moving_frame() {
    let h = Helicoid::new(1.2, -0.4, 0.9, 0.7);
    let p = DVec3::new(0.2, 0.1, 0.15);
    let theta = h.theta(p);
    let q = h.curvatures(p, theta).expect("clear of the singular line");
    let e = 1e-6;
    let step = e * h.direction(theta);
    let ahead = h.frame(h.theta_near(p + step, theta));
    let behind = h.frame(h.theta_near(p - step, theta));
    // F' = F [q]x: the columns' derivatives in the frame itself.
    let rate = h.frame(theta).transpose() * ((ahead - behind) * (0.5 / e));
    let measured = DVec3::new(rate.y_axis.z, rate.z_axis.x, rate.x_axis.y);
    assert!(measured.distance(q) < 1e-9, "{measured} is not {q}");
}

#[test]
fn cycles_are_counted_around_the_singular_line() {
    let h = Helicoid::new(1.0, 0.0, 0.0, 0.1);
    let mut theta = 0.0;
    for i in 0..=300 {
        let angle = f64::from(i) * 0.1;
        theta = h.theta_near(DVec3::new(angle.sin(), 1.0 - angle.cos(), 0.0), theta);
        assert!((theta - angle).abs() < 1e-12);
    }
    assert!((h.phi(theta) - 3.0).abs() < 1e-12);
}

#[test]
fn on_the_singular_line_there_is_no_gradient() {
    let h = Helicoid::new(0.0, -2.0, 0.0, 0.0);
    let singular = DVec3::new(0.5, 0.0, 3.0);
    assert!(h.clearance(singular) < 1e-15);
    assert_eq!(h.gradient(singular), None);
    assert_eq!(h.curvatures(singular, 0.0), None);
    assert!(Helicoid { kt: f64::NAN, ..h }.gradient(singular).is_none());
}
