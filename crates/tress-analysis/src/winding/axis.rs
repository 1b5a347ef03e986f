//! The centerline of a strand by means over its turns.
//!
//! A mean over exactly one turn takes a coil away, and hardly touches a centerline that bends
//! slowly; taken twice it forgives turns that are off by some percent. What the double mean `B`
//! misses of a bent centerline is of second order in the length of a turn; `B + B(1 - B)` misses
//! it in fourth order and takes the coil away as well.
//!
//! A strand ends, and its last turns have nothing beyond. A helix is its own image under the half
//! turn about any of its normals (the line from a point to its axis), so the strand is continued
//! by half turns about the normals at its ends.

use std::ops::Range;

use glam::DVec3;

/// The centerline of a strand continued beyond its ends; positions are relative to the root.
pub(super) struct Axis {
    /// The stations of the strand itself.
    pub(super) stations: Range<usize>,
    /// The turn about each station, in stations.
    pub(super) periods: Vec<f64>,
    pub(super) center: Vec<DVec3>,
    /// The strand less its centerline, across its direction.
    pub(super) offset: Vec<DVec3>,
    /// The unit tangent of the centerline; zero where it does not advance.
    pub(super) direction: Vec<DVec3>,
    /// Length of centerline a station.
    pub(super) speed: Vec<f64>,
}

/// Turns by which a strand is continued: means of means and the moments together look so far.
const CONTINUED: f64 = 2.75;

/// A centerline that advances by less than this share of the strand's own length has no
/// direction: the strand goes round in a circle. The first centerline is also moved by what a turn
/// that is off leaves of the coil.
const LEAST_ADVANCE: [f64; 2] = [0.05, 0.01];

impl Axis {
    /// From one guess of the turn for the whole strand.
    pub(super) fn first(points: &[DVec3], period: f64) -> Self {
        let reversed: Vec<DVec3> = points.iter().rev().copied().collect();
        let normals = [first_normal(points, period), first_normal(&reversed, period)];
        Self::new(points, &vec![period; points.len()], normals, LEAST_ADVANCE[0])
    }

    /// From the turns (of all stations, the continued ones included) that this one led to.
    pub(super) fn again(&self, points: &[DVec3], periods: &[f64]) -> Self {
        let Range { start, end } = self.stations;
        let inside = |k: usize| half_window(periods[k]).min(points.len() - 1);
        let normal = |end: usize, at: usize| {
            let off = self.center[at] - (points[end - start] - points[0]);
            reject(off, self.direction[at])
        };
        let (root, tip) = (start, end - 1);
        let normals = [normal(root, root + inside(root)), normal(tip, tip - inside(tip))];
        Self::new(points, &periods[start..end], normals, LEAST_ADVANCE[1])
    }

    fn new(points: &[DVec3], periods: &[f64], normals: [DVec3; 2], least: f64) -> Self {
        let last = points.len() - 1;
        let reach = |period: f64| 2 * half_window(CONTINUED * period);
        let (before, behind) = (reach(periods[0]), reach(periods[last]));
        let continued = Continued { points, normals };
        let mut strand = Vec::with_capacity(points.len() + before + behind);
        strand.extend((1..=before).rev().map(|k| continued.beyond(0, k)));
        strand.extend(points.iter().map(|p| *p - points[0]));
        strand.extend((1..=behind).map(|k| continued.beyond(1, k)));
        let mut all = vec![periods[0]; before];
        all.extend_from_slice(periods);
        all.resize(strand.len(), periods[last]);
        Self::about(&strand, all, before..before + points.len(), least)
    }

    fn about(strand: &[DVec3], periods: Vec<f64>, stations: Range<usize>, least: f64) -> Self {
        let mean = |points: &[DVec3]| turn_means(&turn_means(points, &periods), &periods);
        let mut center = mean(strand);
        let missed: Vec<DVec3> = strand.iter().zip(&center).map(|(p, c)| *p - *c).collect();
        for (c, more) in center.iter_mut().zip(mean(&missed)) {
            *c += more;
        }
        let n = strand.len();
        let (mut direction, mut speed) = (Vec::with_capacity(n), Vec::with_capacity(n));
        let mut offset = Vec::with_capacity(n);
        for k in 0..n {
            let half = half_window(0.5 * periods[k]);
            let (a, b) = (k.saturating_sub(half), (k + half).min(n - 1));
            let ahead = (center[b] - center[a]) / (b - a) as f64;
            let step = strand[b.min(a + 1)].distance(strand[a]);
            let advances = least * step < ahead.length();
            let t = if advances { ahead.normalize_or_zero() } else { DVec3::ZERO };
            let off = strand[k] - center[k];
            offset.push(off - t * t.dot(off));
            direction.push(t);
            speed.push(ahead.length());
        }
        Self { stations, periods, center, offset, direction, speed }
    }

