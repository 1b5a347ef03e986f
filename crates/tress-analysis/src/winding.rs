//! How a strand winds about its centerline: turn rate, radius, hand and advance at every place.
//!
//! Curvatures taken element by element are those of the coil, of its frizz and of the fit's
//! response to the sampling at once ([CSE Fig. 4a] shows the beat of the last). What a person calls
//! the coil is how the strand goes round its centerline, and that hardly changes with any of
//! them. With `d = r - c` the offset from the centerline and `<.>` the mean over the turn about a
//! place, two moments at a lag of a quarter turn `h` say it all:
//!
//! `C = <d(s - h/2) . d(s + h/2)>`, `S = <T . d(s - h/2) x d(s + h/2)>`, `E = <|d|^2>`.
//!
//! A coil has `C = R^2 cos(W h)`, `S = +-R^2 sin(W h)`; a wave in a plane has the same `C` over `E`
//! and `S = 0`. So
//!
//! - the turn rate is `W = acos(C / E) / h`, radians of winding a unit of arc length,
//! - the circularity is `S / (E sin(W h))`: 1 for a right-handed coil, -1 for a left-handed one, 0
//!   for a planar wave (of an ellipse with half axes `a`, `b` it is `2 a b / (a^2 + b^2)`).
//!
//! A coil that is cut short at many places, or that changes hand within the turn, has a low
//! circularity as a wave does, but is not flat: its spread `<d d^T>` says so (roundness).
//!
//! Frizz that is rough on the scale of `h` enters `E` alone, and at a quarter turn, where `C` is
//! near 0, it does not move `W`.
//!
//! The centerline is the mean of positions over a turn, taken twice, and once more of what it
//! misses. The turn is first read off the spectrum of the positions, and then off `W`, three times.

mod axis;
mod period;
mod stations;

use std::f64::consts::TAU;

use glam::DVec3;
use tress_geometry::SuperHelix;

use axis::Axis;
pub(crate) use axis::{half_window, turn_means};
pub(crate) use period::Spectra;
pub(crate) use stations::Stations;

/// How a strand winds, at stations evenly spaced along it.
///
/// ```
/// use tress_analysis::Winding;
/// use tress_geometry::{Element, Frame, SuperHelix};
///
/// // Eight turns of a left-handed coil of radius 0.5 and pitch 0.4.
/// let coil = Element::coil(0.5, -0.4);
/// let coil = Element { length: 8.0 * std::f64::consts::TAU / coil.curvature.length(), ..coil };
/// let winding = Winding::of(&SuperHelix { root: Frame::IDENTITY, elements: &[coil] })
///     .expect("it is a coil");
/// assert!((winding.turns() - 8.0).abs() < 0.01);
/// let middle = winding.radius.len() / 2;
/// assert!((winding.radius[middle] - 0.5).abs() < 1e-3);
/// assert!(winding.circularity[middle] < -0.99);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Winding {
    /// Arc length from one station to the next; the first is the root, the last the tip.
    pub spacing: f64,
    /// Radians of winding a unit of arc length; 0 where the strand does not wind.
    pub rate: Vec<f64>,
    /// Distance from the centerline, root mean square over a turn; 0 where it does not wind. The
    /// radius of a coil, and 0.71 of the amplitude of a planar wave.
    pub radius: Vec<f64>,
    /// 1 for a right-handed coil, -1 for a left-handed one, near 0 for a planar wave.
    pub circularity: Vec<f64>,
    /// How round the coil is seen along its centerline, whichever way it winds: `2 a b / (a^2 +
    /// b^2)` of the ellipse with its spread, 1 for a coil, near 0 for a planar wave.
    pub roundness: Vec<f64>,
    /// Length of centerline a unit of arc length, 0 to 1.
    pub advance: Vec<f64>,
    /// The centerline.
    pub center: Vec<DVec3>,
    /// The unit tangent of the centerline.
    pub direction: Vec<DVec3>,
}

/// Bending of the whole strand, in radians, below which there is nothing to look for.
const LEAST_BENDING: f64 = 1.0;

/// A strand that goes round hardly once cannot be told from a bow.
const LEAST_TURNS: f64 = 1.2;

