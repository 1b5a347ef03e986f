//! Boxes around points.

use glam::DVec3;
use tress_geometry::Groom;

/// The smallest axis-aligned box around points; may be empty.
///
/// ```
/// use glam::DVec3;
/// use tress_view::Bounds;
///
/// let a = Bounds::around([DVec3::ZERO, DVec3::X, DVec3::NAN]);
/// let b = Bounds::around([DVec3::new(0.0, 2.0, 0.0)]);
/// assert_eq!(a.union(b), Bounds { min: DVec3::ZERO, max: DVec3::new(1.0, 2.0, 0.0) });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least coordinates.
    pub min: DVec3,
    /// The greatest coordinates; less than `min` when the box is empty.
    pub max: DVec3,
}

impl Bounds {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The box around the points that are finite.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let finite = points.into_iter().filter(|point| point.is_finite());
        finite.fold(Self::EMPTY, |b, p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The box around a groom.
    #[must_use]
    pub fn of(groom: &Groom) -> Self {
        Self::around(groom.strands().points().iter().copied())
    }

    /// The box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The eight corners; not finite when the box is empty.
    #[must_use]
    pub fn corners(self) -> [DVec3; 8] {
        let Self { min: a, max: b } = self;
        [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
            let pick = |bit: u8, a: f64, b: f64| if i & bit == 0 { a } else { b };
            DVec3::new(pick(1, a.x, b.x), pick(2, a.y, b.y), pick(4, a.z, b.z))
        })
    }

    /// The middle of the box; the origin when it is empty.
    #[must_use]
    pub fn center(self) -> DVec3 {
        if self.is_empty() { DVec3::ZERO } else { 0.5 * self.min + 0.5 * self.max }
    }

    /// Half of the edges' lengths; zero when the box is empty.
    ///
    /// Halves, because the whole of a box that spans the numbers would not be a number.
    #[must_use]
    pub fn half_extent(self) -> DVec3 {
        if self.is_empty() { DVec3::ZERO } else { 0.5 * self.max - 0.5 * self.min }
    }

    /// Whether the box holds nothing.
    #[must_use]
    pub fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }
}
