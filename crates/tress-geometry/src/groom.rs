//! A groom: polylines with attributes, the unit they are in and the axis that is up.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::{Attributes, Column, ColumnError, OffsetsError, Strands};

/// The axis that points away from the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum UpAxis {
    /// Film and game tools: Maya, Houdini, Alembic from Blender.
    Y,
    /// Blender and CAD.
    Z,
}

/// Polylines with attributes: what files hold and what edits give back.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Column, Groom, Strands, names};
///
/// let strands = Strands::from_counts([2, 1], vec![DVec3::ZERO, DVec3::X, DVec3::Y])?;
/// let mut groom = Groom::new(strands);
/// groom.insert_strand_attribute(names::GROUP, Column::Int(vec![4, 5]))?;
/// groom.unit = Some(0.01); // centimetres
/// assert_eq!(groom.strands().len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Groom {
    /// Metres in one unit of length, where it is known.
    pub unit: Option<f64>,
    /// The axis that is up, where it is known.
    pub up: Option<UpAxis>,
    // Invariant: the attributes have a row a point and a row a strand.
    strands: Strands<DVec3>,
    point_attributes: Attributes,
    strand_attributes: Attributes,
}

/// Why parts do not make a groom.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GroomError {
    /// Attribute tables without a row for each point or each strand.
    ///
    /// ```
    /// # use tress_geometry::{Attributes, Groom, GroomError, Strands};
    /// let none = Strands::default();
    /// let error = Groom::with_attributes(none, Attributes::new(1), Attributes::new(0));
    /// assert_eq!(error, Err(GroomError::Rows { of: "points", rows: 1, expected: 0 }));
    /// ```
    #[error("the attributes of {of} have {rows} rows, expected {expected}")]
    Rows {
        /// Points, strands, joints ...
        of: &'static str,
        /// Rows in the table.
        rows: usize,
        /// Rows there should be.
        expected: usize,
    },
    /// A kept polyline that names no strand, one with elements, or not in ascending order.
    #[error(
        "kept polyline {entry} stands for strand {strand}, which is not there, has elements or is \
         out of order"
    )]
    Kept {
        /// Which of the kept polylines.
        entry: usize,
        /// The strand it says it is.
        strand: u32,
    },
    /// Not one root frame a strand.
    #[error("{roots} root frames for {strands} strands")]
    Roots {
        /// Root frames given.
        roots: usize,
        /// Strands given.
        strands: usize,
    },
}

