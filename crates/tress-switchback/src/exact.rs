//! The exact switchback: the equilibrium that leads from a coil to the coil of the other hand.
//!
//! It is symmetric about its middle `s = 0`: `kappa1`, `kappa2`, `f3` are even and `kappa3`, `f1`,
//! `f2` odd. So `kappa3 = f1 = f2 = 0` there and, as the pull `F` does not change, `f3 = F`: in the
//! middle the strand runs along its axis. The energy is that of the coil, which leaves one number
//! open, the angle `theta` of
//!
//! `(kappa1, kappa2) = rho (cos theta, sin theta)`,
//! `rho^2 = kappa1_h^2 + Gamma kappa3_h^2 + 2 F (v - 1)`.
//!
//! [`crate::shoot`] finds it. That such solutions exist is shown in "Tendril perversion in
//! intrinsically curved rods", Journal of Nonlinear Science 12(3), 2002, the source of [CC 4.2].

use glam::DVec3;

use crate::rod::State;
use crate::shoot::Half;
use crate::tail::Tail;
use crate::{Coil, CoilError, Material, Profile};

mod start;

/// A switchback in equilibrium: right-handed before it and left-handed behind where `v` is
/// positive, the other way round where `v` is negative.
///
/// ```
/// use tress_switchback::{Material, Profile, Switchback};
///
/// let switchback = Switchback::new(0.5, &Material::default())?;
/// // In the middle the twist changes sign, and nothing is left of half of the bending.
/// let middle = switchback.curvature(0.0);
/// assert!((middle.x - 0.4976314802).abs() < 1e-9 && (middle.y - 0.3819084107).abs() < 1e-9);
/// assert!(middle.z.abs() < 1e-12);
/// // Far out it is the coil, of one hand before and of the other behind.
/// let coil = switchback.coil().curvature;
/// assert!(switchback.curvature(-80.0).distance(coil) < 1e-12);
/// assert!((switchback.curvature(80.0).z + coil.z).abs() < 1e-12);
/// # Ok::<(), tress_switchback::SwitchbackError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Switchback {
    coil: Coil,
    material: Material,
    /// Angle of the curvature in the middle, for a positive `v`.
    theta: f64,
    /// The half behind the middle, for a positive `v`.
    half: Half,
}

/// Why there is no switchback.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SwitchbackError {
    /// The coil it should lead from does not exist.
    ///
    /// ```
    /// # use tress_switchback::{CoilError, Material, Switchback, SwitchbackError};
    /// let error = Switchback::new(-1.0, &Material::default()).unwrap_err();
    /// assert_eq!(error, SwitchbackError::Coil(CoilError::Frequency(-1.0)));
    /// ```
    #[error(transparent)]
    Coil(#[from] CoilError),
    /// A ring that nothing pulls has no hand that could change.
    ///
    /// ```
    /// # use tress_switchback::{Material, Switchback, SwitchbackError};
    /// let error = Switchback::new(0.0, &Material::default()).unwrap_err();
    /// assert_eq!(error, SwitchbackError::Slack { v: 0.0 });
    /// ```
    #[error("a coil of frequency {v} is not pulled, and only a pulled coil has switchbacks")]
    Slack {
        /// The coil frequency.
        v: f64,
    },
    /// A rod that rests twisted prefers one hand: a single switchback is no equilibrium of it,
    /// only an even number is.
    ///
    /// ```
    /// # use tress_switchback::{Material, Switchback, SwitchbackError};
    /// let twisted = Material { rest_twist: 0.1, ..Default::default() };
    /// let error = Switchback::new(0.4, &twisted).unwrap_err();
    /// assert_eq!(error, SwitchbackError::PrefersOneHand { rest_twist: 0.1 });
    /// ```
    #[error("a rod that rests twisted by {rest_twist} has switchbacks in even numbers only")]
    PrefersOneHand {
        /// The twist at rest.
        rest_twist: f64,
    },
    /// The equations were not solved. Frequencies from 0.005 to 0.95 of either sign are, for
    /// Poisson's ratios of 0 to 0.5.
    ///
    /// ```
    /// # use tress_switchback::{Material, Switchback, SwitchbackError};
    /// let error = Switchback::new(0.9999, &Material::default()).unwrap_err();
    /// assert_eq!(error, SwitchbackError::NotFound { v: 0.9999 });
    /// ```
    #[error("the switchback of a coil of frequency {v} was not found")]
    NotFound {
        /// The coil frequency.
        v: f64,
    },
}

