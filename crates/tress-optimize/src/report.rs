//! What a solver says when it is done, of a strand and of a groom.

use std::collections::BTreeMap;

/// The energy of [CSE 15] in its two terms, both in length^2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// `sum_k w_k |S(lambda_k) - a_k|^2`, to the anchors within reach.
    pub anchors: f64,
    /// `c |q - q0|^2`, weighted.
    pub bending: f64,
}

impl Energy {
    /// Both terms together.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.anchors + self.bending
    }
}

/// Why a solver stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stop {
    /// The gradient is as small as was asked for.
    Converged,
    /// The gradient is as small as was asked for, and so is that of the anchors' term alone while
    /// an anchor is still away: to first order no change of curvature brings any point nearer to
    /// its anchor. So it is with a straight strand that is pushed along itself, and with anchors
    /// that are too far from each other.
    LocalMinimum,
    /// No step lowers the energy any more, within rounding.
    NoDescent,
    /// As many iterations as were allowed.
    MaxIterations,
    /// Adam: the energy is below the residual it stops at.
    Residual,
    /// Adam: its patience ran out.
    NoImprovement,
}

/// What became of one strand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Where it started.
    pub start: Energy,
    /// Where it ended.
    pub end: Energy,
    /// Evaluations of the energy.
    pub iterations: u32,
    /// Why it stopped.
    pub stop: Stop,
    /// Length of the gradient at the end, in parts of that at the start.
    pub gradient: f64,
    /// Greatest distance of a control of positive weight to the anchor that was asked for; in
    /// length.
    pub anchor_distance: f64,
    /// Anchors that no shape of the strand reaches, because they are farther from the root than
    /// the control's arc length; the strand was stretched towards them.
    pub unreachable: u32,
}

impl Report {
    /// Of a strand without controls.
    pub(crate) const UNTOUCHED: Self = Self {
        start: Energy { anchors: 0.0, bending: 0.0 },
        end: Energy { anchors: 0.0, bending: 0.0 },
        iterations: 0,
        stop: Stop::Converged,
        gradient: 0.0,
        anchor_distance: 0.0,
        unreachable: 0,
    };
}

/// What became of a groom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sculpted {
    /// By strand; none for strands that were not touched.
    pub reports: Vec<Option<Report>>,
    /// Strands without controls.
    pub free: usize,
    /// Strands with controls that are kept as polylines or have no elements.
    pub kept: usize,
    /// Strands with controls that are not finite.
    pub not_finite: usize,
}

/// The reports of a groom's strands, taken together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// Strands that were sculpted.
    pub strands: usize,
    /// Sums of their energies at the start and at the end.
    pub start: Energy,
    /// See `start`.
    pub end: Energy,
    /// Sum and greatest of their iterations.
    pub iterations: (u64, u32),
    /// How many stopped for which reason.
    pub stops: BTreeMap<Stop, usize>,
    /// Greatest distance of a control to its anchor, and the strand where it is; in length.
    pub worst: Option<(usize, f64)>,
    /// Anchors out of reach.
    pub unreachable: usize,
}

impl Sculpted {
    /// All reports taken together.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let mut all = Summary::default();
        for (strand, report) in self.reports.iter().enumerate() {
            let Some(report) = report else { continue };
            all.strands += 1;
            for (sum, energy) in [(&mut all.start, report.start), (&mut all.end, report.end)] {
                sum.anchors += energy.anchors;
                sum.bending += energy.bending;
            }
            let (sum, greatest) = all.iterations;
            let iterations = report.iterations;
            all.iterations = (sum + u64::from(iterations), greatest.max(iterations));
            *all.stops.entry(report.stop).or_default() += 1;
            if all.worst.is_none_or(|(_, distance)| distance < report.anchor_distance) {
                all.worst = Some((strand, report.anchor_distance));
            }
            all.unreachable += report.unreachable as usize;
        }
        all
    }
}
