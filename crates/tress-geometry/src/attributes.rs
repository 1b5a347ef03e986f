//! Named columns of numbers that travel with a groom, one row a strand or a point.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Names that readers, writers and pictures agree on.
pub mod names {
    /// Hair diameter, in the groom's unit; per strand or per point.
    pub const WIDTH: &str = "width";
    /// Red, green, blue in 0 to 1; per strand or per point.
    pub const COLOR: &str = "color";
    /// Opacity, 1 for an opaque hair; per strand or per point.
    pub const OPACITY: &str = "opacity";
    /// Texture coordinates of the root on the scalp; per strand.
    pub const ROOT_UV: &str = "uv";
    /// A whole number that names the group a strand belongs to; per strand.
    pub const GROUP: &str = "group";
}

/// One attribute: rows of numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Column {
    /// `components` floating-point numbers a row, row after row.
    Float {
        /// Numbers in a row: 1 for a width, 2 for texture coordinates, 3 for a colour.
        components: usize,
        /// All rows, one after the other.
        values: Vec<f64>,
    },
    /// One whole number a row.
    Int(Vec<i64>),
}

/// Why a column cannot be attached.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ColumnError {
    /// The number of rows is not the number of strands or points.
    ///
    /// ```
    /// # use tress_geometry::{Attributes, Column, ColumnError};
    /// let mut attributes = Attributes::new(2);
    /// let error = attributes.insert("width", Column::scalar(vec![0.1])).unwrap_err();
    /// assert!(matches!(error, ColumnError::Rows { rows: 1, expected: 2, .. }));
    /// ```
    #[error("attribute {name:?} has {rows} rows, expected {expected}")]
    Rows {
        /// The attribute's name.
        name: String,
        /// Rows it has.
        rows: usize,
        /// Rows it should have.
        expected: usize,
    },
    /// The values do not divide into rows.
    ///
    /// ```
    /// # use tress_geometry::{Attributes, Column, ColumnError};
    /// let mut attributes = Attributes::new(1);
    /// let ragged = Column::Float { components: 2, values: vec![0.0; 3] };
    /// let error = attributes.insert("uv", ragged).unwrap_err();
    /// assert!(matches!(error, ColumnError::Ragged { components: 2, .. }));
    /// ```
    #[error("attribute {name:?} has {values} values, which do not make rows of {components}")]
    Ragged {
        /// The attribute's name.
        name: String,
        /// Values it has.
        values: usize,
        /// Numbers a row.
        components: usize,
    },
    /// Tables that are to be joined do not have the same columns.
    ///
    /// ```
    /// # use tress_geometry::{Attributes, Column, ColumnError};
    /// let mut with = Attributes::new(1);
    /// with.insert("width", Column::scalar(vec![0.1]))?;
    /// let error = with.append(&Attributes::new(2)).unwrap_err();
    /// assert_eq!(error, ColumnError::Unlike { name: "width".into() });
    /// # Ok::<(), ColumnError>(())
    /// ```
    #[error("attribute {name:?} is not there, or not of the same kind, in all parts")]
    Unlike {
        /// The attribute that is not in both.
        name: String,
    },
}

impl Column {
    /// One floating-point number a row.
    #[must_use]
    pub fn scalar(values: Vec<f64>) -> Self {
        Self::Float { components: 1, values }
    }

    /// Numbers in a row.
    #[must_use]
    pub fn components(&self) -> usize {
        match self {
            Self::Float { components, .. } => *components,
            Self::Int(_) => 1,
        }
    }

    /// How many rows there are; a last row cut short counts as none.
    #[must_use]
    pub fn rows(&self) -> usize {
        match self {
            Self::Float { components, values } => {
                values.len().checked_div(*components).unwrap_or(0)
            }
            Self::Int(values) => values.len(),
        }
    }

