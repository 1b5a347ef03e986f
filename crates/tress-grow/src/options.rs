//! What decides how hairs grow from their guides.

use serde::{Deserialize, Serialize};

use crate::{Assignment, Curve};

/// How hairs grow from guides. What is measured in turns or coil radii is the guide's own, so that
/// options do not depend on the groom's unit.
///
/// ```
/// use tress_grow::GrowOptions;
///
/// let options: GrowOptions = ron::from_str("(skip: (probability: 0.5), loose: (0.2, 0.4))")?;
/// assert_eq!(options.skip.probability, 0.5);
/// let error = ron::from_str::<GrowOptions>("(skipp: 0.5)").unwrap_err();
/// assert!(error.to_string().contains("skipp"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GrowOptions {
    /// How roots find their guides. Default one of the three nearest, by distance.
    pub assignment: Assignment,
    /// The share of the guide that a hair follows loosely, drawn for each hair from this range
    /// [CC 3.3.2]. Default 0.1 to 0.4.
    pub loose: (f64, f64),
    /// How far hairs of a wisp stray from their guide, in coil radii, along the guide from 0 to 1:
    /// `w(t)` of [CC 2]. Default 0.6 narrowing to 0.35.
    pub wisp: Curve,
    /// The greatest share of its length that a hair may lack, each hair its own [CC 5.1.2].
    /// Default 0.15.
    pub shorter: f64,
    /// Period skipping [CC 3.4]. Default none.
    pub skip: Skip,
    /// Guides with fewer turns than the first number are duplicated at each root, those with more
    /// than the second make wisps; between them hairs go over from one to the other
    /// [CC 5.1.3]. Default 1 to 3.
    pub fade: (f64, f64),
    /// Turns over which a loose hair's coil opens, from the root on. Default 0.5.
    pub opening: f64,
    /// Turns over which a loose hair's coil becomes the guide's. Default 1.
    pub locking: f64,
    /// How wide the loose coils are.
    pub coils: CoilScale,
}

/// Which turns a hair leaves out, [CC 3.4].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Skip {
    /// How likely each is left out: `rho`.
    pub probability: f64,
    /// Each of what.
    pub each: SkipUnit,
}

/// What period skipping leaves out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum SkipUnit {
    /// Points of the guide, each by itself, as published: turns are cut short.
    #[default]
    Points,
    /// Whole turns: what [CC Fig. 5] shows, a hair that leaves the coil and comes back a turn on.
    Turns,
}

/// How wide the coils of a library are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum CoilScale {
    /// The library's mean radius becomes the guide's; wavelengths go with it.
    #[default]
    Guide,
    /// As they are: library and groom are in the same unit.
    Own,
}

impl Default for GrowOptions {
    fn default() -> Self {
        Self {
            assignment: Assignment::NoisyByDistance(3),
            loose: (0.1, 0.4),
            wisp: Curve::new(vec![(0.0, 0.6), (1.0, 0.35)]).unwrap_or(Curve::constant(0.5)),
            shorter: 0.15,
            skip: Skip::default(),
            fade: (1.0, 3.0),
            opening: 0.5,
            locking: 1.0,
            coils: CoilScale::Guide,
        }
    }
}

/// An option that is out of its range.
///
/// ```
/// # use tress_grow::GrowOptions;
/// let backwards = GrowOptions { loose: (0.5, 0.2), ..GrowOptions::default() };
/// let error = backwards.validate().unwrap_err();
/// assert_eq!(error.to_string(), "loose is (0.5, 0.2), not a range within 0 to 1");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{option} is {value}, not {expected}")]
pub struct GrowOptionsError {
    /// Which option.
    pub option: &'static str,
    /// What it is.
    pub value: String,
    /// What it should be.
    pub expected: &'static str,
}

impl GrowOptions {
    /// Checks that every option is in its range.
    ///
    /// # Errors
    ///
    /// If one is not.
    pub fn validate(&self) -> Result<(), GrowOptionsError> {
        let share = |x: f64| (0.0..=1.0).contains(&x);
        let turns = |x: f64| 0.0 <= x && x.is_finite();
        let (loose, fade) = (self.loose, self.fade);
        let wisp = self.wisp.knots().iter().all(|knot| 0.0 <= knot.1);
        let checks = [
            (
                share(loose.0) && share(loose.1) && loose.0 <= loose.1,
                ("loose", format!("{loose:?}"), "a range within 0 to 1"),
            ),
            (wisp, ("wisp", format!("{:?}", self.wisp.knots()), "a curve of values of 0 or more")),
            (share(self.shorter), ("shorter", self.shorter.to_string(), "a share of 0 to 1")),
            (
                share(self.skip.probability),
                ("skip.probability", self.skip.probability.to_string(), "a share of 0 to 1"),
            ),
            (
                turns(fade.0) && turns(fade.1) && fade.0 <= fade.1,
                ("fade", format!("{fade:?}"), "a range of turns of 0 or more"),
            ),
            (turns(self.opening), ("opening", self.opening.to_string(), "turns of 0 or more")),
            (turns(self.locking), ("locking", self.locking.to_string(), "turns of 0 or more")),
        ];
        match checks.into_iter().find(|(sound, _)| !sound) {
            Some((_, (option, value, expected))) => {
                Err(GrowOptionsError { option, value, expected })
            }
            None => Ok(()),
        }
    }
}
