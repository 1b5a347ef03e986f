//! Attribute columns as formats hold them: one row a point or a strand, of a known width.

use tress_geometry::{Column, ColumnError, Groom};

use crate::binary::same;
use crate::{ParseError, Place, Problem};

/// A column that a format has a place for.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'a> {
    column: &'a Column,
    components: usize,
}

impl<'a> Rows<'a> {
    fn new(column: &'a Column, components: usize) -> Option<Self> {
        (column.components() == components).then_some(Self { column, components })
    }

    /// The column of points of this name, if it has so many components.
    pub(crate) fn of_points(groom: &'a Groom, name: &str, components: usize) -> Option<Self> {
        Self::new(groom.point_attributes().get(name)?, components)
    }

    /// The column of strands of this name, if it has so many components.
    pub(crate) fn of_strands(groom: &'a Groom, name: &str, components: usize) -> Option<Self> {
        Self::new(groom.strand_attributes().get(name)?, components)
    }

    /// One number.
    pub(crate) fn get(&self, row: usize, component: usize) -> f64 {
        match self.column {
            Column::Float { values, .. } => values[row * self.components + component],
            Column::Int(values) => values[row] as f64,
        }
    }

    /// The numbers of one row.
    pub(crate) fn row<const N: usize>(&self, row: usize) -> [f64; N] {
        std::array::from_fn(|component| self.get(row, component))
    }

    /// All numbers.
    pub(crate) fn iter(&self) -> impl Iterator<Item = f64> {
        let numbers = 0..self.column.rows() * self.components;
        numbers.map(|i| self.get(i / self.components, i % self.components))
    }

    /// The one row that all rows are equal to, bit for bit.
    pub(crate) fn constant<const N: usize>(&self) -> Option<[f64; N]> {
        let n = self.column.rows();
        let first = (0 < n).then(|| self.row::<N>(0))?;
        (1..n).all(|row| same(self.row::<N>(row), first)).then_some(first)
    }
}

/// A value for every point: the points' own, or their strand's.
pub(crate) enum PointValues<'a> {
    /// Rows by point.
    Own(Rows<'a>),
    /// Rows by strand.
    Strands(Rows<'a>),
}

impl<'a> PointValues<'a> {
    /// The column of points of this name, else that of strands.
    pub(crate) fn new(groom: &'a Groom, name: &str, components: usize) -> Option<Self> {
        if groom.point_attributes().get(name).is_some() {
            return Rows::of_points(groom, name, components).map(Self::Own);
        }
        Rows::of_strands(groom, name, components).map(Self::Strands)
    }

    /// One number of a point of a strand.
    pub(crate) fn get(&self, strand: usize, point: usize, component: usize) -> f64 {
        match self {
            Self::Own(rows) => rows.get(point, component),
            Self::Strands(rows) => rows.get(strand, component),
        }
    }

    /// The values of a point of a strand.
    pub(crate) fn row<const N: usize>(&self, strand: usize, point: usize) -> [f64; N] {
        match self {
            Self::Own(rows) => rows.row(point),
            Self::Strands(rows) => rows.row(strand),
        }
    }
}

/// The strand and the place in the flat array of every point.
pub(crate) fn every_point(groom: &Groom) -> impl Iterator<Item = (usize, usize)> {
    let strands = groom.strands();
    (0..strands.len()).flat_map(|i| strands.range(i).map(move |point| (i, point)))
}

/// A column that does not fit the strands, as an error of the whole file.
pub(crate) fn misfit(error: ColumnError) -> ParseError {
    Problem::Unsupported(error.to_string()).at(Place::File)
}