    /// The first number of each row, for colouring and statistics.
    pub fn first_components(&self) -> impl Iterator<Item = f64> {
        let (floats, ints): (&[f64], &[i64]) = match self {
            Self::Float { values, .. } => (values, &[]),
            Self::Int(values) => (&[], values),
        };
        let step = self.components().max(1);
        floats.iter().step_by(step).copied().chain(ints.iter().map(|&i| i as f64))
    }

    /// The rows named by `rows`, in that order; rows may repeat.
    ///
    /// # Panics
    ///
    /// If a row is not there.
    #[must_use]
    pub fn select(&self, rows: impl IntoIterator<Item = usize>) -> Self {
        match self {
            Self::Float { components, values } => {
                let n = *components;
                let picked =
                    rows.into_iter().flat_map(|i| values[i * n..(i + 1) * n].iter().copied());
                Self::Float { components: n, values: picked.collect() }
            }
            Self::Int(values) => Self::Int(rows.into_iter().map(|i| values[i]).collect()),
        }
    }

    /// The values between rows: row `i + f` for each `(i, f)`, mixed linearly; whole numbers are
    /// taken from the nearer row.
    ///
    /// # Panics
    ///
    /// If a row `i`, or `i + 1` where `f` is not 0, is not there.
    #[must_use]
    pub fn interpolate(&self, places: impl IntoIterator<Item = (usize, f64)>) -> Self {
        match self {
            Self::Float { components, values } => {
                let n = *components;
                let mut mixed = Vec::new();
                for (i, f) in places {
                    let a = &values[i * n..(i + 1) * n];
                    if f == 0.0 {
                        mixed.extend_from_slice(a);
                        continue;
                    }
                    let b = &values[(i + 1) * n..(i + 2) * n];
                    mixed.extend(a.iter().zip(b).map(|(a, b)| a + (b - a) * f));
                }
                Self::Float { components: n, values: mixed }
            }
            Self::Int(values) => {
                let near = |(i, f): (usize, f64)| if f < 0.5 { values[i] } else { values[i + 1] };
                Self::Int(places.into_iter().map(near).collect())
            }
        }
    }

    /// The rows of this column and behind them those of `other`, which must be of the same kind.
    fn append(&mut self, other: &Self) -> bool {
        match (self, other) {
            (Self::Int(rows), Self::Int(more)) => rows.extend_from_slice(more),
            (
                Self::Float { components, values },
                Self::Float { components: same, values: more },
            ) if components == same => values.extend_from_slice(more),
            _ => return false,
        }
        true
    }

    fn check(&self, name: &str, expected: usize) -> Result<(), ColumnError> {
        if let Self::Float { components, values } = self
            && (*components == 0 || !values.len().is_multiple_of(*components))
        {
            let (values, components) = (values.len(), *components);
            return Err(ColumnError::Ragged { name: name.into(), values, components });
        }
        let rows = self.rows();
        if rows != expected {
            return Err(ColumnError::Rows { name: name.into(), rows, expected });
        }
        Ok(())
    }
}

/// Columns by name, all with the same number of rows.
///
/// ```
/// use tress_geometry::{Attributes, Column, names};
///
/// let mut attributes = Attributes::new(3);
/// attributes.insert(names::GROUP, Column::Int(vec![0, 0, 1]))?;
/// assert_eq!(attributes.get("group").map(Column::rows), Some(3));
/// # Ok::<(), tress_geometry::ColumnError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    // Invariant: every column has `rows` rows.
    rows: usize,
    columns: BTreeMap<String, Column>,
}

impl Attributes {
    /// No columns yet, for `rows` strands or points.
    #[must_use]
    pub fn new(rows: usize) -> Self {
        Self { rows, columns: BTreeMap::new() }
    }

    /// How many rows every column has.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Attaches a column; one of the same name is replaced and returned.
    ///
    /// # Errors
    ///
    /// If its rows do not match; see [`ColumnError`].
    pub fn insert(
        &mut self,
        name: impl Into<String>,
        column: Column,
    ) -> Result<Option<Column>, ColumnError> {
        let name = name.into();
        column.check(&name, self.rows)?;
        Ok(self.columns.insert(name, column))
    }