    /// `2 a b / (a^2 + b^2)` at the strand's own stations, with `a^2` and `b^2` the eigenvalues of
    /// the mean of `d d^T` over the turn, of which the third is 0: offsets lie across.
    pub(super) fn roundness(&self) -> Vec<f64> {
        let squares: Vec<DVec3> = self.offset.iter().map(|d| *d * *d).collect();
        let products: Vec<DVec3> =
            self.offset.iter().map(|d| DVec3::new(d.y * d.z, d.z * d.x, d.x * d.y)).collect();
        let (squares, products) =
            (turn_means(&squares, &self.periods), turn_means(&products, &self.periods));
        let round = |k: usize| {
            let (trace, square) = (squares[k].element_sum(), squares[k].length_squared());
            let product = trace * trace - square - 2.0 * products[k].length_squared();
            if 0.0 < trace { (2.0 * product.max(0.0)).sqrt().min(trace) / trace } else { 0.0 }
        };
        self.stations.clone().map(round).collect()
    }
}

/// A strand continued by half turns about the normals at its root and its tip.
struct Continued<'a> {
    points: &'a [DVec3],
    normals: [DVec3; 2],
}

impl Continued<'_> {
    /// The position `k` stations beyond the root (`end` 0) or the tip (1), relative to the root.
    ///
    /// Beyond the image of the whole strand comes the image of what lies beyond its other end.
    fn beyond(&self, end: usize, k: usize) -> DVec3 {
        let last = self.points.len() - 1;
        let origin = self.points[0];
        let place = if k <= last {
            self.points[if end == 0 { k } else { last - k }] - origin
        } else {
            self.beyond(1 - end, k - last)
        };
        let pivot = self.points[end * last] - origin;
        let (off, normal) = (place - pivot, self.normals[end]);
        pivot + 2.0 * normal * normal.dot(off) - off
    }
}

/// The direction from the first point to the axis, from the first turn.
fn first_normal(points: &[DVec3], period: f64) -> DVec3 {
    let turn = &points[..=(2 * half_window(period)).min(points.len() - 1)];
    let middle = turn.iter().sum::<DVec3>() / turn.len() as f64;
    let chord = turn[turn.len() - 1] - turn[0];
    let area: DVec3 = turn.windows(2).map(|p| (p[0] - middle).cross(p[1] - middle)).sum();
    // A flat turn sweeps an area across the axis, a steep one has its chord along it; where the
    // chord is about the radius both are off by as much.
    let flat = chord.length_squared() < 0.16 * area.length();
    reject(middle - turn[0], (if flat { area } else { chord }).normalize_or_zero())
}

/// The unit vector along what of `v` lies across `axis`; zero if nothing does.
fn reject(v: DVec3, axis: DVec3) -> DVec3 {
    (v - axis * axis.dot(v)).normalize_or_zero()
}

/// Stations on either side of the middle in a window of this many.
pub(crate) fn half_window(period: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative")]
    let half = (0.5 * period + 0.5) as usize;
    half.max(1)
}

/// At each station the mean over the turn about it; near the ends over as much as lies on both
/// sides. The stations at the ends of a window count by half, so that it is exactly a turn wide.
pub(crate) fn turn_means(values: &[DVec3], periods: &[f64]) -> Vec<DVec3> {
    let n = values.len();
    let mut sum = DVec3::ZERO;
    let mut sums = Vec::with_capacity(n + 1);
    sums.push(sum);
    sums.extend(values.iter().map(|value| {
        sum += *value;
        sum
    }));
    let mean = |k: usize| {
        let half = half_window(periods[k]).min(k).min(n - 1 - k);
        if half == 0 {
            return values[k];
        }
        let (a, b) = (k - half, k + half);
        let ends = 0.5 * (values[a] + values[b]);
        (sums[b + 1] - sums[a] - ends) / (2 * half) as f64
    };
    (0..n).map(mean).collect()
}
