//! Lengths and defects of polylines.

use glam::DVec3;

/// What keeps a polyline from being a strand with a direction at every point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Defect {
    /// No point at all.
    Empty,
    /// One point: a root without hair.
    SinglePoint,
    /// A coordinate that is NaN or infinite.
    NotFinite,
    /// All points in one place.
    ZeroLength,
}

impl Defect {
    /// What is wrong, in words that fit behind a count of strands.
    #[must_use]
    pub fn describe(self) -> &'static str {
        match self {
            Self::Empty => "without a point",
            Self::SinglePoint => "of a single point",
            Self::NotFinite => "with a coordinate that is not finite",
            Self::ZeroLength => "of no length",
        }
    }
}

/// The worst defect of a polyline, if it has one.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::polyline::{Defect, defect};
///
/// assert_eq!(defect(&[DVec3::ZERO, DVec3::X]), None);
/// assert_eq!(defect(&[DVec3::ONE, DVec3::ONE]), Some(Defect::ZeroLength));
/// assert_eq!(defect(&[DVec3::ONE, DVec3::NAN]), Some(Defect::NotFinite));
/// ```
#[must_use]
pub fn defect(points: &[DVec3]) -> Option<Defect> {
    if points.is_empty() {
        return Some(Defect::Empty);
    }
    if !points.iter().all(|point| point.is_finite()) {
        return Some(Defect::NotFinite);
    }
    if points.len() == 1 {
        return Some(Defect::SinglePoint);
    }
    // The square of a tiny or huge length may not be a number; the length itself is asked.
    let total = length(points);
    if !total.is_finite() {
        return Some(Defect::NotFinite);
    }
    (total == 0.0).then_some(Defect::ZeroLength)
}

/// Sum of the segments' lengths.
#[must_use]
pub fn length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
}

/// Arc length of each point from the first, appended to `arc_lengths`.
pub fn arc_lengths(points: &[DVec3], arc_lengths: &mut Vec<f64>) {
    let mut s = 0.0;
    let mut before = points.first();
    arc_lengths.extend(points.iter().map(|point| {
        s += before.map_or(0.0, |before| before.distance(*point));
        before = Some(point);
        s
    }));
}

/// How many points stand exactly where their predecessor does.
#[must_use]
pub fn repeated_points(points: &[DVec3]) -> usize {
    points.windows(2).filter(|ends| ends[0] == ends[1]).count()
}

/// Where arc length `s` falls: the segment, and how far along it in 0 to 1.
///
/// `arc_lengths` ascend and are not empty; `s` outside them falls on the first or last segment's
/// end. The pair is what [`Column::interpolate`](crate::Column::interpolate) takes.
#[must_use]
pub fn place(arc_lengths: &[f64], s: f64) -> (usize, f64) {
    let behind = arc_lengths.partition_point(|&a| a <= s);
    if behind == 0 || behind == arc_lengths.len() {
        return (behind.saturating_sub(1), 0.0);
    }
    let (a, b) = (arc_lengths[behind - 1], arc_lengths[behind]);
    (behind - 1, (s - a) / (b - a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defects_are_told_apart() {
        assert_eq!(defect(&[]), Some(Defect::Empty));
        assert_eq!(defect(&[DVec3::ONE]), Some(Defect::SinglePoint));
        assert_eq!(defect(&[DVec3::INFINITY]), Some(Defect::NotFinite));
        assert_eq!(defect(&[DVec3::MAX, DVec3::MIN]), Some(Defect::NotFinite));
        assert_eq!(defect(&[DVec3::ZERO, DVec3::splat(1e-150)]), None);
    }

    #[test]
    fn places_are_found_between_points_on_them_and_outside() {
        let s = [0.0, 1.0, 1.0, 3.0];
        assert_eq!(place(&s, -1.0), (0, 0.0));
        assert_eq!(place(&s, 0.25), (0, 0.25));
        assert_eq!(place(&s, 1.0), (2, 0.0));
        assert_eq!(place(&s, 2.0), (2, 0.5));
        assert_eq!(place(&s, 3.0), (3, 0.0));
        assert_eq!(place(&s, 9.0), (3, 0.0));
    }

    #[test]
    fn arc_lengths_end_at_the_length() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::new(1.0, 2.0, 0.0)];
        let mut s = Vec::new();
        arc_lengths(&points, &mut s);
        assert_eq!(s, [0.0, 1.0, 1.0, 3.0]);
        assert_eq!((length(&points), repeated_points(&points)), (3.0, 1));
        assert_eq!((length(&points), repeated_points(&points)), (3.0, 1));
        assert_eq!([&points[..2], &[DVec3::X; 4]].map(repeated_points), [0, 3]);
    }
}