/// A wave in a plane of fewer turns is a bow with ends that curl.
const LEAST_WAVE_TURNS: f64 = 2.0;

/// With fewer turns than this a strand must lean from its centerline by [`PLAIN_SLOPE`] in the
/// mean, or the sag and the bends of straight hair would pass for waves.
const PLAIN_TURNS: f64 = 3.0;

/// The sine of 20 degrees.
const PLAIN_SLOPE: f64 = 0.35;

/// With any number of turns it must lean by this, the sine of 9 degrees: unevenness of straight
/// hair makes many small turns.
const SLIGHT_SLOPE: f64 = 0.15;

/// The tangent leans from the centerline by at least this (a sine), or the strand does not wind
/// there: about five degrees.
const LEAST_SLOPE: f64 = 0.08;

/// Rounder than this, a strand that winds is no wave in a plane: half axes are as 1 to 0.27.
pub(crate) const FLAT: f64 = 0.5;

/// Below this share of the greatest radius, a strand is straight among its own coils.
const LEAST_RADIUS: f64 = 0.15;

impl Winding {
    /// How a super-helix winds; `None` for one that is no more than a bow: that bends too little,
    /// goes round less than 1.2 times (2 times if it is flat), or leans too little from its
    /// centerline.
    #[must_use]
    pub fn of(strand: &SuperHelix<'_>) -> Option<Self> {
        Self::with(&Stations::of(strand)?, &mut Spectra::default())
    }

    /// How the smooth curve through the points of a polyline winds; likewise.
    #[must_use]
    pub fn of_polyline(points: &[DVec3]) -> Option<Self> {
        Self::with(&Stations::through(points)?.0, &mut Spectra::default())
    }

    /// As [`of`](Self::of), with the transforms at hand.
    pub(crate) fn with(stations: &Stations, spectra: &mut Spectra) -> Option<Self> {
        if stations.bending < LEAST_BENDING {
            return None;
        }
        let starts = spectra.dominant_periods(&stations.positions, stations.bending);
        let refined = |start| Self::refined(&stations.positions, stations.spacing, start);
        let windings = starts.into_iter().flatten().map(refined).filter(Self::is_plain);
        windings.reduce(|a, b| if a.bending() < b.bending() { b } else { a })
    }

    /// Whether there are turns enough, and steep enough, to tell it from a bow.
    fn is_plain(&self) -> bool {
        let turns = self.turns();
        let least_slope = if turns < PLAIN_TURNS { PLAIN_SLOPE } else { SLIGHT_SLOPE };
        let bow = turns < LEAST_TURNS
            || self.mean(|k| self.radius[k] * self.rate[k]) < least_slope
            || (turns < LEAST_WAVE_TURNS && self.mean(|k| self.roundness[k]) < FLAT);
        !bow
    }

    /// Radians by which the winding bends the strand: curvature of its coils times length.
    fn bending(&self) -> f64 {
        let curvature = |k: usize| self.radius[k] * self.rate[k] * self.rate[k];
        (0..self.rate.len()).map(curvature).sum::<f64>() * self.spacing
    }

