//! A groom and all that is known of it.

use std::path::Path;

use tress::analysis::{
    Analysis, Defects, GroomSummary, Quantiles, Quantity, StrandMeasures, Wisps, defects,
};
use tress::geometry::Groom;

use crate::args::Everywhere;
use crate::commands::convert::in_space;
use crate::failure::Failure;
use crate::options::SpaceArgs;
use crate::progress::Progress;
use crate::source;

use super::units::{Shown, Units};

/// A groom and all that is known of it.
pub(crate) struct Study {
    pub(crate) groom: Groom,
    pub(crate) analysis: Analysis,
    pub(crate) summary: GroomSummary,
    pub(crate) wisps: Wisps,
    pub(crate) defects: Defects,
    pub(crate) units: Units,
}

impl Study {
    /// Reads and analyses a groom; super-helices are sampled first.
    pub(crate) fn read(
        input: &Path,
        space: &SpaceArgs,
        everywhere: &Everywhere,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let groom = source::polylines(input, progress)?;
        let groom = in_space(source::share(groom, everywhere), space);
        progress.stage("analysing");
        let analysis = Analysis::of(&groom);
        Ok(Self {
            summary: analysis.summary(),
            wisps: Wisps::of(&groom, &analysis),
            defects: defects(&groom),
            units: Units::new(groom.unit),
            groom,
            analysis,
        })
    }

    /// The share of the strands' lengths that runs together with another.
    pub(crate) fn locked(&self) -> Option<Quantiles> {
        Quantiles::of(self.wisps.locked.iter().copied())
    }

    /// What a quantity is shown in.
    pub(crate) fn shown(&self, of: Quantity) -> Shown {
        match of {
            Quantity::Radius | Quantity::Pitch => self.units.coil(),
            Quantity::Length => self.units.strand(),
            Quantity::Curvature | Quantity::Twist => self.units.per_length(""),
            Quantity::Frequency => self.units.per_length("turns"),
            Quantity::Turns | Quantity::Handedness | Quantity::Beta | Quantity::BetaFourier => {
                Units::none()
            }
        }
    }

    /// One number a strand, for those that have it.
    pub(crate) fn over_strands(&self, value: fn(&StrandMeasures) -> Option<f64>) -> Vec<f64> {
        self.analysis.strands.iter().flatten().filter_map(value).collect()
    }
}
