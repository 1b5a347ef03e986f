//! How a groom is fitted.

use serde::{Deserialize, Serialize};

use super::{FlawOptions, GuideOptions, NumberOptions, ParameterOptions, Smoothing};

/// How a groom is fitted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StageOptions {
    /// Guides. Default 500.
    pub guides: usize,
    /// Operator guides, the number of curls or clumps. Default as many as guides.
    pub operator_guides: Option<usize>,
    /// Points a strand. Default the greatest number the targets have, from 16 to 160.
    pub points: Option<usize>,
    /// Guides a strand is blended from. Default 8.
    pub neighbors: usize,
    /// Whether a strand's guides are weighted as brings it nearest its target, as suits captured
    /// hair, or by the distance of roots, as grooms made by hand are. Default yes. Weights of a
    /// strand's own take up some of what scale and clump would explain.
    pub own_weights: bool,
    /// Weight of the root against the strand in clusters. Default 8: clusters are patches of scalp
    /// whose means even out what operators do; 1 gathers strands that look alike from farther off.
    pub root_weight: f64,
    /// How cluster means become guides.
    pub smoothing: Smoothing,
    /// How guides are refined.
    pub guide: GuideOptions,
    /// How the operators' parameters are found.
    pub parameters: ParameterOptions,
    /// How often guides and parameters are found again, each with what the other came to. Default
    /// 0. Strands that clump and bend are in the mean not where their guides are, and how far off
    /// is known when the operators are; on the known grooms the noise of it outweighed the gain.
    pub alternations: usize,
    /// How random numbers are refined.
    pub numbers: NumberOptions,
    /// Which strands are left out.
    pub flaws: FlawOptions,
    /// Seed of clusters, slices and random numbers. Default 0.
    pub seed: u64,
}

impl Default for StageOptions {
    fn default() -> Self {
        Self {
            guides: 500,
            operator_guides: None,
            points: None,
            neighbors: 8,
            own_weights: true,
            root_weight: 8.0,
            smoothing: Smoothing::default(),
            guide: GuideOptions::default(),
            parameters: ParameterOptions::default(),
            alternations: 0,
            numbers: NumberOptions::default(),
            flaws: FlawOptions::default(),
            seed: 0,
        }
    }
}
