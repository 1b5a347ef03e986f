//! Fewer points for a strand, where its segments stay near it.
//!
//! A segment of length `h` on a curve of curvature `k` misses it by `k h^2 / 8`. Misses are equal
//! where `h` goes with `k^(-1/2)`, so points are spread with the density `k^(1/2)`; what that
//! leaves uneven is evened out by making segments that miss by more shorter, a few times over.
//!
//! On a coil of radius `r` with `n` points a turn, segments between points on the coil miss it by
//! `g = r (1 - c)`, `c = cos(pi / n)`, all inside. Moved outside by `g / (2 c)` a point's segments
//! miss half as much, `r (1 - c) / 2`, in their middles as at their ends: the best that segments
//! can do. At 255 points for 60 turns that is 13 % of the radius instead of 26 %.

use glam::DVec3;
use tress_geometry::curves::{CubicBasis, phantom_end};
use tress_geometry::polyline;

use super::Placement;

/// Samples of the curve for each point placed; a segment's miss is then known to a hundredth.
const FINENESS: usize = 12;
/// How often misses are evened out. On coils they settle within 10.
const ROUNDS: usize = 12;
/// The least density, as a share of the mean: straight stretches keep a few points.
const LEAST_DENSITY: f64 = 0.05;
/// A corner sharper than this is not moved by as much as a coil's.
const LEAST_COSINE: f64 = 0.5;

/// Points of a strand, and where between the rows of the old ones they are.
pub(super) struct Placed {
    pub(super) points: Vec<DVec3>,
    pub(super) rows: Vec<(usize, f64)>,
    /// Greatest distance of the strand from the segments.
    pub(super) error: f64,
}

/// Every point as it is.
pub(super) fn all(points: &[DVec3]) -> Placed {
    let rows = (0..points.len()).map(|i| (i, 0.0)).collect();
    Placed { points: points.to_vec(), rows, error: 0.0 }
}

/// `count` points for a strand that has more.
pub(super) fn fewer(points: &[DVec3], count: usize, placement: Placement) -> Placed {
    if polyline::defect(points).is_some() {
        // No curve to keep near to.
        let last = points.len() - 1;
        let rows: Vec<_> = (0..count).map(|i| (i * last / (count - 1), 0.0)).collect();
        let kept = rows.iter().map(|(row, _)| points[*row]).collect();
        return Placed { points: kept, rows, error: 0.0 };
    }
    let curve = Curve::through(points, count);
    match placement {
        Placement::Uniform => curve.placed(&curve.spread(count, &vec![1.0; curve.points.len()])),
        Placement::Curvature => curve.by_curvature(count),
    }
}

/// A strand, finely sampled.
struct Curve {
    points: Vec<DVec3>,
    /// Arc length from the root.
    lengths: Vec<f64>,
    /// Samples for each segment of the strand.
    per_segment: usize,
}

impl Curve {
    /// The Catmull-Rom curve through points.
    fn through(points: &[DVec3], count: usize) -> Self {
        let segments = points.len() - 1;
        let per_segment = (FINENESS * count).div_ceil(segments);
        let before = phantom_end(points[0], points[1]);
        let behind = phantom_end(points[segments], points[segments - 1]);
        let at = |i: usize| match i {
            0 => before,
            i if i == points.len() + 1 => behind,
            i => points[i - 1],
        };
        let mut samples = Vec::with_capacity(segments * per_segment + 1);
        for i in 0..segments {
            let four = [at(i), at(i + 1), at(i + 2), at(i + 3)];
            let sample = |k| CubicBasis::CatmullRom.position(&four, k as f64 / per_segment as f64);
            samples.extend((0..per_segment).map(sample));
        }
        samples.push(points[segments]);
        let mut lengths = Vec::with_capacity(samples.len());
        polyline::arc_lengths(&samples, &mut lengths);
        Self { points: samples, lengths, per_segment }
    }

    /// The best of the rounds, on the curve or a little outside.
    fn by_curvature(&self, count: usize) -> Placed {
        let mut density = self.curvature_density();
        let mut best = self.placed(&self.spread(count, &density));
        for _ in 0..ROUNDS {
            let places = self.spread(count, &density);
            let outside = self.moved_out(&places);
            let errors = self.errors(&places, &outside);
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            for placed in [self.placed(&places), self.measured(&places, outside)] {
                if placed.error < best.error {
                    best = placed;
                }
            }
            if mean <= 0.0 {
                break;
            }
            for (pair, error) in places.windows(2).zip(errors) {
                // A miss goes with the square of the length; half a step each round is stable.
                let change = (error / mean).clamp(0.1, 10.0).powf(0.25);
                density[split(pair[0]).0..split(pair[1]).0].iter_mut().for_each(|d| *d *= change);
            }
        }
        best
    }

