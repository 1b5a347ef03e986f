//! Two switchbacks that are one shape: the S that a coil makes when it changes hands and changes
//! back at once [CC 4.3.4].
//!
//! Both ends are the same coil, so it exists for rods that rest as a helix too, which a single
//! switchback does not. It is symmetric about its middle by a half turn that keeps the hand:
//! `kappa1`, `kappa3`, `f1`, `f3` are even, `kappa2` and `f2` odd. With `f = F (sin phi, 0, cos
//! phi)` in the middle, no torque about the pull (`m . f = 0`) makes the moment there
//! `m = t (Gamma cos phi, 0, -Gamma sin phi)`, and the energy is the coil's, which gives
//!
//! `t^2/2 (Gamma^2 cos^2 + Gamma sin^2) + t Gamma (cos - kappa3_0 sin) + F cos - H = 0`.
//!
//! The angle `phi` is the one number left, and [`crate::shoot`] finds it. Solutions come in
//! families, by how far apart the two are; this is the closest. It is followed from a coil where
//! its angle is known to the one asked for, in strides of frequency and twist at rest that shorten
//! where it turns. Where it ends the two changes of hand have met and are gone: for a rod at rest
//! untwisted below a frequency of 0.4, for a twisted one outside of a band that begins a little
//! above its frequency at rest.

use glam::DVec3;

use crate::rod::State;
use crate::shoot::Half;
use crate::tail::Tail;
use crate::{Coil, Material, Profile, SwitchbackError};

/// A double switchback in equilibrium: the same coil before it and behind.
///
/// ```
/// use tress_switchback::{DoubleSwitchback, Material, Profile};
///
/// let hair = Material { rest_twist: 0.2, ..Material::default() };
/// let double = DoubleSwitchback::new(0.6, &hair)?;
/// let coil = double.coil().curvature;
/// assert!(double.curvature(-90.0).distance(coil) < 1e-9);
/// assert!(double.curvature(90.0).distance(coil) < 1e-9);
/// // Right-handed coils, and left-handed between the two changes.
/// assert!(0.0 < coil.z && double.curvature(0.0).z < 0.0);
/// # Ok::<(), tress_switchback::SwitchbackError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DoubleSwitchback {
    coil: Coil,
    half: Half,
}

/// Coil frequency where followed solutions begin, at rest untwisted.
const ORIGIN: f64 = 0.6;

/// Angles there for Poisson's ratios 0, 0.25 and 0.5.
const ANGLES: [f64; 3] = [-0.7102, -0.6946, -0.6853];

/// The first and the longest stride by which a solution is followed, in frequency or twist at rest.
const STRIDES: [f64; 2] = [0.02, 0.05];

/// A solution that shorter strides would be needed for has come to its end.
const LEAST_STRIDE: f64 = 1e-4;

/// How far the angle may be from where it is expected: farther off is another solution.
const NEAR: f64 = 0.01;

impl DoubleSwitchback {
    /// The double switchback of the coil of frequency `v`.
    ///
    /// # Errors
    ///
    /// If there is no coil of this frequency, if it is not pulled, or if there is no solution.
    /// There are for frequencies from 0.4 to 0.9 where the rod rests untwisted; from 0.3 to 0.6,
    /// 0.45 to 0.65, 0.6 to 0.7 where its twist at rest is 0.2, 0.4, 0.6 the same way.
    pub fn new(v: f64, material: &Material) -> Result<Self, SwitchbackError> {
        let coil = Coil::new(v, material)?;
        // Solved for a right-handed coil; the other is its mirror image.
        let (target, twist) = (v.abs(), material.rest_twist * v.signum());
        let on_the_way = |part: f64, expected: f64| {
            let material = Material { rest_twist: twist * part, ..*material };
            let coil = Coil::new(ORIGIN + (target - ORIGIN) * part, &material).ok()?;
            let (angle, half) = solve(&coil, &material, expected)?;
            let both_hands = half.at(0.0)[2] < 0.0;
            (both_hands && (angle - expected).abs() < NEAR).then_some((angle, half))
        };
        let not_found = SwitchbackError::NotFound { v };
        let (mut angle, mut half) =
            on_the_way(0.0, start(material.poisson_ratio)).ok_or(not_found)?;
        let span = (target - ORIGIN).abs().max(twist.abs());
        let [mut stride, longest] = STRIDES.map(|stride| stride / span);
        let (mut part, mut slope) = (0.0, 0.0);
        while part < 1.0 {
            let next = f64::min(part + stride, 1.0);
            if let Some((found, solved)) = on_the_way(next, angle + slope * (next - part)) {
                slope = (found - angle) / (next - part);
                (part, angle, half) = (next, found, solved);
                stride = longest.min(1.5 * stride);
            } else {
                stride *= 0.5;
            }
            if stride * span < LEAST_STRIDE {
                return Err(not_found);
            }
        }
        Ok(Self { coil, half })
    }

    /// The coil before it and behind.
    #[must_use]
    pub fn coil(&self) -> &Coil {
        &self.coil
    }
}

