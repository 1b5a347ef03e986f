//! Boxes around points.

use glam::DVec3;
use tress_geometry::Groom;

/// The smallest axis-aligned box around points; may be empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    /// The least coordinates.
    pub(crate) min: DVec3,
    /// The greatest coordinates; less than `min` when the box is empty.
    pub(crate) max: DVec3,
}

impl Bounds {
    /// The box that holds nothing.
    pub(crate) const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The box around the points that are finite.
    #[must_use]
    pub(crate) fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let finite = points.into_iter().filter(|point| point.is_finite());
        finite.fold(Self::EMPTY, |b, p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The box around a groom.
    #[must_use]
    pub(crate) fn of(groom: &Groom) -> Self {
        Self::around(groom.strands().points().iter().copied())
    }

    /// The middle of the box; the origin when it is empty.
    #[must_use]
    pub(crate) fn center(self) -> DVec3 {
        if self.is_empty() { DVec3::ZERO } else { 0.5 * self.min + 0.5 * self.max }
    }

    /// Half of the edges' lengths; zero when the box is empty.
    ///
    /// Halves, because the whole of a box that spans the numbers would not be a number.
    #[must_use]
    pub(crate) fn half_extent(self) -> DVec3 {
        if self.is_empty() { DVec3::ZERO } else { 0.5 * self.max - 0.5 * self.min }
    }

    /// Whether the box holds nothing.
    #[must_use]
    pub(crate) fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }
}
