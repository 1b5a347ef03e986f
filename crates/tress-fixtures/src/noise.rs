//! Smooth random functions of arc length.

use std::f64::consts::TAU;

use glam::DVec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// Waves in a random function; three are enough to hide that it repeats.
const WAVES: usize = 3;

/// A sum of sine waves with random phases, of standard deviation about 1.
pub(crate) struct Wander {
    /// Angular frequency and phase of each wave.
    waves: [(f64, f64); WAVES],
}

impl Wander {
    /// A function that changes noticeably over `wavelength`.
    pub(crate) fn new(wavelength: f64, rng: &mut Pcg64Mcg) -> Self {
        let wave = |_| (TAU / wavelength * rng.random_range(0.5..1.5), rng.random_range(0.0..TAU));
        Self { waves: std::array::from_fn(wave) }
    }

    pub(crate) fn at(&self, s: f64) -> f64 {
        let sum: f64 = self.waves.iter().map(|&(omega, phase)| (omega * s + phase).sin()).sum();
        // A sine has variance 1/2.
        sum * (2.0 / WAVES as f64).sqrt()
    }
}

/// Three of them.
pub(crate) struct WanderVector([Wander; 3]);

impl WanderVector {
    pub(crate) fn new(wavelength: f64, rng: &mut Pcg64Mcg) -> Self {
        Self(std::array::from_fn(|_| Wander::new(wavelength, rng)))
    }

    pub(crate) fn at(&self, s: f64) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|axis| self.0[axis].at(s)))
    }
}
