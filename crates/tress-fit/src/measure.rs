//! How far a super-helix and the polyline it was fitted to are apart.
//!
//! The distance of a point is to the nearest place of the curve, found by Newton's method on
//! `(r(s) - p) . t(s) = 0` from the arc length the fit says the point corresponds to. The other way
//! round, the middle of the curve between two points is measured against the segment between them;
//! for a coil that is mostly the segment's own sag, `R (1 - cos(phi / 2))` at `phi` a segment.

use glam::DVec3;
use serde::Serialize;
use tress_geometry::{Element, Frame, SuperHelix};

/// How far super-helices and polylines are apart. Lengths are in the unit of the groom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Deviation {
    /// Points measured.
    pub points: usize,
    /// Root of the mean square distance of the points to the curves.
    pub rms: f64,
    /// Greatest distance of a point to its curve.
    pub greatest: f64,
    /// Root of the mean square distance of the curves, midway between points, to the segments.
    pub rms_back: f64,
    /// Greatest such distance.
    pub greatest_back: f64,
    /// Like `rms`, each distance over the coil radius of its strand; straight strands left out.
    pub rms_of_radius: f64,
    /// Like `greatest`, over the coil radius of the strand.
    pub greatest_of_radius: f64,
    /// Greatest change of a strand's length as a polyline, as a fraction: the polyline through the
    /// curve's places that correspond to the points against the polyline through the points.
    pub length_change: f64,
    /// Greatest excess of a curve's arc length over its polyline's length, as a fraction. A coil is
    /// longer than its chords: by 6.9 % at five points a turn.
    pub arc_excess: f64,
    /// Greatest jump of curvature between neighbouring elements, in one over length.
    pub curvature_jump: f64,
}

/// Sums from which deviations come; sums of strands add up in the order of the strands.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    points: usize,
    coiled_points: usize,
    middles: usize,
    square: f64,
    square_back: f64,
    square_of_radius: f64,
    worst: Deviation,
}

impl Sums {
    /// Of one strand, whose points correspond to `arc_lengths`.
    pub(crate) fn of(strand: &SuperHelix<'_>, points: &[DVec3], arc_lengths: &[f64]) -> Self {
        let mut curve = Projector::new(*strand);
        let mut sums = Self { points: points.len(), ..Self::default() };
        let (mut chords, mut own_chords) = (0.0, 0.0);
        let mut before: Option<(DVec3, f64, DVec3)> = None;
        for (point, &s) in points.iter().zip(arc_lengths) {
            if let Some((last, last_s, last_place)) = before {
                let middle = curve.position(0.5 * (last_s + s));
                sums.add_middle(distance_to_segment(middle, last, *point));
                chords += last.distance(*point);
                let place = curve.position(s);
                own_chords += last_place.distance(place);
                before = Some((*point, s, place));
            } else {
                before = Some((*point, s, curve.position(s)));
            }
            let distance = curve.nearest(*point, s);
            sums.square += distance * distance;
            sums.worst.greatest = sums.worst.greatest.max(distance);
        }
        if 0.0 < chords {
            sums.worst.length_change = (own_chords / chords - 1.0).abs();
            sums.worst.arc_excess = strand.length() / chords - 1.0;
        }
        sums.worst.curvature_jump = curvature_jump(strand.elements);
        let radius = coil_radius(strand.elements);
        if 0.0 < radius {
            sums.coiled_points = points.len();
            sums.square_of_radius = sums.square / (radius * radius);
            sums.worst.greatest_of_radius = sums.worst.greatest / radius;
        }
        sums
    }

    fn add_middle(&mut self, distance: f64) {
        self.middles += 1;
        self.square_back += distance * distance;
        self.worst.greatest_back = self.worst.greatest_back.max(distance);
    }

