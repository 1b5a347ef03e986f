//! Skip: strands that leave turns of their coil out, [CC 3.4]. An operator of tress's own.
//!
//! [`tress_grow::skip_periods`] draws what is left out and joins what stays by a spline, so that a
//! strand leaves its coil and comes back to it farther on. It becomes shorter by that; where its
//! length is to stay, every segment takes the direction of the spline's and keeps its own length.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_edit::strand_rng;
use tress_fit::centerline;
use tress_grow::{SkipScratch, SkipUnit, skip_periods};

use crate::EvenStrands;

/// Turns left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Skip {
    /// How likely each is left out, 0 to 1. Default 0.
    pub probability: f64,
    /// Each of what. Default whole turns.
    pub each: SkipUnit,
    /// What stays. Default the coil.
    pub keep: SkipKeep,
}

/// What stays when a strand leaves turns out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum SkipKeep {
    /// The coil: a strand comes back to it and ends where it ended, shorter than it was.
    #[default]
    Coil,
    /// The length of every segment: a strand winds on farther along, and hangs lower.
    Length,
}

impl Default for Skip {
    fn default() -> Self {
        Self { probability: 0.0, each: SkipUnit::Turns, keep: SkipKeep::default() }
    }
}

impl Skip {
    /// Lets every strand leave out what it draws from its own stream of numbers.
    pub(super) fn apply(&self, strands: &mut EvenStrands, seed: u64) {
        let m = strands.points_each();
        strands.points_mut().par_chunks_mut(m).enumerate().for_each_init(
            SkipScratch::default,
            |scratch, (i, strand)| {
                self.apply_to_strand(strand, seed, i, scratch);
            },
        );
    }

    fn apply_to_strand(
        &self,
        strand: &mut [DVec3],
        seed: u64,
        i: usize,
        scratch: &mut SkipScratch,
    ) {
        // A strand without a turn has none to leave out.
        let turns = centerline(strand).map_or(0.0, |line| line.turns());
        if turns < 1.0 {
            return;
        }
        let skip = tress_grow::Skip { probability: self.probability, each: self.each };
        let per_turn = (strand.len() - 1) as f64 / turns;
        let lengths: Vec<f64> = strand.windows(2).map(|e| e[0].distance(e[1])).collect();
        skip_periods(strand, &skip, per_turn.max(1.0), &mut strand_rng(seed, i), scratch);
        if self.keep == SkipKeep::Length {
            stretch(strand, &lengths);
        }
    }
}

/// Gives every segment a length, keeping its direction; one that has none goes on as the one
/// before it.
fn stretch(strand: &mut [DVec3], lengths: &[f64]) {
    let mut before = strand[0];
    let mut direction = DVec3::ZERO;
    for (j, length) in lengths.iter().enumerate() {
        let e = strand[j + 1] - before;
        direction = e.try_normalize().unwrap_or(direction);
        before = strand[j + 1];
        strand[j + 1] = strand[j] + *length * direction;
    }
}
