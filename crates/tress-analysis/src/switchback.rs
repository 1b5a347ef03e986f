//! Switchbacks: where a strand changes the hand that it winds with.
//!
//! A switchback (a perversion of the helix, as in a telephone cord or a tendril) joins a coil of
//! one hand to a coil of the other. In the circularity of the [`Winding`] it is a fall from near 1
//! to near -1, or back. A planar wave stays near 0, and a strand that skips a period or is straight
//! for a while comes back with the hand it had: neither passes for a switchback, because both
//! sides must wind, for [`LEAST_TURNS`] each, with a circularity of [`LEAST_CIRCULARITY`] in the
//! mean.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::{Hand, Winding};

/// A change of hand along a strand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Switchback {
    /// Which strand of the groom.
    pub strand: usize,
    /// Arc length from the root.
    pub arc_length: f64,
    /// The hand on the side of the root.
    pub before: Hand,
    /// The hand on the side of the tip.
    pub behind: Hand,
    /// How coil-like the less coil-like side is, 0.5 to 1: its mean circularity over the turns
    /// next to the switchback.
    pub confidence: f64,
}

/// Turns that each side must wind with its hand.
const LEAST_TURNS: f64 = 0.75;

/// Mean circularity that each side must have.
const LEAST_CIRCULARITY: f64 = 0.5;

/// Turns on each side that are looked at.
const SEEN_TURNS: f64 = 1.5;

/// The turns about a change that belong to it and to neither side: the moments are those of a
/// turn, half of it on each side.
const BLURRED_TURNS: f64 = 0.35;

/// A stretch of one sign of circularity.
struct Stretch {
    first: usize,
    end: usize,
    hand: f64,
}

/// The switchbacks of a strand, from root to tip.
#[must_use]
pub fn switchbacks(winding: &Winding, strand: usize) -> Vec<Switchback> {
    let mut stretches: Vec<Stretch> = Vec::new();
    for stretch in signed_stretches(winding) {
        if strength(winding, &stretch).is_none() {
            continue;
        }
        match stretches.last_mut() {
            Some(last) if last.hand * stretch.hand > 0.0 => last.end = stretch.end,
            _ => stretches.push(stretch),
        }
    }
    let found = stretches.windows(2).filter_map(|pair| {
        let (a, b) = (side(winding, &pair[0], true)?, side(winding, &pair[1], false)?);
        let hand = |sign: f64| if 0.0 < sign { Hand::Right } else { Hand::Left };
        Some(Switchback {
            strand,
            arc_length: crossing(winding, pair[0].end, pair[1].first),
            before: hand(pair[0].hand),
            behind: hand(pair[1].hand),
            confidence: a.min(b),
        })
    });
    found.collect()
}

/// Where circularity changes sign, between the last station of one stretch and the first of the
/// next.
fn crossing(winding: &Winding, end: usize, first: usize) -> f64 {
    if first == end {
        let (a, b) = (winding.circularity[end - 1], winding.circularity[end]);
        return winding.spacing * ((end - 1) as f64 + a / (a - b));
    }
    winding.spacing * 0.5 * ((end - 1) as f64 + first as f64)
}

fn signed_stretches(winding: &Winding) -> Vec<Stretch> {
    let mut stretches: Vec<Stretch> = Vec::new();
    for (k, &c) in winding.circularity.iter().enumerate() {
        match stretches.last_mut() {
            Some(last) if last.end == k && 0.0 < last.hand * c => last.end = k + 1,
            _ if c == 0.0 => {}
            _ => stretches.push(Stretch { first: k, end: k + 1, hand: c.signum() }),
        }
    }
    stretches
}

/// The mean circularity of a stretch, its greater part; `None` if it winds too little or too flat.
fn strength(winding: &Winding, stretch: &Stretch) -> Option<f64> {
    let (turns, mean) = mean_circularity(winding, stretch.first..stretch.end);
    (LEAST_TURNS <= turns && 0.6 * LEAST_CIRCULARITY <= mean).then_some(mean)
}

/// The mean circularity over the turns of a stretch that are next to its end or beginning.
fn side(winding: &Winding, stretch: &Stretch, at_end: bool) -> Option<f64> {
    let inward = |i: usize| if at_end { stretch.end - 1 - i } else { stretch.first + i };
    let (mut turns, mut seen, mut sum) = (0.0, 0.0, 0.0);
    for k in (0..stretch.end - stretch.first).map(inward) {
        let turn = winding.rate[k] * winding.spacing / TAU;
        turns += turn;
        if SEEN_TURNS < turns {
            break;
        }
        if BLURRED_TURNS <= turns {
            seen += turn;
            sum += turn * winding.circularity[k].abs();
        }
    }
    let mean = if 0.0 < seen { sum / seen } else { 0.0 };
    (LEAST_CIRCULARITY <= mean).then_some(mean)
}

/// Turns of some stations, and their circularity without its sign in the mean over the turns.
fn mean_circularity(winding: &Winding, stations: std::ops::Range<usize>) -> (f64, f64) {
    let (mut turns, mut sum) = (0.0, 0.0);
    for k in stations {
        turns += winding.rate[k];
        sum += winding.rate[k] * winding.circularity[k].abs();
    }
    let mean = if 0.0 < turns { sum / turns } else { 0.0 };
    (turns * winding.spacing / TAU, mean)
}

#[cfg(test)]
mod tests;
