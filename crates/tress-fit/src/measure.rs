//! How far a super-helix is from the points it was fitted to.
//!
//! The distance of a point is to the nearest place of the curve, found by Newton's method on
//! `(r(s) - p) . t(s) = 0` from the arc length the fit says the point corresponds to.

use glam::DVec3;
use tress_geometry::{Frame, SuperHelix, polyline};

/// How far super-helices and polylines are apart.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Points measured.
    pub points: usize,
    /// Root of the mean square distance of the points to the curves.
    pub rms: f64,
    /// Greatest distance of a point to its curve.
    pub greatest: f64,
    /// Greatest change of a strand's length, as a fraction of its polyline's length.
    pub length_change: f64,
}

/// Sums from which deviations come; sums of strands add up in the order of the strands.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    points: usize,
    square: f64,
    greatest: f64,
    length_change: f64,
}

impl Sums {
    /// Of one strand, whose points correspond to `arc_lengths`.
    pub(crate) fn of(strand: &SuperHelix<'_>, points: &[DVec3], arc_lengths: &[f64]) -> Self {
        let curve = Projector::new(*strand);
        let mut sums = Self { points: points.len(), ..Self::default() };
        for (point, &s) in points.iter().zip(arc_lengths) {
            let (_, distance) = curve.nearest(*point, s);
            sums.square += distance * distance;
            sums.greatest = sums.greatest.max(distance);
        }
        let length = polyline::length(points);
        sums.length_change = (strand.length() / length - 1.0).abs();
        sums
    }

    pub(crate) fn add(&mut self, other: Self) {
        self.points += other.points;
        self.square += other.square;
        self.greatest = self.greatest.max(other.greatest);
        self.length_change = self.length_change.max(other.length_change);
    }

    pub(crate) fn deviation(&self) -> Deviation {
        Deviation {
            points: self.points,
            rms: (self.square / self.points.max(1) as f64).sqrt(),
            greatest: self.greatest,
            length_change: self.length_change,
        }
    }
}

/// How far a super-helix is from a polyline whose points lie at these arc lengths of it.
///
/// ```
/// use glam::DVec3;
/// use tress_fit::deviation;
/// use tress_geometry::{Element, Frame, SuperHelix};
///
/// let straight = [Element { curvature: DVec3::ZERO, length: 2.0 }];
/// let strand = SuperHelix { root: Frame::IDENTITY, elements: &straight };
/// let points = [DVec3::ZERO, DVec3::new(1.0, 0.3, 0.0), 2.0 * DVec3::X];
/// let apart = deviation(&strand, &points, &[0.0, 1.1, 2.0]);
/// assert!((apart.greatest - 0.3).abs() < 1e-12);
/// ```
#[must_use]
pub fn deviation(strand: &SuperHelix<'_>, points: &[DVec3], arc_lengths: &[f64]) -> Deviation {
    Sums::of(strand, points, arc_lengths).deviation()
}

/// Newton steps before a point's search ends where it is; from a good start two or three do.
const NEWTON_STEPS: usize = 12;

/// A super-helix with its joints at hand, to find nearest places on.
struct Projector<'a> {
    strand: SuperHelix<'a>,
    joints: Vec<Frame>,
    /// Arc lengths at the joints.
    begins: Vec<f64>,
}

impl<'a> Projector<'a> {
    fn new(strand: SuperHelix<'a>) -> Self {
        let mut s = 0.0;
        let mut begins = vec![0.0];
        begins.extend(strand.elements.iter().map(|element| {
            s += element.length;
            s
        }));
        Self { strand, joints: strand.joints().collect(), begins }
    }

    /// The frame at an arc length, and the curvature vector `t'` there.
    fn at(&self, s: f64) -> (Frame, DVec3) {
        let last = self.strand.elements.len().saturating_sub(1);
        let i = self.begins.partition_point(|&b| b <= s).saturating_sub(1).min(last);
        let Some(element) = self.strand.elements.get(i) else {
            return (self.strand.root, DVec3::ZERO);
        };
        let frame = element.frame_at(&self.joints[i], s - self.begins[i]);
        let q = element.curvature;
        (frame, frame.axes * DVec3::new(0.0, q.z, -q.y))
    }

    /// The arc length nearest to `point` around the arc length `s`, and the distance.
    fn nearest(&self, point: DVec3, s: f64) -> (f64, f64) {
        let length = self.begins.last().copied().unwrap_or(0.0);
        let mut s = s.clamp(0.0, length);
        let mut best = (s, f64::INFINITY);
        for _ in 0..NEWTON_STEPS {
            let (frame, bend) = self.at(s);
            let off = frame.position - point;
            let distance = off.length();
            if distance < best.1 {
                best = (s, distance);
            }
            let (slope, second) = (off.dot(frame.tangent()), 1.0 + off.dot(bend));
            let step = slope / second.max(0.25);
            let next = (s - step).clamp(0.0, length);
            // The distance is stationary: what is left of the step counts by its square.
            if (next - s).abs() <= 1e-4 * distance || (next - s).abs() <= 1e-15 * length {
                break;
            }
            s = next;
        }
        best
    }
}
