//! What is wrong with the polylines of a groom.

use std::collections::BTreeMap;

use serde::Serialize;
use tress_geometry::Groom;
use tress_geometry::polyline::{Defect, defect, length, repeated_points};

/// Counts of what is wrong, and where it was seen first.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Defects {
    /// Strands that no curve can be fitted to: why, how many, and the first of them.
    pub strands: BTreeMap<&'static str, (usize, usize)>,
    /// Points that stand exactly where their predecessor does, in strands otherwise sound.
    pub repeated_points: usize,
    /// Strands with a segment over [`LONG_SEGMENT`] times as long as the strand's mean segment.
    pub long_segments: usize,
    /// The first strand with such a segment.
    pub first_long_segment: Option<usize>,
}

/// A segment this many times the mean of its strand is reported: a strand joined to another, or a
/// point astray.
pub const LONG_SEGMENT: f64 = 10.0;

impl Defects {
    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    fn add(&mut self, strand: usize, defect: Defect) {
        self.strands.entry(defect.describe()).or_insert((0, strand)).0 += 1;
    }
}

/// Looks for defects in every strand.
///
/// ```
/// use glam::DVec3;
/// use tress_analysis::defects;
/// use tress_geometry::{Groom, Strands};
///
/// let points = vec![DVec3::ZERO, DVec3::X, DVec3::ONE];
/// let groom = Groom::new(Strands::from_counts([2, 1], points)?);
/// assert_eq!(defects(&groom).strands["of a single point"], (1, 1));
/// # Ok::<(), tress_geometry::OffsetsError>(())
/// ```
#[must_use]
pub fn defects(groom: &Groom) -> Defects {
    let mut found = Defects::default();
    for (i, points) in groom.strands().iter().enumerate() {
        if let Some(defect) = defect(points) {
            found.add(i, defect);
            continue;
        }
        found.repeated_points += repeated_points(points);
        let mean = length(points) / (points.len() - 1) as f64;
        if points.windows(2).any(|ends| LONG_SEGMENT * mean < ends[0].distance(ends[1])) {
            found.long_segments += 1;
            found.first_long_segment.get_or_insert(i);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use tress_geometry::Strands;

    use super::*;

    #[test]
    fn a_point_astray_and_repeated_points_are_counted() {
        let mut points: Vec<DVec3> = (0..40).map(|i| DVec3::X * f64::from(i)).collect();
        points[39] = DVec3::X * 1000.0;
        points.extend([DVec3::ZERO, DVec3::ZERO, DVec3::Y]);
        let groom = Groom::new(Strands::from_counts([40, 3], points).expect("43 points"));
        let found = defects(&groom);
        assert_eq!((found.long_segments, found.first_long_segment), (1, Some(0)));
        assert_eq!(found.repeated_points, 1);
        assert!(found.strands.is_empty() && !found.is_empty());
    }
}
