//! How far two grooms are apart: in place, in length, and in what their coils are like.

mod frechet;
mod nearest;
mod wasserstein;

use rayon::prelude::*;
use serde::Serialize;
use tress_geometry::Groom;
use tress_geometry::polyline::{arc_lengths, defect, length, place};

use crate::{Analysis, StrandMeasures};

pub use frechet::discrete_frechet;
pub use nearest::nearest_distances;
pub use wasserstein::{wasserstein, wasserstein_of_shares};

/// How far two grooms are apart. Lengths are in the grooms' unit, which should be the same.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Strands of each.
    pub strands: [usize; 2],
    /// Points of each.
    pub points: [usize; 2],
    /// From each point of either to the other groom, wherever that is nearest.
    pub nearest: Option<Distances>,
    /// From each strand to the one of the same index, at equal shares of their lengths.
    pub by_index: Option<ByIndex>,
    /// Wasserstein distances (of order 1) of the strands' distributions.
    pub distributions: Distributions,
}

/// Distances in sum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Distances {
    /// Root mean square.
    pub rms: f64,
    /// The mean.
    pub mean: f64,
    /// The greatest.
    pub greatest: f64,
}

/// Strands against those of the same index; of the strands that both grooms have as curves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ByIndex {
    /// Strands compared.
    pub strands: usize,
    /// Distances of places at equal shares of the strands' lengths.
    pub distances: Distances,
    /// Discrete Frechet distance of the strands.
    pub frechet: Distances,
    /// Change of length as a fraction of that in the first groom, without its sign.
    pub length_change: Distances,
}

/// Wasserstein distances: how far, in the mean, values must move to make one distribution the
/// other. `None` where a groom has no values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Distributions {
    /// Of arc lengths, in units of length.
    pub length: Option<f64>,
    /// Of turns.
    pub turns: Option<f64>,
    /// Of coil radii, in units of length.
    pub coil_radius: Option<f64>,
    /// Of pitches, in units of length.
    pub pitch: Option<f64>,
    /// Of hand balances, -1 to 1.
    pub hand_balance: Option<f64>,
    /// Of the spectra, in octaves of frequency.
    pub spectrum: Option<f64>,
}

/// Places along each strand at which strands of the same index are compared, at least; more where
/// a strand has more points.
const PLACES: usize = 64;

/// Places along a strand at most for its Frechet distance, whose time grows with their square.
const MOST_PLACES: usize = 512;

/// Compares two grooms, of which `analyses` are what is known.
///
/// ```
/// use glam::DVec3;
/// use tress_analysis::{Analysis, compare};
/// use tress_geometry::{Groom, Strands};
///
/// let line = |y: f64| -> Result<Groom, tress_geometry::OffsetsError> {
///     let points = (0..5).map(|i| DVec3::new(f64::from(i), y, 0.0)).collect();
///     Ok(Groom::new(Strands::from_counts([5], points)?))
/// };
/// let (a, b) = (line(0.0)?, line(0.5)?);
/// let apart = compare([&a, &b], [&Analysis::of(&a), &Analysis::of(&b)]);
/// assert_eq!(apart.nearest.map(|d| d.greatest), Some(0.5));
/// assert_eq!(apart.by_index.map(|d| d.frechet.rms), Some(0.5));
/// assert_eq!(apart.distributions.length, Some(0.0));
/// # Ok::<(), tress_geometry::OffsetsError>(())
/// ```
#[must_use]
pub fn compare(grooms: [&Groom; 2], analyses: [&Analysis; 2]) -> Comparison {
    let [a, b] = grooms;
    let mut nearest = nearest_distances(a, b);
    nearest.extend(nearest_distances(b, a));
    Comparison {
        strands: grooms.map(|groom| groom.strands().len()),
        points: grooms.map(|groom| groom.strands().points().len()),
        nearest: Distances::of(nearest),
        by_index: by_index(a, b),
        distributions: Distributions::of(analyses),
    }
}

