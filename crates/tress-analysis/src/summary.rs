//! A groom in a few numbers.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::HelixGroom;

use crate::{Hand, Quantiles, StrandMeasures, measure};

/// Distributions over the strands of a groom; strands kept as polylines are counted, not measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroomSummary {
    /// All strands.
    pub strands: usize,
    /// Strands that are helices, on which the rest is measured.
    pub measured: usize,
    /// Arc length, in the groom's unit.
    pub length: Option<Quantiles>,
    /// Turns from root to tip.
    pub turns: Option<Quantiles>,
    /// Coil radius in the groom's unit, of the strands that turn at least once.
    pub coil_radius: Option<Quantiles>,
    /// Strands that turn at least once.
    pub coiled: usize,
    /// Strands that wind to the right.
    pub right_handed: usize,
    /// Strands that wind to the left.
    pub left_handed: usize,
}

/// Measures every strand and summarizes.
#[must_use]
pub fn summarize(groom: &HelixGroom) -> GroomSummary {
    let measures: Vec<StrandMeasures> = (0..groom.len())
        .into_par_iter()
        .filter(|&i| groom.kept_polyline(i).is_none())
        .map(|i| measure(&groom.strand(i)))
        .collect();
    let hands = |hand| measures.iter().filter(|m| m.hand == hand).count();
    GroomSummary {
        strands: groom.len(),
        measured: measures.len(),
        length: Quantiles::of(measures.iter().map(|m| m.length)),
        turns: Quantiles::of(measures.iter().map(|m| m.turns)),
        coil_radius: Quantiles::of(measures.iter().filter_map(|m| m.coil_radius)),
        coiled: measures.iter().filter(|m| m.coil_radius.is_some()).count(),
        right_handed: hands(Hand::Right),
        left_handed: hands(Hand::Left),
    }
}
