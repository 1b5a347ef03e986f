//! The switchback by Rayleigh and Ritz, as published [CC 4.3].
//!
//! Bending is the coil's and two bumps each for `kappa1` and `kappa2` [CC 20-21]; twist follows
//! from `kappa3' = -kappa2 / Gamma` in closed form [CC 22], and its change of sign fixes one of the
//! twelve numbers [CC 23]:
//!
//! `kappa1 = kappa1_h + sum_{1,2} a_i exp(-b_i s^2) cos(c_i s)`,
//! `kappa2 = sum_{3,4} a_i exp(-b_i s^2) cos(c_i s)`,
//! `kappa3 = -alpha Re erf(z_3) - (kappa3_h - alpha) Re erf(z_4)`,
//! `z_i = sqrt(b_i) s + i c_i / (2 sqrt(b_i))`,
//! `alpha = a_3/(2 Gamma) sqrt(pi/b_3) exp(-c_3^2/(4 b_3))`
//!
//! (the paper prints an `s` in the denominator of `z`). Nelder and Mead's simplex finds the eleven
//! that make the least of the greatest energy density [CC 12] at a few places and of how far the
//! tangent in the middle is from the axis [CC 25-26].
//!
//! Where the paper leaves a choice: the density counts from the coil's own, which no switchback
//! can go below; and as both hands are pulled alike, `v` in it is `|kappa3| / sqrt(kappa1^2 +
//! kappa3^2)`. That local `v` is a heuristic: it is 0 in the middle, where in truth the strand runs
//! along the pull. The minimum of this energy is therefore not the equilibrium, and how far it is
//! from it is what [`greatest_distance`] tells. [`Switchback`](crate::Switchback) is exact, and
//! faster.

use argmin::core::{CostFunction, Executor, State as _};
use argmin::solver::neldermead::NelderMead;
use errorfunctions::ComplexErrorFunctions;
use glam::{DQuat, DVec3};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use crate::tail::Tail;
use crate::{Coil, Material, Profile, SwitchbackError};

/// How much work the approximation is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RitzOptions {
    /// Places between the middle and the coil where the energy counts. Default 24.
    pub samples: usize,
    /// Iterations of the simplex, about 10 microseconds each. Default 2,000: energies still fall
    /// slowly there, distances from the equilibrium do not.
    pub iterations: u64,
}

impl Default for RitzOptions {
    fn default() -> Self {
        Self { samples: 24, iterations: 2_000 }
    }
}

/// An approximate switchback of eleven parameters.
///
/// ```
/// use tress_switchback::{Material, Profile, Ritz, RitzOptions, Switchback, greatest_distance};
///
/// let material = Material::default();
/// let quick = RitzOptions { iterations: 200, ..RitzOptions::default() };
/// let ritz = Ritz::new(0.5, &material, &quick)?;
/// let exact = Switchback::new(0.5, &material)?;
/// // Both change hands alike; between the coils they differ.
/// assert!((ritz.curvature(1e3).z - exact.curvature(1e3).z).abs() < 1e-9);
/// let off = greatest_distance(&ritz, &exact, 20.0);
/// assert!(0.01 < off && off < 1.0, "{off}");
/// # Ok::<(), tress_switchback::SwitchbackError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Ritz {
    coil: Coil,
    material: Material,
    parameters: [f64; 11],
    energy: f64,
}

impl Ritz {
    /// The approximation for the coil of frequency `v`.
    ///
    /// # Errors
    ///
    /// If there is no coil of this frequency, if it is not pulled, or if the rod rests twisted.
    pub fn new(
        v: f64,
        material: &Material,
        options: &RitzOptions,
    ) -> Result<Self, SwitchbackError> {
        let problem = Problem::new(v, material, options)?;
        let start = problem.start();
        // A second simplex about what the first has found gets out of where that one got stuck.
        let half = options.iterations / 2;
        let (rough, _) = problem.minimize(start, SPREAD, half);
        Ok(problem.solved(rough, options.iterations - half))
    }