impl Distances {
    /// Of the finite ones; `None` if there are none.
    #[must_use]
    pub fn of(distances: impl IntoIterator<Item = f64>) -> Option<Self> {
        let (mut n, mut sum, mut square, mut greatest) = (0_usize, 0.0, 0.0, 0.0_f64);
        for d in distances.into_iter().filter(|d| d.is_finite()) {
            n += 1;
            sum += d;
            square += d * d;
            greatest = greatest.max(d);
        }
        let count = n as f64;
        (0 < n).then(|| Self { rms: (square / count).sqrt(), mean: sum / count, greatest })
    }
}

impl Distributions {
    fn of(analyses: [&Analysis; 2]) -> Self {
        let between = |value: fn(&StrandMeasures) -> Option<f64>| {
            let [a, b] = analyses.map(|analysis| {
                let values = analysis.strands.iter().flatten().filter_map(value);
                values.collect::<Vec<f64>>()
            });
            wasserstein(&a, &b)
        };
        let octaves = analyses.map(|analysis| {
            let shares = analysis.spectrum.shares().into_iter();
            shares.map(|(frequency, share)| (frequency.log2(), share)).collect::<Vec<_>>()
        });
        Self {
            length: between(|m| Some(m.length)),
            turns: between(|m| Some(m.turns)),
            coil_radius: between(|m| m.coil_radius),
            pitch: between(|m| m.pitch),
            hand_balance: between(|m| m.coil_radius.map(|_| m.hand_balance)),
            spectrum: wasserstein_of_shares(&octaves[0], &octaves[1]),
        }
    }
}

fn by_index(a: &Groom, b: &Groom) -> Option<ByIndex> {
    let n = a.strands().len().min(b.strands().len());
    let pairs: Vec<Pair> = (0..n)
        .into_par_iter()
        .filter_map(|i| Pair::of(a.strands().strand(i), b.strands().strand(i)))
        .collect();
    Some(ByIndex {
        strands: pairs.len(),
        distances: Distances::of(pairs.iter().flat_map(|pair| pair.distances.iter().copied()))?,
        frechet: Distances::of(pairs.iter().map(|pair| pair.frechet))?,
        length_change: Distances::of(pairs.iter().map(|pair| pair.length_change))?,
    })
}

/// Two strands of the same index.
struct Pair {
    distances: Vec<f64>,
    frechet: f64,
    length_change: f64,
}

impl Pair {
    fn of(a: &[glam::DVec3], b: &[glam::DVec3]) -> Option<Self> {
        if defect(a).is_some() || defect(b).is_some() {
            return None;
        }
        // As many points as each other: the points themselves are the places.
        let same = a.len() == b.len();
        let n = a.len().max(b.len()).max(PLACES);
        let placed = |points: &[glam::DVec3]| if same { points.to_vec() } else { even(points, n) };
        let (p, q) = (placed(a), placed(b));
        let step = p.len().div_ceil(MOST_PLACES);
        let thinned = |points: &[glam::DVec3]| -> Vec<glam::DVec3> {
            let last = points.last().copied();
            points.iter().step_by(step).copied().chain(last).collect()
        };
        Some(Self {
            distances: p.iter().zip(&q).map(|(p, q)| p.distance(*q)).collect(),
            frechet: discrete_frechet(&thinned(&p), &thinned(&q)),
            length_change: (length(b) / length(a) - 1.0).abs(),
        })
    }
}

/// `n` places at equal shares of a polyline's length.
fn even(points: &[glam::DVec3], n: usize) -> Vec<glam::DVec3> {
    let mut along = Vec::with_capacity(points.len());
    arc_lengths(points, &mut along);
    let total = along.last().copied().unwrap_or(0.0);
    let at = |k: usize| {
        let (i, f) = place(&along, total * k as f64 / (n - 1) as f64);
        if f == 0.0 { points[i] } else { points[i].lerp(points[i + 1], f) }
    };
    (0..n).map(at).collect()
}

#[cfg(test)]
mod tests;