impl Profile for DoubleSwitchback {
    fn curvature(&self, s: f64) -> DVec3 {
        let [k1, k2, k3, ..] = self.half.at(s.abs());
        let mirror = if self.coil.v < 0.0 { -1.0 } else { 1.0 };
        let behind = if s < 0.0 { -1.0 } else { 1.0 };
        DVec3::new(k1, mirror * behind * k2, mirror * k3)
    }

    fn ends(&self) -> [DVec3; 2] {
        [self.coil.curvature; 2]
    }

    fn half_width(&self, share: f64) -> f64 {
        self.half.settled(share * self.coil.turning())
    }
}

/// The parabola through the known angles.
fn start(poisson_ratio: f64) -> f64 {
    let x = poisson_ratio / 0.25;
    let [a, b, c] = ANGLES;
    a + (b - a) * x + 0.5 * (c - 2.0 * b + a) * x * (x - 1.0)
}

fn solve(coil: &Coil, material: &Material, angle: f64) -> Option<(f64, Half)> {
    let tail = Tail::new(material, coil.state())?;
    let gamma = material.torsional();
    let rest = material.rest_twist;
    let [k1, _, k3, _, _, f3] = coil.state();
    let elastic = 0.5 * ((k1 - 1.0).powi(2) + gamma * (k3 - rest).powi(2));
    let energy = elastic + (k1 - 1.0) + rest * gamma * (k3 - rest) + f3;
    let pull = coil.pull();
    let middle = |phi: f64| -> State {
        let (sine, cosine) = phi.sin_cos();
        let a = 0.5 * gamma * (gamma * cosine * cosine + sine * sine);
        let b = gamma * (cosine - rest * sine);
        let c = pull * cosine - energy;
        let t = (-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
        [1.0 + t * gamma * cosine, 0.0, rest - t * sine, pull * sine, 0.0, pull * cosine]
    };
    Half::shoot(material, tail, middle, angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rod::{derivative, invariants};

    fn state(double: &DoubleSwitchback, s: f64) -> State {
        let [k1, k2, k3, f1, f2, f3] = double.half.at(s.abs());
        let behind = if s < 0.0 { -1.0 } else { 1.0 };
        [k1, behind * k2, k3, f1, behind * f2, f3]
    }

    #[test]
    fn equations_hold_everywhere_and_across_the_middle() {
        for (v, rest_twist, poisson_ratio) in [
            (0.6, 0.0, 0.4),
            (0.5, 0.0, 0.0),
            (0.8, 0.0, 0.5),
            (0.6, 0.3, 0.4),
            (0.6, -0.1, 0.3),
            (0.45, 0.1, 0.4),
            (0.55, 0.5, 0.4),
            (0.3, 0.2, 0.0),
            (0.75, 0.8, 0.4),
        ] {
            let material = Material { poisson_ratio, rest_twist };
            let double = DoubleSwitchback::new(v, &material).expect("in the band that has one");
            let before = invariants(&material, &double.coil.state());
            let h = 1e-4;
            for i in -40..=40 {
                let s = 0.5 * f64::from(i);
                let rate = derivative(&material, &state(&double, s));
                let (up, down) = (state(&double, s + h), state(&double, s - h));
                for k in 0..6 {
                    let change = (up[k] - down[k]) / (2.0 * h);
                    assert!((rate[k] - change).abs() < 2e-7, "{v} {rest_twist} {s} {k}");
                }
                let here = invariants(&material, &state(&double, s));
                assert!(before.iter().zip(here).all(|(a, b)| (a - b).abs() < 1e-8));
            }
        }
    }

    #[test]
    fn the_hand_changes_twice() {
        let double = DoubleSwitchback::new(0.6, &Material::default()).expect("a double one");
        let signs = (-300..=300).map(|i| double.curvature(0.05 * f64::from(i)).z.signum());
        let signs: Vec<f64> = signs.collect();
        assert_eq!(signs.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count(), 2);
        assert!((double.half_width(0.05) - double.half_width(0.01)).is_sign_negative());
    }

    #[test]
    fn the_left_one_is_the_mirror_image() {
        let twisted = |rest_twist| Material { rest_twist, ..Material::default() };
        let right = DoubleSwitchback::new(0.6, &twisted(0.2)).expect("a double one");
        let left = DoubleSwitchback::new(-0.6, &twisted(-0.2)).expect("its mirror image");
        for s in [-3.0, 0.0, 0.7, 9.0] {
            let mirrored = right.curvature(s) * DVec3::new(1.0, -1.0, -1.0);
            assert!(left.curvature(s).distance(mirrored) < 1e-14);
        }
    }

    #[test]
    fn where_there_is_none_it_says_so() {
        let error = DoubleSwitchback::new(0.1, &Material::default());
        assert_eq!(error, Err(SwitchbackError::NotFound { v: 0.1 }));
        let slack = Material { rest_twist: 1.0, ..Material::default() };
        assert_eq!(DoubleSwitchback::new(0.6, &slack), Err(SwitchbackError::NotFound { v: 0.6 }));
        assert!(DoubleSwitchback::new(1.0, &Material::default()).is_err());
    }
}