    /// The square root of the curvature at each sample, of which none is far below the mean.
    fn curvature_density(&self) -> Vec<f64> {
        let n = self.points.len();
        // Over as many samples as a point of the strand has, since a Catmull-Rom curve bends
        // unevenly between them.
        let reach = self.per_segment.max(1);
        let root_of_curvature = |i: usize| {
            let i = i.clamp(reach, n.saturating_sub(reach + 1).max(reach));
            let (a, b) = (i - reach, (i + reach).min(n - 1));
            let (u, v) = (self.points[i] - self.points[a], self.points[b] - self.points[i]);
            let length = 0.5 * (self.lengths[b] - self.lengths[a]);
            if length <= 0.0 { 0.0 } else { (u.angle_between(v) / length).sqrt() }
        };
        let roots: Vec<f64> = (0..n)
            .map(root_of_curvature)
            .map(|root| if root.is_finite() { root } else { 0.0 })
            .collect();
        let mean = roots.iter().sum::<f64>() / n as f64;
        let least = if mean <= 0.0 { 1.0 } else { LEAST_DENSITY * mean };
        roots.into_iter().map(|root| root.max(least)).collect()
    }

    /// Where between samples to put `count` points, ascending, so that the density is even.
    fn spread(&self, count: usize, density: &[f64]) -> Vec<f64> {
        let mut sums = Vec::with_capacity(density.len());
        let mut sum = 0.0;
        sums.push(sum);
        for (i, pair) in self.lengths.windows(2).enumerate() {
            sum += density[i] * (pair[1] - pair[0]);
            sums.push(sum);
        }
        let place = |k: usize| {
            let target = sum * k as f64 / (count - 1) as f64;
            let (sample, between) = polyline::place(&sums, target);
            sample as f64 + between
        };
        let mut places: Vec<f64> = (0..count).map(place).collect();
        places[0] = 0.0;
        places[count - 1] = (self.points.len() - 1) as f64;
        places
    }

    /// The point at a place between samples.
    fn at(&self, place: f64) -> DVec3 {
        let (i, between) = split(place);
        let here = self.points[i];
        self.points.get(i + 1).map_or(here, |next| here.lerp(*next, between))
    }

    /// The samples from one place to another, and the points at both.
    fn samples(&self, from: f64, to: f64) -> impl Iterator<Item = DVec3> {
        let between = split(from).0 + 1..split(to).0 + 1;
        let inner = self.points.get(between).unwrap_or_default().iter().copied();
        [self.at(from), self.at(to)].into_iter().chain(inner)
    }

    /// Points at these places.
    fn placed(&self, places: &[f64]) -> Placed {
        self.measured(places, places.iter().map(|&place| self.at(place)).collect())
    }

    /// Points at these places, all but the first and the last moved out at bends.
    fn moved_out(&self, places: &[f64]) -> Vec<DVec3> {
        let on_it: Vec<DVec3> = places.iter().map(|&place| self.at(place)).collect();
        let pairs = places.windows(2).zip(on_it.windows(2));
        let misses: Vec<DVec3> =
            pairs.map(|(ends, segment)| self.miss(ends[0], ends[1], segment)).collect();
        let mut points = on_it.clone();
        for i in 1..points.len() - 1 {
            let (before, here, behind) = (on_it[i - 1], on_it[i], on_it[i + 1]);
            let half_turn = 0.5 * (here - before).angle_between(behind - here);
            let cosine = half_turn.cos().max(LEAST_COSINE);
            // The misses beside a point lean from its direction by half its turn, their mean is
            // shorter than they are by the cosine.
            points[i] += 0.5 * (misses[i - 1] + misses[i]) / (2.0 * cosine * cosine);
        }
        points
    }

    /// Where a segment misses the curve by most: from the segment to the curve.
    fn miss(&self, from: f64, to: f64, segment: &[DVec3]) -> DVec3 {
        let miss = |sample: DVec3| sample - nearest(segment[0], segment[1], sample);
        let longer = |a: &DVec3, b: &DVec3| a.length_squared().total_cmp(&b.length_squared());
        self.samples(from, to).map(miss).max_by(longer).unwrap_or(DVec3::ZERO)
    }

    /// How far the part of the curve that belongs to each segment is from the segments near it.
    fn errors(&self, places: &[f64], points: &[DVec3]) -> Vec<f64> {
        let error = |(i, pair): (usize, &[f64])| {
            // Near its ends the neighbours of a segment may be nearer.
            let near = &points[i.saturating_sub(1)..(i + 3).min(points.len())];
            let distance = |sample: DVec3| {
                let distances =
                    near.windows(2).map(|s| nearest(s[0], s[1], sample).distance(sample));
                distances.fold(f64::INFINITY, f64::min)
            };
            self.samples(pair[0], pair[1]).map(distance).fold(0.0, f64::max)
        };
        places.windows(2).enumerate().map(error).collect()
    }

    /// Points that belong to these places, with how far the curve is from their segments.
    fn measured(&self, places: &[f64], points: Vec<DVec3>) -> Placed {
        let error = self.errors(places, &points).into_iter().fold(0.0, f64::max);
        let row = |&place: &f64| split(place / self.per_segment as f64);
        Placed { points, rows: places.iter().map(row).collect(), error }
    }
}

/// A place as an index and how far it is to the next.
#[expect(clippy::cast_possible_truncation, reason = "the whole part of what is not negative")]
fn split(place: f64) -> (usize, f64) {
    (place as usize, place.fract())
}

/// The point of a segment that is nearest.
fn nearest(a: DVec3, b: DVec3, point: DVec3) -> DVec3 {
    let along = b - a;
    let t = (point - a).dot(along) / along.length_squared();
    a + along * if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests;