impl Switchback {
    /// The switchback of the coil of frequency `v`.
    ///
    /// # Errors
    ///
    /// If there is no coil of this frequency, if it is not pulled, if the rod rests twisted, or if
    /// the solution was not found.
    pub fn new(v: f64, material: &Material) -> Result<Self, SwitchbackError> {
        let coil = Coil::new(v, material)?;
        Self::solve(coil, material, start::theta(v.abs(), material.poisson_ratio))
    }

    /// The switchback of the coil of frequency `v`, of the same material, found from this one.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new); [`SwitchbackError::NotFound`] also where the frequencies are too far
    /// apart (more than 0.1 where they are small).
    pub fn near(&self, v: f64) -> Result<Self, SwitchbackError> {
        let coil = Coil::new(v, &self.material)?;
        let nu = self.material.poisson_ratio;
        let off = self.theta - start::theta(self.coil.v.abs(), nu);
        Self::solve(coil, &self.material, start::theta(v.abs(), nu) + off)
    }

    fn solve(coil: Coil, material: &Material, start: f64) -> Result<Self, SwitchbackError> {
        let v = coil.v;
        if material.rest_twist != 0.0 {
            return Err(SwitchbackError::PrefersOneHand { rest_twist: material.rest_twist });
        }
        let right = if v < 0.0 { coil.other_hand() } else { coil };
        let pull = right.pull();
        let tail = Tail::new(material, right.other_hand().state());
        let tail = tail.ok_or(SwitchbackError::Slack { v })?;
        let kappa = right.curvature;
        let square = kappa.x * kappa.x
            + material.torsional() * kappa.z * kappa.z
            + 2.0 * pull * (right.v - 1.0);
        let rho = square.max(0.0).sqrt();
        let middle = |theta: f64| {
            let (sine, cosine) = theta.sin_cos();
            [rho * cosine, rho * sine, 0.0, 0.0, 0.0, pull]
        };
        let found = Half::shoot(material, tail, middle, start);
        let (theta, half) = found.ok_or(SwitchbackError::NotFound { v })?;
        Ok(Self { coil, material: *material, theta, half })
    }

    /// The coil before it.
    #[must_use]
    pub fn coil(&self) -> &Coil {
        &self.coil
    }

    /// What it is made of.
    #[must_use]
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// The force in the body frame, in units of bending stiffness times the square of the rest
    /// curvature; its length is the pull everywhere.
    #[must_use]
    pub fn force(&self, s: f64) -> DVec3 {
        let [.., f1, f2, f3] = self.state(s);
        DVec3::new(f1, f2, f3)
    }

    fn state(&self, s: f64) -> State {
        let [k1, k2, k3, f1, f2, f3] = self.half.at(s.abs());
        // The half behind the middle is left-handed for a positive v; a mirror image has the
        // other sign of kappa2, kappa3, f1 (an axial and a polar vector seen in a mirror).
        let behind = if s < 0.0 { -1.0 } else { 1.0 };
        let mirror = if self.coil.v < 0.0 { -1.0 } else { 1.0 };
        [k1, mirror * k2, mirror * behind * k3, mirror * behind * f1, behind * f2, f3]
    }
}

impl Profile for Switchback {
    fn curvature(&self, s: f64) -> DVec3 {
        let [k1, k2, k3, ..] = self.state(s);
        DVec3::new(k1, k2, k3)
    }

    fn ends(&self) -> [DVec3; 2] {
        [self.coil.curvature, self.coil.other_hand().curvature]
    }

    fn half_width(&self, share: f64) -> f64 {
        self.half.settled(share * self.coil.turning())
    }
}

#[cfg(test)]
mod tests;
