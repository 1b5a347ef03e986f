//! When the samples of an animated file are taken.

use serde::{Deserialize, Serialize};

/// Frames at an even rate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Frames {
    /// The number of the first frame. Default 1.
    pub start: f64,
    /// Frames a second. Default 24.
    pub rate: f64,
}

impl Default for Frames {
    fn default() -> Self {
        Self { start: 1.0, rate: 24.0 }
    }
}
