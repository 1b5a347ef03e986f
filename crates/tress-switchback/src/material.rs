//! What a strand is made of, as far as its coil's shape depends on it.

use serde::{Deserialize, Serialize};

/// An isotropic rod whose rest state bends: `kappa^0 = (1, 0, rest_twist)` [CC 7].
///
/// Curvatures are in units of the rest curvature `k0` throughout this crate, lengths in `1 / k0`,
/// forces in units of the bending stiffness times `k0^2`.
///
/// ```
/// let hair = tress_switchback::Material::default();
/// assert!((hair.torsional() - 1.0 / 1.4).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// Poisson's ratio `mu`, 0 to 0.5 for what hair is made of. Default 0.4.
    pub poisson_ratio: f64,
    /// Twist at rest over curvature at rest, `kappa_3^0`. Default 0: a rod that rests as a circle,
    /// the only one whose coils come in two hands alike.
    pub rest_twist: f64,
}

impl Default for Material {
    fn default() -> Self {
        Self { poisson_ratio: 0.4, rest_twist: 0.0 }
    }
}

impl Material {
    /// Torsional over bending stiffness of a round cross-section, `Gamma = 1 / (1 + mu)` [CC 4.1].
    #[must_use]
    pub fn torsional(&self) -> f64 {
        1.0 / (1.0 + self.poisson_ratio)
    }
}
