//! The coils of a rod under tension, in closed form [CC 4.2].
//!
//! A rod that rests as a circle, or as a helix of twist `kappa_3^0`, and is pulled at its ends by a
//! force alone (no torque about the axis) is a helix for every pull. With the coil frequency
//! `v = kappa3 / |kappa|` (0 a flat ring, 1 or -1 pulled straight, its sign the hand),
//!
//! `lambda = (sqrt(1 - v^2) + Gamma kappa_3^0 v) / (1 + (Gamma - 1) v^2)`,
//! `kappa1 = lambda sqrt(1 - v^2)`, `kappa2 = 0`, `kappa3 = lambda v`,
//! `f = (1/kappa1 - 1 + Gamma (1 - kappa_3^0 / kappa3)) kappa3 kappa`.
//!
//! `lambda = |kappa|` is how fast the coil turns. This agrees with [CC 16] and [CC 15]; the square
//! root of [CC 17] is on the wrong branch for small `v` when the rest state is twisted the same
//! way.

use glam::DVec3;

use crate::Material;
use crate::rod::State;

/// A coil in equilibrium, in units of the rest curvature.
///
/// ```
/// use tress_switchback::{Coil, Material};
///
/// let coil = Coil::new(0.2, &Material::default())?;
/// assert!((coil.curvature.x - 0.9710982658959537).abs() < 1e-15);
/// assert!((coil.curvature.z - 0.1982246034622225).abs() < 1e-15);
/// assert!((coil.pull() - 0.14617929098867324).abs() < 1e-15);
/// # Ok::<(), tress_switchback::CoilError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coil {
    /// Coil frequency, over -1 and below 1.
    pub v: f64,
    /// `(kappa1, kappa2, kappa3)`: bending about `d1` and `d2`, twist; `kappa2` is 0.
    pub curvature: DVec3,
    /// The force along the strand in the body frame; parallel to the curvature.
    pub force: DVec3,
}

/// Why there is no coil.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CoilError {
    /// Coil frequencies lie between -1 and 1.
    ///
    /// ```
    /// # use tress_switchback::{Coil, CoilError, Material};
    /// let error = Coil::new(1.0, &Material::default());
    /// assert_eq!(error, Err(CoilError::Frequency(1.0)));
    /// ```
    #[error("a coil frequency of {0}, expected more than -1 and less than 1")]
    Frequency(f64),
    /// Poisson's ratio of a solid lies between -1 and 0.5.
    ///
    /// ```
    /// # use tress_switchback::{Coil, CoilError, Material};
    /// let error = Coil::new(0.3, &Material { poisson_ratio: 0.6, ..Default::default() });
    /// assert_eq!(error, Err(CoilError::PoissonRatio(0.6)));
    /// ```
    #[error("a Poisson's ratio of {0}, expected more than -1 and at most 0.5")]
    PoissonRatio(f64),
    /// Twist at rest must be finite.
    ///
    /// ```
    /// # use tress_switchback::{Coil, CoilError, Material};
    /// let error = Coil::new(0.3, &Material { rest_twist: f64::INFINITY, ..Default::default() });
    /// assert_eq!(error, Err(CoilError::RestTwist(f64::INFINITY)));
    /// ```
    #[error("a twist at rest of {0} curvatures, expected a finite number")]
    RestTwist(f64),
    /// The rod rests too twisted the other way: no pull makes it a coil of this frequency.
    ///
    /// ```
    /// # use tress_switchback::{Coil, CoilError, Material};
    /// let error = Coil::new(0.9, &Material { rest_twist: -3.0, ..Default::default() });
    /// assert_eq!(error, Err(CoilError::Unreachable { v: 0.9, rest_twist: -3.0 }));
    /// ```
    #[error("no pull makes a coil of frequency {v} of a rod that rests twisted by {rest_twist}")]
    Unreachable {
        /// The frequency asked for.
        v: f64,
        /// The twist at rest.
        rest_twist: f64,
    },
}

