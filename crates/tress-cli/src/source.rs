//! Reading what a command works on.

use std::path::Path;

use tress::edit::Grouping;
use tress::fit::{FitOptions, FitReport, Sampling};
use tress::geometry::{Groom, HelixGroom};
use tress::io::Model;

use crate::args::Everywhere;
use crate::failure::Failure;
use crate::options::{FitArgs, SamplingArgs};
use crate::progress::Progress;
use crate::report::count;

/// Reads a file of any format.
pub(crate) fn read(path: &Path, progress: &Progress) -> Result<Model, Failure> {
    progress.stage(format!("reading {}", path.display()));
    Ok(tress::io::read(path)?)
}

/// A groom as super-helices, and how many points each strand came with.
pub(crate) struct Curved {
    pub(crate) helices: HelixGroom,
    /// Points of each strand, where the input was polylines.
    pub(crate) counts: Option<Vec<usize>>,
    /// What the fit came to, where there was one.
    pub(crate) fit: Option<FitReport>,
}

impl Curved {
    /// Fits polylines; takes super-helices as they are.
    pub(crate) fn new(
        model: Model,
        options: &FitOptions,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        match model {
            Model::Helices(helices) => Ok(Self { helices, counts: None, fit: None }),
            Model::Polylines(groom) => Self::fit(&groom, options, progress),
        }
    }

    /// Fits polylines.
    pub(crate) fn fit(
        groom: &Groom,
        options: &FitOptions,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let strands = groom.strands().len();
        progress.stage_of(format!("fitting {} strands", count(strands)), strands);
        let fitted = tress::fit::fit_with(groom, options, |more| progress.add(more))?;
        Ok(Self {
            helices: fitted.helices,
            counts: Some(groom.strands().counts().collect()),
            fit: Some(fitted.report),
        })
    }

    /// The group of each strand. In a sequence clusters are those of its first frame, so that no
    /// strand goes over to another.
    pub(crate) fn groups(
        &self,
        grouping: &Grouping,
        input: &Path,
        fit: &FitArgs,
        everywhere: &Everywhere,
        progress: &Progress,
    ) -> Result<Vec<u32>, Failure> {
        let first = match (grouping, everywhere.frame.first(input)) {
            (Grouping::Clusters(_), Some(first)) => {
                Some(Self::new(read(first, progress)?, &fit.options(), progress)?)
            }
            _ => None,
        };
        let helices = first.as_ref().map_or(&self.helices, |first| &first.helices);
        Ok(tress::edit::groups(helices, grouping, everywhere.seed)?)
    }

    /// The share of the strands that was asked for.
    pub(crate) fn share(mut self, everywhere: &Everywhere) -> Self {
        let Some(shard) = everywhere.shard else { return self };
        let range = shard.range(self.helices.len());
        self.helices = self.helices.select(&range.clone().collect::<Vec<_>>());
        self.counts = self.counts.map(|counts| counts[range].to_vec());
        self
    }

    /// Polylines of the super-helices, by default with as many points as came in.
    pub(crate) fn sample(&self, args: &SamplingArgs) -> Result<Groom, Failure> {
        let how = match (args.points, args.spacing, &self.counts) {
            (Some(points), _, _) => Sampling::Points(points),
            (None, Some(spacing), _) => Sampling::Spacing(spacing),
            (None, None, Some(counts)) => Sampling::Counts(counts),
            (None, None, None) => Sampling::PerTurn(POINTS_PER_TURN),
        };
        Ok(tress::fit::sample(&self.helices, &how)?)
    }
}

/// Points a turn where nothing else is known: a polyline of 16 points a turn is 2 % narrower than
/// its coil at worst.
const POINTS_PER_TURN: f64 = 16.0;

/// The share of the strands of polylines that was asked for.
pub(crate) fn share(groom: Groom, everywhere: &Everywhere) -> Groom {
    match everywhere.shard {
        None => groom,
        Some(shard) => groom.select(&shard.range(groom.strands().len()).collect::<Vec<_>>()),
    }
}
