//! The stages of a fit and what is told and kept of their steps.

use serde::{Deserialize, Serialize};

/// What comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Stage {
    /// Clusters, smoothing, operator guides and instancing weights.
    Initialize,
    /// Guides refined.
    Guides,
    /// Parameters of the operators.
    Parameters,
    /// Random numbers of single strands.
    Numbers,
    /// Nothing.
    Done,
}

impl Stage {
    /// In words.
    #[must_use]
    pub fn describe(self) -> &'static str {
        match self {
            Self::Initialize => "finding guides",
            Self::Guides => "refining guides",
            Self::Parameters => "finding parameters",
            Self::Numbers => "refining random numbers",
            Self::Done => "done",
        }
    }
}

/// The loss after one step of a stage, and the parameters of all operators.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// The stage; losses of different stages do not compare.
    pub stage: Stage,
    /// The loss.
    pub loss: f64,
    /// Values of each operator's [parameters](crate::Operator::parameters).
    pub parameters: Vec<Vec<f64>>,
}

/// What is told while a fit runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The stage at work.
    pub stage: Stage,
    /// The loss now.
    pub loss: f64,
    /// How much of the stage's steps is done, 0 to 1.
    pub done: f64,
}
