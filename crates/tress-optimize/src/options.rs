//! How to sculpt: stiffness, weights, solver and when to stop.

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// `c` of the energy: what it costs a strand to change its curvatures.
///
/// In both forms `0` is allowed: of all curvatures that reach the anchors one near the start is
/// taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Stiffness {
    /// `c` as it stands in [CSE 15], in length^4: the number means another thing in millimetres
    /// than in metres, for long strands than for short ones, and for many elements than for few.
    Raw(f64),
    /// The same whatever the unit, the length and the number of elements: a single anchor that
    /// draws the tip is reached to `1 / (1 + stiffness)` of the way, on the average over all
    /// directions and as far as the motion is small. `0.01`: to a hundredth; `1`: half the way.
    Relative(f64),
}

impl Stiffness {
    /// The number.
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::Raw(c) | Self::Relative(c) => c,
        }
    }
}

/// Which optimiser.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Solver {
    /// Levenberg-Marquardt with a factorisation the size of the controls: a few steps.
    #[default]
    LevenbergMarquardt,
    /// Adam as published, [CSE 6.5.1]: thousands of steps, for comparison.
    Adam(Adam),
}

/// The constants of Adam; their defaults are those of [CSE 6.5.1].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Adam {
    /// Step size, in curvature (one over length). Default 0.001.
    pub step: f64,
    /// Decay of the first moment. Default 0.9.
    pub beta1: f64,
    /// Decay of the second moment. Default 0.999.
    pub beta2: f64,
    /// What keeps the denominator from 0. Default 1e-8.
    pub epsilon: f64,
    /// Steps at most. Default 4000.
    pub max_steps: usize,
    /// Energy below which it stops. Default 1e-6.
    pub residual: f64,
    /// Steps without a lower energy after which it stops. Default 50.
    pub patience: usize,
}

impl Default for Adam {
    fn default() -> Self {
        Self {
            step: 1e-3,
            beta1: 0.9,
            beta2: 0.999,
            epsilon: 1e-8,
            max_steps: 4000,
            residual: 1e-6,
            patience: 50,
        }
    }
}

/// How strands are moved to their anchors.
///
/// ```
/// use tress_optimize::{SculptOptions, Stiffness};
///
/// let stiff = SculptOptions { stiffness: Stiffness::Relative(0.5), ..Default::default() };
/// assert!(stiff.validate().is_ok());
/// let negative = SculptOptions { stiffness: Stiffness::Raw(-1.0), ..Default::default() };
/// assert!(negative.validate().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SculptOptions {
    /// What bending costs. Default `Relative(1e-4)`: anchors are met to a ten-thousandth.
    pub stiffness: Stiffness,
    /// How dear a change of each of `k0`, `k1`, `k2` is. Default `(0.1, 1, 1)`: hair twists before
    /// it bends, see the droop test in the documentation; `(1, 1, 1)` is [CSE 15].
    pub weights: DVec3,
    /// How dear a change at the tip is, in parts of one at the root, geometrically in between.
    /// Default 0.15: hair gives more towards its tip, see the same test; 1 is [CSE 15].
    pub tip_weight: f64,
    /// The optimiser. Default Levenberg-Marquardt.
    pub solver: Solver,
    /// Length of the gradient, in parts of its length at the start, that counts as nothing.
    /// Default 1e-6.
    pub tolerance: f64,
    /// Evaluations of the energy after which Levenberg-Marquardt gives up. Default 1000: nearly all
    /// strands need about ten, and the few that need hundreds are asked for them.
    pub max_iterations: usize,
    /// How far anchors are moved in one step, in parts of the strand's extent. Default 0.25: with
    /// 1 a strand may flip over instead of morphing.
    pub continuation: f64,
}

impl Default for SculptOptions {
    fn default() -> Self {
        Self {
            stiffness: Stiffness::Relative(1e-4),
            weights: DVec3::new(0.1, 1.0, 1.0),
            tip_weight: 0.15,
            solver: Solver::default(),
            tolerance: 1e-6,
            max_iterations: 1000,
            continuation: 0.25,
        }
    }
}

/// Which option has no meaning.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OptionsError {
    /// The stiffness is negative or not finite: `Stiffness::Raw(-1.0)`.
    #[error("stiffness must be a number and at least 0, not {0}")]
    Stiffness(f64),
    /// A weight is not positive or not finite: `weights: DVec3::ZERO`.
    #[error("weights must be positive numbers, not {0}")]
    Weights(DVec3),
    /// The tip's weight is not positive or not finite: `tip_weight: 0.0`.
    #[error("the tip's weight must be a positive number, not {0}")]
    TipWeight(f64),
    /// The tolerance is negative or NaN: `tolerance: -1.0`.
    #[error("tolerance must be at least 0, not {0}")]
    Tolerance(f64),
    /// The continuation step is not positive: `continuation: 0.0`.
    #[error("continuation must be greater than 0, not {0}")]
    Continuation(f64),
}

impl SculptOptions {
    /// The paper's energy with the constant `c`: [CSE 15], nothing weighted.
    #[must_use]
    pub fn published(c: f64) -> Self {
        Self {
            stiffness: Stiffness::Raw(c),
            weights: DVec3::ONE,
            tip_weight: 1.0,
            ..Self::default()
        }
    }

    /// Whether every option has a meaning.
    ///
    /// # Errors
    ///
    /// The first that has none.
    pub fn validate(&self) -> Result<(), OptionsError> {
        let stiffness = self.stiffness.value();
        if !(0.0 <= stiffness && stiffness.is_finite()) {
            return Err(OptionsError::Stiffness(stiffness));
        }
        if !(self.weights.is_finite() && 0.0 < self.weights.min_element()) {
            return Err(OptionsError::Weights(self.weights));
        }
        if !(0.0 < self.tip_weight && self.tip_weight.is_finite()) {
            return Err(OptionsError::TipWeight(self.tip_weight));
        }
        if self.tolerance.is_nan() || self.tolerance < 0.0 {
            return Err(OptionsError::Tolerance(self.tolerance));
        }
        if self.continuation.is_nan() || self.continuation <= 0.0 {
            return Err(OptionsError::Continuation(self.continuation));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_meaningless_option_is_named() {
        let ok = SculptOptions::default();
        let with = |options: SculptOptions| options.validate().unwrap_err();
        for c in [-1.0, f64::INFINITY] {
            let stiffness = Stiffness::Relative(c);
            assert_eq!(with(SculptOptions { stiffness, ..ok }), OptionsError::Stiffness(c));
        }
        let nan = SculptOptions { stiffness: Stiffness::Raw(f64::NAN), ..ok };
        assert!(matches!(with(nan), OptionsError::Stiffness(_)));
        let weights = DVec3::new(0.0, 1.0, 1.0);
        assert_eq!(with(SculptOptions { weights, ..ok }), OptionsError::Weights(weights));
        assert_eq!(with(SculptOptions { tip_weight: 0.0, ..ok }), OptionsError::TipWeight(0.0));
        assert_eq!(with(SculptOptions { tolerance: -1.0, ..ok }), OptionsError::Tolerance(-1.0));
        let still = SculptOptions { continuation: 0.0, ..ok };
        assert_eq!(with(still), OptionsError::Continuation(0.0));
    }

    #[test]
    fn an_unknown_option_is_refused_by_name() {
        let error = ron::from_str::<SculptOptions>("(stifness: Raw(1.0))").unwrap_err();
        assert!(error.to_string().contains("stifness"), "{error}");
    }
}