    /// The approximation for a frequency near to this one's, started from it: half the iterations.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn near(&self, v: f64, options: &RitzOptions) -> Result<Self, SwitchbackError> {
        let problem = Problem::new(v, &self.material, options)?;
        Ok(problem.solved(self.parameters, options.iterations / 2))
    }

    /// The coil before it.
    #[must_use]
    pub fn coil(&self) -> &Coil {
        &self.coil
    }

    /// `[a1, b1, c1, a2, b2, c2, a3, b3, c3, b4, c4]` for a positive `v`.
    #[must_use]
    pub fn parameters(&self) -> [f64; 11] {
        self.parameters
    }

    /// What was minimized, at the end.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.energy
    }
}

impl Profile for Ritz {
    fn curvature(&self, s: f64) -> DVec3 {
        let right = if self.coil.v < 0.0 { self.coil.other_hand() } else { self.coil };
        let kappa = family(&self.parameters, &right, self.material.torsional(), s);
        let mirror = if self.coil.v < 0.0 { -1.0 } else { 1.0 };
        kappa * DVec3::new(1.0, mirror, mirror)
    }

    fn ends(&self) -> [DVec3; 2] {
        [self.coil.curvature, self.coil.other_hand().curvature]
    }

    fn half_width(&self, share: f64) -> f64 {
        let [_, b1, _, _, b2, _, _, b3, _, b4, _] = self.parameters;
        let slowest = [b1, b2, b3, b4].into_iter().fold(f64::INFINITY, f64::min);
        (-share.ln() / slowest).sqrt()
    }
}

/// The greatest distance between the curvatures of two profiles from `-reach` to `reach`.
#[must_use]
pub fn greatest_distance(a: &impl Profile, b: &impl Profile, reach: f64) -> f64 {
    let places = (-500..=500).map(|i| reach * f64::from(i) / 500.0);
    places.map(|s| a.curvature(s).distance(b.curvature(s))).fold(0.0, f64::max)
}

/// Share by which the first simplex spreads about the start, and the second.
const SPREAD: f64 = 0.25;

/// Widths of Gaussians below this share of the squared decay are not bumps any more.
const NARROWEST: f64 = 1e-3;

/// A simplex this small has ended.
const TOLERANCE: f64 = 1e-9;

/// `kappa` of the family at `s`.
fn family(n: &[f64; 11], coil: &Coil, gamma: f64, s: f64) -> DVec3 {
    let [a1, b1, c1, a2, b2, c2, a3, b3, c3, b4, c4] = *n;
    let pi = std::f64::consts::PI;
    let bump = |a: f64, b: f64, c: f64| a * (-b * s * s).exp() * (c * s).cos();
    let kappa3 = coil.curvature.z;
    let alpha = a3 / (2.0 * gamma) * (pi / b3).sqrt() * (-c3 * c3 / (4.0 * b3)).exp();
    let a4 = 2.0 * gamma * (kappa3 - alpha) * (b4 / pi).sqrt() * (c4 * c4 / (4.0 * b4)).exp();
    let step = |b: f64, c: f64| {
        let root = b.sqrt();
        Complex64::new(root * s, 0.5 * c / root).erf().re
    };
    DVec3::new(
        coil.curvature.x + bump(a1, b1, c1) + bump(a2, b2, c2),
        bump(a3, b3, c3) + bump(a4, b4, c4),
        -alpha * step(b3, c3) - (kappa3 - alpha) * step(b4, c4),
    )
}

/// What is minimized.
struct Problem {
    coil: Coil,
    right: Coil,
    material: Material,
    decay: f64,
    /// Length of the steps from the coil to the middle; curvatures are taken at their middles.
    step: f64,
    steps: usize,
}

impl Problem {
    fn new(v: f64, material: &Material, options: &RitzOptions) -> Result<Self, SwitchbackError> {
        let coil = Coil::new(v, material)?;
        if material.rest_twist != 0.0 {
            return Err(SwitchbackError::PrefersOneHand { rest_twist: material.rest_twist });
        }
        let right = if v < 0.0 { coil.other_hand() } else { coil };
        let tail = Tail::new(material, right.state()).ok_or(SwitchbackError::Slack { v })?;
        let steps = options.samples.max(4);
        let step = REACH / tail.decay() / steps as f64;
        Ok(Self { coil, right, material: *material, decay: tail.decay(), step, steps })
    }

