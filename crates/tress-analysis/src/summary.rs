//! A groom in a few numbers.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::HelixGroom;

use crate::{Hand, Quantiles, StrandMeasures, measure};

/// Distributions over the strands of a groom; strands that are no curves are counted, not measured.
///
/// Coil diameter (twice the radius), turns a length and curl index (length over reach) are what the
/// classifications of curl by measurement go by (Loussouarn et al., "Worldwide diversity of hair
/// curliness: a new method of assessment", International Journal of Dermatology 2007).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroomSummary {
    /// All strands.
    pub strands: usize,
    /// Strands that are curves, on which the rest is measured.
    pub measured: usize,
    /// Arc length, in the groom's unit.
    pub length: Option<Quantiles>,
    /// Arc length over the distance from root to tip.
    pub curl_index: Option<Quantiles>,
    /// Turns from root to tip.
    pub turns: Option<Quantiles>,
    /// Turns a unit of arc length, of the strands that coil or wave, as are all below.
    pub turns_per_length: Option<Quantiles>,
    /// Coil radius in the groom's unit.
    pub coil_radius: Option<Quantiles>,
    /// Advance along the centerline in one turn, in the groom's unit.
    pub pitch: Option<Quantiles>,
    /// Turns a unit of centerline.
    pub frequency: Option<Quantiles>,
    /// Near 1 for coils that wind one way, near 0 for planar waves.
    pub circularity: Option<Quantiles>,
    /// Near 1 for coils, near 0 for planar waves, whichever way they wind.
    pub roundness: Option<Quantiles>,
    /// Share of the direction's variance finer than the coil.
    pub frizz: Option<Quantiles>,
    /// Strands that coil or wave.
    pub coiled: usize,
    /// Among them those that wave in a plane rather than coil.
    pub waves: usize,
    /// Strands that wind to the right.
    pub right_handed: usize,
    /// Strands that wind to the left.
    pub left_handed: usize,
    /// Changes of hand, on all strands together.
    pub switchbacks: usize,
}

impl GroomSummary {
    /// Summarizes strands; `None` stands for one that is no curve.
    #[must_use]
    pub fn of(strands: &[Option<StrandMeasures>]) -> Self {
        let measured: Vec<&StrandMeasures> = strands.iter().flatten().collect();
        let coiled: Vec<&StrandMeasures> =
            measured.iter().filter(|m| m.coil_radius.is_some()).copied().collect();
        let hands = |hand| measured.iter().filter(|m| m.hand == hand).count();
        let over = |of: &[&StrandMeasures], value: fn(&StrandMeasures) -> Option<f64>| {
            Quantiles::of(of.iter().filter_map(|m| value(m)))
        };
        Self {
            strands: strands.len(),
            measured: measured.len(),
            length: over(&measured, |m| Some(m.length)),
            curl_index: over(&measured, |m| Some(m.curl_index())),
            turns: over(&measured, |m| Some(m.turns)),
            turns_per_length: over(&coiled, |m| Some(m.turns / m.length)),
            coil_radius: over(&coiled, |m| m.coil_radius),
            pitch: over(&coiled, |m| m.pitch),
            frequency: over(&coiled, |m| m.frequency),
            circularity: over(&coiled, |m| Some(m.circularity)),
            roundness: over(&coiled, |m| Some(m.roundness)),
            frizz: over(&coiled, |m| Some(m.frizz)),
            coiled: coiled.len(),
            waves: coiled.iter().filter(|m| m.is_wave()).count(),
            right_handed: hands(Hand::Right),
            left_handed: hands(Hand::Left),
            switchbacks: measured.iter().map(|m| m.switchbacks).sum(),
        }
    }
}

/// Measures every strand and summarizes.
#[must_use]
pub fn summarize(groom: &HelixGroom) -> GroomSummary {
    let measures: Vec<Option<StrandMeasures>> = (0..groom.len())
        .into_par_iter()
        .map(|i| groom.kept_polyline(i).is_none().then(|| measure(&groom.strand(i))))
        .collect();
    GroomSummary::of(&measures)
}
