//! What a format has no place for, so that nothing is dropped without a word.

use std::fmt;

use tress_geometry::{Attributes, Groom, UpAxis};

use crate::Format;

/// Something that a groom has and a file does not.
///
/// Numbers narrowed from 64 to 32 bits are not counted as lost.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Loss {
    /// The unit of length, in metres.
    Unit(f64),
    /// The up axis.
    UpAxis(UpAxis),
    /// A column with one row a point, by name.
    PointAttribute(String),
    /// A column with one row a strand, by name.
    StrandAttribute(String),
    /// Colours are rounded to 8 bits a channel, and held within 0 to 1.
    ColorDepth,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unit(metres) => write!(f, "the unit ({metres} m)"),
            Self::UpAxis(axis) => write!(f, "the up axis ({axis:?})"),
            Self::PointAttribute(name) => write!(f, "point attribute {name:?}"),
            Self::StrandAttribute(name) => write!(f, "strand attribute {name:?}"),
            Self::ColorDepth => f.write_str("colours beyond 8 bits a channel"),
        }
    }
}

/// What of `groom` a file of `format` has no place for.
///
/// ```
/// use tress_geometry::{Column, Groom, Strands};
/// use tress_io::{Format, Loss, losses};
///
/// let mut groom = Groom::new(Strands::default()).in_space(Some(0.01), None);
/// groom.insert_strand_attribute("group", Column::Int(vec![]))?;
/// let lost = losses(&groom, Format::Hair);
/// assert_eq!(lost, [Loss::Unit(0.01), Loss::StrandAttribute("group".into())]);
/// assert_eq!(losses(&groom, Format::Npz), []);
/// # Ok::<(), tress_geometry::ColumnError>(())
/// ```
#[must_use]
pub fn losses(groom: &Groom, format: Format) -> Vec<Loss> {
    let carries = format.carries();
    let mut lost = Vec::new();
    lost.extend(groom.unit.filter(|_| !carries.unit).map(Loss::Unit));
    lost.extend(groom.up.filter(|_| !carries.up).map(Loss::UpAxis));
    let (points, strands) = (groom.point_attributes(), groom.strand_attributes());
    let dropped = |table: &Attributes, held: &dyn Fn(&str, usize) -> bool| -> Vec<String> {
        let columns = table.iter().filter(|(name, column)| !held(name, column.components()));
        columns.map(|(name, _)| name.to_owned()).collect()
    };
    let dropped_points = dropped(points, &|name, n| carries.point_columns.hold(name, n));
    lost.extend(dropped_points.into_iter().map(Loss::PointAttribute));
    let dropped_strands = dropped(strands, &|name, n| {
        carries.strand_columns.hold(name, n)
            || carries.point_columns.hold(name, n) && points.get(name).is_none()
    });
    lost.extend(dropped_strands.into_iter().map(Loss::StrandAttribute));
    if format == Format::Ply && crate::ply::rounds_colors(groom) {
        lost.push(Loss::ColorDepth);
    }
    lost
}