impl Coil {
    /// The coil of frequency `v`.
    ///
    /// # Errors
    ///
    /// If `v` is not between -1 and 1, the material is none, or no such coil exists.
    pub fn new(v: f64, material: &Material) -> Result<Self, CoilError> {
        let inside = -1.0 < v && v < 1.0;
        if !inside {
            return Err(CoilError::Frequency(v));
        }
        let Material { poisson_ratio, rest_twist } = *material;
        if !(-1.0 < poisson_ratio && poisson_ratio <= 0.5) {
            return Err(CoilError::PoissonRatio(poisson_ratio));
        }
        if !rest_twist.is_finite() {
            return Err(CoilError::RestTwist(rest_twist));
        }
        let gamma = material.torsional();
        let w = ((1.0 - v) * (1.0 + v)).sqrt();
        let lambda = (w + gamma * rest_twist * v) / (1.0 + (gamma - 1.0) * v * v);
        if lambda <= 0.0 {
            return Err(CoilError::Unreachable { v, rest_twist });
        }
        let curvature = DVec3::new(lambda * w, 0.0, lambda * v);
        // The factor of kappa3 in [CC 15], multiplied out so that v = 0 is like any other.
        let factor = (1.0 / curvature.x - 1.0 + gamma) * curvature.z - gamma * rest_twist;
        Ok(Self { v, curvature, force: curvature * factor })
    }

    /// How fast it turns, `lambda = |kappa|`: radians in a unit of arc length.
    #[must_use]
    pub fn turning(&self) -> f64 {
        self.curvature.length()
    }

    /// The pull along the axis: positive stretches the coil, negative compresses it.
    #[must_use]
    pub fn pull(&self) -> f64 {
        self.force.length().copysign(self.force.z)
    }

    /// The same coil with the other hand, which the same pull holds when the rod rests untwisted.
    #[must_use]
    pub(crate) fn other_hand(&self) -> Self {
        let flip = DVec3::new(1.0, 1.0, -1.0);
        Self { v: -self.v, curvature: self.curvature * flip, force: self.force * -flip }
    }

    pub(crate) fn state(&self) -> State {
        let (k, f) = (self.curvature, self.force);
        [k.x, k.y, k.z, f.x, f.y, f.z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rod::derivative;
    use proptest::prelude::*;

    fn material() -> impl Strategy<Value = Material> {
        (0.0..0.5, -0.5..0.5)
            .prop_map(|(poisson_ratio, rest_twist)| Material { poisson_ratio, rest_twist })
    }

    proptest! {
        #[test]
        fn a_coil_is_in_equilibrium_and_has_its_frequency(m in material(), v in -0.8..0.8) {
            let coil = Coil::new(v, &m).expect("weakly twisted rods coil both ways");
            let rate = derivative(&m, &coil.state());
            prop_assert!(rate.iter().all(|value| value.abs() < 1e-13), "{rate:?}");
            prop_assert!((coil.curvature.z / coil.turning() - v).abs() < 1e-14);
        }

        #[test]
        fn no_torque_is_needed_about_the_axis(m in material(), v in -0.8..0.8) {
            let coil = Coil::new(v, &m).expect("weakly twisted rods coil both ways");
            let twist = m.torsional() * (coil.curvature.z - m.rest_twist);
            let torque = (coil.curvature.x - 1.0) * coil.force.x + twist * coil.force.z;
            prop_assert!(torque.abs() < 1e-13);
        }
    }

    #[test]
    fn at_rest_nothing_pulls() {
        let m = Material { poisson_ratio: 0.3, rest_twist: 0.75 };
        let coil = Coil::new(0.6, &m).expect("its own rest state");
        assert!(coil.curvature.distance(DVec3::new(1.0, 0.0, 0.75)) < 1e-14);
        assert!(coil.pull().abs() < 1e-14);
    }

    #[test]
    fn the_other_hand_is_in_equilibrium_under_the_same_pull() {
        let m = Material::default();
        let coil = Coil::new(0.4, &m).expect("a coil");
        let other = coil.other_hand();
        assert!((other.pull() - coil.pull()).abs() < 1e-15 && 0.0 < other.pull());
        assert!(derivative(&m, &other.state()).iter().all(|value| value.abs() < 1e-15));
    }

    #[test]
    fn frequencies_outside_are_refused() {
        for v in [1.0, -1.0, 2.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Coil::new(v, &Material::default()), Err(CoilError::Frequency(_))));
        }
    }
}
