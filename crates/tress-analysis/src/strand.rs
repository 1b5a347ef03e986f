//! Measures of one strand.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};
use tress_geometry::SuperHelix;

use crate::spectrum::frizz;
use crate::winding::{FLAT, Spectra, Stations};
use crate::{FLATTEST, Winding, switchbacks};

/// Which way a strand winds, root to tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Hand {
    /// Like a common screw: twist is positive.
    Right,
    /// The mirror image: twist is negative.
    Left,
    /// It hardly turns, or winds as much one way as the other, or waves in a plane.
    Neither,
}

/// What is measured on one strand. Lengths are in the groom's unit.
///
/// A strand *winds* where it goes round its centerline, see [`Winding`]; medians are over the
/// turns, so that straight stretches have no say in them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrandMeasures {
    /// Arc length.
    pub length: f64,
    /// Distance from root to tip.
    pub reach: f64,
    /// Turns about the centerline, whichever way; 0 for a strand that hardly goes round once.
    pub turns: f64,
    /// Median coil radius; `None` where there is no coil.
    pub coil_radius: Option<f64>,
    /// Median advance along the centerline in one turn, without its sign.
    pub pitch: Option<f64>,
    /// Median turns a unit of centerline: `|omega| / 2 pi` of [CSE 12].
    pub frequency: Option<f64>,
    /// Mean over the turns of the circularity without its sign: near 1 for coils, near 0 for planar
    /// waves, 0 for straight hair.
    pub circularity: f64,
    /// Mean over the turns of the roundness, see [`Winding::roundness`]: near 0 for planar waves;
    /// near 1 for coils, also for those that skip periods or are cut short.
    pub roundness: f64,
    /// Which way it winds.
    pub hand: Hand,
    /// Turns to the right less turns to the left, over all turns: -1 (all left) to 1 (all right);
    /// planar waves count as 0.
    pub hand_balance: f64,
    /// Changes of hand, see [`switchbacks`].
    pub switchbacks: usize,
    /// How much of the direction's variance is finer than the coil: the share of the tangent's
    /// power beyond 2.5 times its frequency. 0 for an exact helix and for straight hair.
    pub frizz: f64,
}

/// Below this balance a strand has no hand: one that changes hand at its middle, or a wave.
const LEAST_BALANCE: f64 = 0.2;

/// Measures one strand.
///
/// ```
/// use tress_analysis::{Hand, measure};
/// use tress_geometry::{Element, Frame, SuperHelix};
///
/// let coil = Element { length: 20.0, ..Element::coil(0.5, 0.3) };
/// let strand = SuperHelix { root: Frame::IDENTITY, elements: &[coil] };
/// let measures = measure(&strand);
/// assert_eq!(measures.hand, Hand::Right);
/// assert!((measures.coil_radius.expect("many turns") - 0.5).abs() < 5e-4);
/// assert!((measures.turns - 20.0 / (std::f64::consts::PI).hypot(0.3)).abs() < 0.01);
/// ```
#[must_use]
pub fn measure(strand: &SuperHelix<'_>) -> StrandMeasures {
    let (length, reach) = (strand.length(), strand.tip().position.distance(strand.root.position));
    let mut spectra = Spectra::default();
    let stations = Stations::of(strand);
    let winding = stations.as_ref().and_then(|s| Winding::with(s, &mut spectra));
    let Some((stations, winding)) = stations.zip(winding) else {
        return StrandMeasures::straight(length, reach);
    };
    let (power, _) = stations.tangent_power(&mut spectra);
    StrandMeasures::of(&stations, &winding, power)
}

impl StrandMeasures {
    /// Of a strand that does not wind.
    pub(crate) fn straight(length: f64, reach: f64) -> Self {
        Self {
            length,
            reach,
            turns: 0.0,
            coil_radius: None,
            pitch: None,
            frequency: None,
            circularity: 0.0,
            roundness: 0.0,
            hand: Hand::Neither,
            hand_balance: 0.0,
            switchbacks: 0,
            frizz: 0.0,
        }
    }

    /// Of one that does; `power` is that of its tangent at whole cycles.
    pub(crate) fn of(stations: &Stations, winding: &Winding, power: &[f64]) -> Self {
        let turns = winding.turns();
        let hand_balance = winding.mean(|k| winding.circularity[k]);
        let hand = match hand_balance {
            balance if LEAST_BALANCE <= balance => Hand::Right,
            balance if balance <= -LEAST_BALANCE => Hand::Left,
            _ => Hand::Neither,
        };
        let pitch = |k: usize| TAU * winding.advance[k] / winding.rate[k];
        let frequency = |k: usize| winding.rate[k] / (TAU * winding.advance[k].max(FLATTEST));
        let [root, .., tip] = stations.positions[..] else {
            return Self::straight(stations.length(), 0.0);
        };
        Self {
            length: stations.length(),
            reach: root.distance(tip),
            turns,
            coil_radius: median_by_turns(winding, |k| winding.radius[k]),
            pitch: median_by_turns(winding, pitch),
            frequency: median_by_turns(winding, frequency),
            circularity: winding.mean(|k| winding.circularity[k].abs()),
            roundness: winding.mean(|k| winding.roundness[k]),
            hand,
            hand_balance,
            switchbacks: switchbacks(winding, 0).len(),
            frizz: frizz(power, turns),
        }
    }

    /// Arc length over the distance from root to tip: 1 for straight hair; infinite for a closed
    /// curve.
    #[must_use]
    pub fn curl_index(&self) -> f64 {
        if self.length == 0.0 { 1.0 } else { self.length / self.reach }
    }

    /// Whether it winds like a wave in a plane rather than like a coil.
    #[must_use]
    pub fn is_wave(&self) -> bool {
        self.coil_radius.is_some() && self.roundness < FLAT
    }
}

/// Of so many stations a median takes one: values hardly change between them.
const THINNED: usize = 4;

/// The value that half of the turning is done at or below; `None` where nothing winds.
fn median_by_turns(winding: &Winding, value: impl Fn(usize) -> f64) -> Option<f64> {
    let turning = (0..winding.rate.len()).step_by(THINNED).filter(|&k| 0.0 < winding.rate[k]);
    let mut values: Vec<(f64, f64)> = turning.map(|k| (value(k), winding.rate[k])).collect();
    values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * values.iter().map(|&(_, rate)| rate).sum::<f64>();
    let mut below = 0.0;
    values.into_iter().find_map(|(value, rate)| {
        below += rate;
        (half <= below).then_some(value)
    })
}

#[cfg(test)]
mod tests;