    /// Bumps as wide as the tail is long, and as high as the middle of a typical switchback is.
    fn start(&self) -> [f64; 11] {
        let (b, turning) = (0.5 * self.decay * self.decay, self.right.turning());
        let gamma = self.material.torsional();
        let (kappa1, kappa3) = (self.right.curvature.x, self.right.curvature.z);
        let a3 = gamma * kappa3 * (b / std::f64::consts::PI).sqrt();
        [
            -0.3 * kappa1,
            b,
            0.1 * turning,
            -0.1 * kappa1,
            2.0 * b,
            turning,
            a3,
            b,
            0.1 * turning,
            2.0 * b,
            0.5 * turning,
        ]
    }

    fn solved(&self, start: [f64; 11], iterations: u64) -> Ritz {
        let (parameters, energy) = self.minimize(start, SPREAD, iterations);
        Ritz { coil: self.coil, material: self.material, parameters, energy }
    }

    /// The best of a simplex about `start`.
    fn minimize(&self, start: [f64; 11], spread: f64, iterations: u64) -> ([f64; 11], f64) {
        let mut simplex = vec![start.to_vec()];
        for i in 0..start.len() {
            let mut corner = start.to_vec();
            corner[i] += spread * corner[i].abs().max(1e-3);
            simplex.push(corner);
        }
        let unmoved = (start, self.energy(&start));
        let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(TOLERANCE) else {
            return unmoved;
        };
        let executor = Executor::new(self, solver).configure(|state| state.max_iters(iterations));
        let Ok(result) = executor.run() else { return unmoved };
        let best = result.state().get_best_param().and_then(|n| n.as_slice().try_into().ok());
        best.map_or(unmoved, |n: [f64; 11]| (n, result.state().get_best_cost()))
    }

    /// [CC 26] with the integral replaced by the greatest value, as [CC 5.1.4] does.
    fn energy(&self, n: &[f64; 11]) -> f64 {
        let [_, b1, _, _, b2, _, _, b3, _, b4, _] = *n;
        let least = NARROWEST * self.decay * self.decay;
        if ![b1, b2, b3, b4].iter().all(|&b| least < b) {
            return f64::MAX;
        }
        let gamma = self.material.torsional();
        let of_coil = self.density(self.right.curvature);
        // The axis, seen from the body frame, is carried from the coil to the middle.
        let mut axis = self.right.curvature.normalize();
        let mut greatest: f64 = 0.0;
        for i in 0..self.steps {
            let s = -self.step * (self.steps as f64 - i as f64 - 0.5);
            let kappa = family(n, &self.right, gamma, s);
            greatest = greatest.max((self.density(kappa) - of_coil).abs());
            axis = DQuat::from_scaled_axis(-kappa * self.step) * axis;
        }
        let energy = 1.0 - axis.z * axis.z + greatest;
        if energy.is_finite() { energy } else { f64::MAX }
    }

    /// [CC 12].
    fn density(&self, kappa: DVec3) -> f64 {
        let gamma = self.material.torsional();
        let v = kappa.z.abs() / kappa.x.hypot(kappa.z);
        let bending = (kappa.x - 1.0) * (kappa.x - 1.0) + kappa.y * kappa.y;
        0.5 * (bending + gamma * kappa.z * kappa.z) - self.right.pull() * v
    }
}

/// How far from the middle the energy counts, in e-foldings of the tail.
const REACH: f64 = 4.0;

impl CostFunction for &Problem {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, n: &Self::Param) -> Result<Self::Output, argmin::core::Error> {
        let n = n.as_slice().try_into()?;
        Ok(self.energy(n))
    }
}

#[cfg(test)]
mod tests {
    use tress_geometry::{Element, Frame};

    use super::*;
    use crate::{Switchback, material_curvature, rod};

    fn ritz(v: f64) -> Ritz {
        Ritz::new(v, &Material::default(), &RitzOptions::default()).expect("a pulled coil")
    }

    #[test]
    fn the_family_obeys_the_equation_of_twist() {
        let n = [-0.3, 0.02, 0.3, 0.1, 0.05, 1.0, 0.1, 0.03, 0.2, 0.06, 0.4];
        let coil = Coil::new(0.4, &Material::default()).expect("a coil");
        let gamma = Material::default().torsional();
        let h = 1e-5;
        for i in -20..=20 {
            let s = f64::from(i);
            let rate = (family(&n, &coil, gamma, s + h) - family(&n, &coil, gamma, s - h)).z;
            let kappa2 = family(&n, &coil, gamma, s).y;
            assert!((rate / (2.0 * h) + kappa2 / gamma).abs() < 1e-9);
        }
        let (before, behind) = (family(&n, &coil, gamma, -60.0), family(&n, &coil, gamma, 60.0));
        assert!(before.distance(coil.curvature) < 1e-12);
        assert!((behind.z + coil.curvature.z).abs() < 1e-12);
    }