    pub(crate) fn add(&mut self, other: Self) {
        self.points += other.points;
        self.coiled_points += other.coiled_points;
        self.middles += other.middles;
        self.square += other.square;
        self.square_back += other.square_back;
        self.square_of_radius += other.square_of_radius;
        let (worst, more) = (&mut self.worst, other.worst);
        worst.greatest = worst.greatest.max(more.greatest);
        worst.greatest_back = worst.greatest_back.max(more.greatest_back);
        worst.greatest_of_radius = worst.greatest_of_radius.max(more.greatest_of_radius);
        worst.length_change = worst.length_change.max(more.length_change);
        worst.arc_excess = worst.arc_excess.max(more.arc_excess);
        worst.curvature_jump = worst.curvature_jump.max(more.curvature_jump);
    }

    pub(crate) fn deviation(&self) -> Deviation {
        let rms = |square: f64, n: usize| (square / n.max(1) as f64).sqrt();
        Deviation {
            points: self.points,
            rms: rms(self.square, self.points),
            rms_back: rms(self.square_back, self.middles),
            rms_of_radius: rms(self.square_of_radius, self.coiled_points),
            ..self.worst
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
/// assert!((apart.greatest_back - 0.158).abs() < 1e-3);
/// ```
#[must_use]
pub fn deviation(strand: &SuperHelix<'_>, points: &[DVec3], arc_lengths: &[f64]) -> Deviation {
    Sums::of(strand, points, arc_lengths).deviation()
}

/// The greatest distance of a point from a super-helix, on which they lie at these arc lengths.
pub(crate) fn greatest_distance(
    strand: &SuperHelix<'_>,
    points: &[DVec3],
    arc_lengths: &[f64],
) -> f64 {
    let mut curve = Projector::new(*strand);
    points.iter().zip(arc_lengths).map(|(p, &s)| curve.nearest(*p, s)).fold(0.0, f64::max)
}

/// The coil radius in the mean over the length that bends; 0 where nothing does.
pub(crate) fn coil_radius(elements: &[Element]) -> f64 {
    let bent = elements.iter().filter(|element| 0.0 < element.bending());
    let (sum, length) = bent.fold((0.0, 0.0), |(sum, length), element| {
        // Nearly straight elements have any radius; those that turn say what the coil's is.
        let weight = element.length * element.curvature.length();
        (sum + weight * element.radius(), length + weight)
    });
    if 0.0 < length { sum / length } else { 0.0 }
}

fn curvature_jump(elements: &[Element]) -> f64 {
    let jumps = elements.windows(2).map(|pair| pair[0].curvature.distance(pair[1].curvature));
    jumps.fold(0.0, f64::max)
}

fn distance_to_segment(point: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (along, square) = (b - a, a.distance_squared(b));
    let t = if 0.0 < square { ((point - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(a + t * along)
}

/// Newton steps before a point's search ends where it is; from a good start one or two do.
const NEWTON_STEPS: usize = 12;

/// A super-helix with its joints at hand, to find nearest places on.
struct Projector<'a> {
    strand: SuperHelix<'a>,
    joints: Vec<Frame>,
    /// Arc lengths at the joints.
    begins: Vec<f64>,
    /// The element looked at last: the next is the same or near.
    index: usize,
}

impl<'a> Projector<'a> {
    fn new(strand: SuperHelix<'a>) -> Self {
        let mut s = 0.0;
        let mut begins = vec![0.0];
        begins.extend(strand.elements.iter().map(|element| {
            s += element.length;
            s
        }));
        Self { strand, joints: strand.joints().collect(), begins, index: 0 }
    }

    /// The element that holds an arc length, where it is joined and how far along it that is.
    fn find(&mut self, s: f64) -> Option<(&Element, &Frame, f64)> {
        let elements = self.strand.elements;
        while self.index + 1 < elements.len() && self.begins[self.index + 1] < s {
            self.index += 1;
        }
        while 0 < self.index && s < self.begins[self.index] {
            self.index -= 1;
        }
        let local = s - self.begins[self.index];
        Some((elements.get(self.index)?, &self.joints[self.index], local))
    }

    fn position(&mut self, s: f64) -> DVec3 {
        let root = self.strand.root.position;
        self.find(s).map_or(root, |(element, joint, local)| {
            joint.position + joint.axes * element.displacement(local)
        })
    }

    /// The frame at an arc length, and the curvature vector `t'` there.
    fn at(&mut self, s: f64) -> (Frame, DVec3) {
        let root = self.strand.root;
        self.find(s).map_or((root, DVec3::ZERO), |(element, joint, local)| {
            let frame = element.frame_at(joint, local);
            let q = element.curvature;
            (frame, frame.axes * DVec3::new(0.0, q.z, -q.y))
        })
    }

    /// The distance of `point` to the curve around the arc length `s`.
    fn nearest(&mut self, point: DVec3, s: f64) -> f64 {
        let length = self.begins.last().copied().unwrap_or(0.0);
        let mut s = s.max(0.0).min(length);
        let mut best = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            let (frame, bend) = self.at(s);
            let off = frame.position - point;
            let distance = off.length();
            best = best.min(distance);
            let (slope, second) = (off.dot(frame.tangent()), 1.0 + off.dot(bend));
            let next = (s - slope / second.max(0.25)).max(0.0).min(length);
            // The distance is stationary: what is left of the step counts by its square.
            if (next - s).abs() <= 1e-3 * distance || (next - s).abs() <= 1e-15 * length {
                break;
            }
            s = next;
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strands_together_deviate_as_all_their_points_do() {
        let straight = [Element { curvature: DVec3::ZERO, length: 2.0 }];
        let coil = [Element { length: 5.0, ..Element::coil(0.5, 0.3) }];
        let strand = |elements| SuperHelix { root: Frame::IDENTITY, elements };
        let sums = |elements, n: u32, off: f64| {
            let strand = strand(elements);
            let along: Vec<f64> =
                (0..=n).map(|i| strand.length() * f64::from(i) / f64::from(n)).collect();
            let beside = |frame: Frame| frame.position + off * frame.axes.z_axis;
            let points: Vec<_> = strand.frames_at(along.iter().copied()).map(beside).collect();
            Sums::of(&strand, &points, &along)
        };
        let parts = [sums(&straight, 4, 0.1), sums(&coil, 20, 0.02), sums(&coil, 9, 0.01)];
        let mut all = Sums::default();
        parts.into_iter().for_each(|part| all.add(part));
        let (parts, all) = (parts.map(|part| part.deviation()), all.deviation());
        let pooled = |value: fn(&Deviation) -> f64, weights: [f64; 3]| {
            let squares = parts.iter().zip(weights).map(|(part, n)| n * value(part).powi(2));
            (squares.sum::<f64>() / weights.iter().sum::<f64>()).sqrt()
        };
        let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
        assert_eq!(all.points, 5 + 21 + 10);
        assert!(near(all.rms, pooled(|part| part.rms, [5.0, 21.0, 10.0])));
        assert!(near(all.rms_back, pooled(|part| part.rms_back, [4.0, 20.0, 9.0])));
        assert!(near(all.rms_of_radius, pooled(|part| part.rms_of_radius, [0.0, 21.0, 10.0])));
        // The worst of all, wherever it is.
        let worst = |value: fn(&Deviation) -> f64| parts.iter().map(value).fold(0.0, f64::max);
        assert!(near(all.greatest, worst(|part| part.greatest)));
        assert!(near(all.greatest_back, worst(|part| part.greatest_back)));
        assert!(near(all.greatest_of_radius, worst(|part| part.greatest_of_radius)));
        assert!(near(all.arc_excess, worst(|part| part.arc_excess)));
        assert!(near(all.greatest, 0.1) && near(all.greatest_of_radius, 0.04));
    }

    #[test]
    fn the_coil_radius_is_the_mean_over_what_turns() {
        let wound = |radius: f64, turns: f64| {
            let coil = Element::coil(radius, 0.4);
            Element { length: turns * std::f64::consts::TAU / coil.curvature.length(), ..coil }
        };
        let straight = Element { curvature: 2.0 * DVec3::X, length: 50.0 };
        let radius = coil_radius(&[wound(1.0, 3.0), straight, wound(5.0, 1.0)]);
        assert!((radius - 2.0).abs() < 1e-14, "{radius}");
        assert!((coil_radius(&[wound(0.3, 0.2)]) - 0.3).abs() < 1e-15);
        assert_eq!((coil_radius(&[straight]), coil_radius(&[])), (0.0, 0.0));
    }
}