    /// The mean of a value of the stations over the turns; 0 where nothing turns.
    pub(crate) fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        let (mut sum, mut turns) = (0.0, 0.0);
        for (k, rate) in self.rate.iter().enumerate() {
            sum += rate * value(k);
            turns += rate;
        }
        if 0.0 < turns { sum / turns } else { 0.0 }
    }

    /// Turns from root to tip, whichever way.
    #[must_use]
    pub fn turns(&self) -> f64 {
        // The stations at the ends stand for half a space each.
        let ends = 0.5 * (self.rate[0] + self.rate[self.rate.len() - 1]);
        (self.rate.iter().sum::<f64>() - ends) * self.spacing / TAU
    }

    /// The turn about each station, in stations; that of the nearest station that winds where the
    /// strand does not.
    pub(crate) fn periods(&self) -> Vec<f64> {
        let period = |rate: f64| (0.0 < rate).then(|| TAU / (rate * self.spacing));
        let first = self.rate.iter().find_map(|&rate| period(rate));
        let mut last = first.unwrap_or(self.rate.len() as f64);
        let held = self.rate.iter().map(|&rate| {
            last = period(rate).unwrap_or(last);
            last
        });
        held.collect()
    }

    /// Rounds of centerline and turn rate, from a period in stations.
    fn refined(points: &[DVec3], spacing: f64, start: f64) -> Self {
        let mut axis = Axis::first(points, start);
        let mut moments = Moments::new(&axis, 0.125);
        for share in [0.125, 0.25, 0.25] {
            axis = axis.again(points, &moments.periods(start));
            moments = Moments::new(&axis, share);
        }
        Self::assembled(&axis, &moments, points[0], spacing)
    }

    fn assembled(axis: &Axis, moments: &Moments, root: DVec3, spacing: f64) -> Self {
        let range = axis.stations.clone();
        let radius: Vec<f64> = moments.energy[range.clone()].iter().map(|e| e.sqrt()).collect();
        let most = radius.iter().copied().fold(0.0, f64::max);
        let mut winding = Self {
            spacing,
            rate: moments.rate[range.clone()].iter().map(|w| w / spacing).collect(),
            circularity: moments.circularity[range.clone()].to_vec(),
            roundness: axis.roundness(),
            advance: axis.speed[range.clone()].iter().map(|v| (v / spacing).min(1.0)).collect(),
            center: axis.center[range.clone()].iter().map(|c| root + *c).collect(),
            direction: axis.direction[range].to_vec(),
            radius,
        };
        for i in 0..winding.rate.len() {
            let slope = winding.rate[i] * winding.radius[i];
            if slope < LEAST_SLOPE || winding.radius[i] < LEAST_RADIUS * most {
                winding.rate[i] = 0.0;
                winding.radius[i] = 0.0;
                winding.circularity[i] = 0.0;
                winding.roundness[i] = 0.0;
            }
        }
        winding
    }
}

/// The moments of the offset from the centerline, at each station of the extended strand.
struct Moments {
    /// Radians of winding a station.
    rate: Vec<f64>,
    /// Mean square offset.
    energy: Vec<f64>,
    circularity: Vec<f64>,
}

impl Moments {
    /// Moments at a lag of this share of the turn.
    fn new(axis: &Axis, share: f64) -> Self {
        let n = axis.offset.len();
        let half_lag = |k: usize| half_window(share * axis.periods[k]).min(k).min(n - 1 - k);
        let product = |k: usize| {
            let a = half_lag(k);
            let (before, behind) = (axis.offset[k - a], axis.offset[k + a]);
            let energy = 0.5 * (before.length_squared() + behind.length_squared());
            let swept = axis.direction[k].dot(before.cross(behind));
            DVec3::new(energy, before.dot(behind), swept)
        };
        let means = turn_means(&(0..n).map(product).collect::<Vec<_>>(), &axis.periods);
        let mut moments = Self { rate: vec![], energy: vec![], circularity: vec![] };
        for (k, mean) in means.into_iter().enumerate() {
            let (energy, along, swept) = (mean.x, mean.y, mean.z);
            let cosine = if 0.0 < energy { (along / energy).clamp(-1.0, 1.0) } else { 1.0 };
            let lag = 2.0 * half_lag(k) as f64;
            let sine = energy * (1.0 - cosine * cosine).sqrt();
            moments.rate.push(if 0.0 < lag { cosine.acos() / lag } else { 0.0 });
            moments.energy.push(energy);
            moments.circularity.push(if 0.0 < sine {
                (swept / sine).clamp(-1.0, 1.0)
            } else {
                0.0
            });
        }
        moments
    }

    /// The turn about each station, in stations, held to a factor of four about `start`, and
    /// `start` itself where there is too little of a coil to tell.
    fn periods(&self, start: f64) -> Vec<f64> {
        let most = self.energy.iter().copied().fold(0.0, f64::max);
        let period = |(rate, energy): (&f64, &f64)| {
            let told = LEAST_RADIUS * LEAST_RADIUS * most < *energy && 0.0 < *rate;
            if told { (TAU / rate).clamp(start / 4.0, start * 4.0) } else { start }
        };
        self.rate.iter().zip(&self.energy).map(period).collect()
    }
}

#[cfg(test)]
mod tests;
