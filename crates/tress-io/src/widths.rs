//! The box around a groom, and the diameters of its strands.

use glam::DVec3;
use tress_geometry::{Column, Groom, names};

/// Diameter of a hair that says nothing of it, in metres: between fine (0.05 mm) and thick
/// (0.12 mm) hair.
const HAIR: f64 = 1e-4;
/// The same over the diagonal of the box around a groom, where the unit is unknown: a head of
/// hair is some 0.4 m across.
const HAIR_OVER_SIZE: f64 = 1.0 / 4000.0;

/// The box around the finite points, if there are any.
pub(crate) struct Extent(Option<(DVec3, DVec3)>);

impl Extent {
    pub(crate) fn of(groom: &Groom) -> Self {
        let outside_in = (DVec3::MAX, DVec3::MIN);
        let finite = groom.strands().points().iter().filter(|point| point.is_finite());
        let (low, high) =
            finite.fold(outside_in, |(low, high), &point| (low.min(point), high.max(point)));
        Self((low.x <= high.x).then_some((low, high)))
    }

    fn size(&self) -> f64 {
        self.0.map_or(0.0, |(low, high)| low.distance(high))
    }

    /// The box with half the greatest width around it.
    pub(crate) fn with(&self, widths: &Widths<'_>) -> Option<(DVec3, DVec3)> {
        let margin = 0.5 * widths.greatest();
        self.0.map(|(low, high)| (low - margin, high + margin))
    }
}

/// Diameters of the strands.
pub(crate) enum Widths<'a> {
    Constant(f64),
    Uniform(&'a [f64]),
    Vertex(&'a [f64]),
}

impl<'a> Widths<'a> {
    /// The groom's own, or one for all of a hair's size: tools differ wildly in what they assume.
    pub(crate) fn of(groom: &'a Groom) -> Self {
        let values = |column: Option<&'a Column>| match column {
            Some(Column::Float { components: 1, values }) => Some(values.as_slice()),
            _ => None,
        };
        if let Some(values) = values(groom.point_attributes().get(names::WIDTH)) {
            return Self::Vertex(values);
        }
        if let Some(values) = values(groom.strand_attributes().get(names::WIDTH)) {
            return Self::Uniform(values);
        }
        let of_size = || {
            let width = Extent::of(groom).size() * HAIR_OVER_SIZE;
            if 0.0 < width { width } else { HAIR }
        };
        Self::Constant(groom.unit.map_or_else(of_size, |metres| HAIR / metres))
    }

    fn greatest(&self) -> f64 {
        let values = match self {
            Self::Constant(width) => return *width,
            Self::Uniform(values) | Self::Vertex(values) => values,
        };
        values.iter().copied().filter(|width| width.is_finite()).fold(0.0, f64::max)
    }
}

/// Whether a column is what [`Widths`] holds.
pub(crate) fn is_width(name: &str, column: &Column) -> bool {
    name == names::WIDTH && matches!(column, Column::Float { components: 1, .. })
}