    #[test]
    fn the_simplex_goes_down_and_a_warm_start_lower_still() {
        let cold = ritz(0.4);
        let problem =
            Problem::new(0.4, &Material::default(), &RitzOptions::default()).expect("a problem");
        assert!(cold.energy() < 0.5 * problem.energy(&problem.start()));
        let warm = cold.near(0.4, &RitzOptions::default()).expect("the same coil");
        assert!(warm.energy() <= cold.energy());
    }

    #[test]
    fn it_is_no_equilibrium_and_the_distance_says_so() {
        for v in [0.3, 0.6] {
            let exact = Switchback::new(v, &Material::default()).expect("within range");
            let off = greatest_distance(&ritz(v), &exact, 30.0);
            assert!(0.02 < off && off < 0.8, "{v}: {off}");
            assert!(greatest_distance(&exact, &exact, 30.0) < 1e-15);
        }
        // The exact solution is one: checked by its own equations, not by the distance.
        let exact = Switchback::new(0.3, &Material::default()).expect("within range");
        let middle = exact.force(0.0);
        let state = [exact.curvature(0.0).x, exact.curvature(0.0).y, 0.0, 0.0, 0.0, middle.z];
        assert!(rod::derivative(&Material::default(), &state)[0].abs() < 1e-9);
    }

    #[test]
    fn the_other_hand_is_the_mirror_image() {
        let (right, left) = (ritz(0.5), ritz(-0.5));
        assert!(right.parameters().iter().eq(left.parameters().iter()));
        for s in [-7.0, -0.5, 0.0, 3.0] {
            let mirrored = right.curvature(s) * DVec3::new(1.0, -1.0, -1.0);
            assert!(left.curvature(s).distance(mirrored) < 1e-14);
        }
    }

    #[test]
    fn the_widest_bump_has_fallen_to_the_share_where_the_room_ends() {
        let ritz = ritz(0.5);
        let [_, b1, _, _, b2, _, _, b3, _, b4, _] = ritz.parameters();
        for share in [0.5, 0.05, 1e-4] {
            let end = ritz.half_width(share);
            let left = [b1, b2, b3, b4].map(|b| (-b * end * end).exp());
            let widest = left.into_iter().fold(0.0, f64::max);
            assert!((widest / share - 1.0).abs() < 1e-12, "{share}: {left:?}");
        }
    }

    #[test]
    fn the_energy_sees_how_far_the_middle_leans_from_the_axis() {
        let options = RitzOptions::default();
        let problem = Problem::new(0.4, &Material::default(), &options).expect("a problem");
        let n = problem.start();
        let gamma = Material::default().torsional();
        // The same steps walked by a strand in space, whose axis stands still.
        let mut frame = Frame::IDENTITY;
        let mut greatest: f64 = 0.0;
        for i in 0..problem.steps {
            let s = problem.step * (i as f64 + 0.5 - problem.steps as f64);
            let kappa = family(&n, &problem.right, gamma, s);
            let above = problem.density(kappa) - problem.density(problem.right.curvature);
            greatest = greatest.max(above.abs());
            let element = Element { curvature: material_curvature(kappa), length: problem.step };
            frame = element.advance(&frame);
        }
        let axis = material_curvature(problem.right.curvature).normalize();
        let sine = frame.tangent().cross(axis).length();
        let energy = problem.energy(&n);
        assert!((energy - greatest - sine * sine).abs() < 1e-12, "{energy} {greatest} {sine}");
    }

    #[test]
    fn what_has_no_switchback_is_refused() {
        let options = RitzOptions::default();
        let twisted = Material { rest_twist: 0.2, ..Material::default() };
        let error = Ritz::new(0.5, &twisted, &options);
        assert_eq!(error, Err(SwitchbackError::PrefersOneHand { rest_twist: 0.2 }));
        let error = Ritz::new(0.0, &Material::default(), &options);
        assert_eq!(error, Err(SwitchbackError::Slack { v: 0.0 }));
        assert!(Ritz::new(1.5, &Material::default(), &options).is_err());
    }
}