    /// Takes a column away.
    pub fn remove(&mut self, name: &str) -> Option<Column> {
        self.columns.remove(name)
    }

    /// The column of this name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Column> {
        self.columns.get(name)
    }

    /// All columns, by name.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, &Column)> {
        self.columns.iter().map(|(name, column)| (name.as_str(), column))
    }

    /// Whether there is no column.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// Appends the rows of another table with the same columns.
    ///
    /// # Errors
    ///
    /// If a column is missing in one of them or of another kind; nothing is appended then.
    pub fn append(&mut self, other: &Self) -> Result<(), ColumnError> {
        let names = || self.columns.keys().chain(other.columns.keys());
        let unlike = |name: &&String| match (self.columns.get(*name), other.columns.get(*name)) {
            (Some(a), Some(b)) => !a.select([]).append(&b.select([])),
            _ => true,
        };
        if let Some(name) = names().find(unlike) {
            return Err(ColumnError::Unlike { name: name.clone() });
        }
        for (name, column) in &mut self.columns {
            column.append(&other.columns[name]);
        }
        self.rows += other.rows;
        Ok(())
    }

    /// The same columns with other rows, each made by `change`.
    ///
    /// # Panics
    ///
    /// If `change` does not return columns of `rows` rows.
    #[must_use]
    pub fn map(&self, rows: usize, mut change: impl FnMut(&Column) -> Column) -> Self {
        let mut changed = Self::new(rows);
        for (name, column) in self.iter() {
            changed.insert(name, change(column)).expect("`change` keeps to the number of rows");
        }
        changed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_picked_and_mixed() {
        let uv = Column::Float { components: 2, values: vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0] };
        let picked = uv.select([2, 0]);
        assert_eq!(picked, Column::Float { components: 2, values: vec![4.0, 5.0, 0.0, 1.0] });
        let mixed = uv.interpolate([(0, 0.5), (2, 0.0)]);
        assert_eq!(mixed, Column::Float { components: 2, values: vec![1.0, 2.0, 4.0, 5.0] });
        let ids = Column::Int(vec![7, 9]).interpolate([(0, 0.4), (0, 0.6), (1, 0.0)]);
        assert_eq!(ids, Column::Int(vec![7, 9, 9]));
    }

    #[test]
    fn the_first_number_of_a_row_stands_for_it() {
        let color = Column::Float { components: 3, values: (0..6).map(f64::from).collect() };
        assert_eq!((color.components(), color.rows()), (3, 2));
        assert_eq!(color.first_components().collect::<Vec<_>>(), [0.0, 3.0]);
        let ids = Column::Int(vec![7, -9]);
        assert_eq!((ids.components(), ids.rows()), (1, 2));
        assert_eq!(ids.first_components().collect::<Vec<_>>(), [7.0, -9.0]);
    }

    #[test]
    fn tables_with_the_same_columns_join_row_after_row() {
        let table = |ids: &[i64], uv: &[f64]| {
            let mut table = Attributes::new(ids.len());
            table.insert("id", Column::Int(ids.to_vec())).expect("a row an id");
            let uv = Column::Float { components: 2, values: uv.to_vec() };
            table.insert("uv", uv).expect("two numbers an id");
            table
        };
        let mut joined = table(&[1], &[0.0, 1.0]);
        joined.append(&table(&[2, 3], &[2.0, 3.0, 4.0, 5.0])).expect("the same columns");
        let whole = table(&[1, 2, 3], &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(joined, whole);
        // Of the same name, but single numbers.
        let mut other = table(&[4], &[6.0, 7.0]);
        other.insert("uv", Column::scalar(vec![8.0])).expect("a number a row");
        let unlike = ColumnError::Unlike { name: "uv".into() };
        assert_eq!(joined.append(&other), Err(unlike));
        assert_eq!(joined, whole);
    }

    #[test]
    fn zero_components_are_refused() {
        let none = Column::Float { components: 0, values: vec![] };
        assert!(Attributes::new(0).insert("none", none).is_err());
    }
}