/// Why grooms cannot be joined to one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JoinError {
    /// The parts are in different units or have different axes up.
    #[error("the parts do not agree on {0}")]
    Space(&'static str),
    /// The parts have different attributes.
    #[error(transparent)]
    Attributes(#[from] ColumnError),
    /// Together they have more points than offsets can tell apart.
    #[error(transparent)]
    Offsets(#[from] OffsetsError),
}

/// An error unless two parts are in the same unit with the same axis up.
pub(crate) fn check_space(
    a: (Option<f64>, Option<UpAxis>),
    b: (Option<f64>, Option<UpAxis>),
) -> Result<(), JoinError> {
    if a.0 != b.0 {
        return Err(JoinError::Space("the unit"));
    }
    if a.1 != b.1 {
        return Err(JoinError::Space("the axis that is up"));
    }
    Ok(())
}

/// An error unless the table has the rows it should.
pub(crate) fn check_rows(
    of: &'static str,
    table: &Attributes,
    expected: usize,
) -> Result<(), GroomError> {
    let rows = table.rows();
    if rows == expected { Ok(()) } else { Err(GroomError::Rows { of, rows, expected }) }
}

impl Groom {
    /// Strands without attributes, unit and up axis unknown.
    #[must_use]
    pub fn new(strands: Strands<DVec3>) -> Self {
        let point_attributes = Attributes::new(strands.points().len());
        let strand_attributes = Attributes::new(strands.len());
        Self { unit: None, up: None, strands, point_attributes, strand_attributes }
    }

    /// Strands with attributes of points and of strands.
    ///
    /// # Errors
    ///
    /// If an attribute table has not one row for each.
    pub fn with_attributes(
        strands: Strands<DVec3>,
        point_attributes: Attributes,
        strand_attributes: Attributes,
    ) -> Result<Self, GroomError> {
        check_rows("points", &point_attributes, strands.points().len())?;
        check_rows("strands", &strand_attributes, strands.len())?;
        Ok(Self { unit: None, up: None, strands, point_attributes, strand_attributes })
    }

    /// The same groom, said to be in this unit and with this axis up.
    #[must_use]
    pub fn in_space(mut self, unit: Option<f64>, up: Option<UpAxis>) -> Self {
        self.unit = unit;
        self.up = up;
        self
    }

    /// The polylines.
    #[must_use]
    pub fn strands(&self) -> &Strands<DVec3> {
        &self.strands
    }

    /// The positions, to be moved.
    pub fn positions_mut(&mut self) -> &mut [DVec3] {
        self.strands.points_mut()
    }

    /// Columns with one row a point.
    #[must_use]
    pub fn point_attributes(&self) -> &Attributes {
        &self.point_attributes
    }

    /// Columns with one row a strand.
    #[must_use]
    pub fn strand_attributes(&self) -> &Attributes {
        &self.strand_attributes
    }

    /// Attaches a column with one row a point; one of the same name is replaced.
    ///
    /// # Errors
    ///
    /// If there is not one row a point.
    pub fn insert_point_attribute(
        &mut self,
        name: impl Into<String>,
        column: Column,
    ) -> Result<(), ColumnError> {
        self.point_attributes.insert(name, column).map(drop)
    }

    /// Attaches a column with one row a strand; one of the same name is replaced.
    ///
    /// # Errors
    ///
    /// If there is not one row a strand.
    pub fn insert_strand_attribute(
        &mut self,
        name: impl Into<String>,
        column: Column,
    ) -> Result<(), ColumnError> {
        self.strand_attributes.insert(name, column).map(drop)
    }

    /// Takes a column of points away.
    pub fn remove_point_attribute(&mut self, name: &str) -> Option<Column> {
        self.point_attributes.remove(name)
    }

    /// Takes a column of strands away.
    pub fn remove_strand_attribute(&mut self, name: &str) -> Option<Column> {
        self.strand_attributes.remove(name)
    }

    /// A column with one number a strand: the strand's own, or the mean of its points'.
    ///
    /// `None` when there is no attribute of this name. A strand without points gets NaN from a
    /// column of points.
    #[must_use]
    pub fn strand_values(&self, name: &str) -> Option<Vec<f64>> {
        if let Some(column) = self.strand_attributes.get(name) {
            return Some(column.first_components().collect());
        }
        let values: Vec<f64> = self.point_attributes.get(name)?.first_components().collect();
        let mean = |i| {
            let range: std::ops::Range<usize> = self.strands.range(i);
            let n = range.len() as f64;
            values[range].iter().sum::<f64>() / n
        };
        Some((0..self.strands.len()).map(mean).collect())
    }

    /// The groom turned so that `up` is its up axis; unchanged when its own is unknown.
    ///
    /// Z-up `(x, y, z)` is Y-up `(x, z, -y)`. Only positions turn; a vector kept as an attribute
    /// does not.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_geometry::{Groom, Strands, UpAxis};
    ///
    /// let strands = Strands::from_counts([1], vec![DVec3::new(1.0, 2.0, 3.0)])?;
    /// let groom = Groom::new(strands).in_space(None, Some(UpAxis::Z)).with_up(UpAxis::Y);
    /// assert_eq!(groom.strands().points(), [DVec3::new(1.0, 3.0, -2.0)]);
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[must_use]
    pub fn with_up(mut self, up: UpAxis) -> Self {
        let turn: fn(DVec3) -> DVec3 = match (self.up, up) {
            (Some(UpAxis::Z), UpAxis::Y) => |p| DVec3::new(p.x, p.z, -p.y),
            (Some(UpAxis::Y), UpAxis::Z) => |p| DVec3::new(p.x, -p.z, p.y),
            _ => return self,
        };
        self.up = Some(up);
        self.positions_mut().iter_mut().for_each(|p| *p = turn(*p));
        self
    }

    /// Appends the strands of another groom.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_geometry::{Groom, Strands};
    ///
    /// let mut groom = Groom::new(Strands::from_counts([1], vec![DVec3::X])?);
    /// groom.append(&Groom::new(Strands::from_counts([1], vec![DVec3::Y])?))?;
    /// assert_eq!(groom.strands().strand(1), [DVec3::Y]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If the other is in another unit, has another axis up or other attributes, or if both have
    /// too many points; this groom is then as it was.
    pub fn append(&mut self, other: &Self) -> Result<(), JoinError> {
        check_space((self.unit, self.up), (other.unit, other.up))?;
        let mut joined = self.clone();
        joined.point_attributes.append(&other.point_attributes)?;
        joined.strand_attributes.append(&other.strand_attributes)?;
        joined.strands.append(&other.strands)?;
        *self = joined;
        Ok(())
    }

    /// The strands named, in that order, with their attributes.
    ///
    /// # Panics
    ///
    /// If a strand is not there.
    #[must_use]
    pub fn select(&self, strands: &[usize]) -> Self {
        let selected = self.strands.select(strands.iter().copied());
        let n_points = selected.points().len();
        let points = || strands.iter().flat_map(|&i| self.strands.range(i));
        Self {
            unit: self.unit,
            up: self.up,
            strands: selected,
            point_attributes: self.point_attributes.map(n_points, |c| c.select(points())),
            strand_attributes: self
                .strand_attributes
                .map(strands.len(), |c| c.select(strands.iter().copied())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn groom() -> Groom {
        let points = (0..5).map(|i| DVec3::new(f64::from(i), 1.0, 2.0)).collect();
        let strands = Strands::from_counts([2, 0, 3], points).expect("counts sum to 5");
        let mut groom = Groom::new(strands).in_space(Some(0.01), Some(UpAxis::Z));
        groom
            .insert_point_attribute("width", Column::scalar(vec![1.0, 3.0, 4.0, 5.0, 6.0]))
            .unwrap();
        groom.insert_strand_attribute("id", Column::Int(vec![10, 11, 12])).unwrap();
        groom
    }

    #[test]
    fn selecting_takes_attributes_along() {
        let picked = groom().select(&[2, 0]);
        assert_eq!(picked.strands().points()[0], DVec3::new(2.0, 1.0, 2.0));
        assert_eq!(picked.strand_attributes().get("id"), Some(&Column::Int(vec![12, 10])));
        let widths = Column::scalar(vec![4.0, 5.0, 6.0, 1.0, 3.0]);
        assert_eq!(picked.point_attributes().get("width"), Some(&widths));
    }

    #[test]
    fn strand_values_are_means_of_point_values() {
        let values = groom().strand_values("width").expect("a width");
        assert_eq!((values[0], values[2]), (2.0, 5.0));
        assert!(values[1].is_nan());
        assert_eq!(groom().strand_values("id"), Some(vec![10.0, 11.0, 12.0]));
        assert_eq!(groom().strand_values("none"), None);
    }

    #[test]
    fn turning_there_and_back_changes_nothing() {
        assert_eq!(groom().with_up(UpAxis::Y).with_up(UpAxis::Z), groom());
        let unknown = groom().in_space(None, None);
        assert_eq!(unknown.clone().with_up(UpAxis::Y), unknown);
    }
}
