//! Fewer points for a strand, where its segments stay near it.
//!
//! A segment of length `h` on a curve of curvature `k` misses it by `k h^2 / 8`. Misses are equal
//! where `h` goes with `k^(-1/2)`, so points are spread with the density `k^(1/2)`; what that leaves
//! uneven is evened out by making segments that miss by more shorter, a few times over.
//!
//! On a coil of radius `r` with `n` points a turn, segments between points on the coil miss it by
//! `g = r (1 - c)`, `c = cos(pi / n)`, all inside. Moved outside by `g / (2 c)` a point's segments
//! miss half as much, `r (1 - c) / 2`, in their middles as at their ends: the best that segments can
//! do. At 255 points for 60 turns that is 13 % of the radius instead of 26 %.

use glam::DVec3;
use tress_geometry::curves::{CubicBasis, phantom_end};
use tress_geometry::polyline;

use super::Placement;

/// Samples of the curve for each point placed; a segment's miss is then known to a hundredth.
const FINENESS: usize = 12;
/// How often misses are evened out. They settle within 5.
const ROUNDS: usize = 8;
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
            let ends = self.spread(count, &density);
            let on_it = self.placed(&ends);
            let misses = self.misses(&ends, &on_it.points);
            let outside = self.moved_out(&ends, &misses);
            for placed in [on_it, outside] {
                if placed.error < best.error {
                    best = placed;
                }
            }
            let sizes: Vec<f64> = misses.iter().map(|miss| miss.length()).collect();
            let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
            if mean <= 0.0 {
                break;
            }
            for (pair, size) in ends.windows(2).zip(sizes) {
                // The miss goes with the square of the length; half a step each round is stable.
                let change = (size / mean).clamp(0.1, 10.0).powf(0.25);
                density[pair[0]..pair[1]].iter_mut().for_each(|d| *d *= change);
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

    /// The samples to put `count` points at, ascending, so that the density between them is even.
    fn spread(&self, count: usize, density: &[f64]) -> Vec<usize> {
        let mut sums = Vec::with_capacity(density.len());
        let mut sum = 0.0;
        sums.push(sum);
        for (i, pair) in self.lengths.windows(2).enumerate() {
            sum += density[i] * (pair[1] - pair[0]);
            sums.push(sum);
        }
        let last = self.points.len() - 1;
        let mut ends: Vec<usize> = Vec::with_capacity(count);
        for k in 0..count {
            let target = sum * k as f64 / (count - 1) as f64;
            let behind = sums.partition_point(|&s| s < target);
            let before = behind.saturating_sub(1);
            let nearer = if target - sums[before] < sums[behind.min(last)] - target {
                before
            } else {
                behind.min(last)
            };
            // Each point has a sample of its own: there are many more samples than points.
            let least = ends.last().map_or(0, |end| end + 1);
            ends.push(nearer.clamp(least, last - (count - 1 - k)));
        }
        ends[count - 1] = last;
        ends
    }

    /// Points at these samples.
    fn placed(&self, ends: &[usize]) -> Placed {
        self.measured(ends, ends.iter().map(|&end| self.points[end]).collect())
    }

    /// Where each segment misses the curve by most: from the segment to the curve.
    fn misses(&self, ends: &[usize], points: &[DVec3]) -> Vec<DVec3> {
        let segments = ends.windows(2).zip(points.windows(2));
        segments
            .map(|(ends, segment)| {
                let samples = &self.points[ends[0]..=ends[1]];
                let miss = |&sample: &DVec3| sample - nearest(segment[0], segment[1], sample);
                let longer =
                    |a: &DVec3, b: &DVec3| a.length_squared().total_cmp(&b.length_squared());
                samples.iter().map(miss).max_by(longer).unwrap_or(DVec3::ZERO)
            })
            .collect()
    }

    /// Points at these samples, all but the first and the last moved out at bends.
    fn moved_out(&self, ends: &[usize], misses: &[DVec3]) -> Placed {
        let mut points: Vec<DVec3> = ends.iter().map(|&end| self.points[end]).collect();
        for i in 1..points.len() - 1 {
            let [before, here, behind] = [i - 1, i, i + 1].map(|k| self.points[ends[k]]);
            let half_turn = 0.5 * (here - before).angle_between(behind - here);
            let cosine = half_turn.cos().max(LEAST_COSINE);
            points[i] += 0.5 * (misses[i - 1] + misses[i]) / (2.0 * cosine);
        }
        self.measured(ends, points)
    }

    /// Points that belong to these samples, with how far the curve is from their segments.
    fn measured(&self, ends: &[usize], points: Vec<DVec3>) -> Placed {
        let mut error: f64 = 0.0;
        for (i, pair) in ends.windows(2).enumerate() {
            // Near its ends the neighbours of a segment may be nearer.
            let near = &points[i.saturating_sub(1)..(i + 3).min(points.len())];
            for &sample in &self.points[pair[0]..=pair[1]] {
                let distances =
                    near.windows(2).map(|s| nearest(s[0], s[1], sample).distance(sample));
                error = error.max(distances.fold(f64::INFINITY, f64::min));
            }
        }
        let row = |&end: &usize| {
            (end / self.per_segment, (end % self.per_segment) as f64 / self.per_segment as f64)
        };
        Placed { points, rows: ends.iter().map(row).collect(), error }
    }
}

/// The point of a segment that is nearest.
fn nearest(a: DVec3, b: DVec3, point: DVec3) -> DVec3 {
    let along = b - a;
    let t = (point - a).dot(along) / along.length_squared();
    a + along * if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests;
