//! Spectra: how much of the hair's direction varies how fast along it.
//!
//! The power of a strand's unit tangent by spatial frequency, in cycles (turns) a unit of arc
//! length: bends and sway at the low end, the coil as a peak, frizz as what lies beyond. Taken from
//! the smooth curve at even stations, it does not depend on the sampling up to the coarsest one's
//! own limit.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use glam::DVec3;
use serde::Serialize;

use crate::winding::{Spectra, Stations};

/// Power by frequency on a logarithmic grid that is the same for all grooms.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Spectrum {
    /// Power by bin, strand lengths times mean squares; the bins hold a twelfth of an octave each.
    bins: BTreeMap<i32, f64>,
}

/// Bins an octave.
const BINS: f64 = 12.0;

/// Beyond so many times the coil's frequency, power is frizz.
const FRIZZ_BEYOND: f64 = 2.5;

impl Spectrum {
    /// Frequencies (in turns a unit of arc length) at the middles of the bins, and the share of the
    /// power a bin, from the lowest frequency that there is to the highest; none without power.
    #[must_use]
    pub fn shares(&self) -> Vec<(f64, f64)> {
        let total: f64 = self.bins.values().sum();
        let ends = self.bins.keys().next().zip(self.bins.keys().next_back());
        let Some((&first, &last)) = ends.filter(|_| 0.0 < total) else { return vec![] };
        let share = |bin: i32| self.bins.get(&bin).map_or(0.0, |power| power / total);
        (first..=last).map(|bin| (((f64::from(bin) + 0.5) / BINS).exp2(), share(bin))).collect()
    }

    /// Adds the power of a strand at whole numbers of cycles over its length.
    pub(crate) fn add(&mut self, power: &[f64], length: f64) {
        let shift = BINS * length.log2();
        // The bin under way: lines ascend, and most bins hold many of them.
        let mut under_way = (0, 0.0);
        // The mean bend of a strand, its zeroth cycle, is no variation.
        for (k, power) in power.iter().enumerate().skip(1) {
            if *power == 0.0 {
                continue;
            }
            // A line of the transform stands for the band up to its neighbours.
            let [low, high] = [k - 1, k].map(|below| middle(below) - shift);
            #[expect(clippy::cast_possible_truncation, reason = "`as` saturates")]
            let (first, last) = (low.floor() as i32, high.floor() as i32);
            for bin in first..=last {
                let from = low.max(f64::from(bin));
                let to = high.min(f64::from(bin) + 1.0);
                let share = ((to - from) / (high - low)).max(0.0);
                if bin != under_way.0 {
                    self.add_to(under_way);
                    under_way = (bin, 0.0);
                }
                under_way.1 += power * share * length;
            }
        }
        self.add_to(under_way);
    }

    fn add_to(&mut self, (bin, power): (i32, f64)) {
        if 0.0 < power {
            *self.bins.entry(bin).or_insert(0.0) += power;
        }
    }

    /// Adds another spectrum.
    pub(crate) fn append(&mut self, other: &Self) {
        for (bin, power) in &other.bins {
            *self.bins.entry(*bin).or_insert(0.0) += power;
        }
    }
}

/// The middle between a line of a transform and the next, as a bin of lines a unit.
fn middle(line: usize) -> f64 {
    /// More than half as many as a strand has stations.
    const LINES: usize = 2049;
    static MIDDLES: LazyLock<Vec<f64>> =
        LazyLock::new(|| (0..LINES).map(|k| BINS * (k as f64 + 0.5).log2()).collect());
    MIDDLES.get(line).copied().unwrap_or_else(|| BINS * (line as f64 + 0.5).log2())
}

impl Stations {
    /// Power of the unit tangent less its mean at whole numbers of cycles, and the length.
    pub(crate) fn tangent_power<'a>(&self, spectra: &'a mut Spectra) -> (&'a [f64], f64) {
        let steps = self.positions.windows(2).map(|p| (p[1] - p[0]) / self.spacing);
        let mut tangents: Vec<DVec3> = steps.collect();
        let mean = tangents.iter().sum::<DVec3>() / tangents.len() as f64;
        for tangent in &mut tangents {
            *tangent -= mean;
        }
        (spectra.power(&tangents), self.length())
    }
}

/// The share of the power beyond the coil's band.
pub(crate) fn frizz(power: &[f64], turns: f64) -> f64 {
    let beyond = |k: usize| FRIZZ_BEYOND * turns < k as f64;
    let (mut all, mut frizz) = (0.0, 0.0);
    for (k, power) in power.iter().enumerate().skip(1) {
        all += power;
        frizz += if beyond(k) { *power } else { 0.0 };
    }
    if 0.0 < all { frizz / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn coil(turns: u32, per_turn: u32) -> Stations {
        let n = turns * per_turn;
        let point = |i: u32| {
            let a = TAU * f64::from(i) / f64::from(per_turn);
            DVec3::new(a.cos(), a.sin(), 0.2 * a)
        };
        Stations::through(&(0..=n).map(point).collect::<Vec<_>>()).expect("a strand").0
    }

    #[test]
    fn a_coil_is_a_peak_at_its_frequency_whatever_its_sampling() {
        let per_length = 1.0 / (TAU * 1.0_f64.hypot(0.2));
        for per_turn in [8, 16, 32] {
            let mut spectrum = Spectrum::default();
            let mut spectra = Spectra::default();
            let coil = coil(24, per_turn);
            let (power, length) = coil.tangent_power(&mut spectra);
            spectrum.add(power, length);
            assert!(frizz(power, 24.0) < 1e-3, "{}", frizz(power, 24.0));
            let shares = spectrum.shares();
            let peak = shares.iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("power");
            assert!((peak.0 / per_length).log2().abs() < 1.5 / BINS, "{peak:?} {per_length}");
            assert!((shares.iter().map(|s| s.1).sum::<f64>() - 1.0).abs() < 1e-12);
        }
        assert_eq!(Spectrum::default().shares(), []);
    }
}
