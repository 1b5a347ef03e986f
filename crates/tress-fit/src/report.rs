//! What a fit came to.

use tress_geometry::polyline::Defect;

use crate::Deviation;

/// Why a strand is kept as a polyline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, thiserror::Error)]
#[error("a strand {}", self.describe())]
pub enum KeptReason {
    /// The polyline has no direction.
    Defect(Defect),
    /// Smaller than 1e-60 or larger than 1e60 units: powers of its curvatures are not numbers.
    Size,
}

impl KeptReason {
    /// The reason, in words that fit behind a count of strands.
    #[must_use]
    pub fn describe(self) -> &'static str {
        match self {
            Self::Defect(defect) => defect.describe(),
            Self::Size => "smaller than 1e-60 or larger than 1e60 units",
        }
    }
}

/// What a fit came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FitReport {
    /// Strands given.
    pub strands: usize,
    /// Elements made.
    pub elements: usize,
    /// Strands kept as polylines, by reason; reasons that did not occur are left out.
    pub kept: Vec<(KeptReason, usize)>,
    /// How far fit and input are apart.
    pub deviation: Deviation,
}
