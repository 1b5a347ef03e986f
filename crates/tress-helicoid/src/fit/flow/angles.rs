//! The two angles of a frame, as sines and cosines that are turned on by small steps.

use glam::DVec3;

use crate::Helicoid;

/// Sines and cosines of `theta` and `phi`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Angles {
    sine: f64,
    cosine: f64,
    /// `sin phi`.
    pub(super) rise: f64,
    /// `cos phi`.
    pub(super) run: f64,
}

impl Angles {
    pub(super) fn of(k: &Helicoid, theta: f64) -> Self {
        let (sine, cosine) = theta.sin_cos();
        let (rise, run) = k.phi(theta).sin_cos();
        Self { sine, cosine, rise, run }
    }

    /// Where `theta` is more by `difference`.
    pub(super) fn turned(&self, k: &Helicoid, difference: f64) -> Self {
        let (sine, cosine) = turned((self.sine, self.cosine), difference);
        let (rise, run) = turned((self.rise, self.run), k.phi(difference));
        Self { sine, cosine, rise, run }
    }

    pub(super) fn e_t(&self) -> DVec3 {
        DVec3::new(self.run * self.cosine, self.run * self.sine, self.rise)
    }

    pub(super) fn e_n(&self) -> DVec3 {
        DVec3::new(-self.sine, self.cosine, 0.0)
    }

    pub(super) fn e_b(&self) -> DVec3 {
        DVec3::new(-self.rise * self.cosine, -self.rise * self.sine, self.run)
    }
}

/// Sine and cosine of a sum, from those of one angle.
fn turned((sine, cosine): (f64, f64), difference: f64) -> (f64, f64) {
    let (s, c) = small_sin_cos(difference);
    (sine * c + cosine * s, cosine * c - sine * s)
}

/// Up to here the series below err by less than 3e-10.
const SMALL: f64 = 0.5;

/// Sine and cosine, without the reduction that a large angle needs.
fn small_sin_cos(x: f64) -> (f64, f64) {
    if SMALL < x.abs() {
        return x.sin_cos();
    }
    let q = x * x;
    let sine =
        1.0 + q * (-1.0 / 6.0 + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q * (1.0 / 362880.0))));
    let cosine = 1.0 + q * (-0.5 + q * (1.0 / 24.0 + q * (-1.0 / 720.0 + q * (1.0 / 40320.0))));
    (x * sine, cosine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_angles_are_as_the_library_has_them() {
        for i in -60..=60 {
            let x = f64::from(i) * 0.01;
            let (s, c) = small_sin_cos(x);
            assert!((s - x.sin()).abs() < 2e-11 && (c - x.cos()).abs() < 3e-10, "at {x}");
        }
    }

    #[test]
    fn angles_turned_in_steps_are_the_sum() {
        let k = Helicoid::new(1.0, 0.0, 0.0, -1.7);
        let turned = Angles::of(&k, 0.4).turned(&k, 0.25).turned(&k, 3.0);
        let whole = Angles::of(&k, 3.65);
        assert!(turned.e_t().distance(whole.e_t()) < 1e-9);
        assert!(turned.e_n().distance(whole.e_n()) < 1e-9);
        assert!(turned.e_b().distance(whole.e_b()) < 1e-9);
    }
}
