//! What the rows of an attribute of curves stand for, and where they go in a groom.

use tress_geometry::{Column, ColumnError, Groom};

use super::BasisCurves;

/// What an attribute has a row for: USD's interpolation, Alembic's geometry scope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rows {
    /// Once.
    Constant,
    /// Each curve.
    Uniform,
    /// Each knot: both ends of every segment.
    Varying,
    /// Each control point.
    Vertex,
}

/// Why an attribute does not fit its curves.
#[derive(Debug, thiserror::Error)]
pub(crate) enum AttachError {
    /// The number of rows is that of nothing there is.
    #[error(
        "{rows} rows, where there are {curves} curves, {knots} knots and {points} control points"
    )]
    Rows {
        /// Rows found.
        rows: usize,
        /// Rows of a uniform attribute.
        curves: usize,
        /// Rows of a varying attribute.
        knots: usize,
        /// Rows of a vertex attribute.
        points: usize,
    },
    /// The values do not make rows.
    #[error(transparent)]
    Column(#[from] ColumnError),
}

/// Adds an attribute of `curves` to the groom that they became: as a column of strands if it is
/// constant or uniform, else of points.
pub(crate) fn attach(
    groom: &mut Groom,
    curves: &BasisCurves,
    name: &str,
    column: Column,
    declared: Rows,
) -> Result<(), AttachError> {
    let rows = column.rows();
    let Some(meant) = meaning(declared, rows, curves) else {
        let (knots, points) = (curves.knots(), curves.control_points());
        return Err(AttachError::Rows { rows, curves: curves.len(), knots, points });
    };
    match meant {
        Rows::Constant => {
            let everywhere = column.select((0..curves.len()).map(|_| 0));
            groom.insert_strand_attribute(name, everywhere)?;
        }
        Rows::Uniform => groom.insert_strand_attribute(name, column)?,
        Rows::Varying => groom.insert_point_attribute(name, curves.at_knots(column))?,
        Rows::Vertex => groom.insert_point_attribute(name, curves.at_control_points(column))?,
    }
    Ok(())
}

/// What `rows` rows are, where files say one thing and mean another: exporters call a single value
/// `vertex`, and take `vertex` and `varying` for the same.
fn meaning(declared: Rows, rows: usize, curves: &BasisCurves) -> Option<Rows> {
    let expected = |rows| match rows {
        Rows::Constant => 1,
        Rows::Uniform => curves.len(),
        Rows::Varying => curves.knots(),
        Rows::Vertex => curves.control_points(),
    };
    let others: &[Rows] = match declared {
        Rows::Constant => &[],
        Rows::Uniform => &[Rows::Constant],
        Rows::Varying => &[Rows::Vertex, Rows::Constant],
        Rows::Vertex => &[Rows::Varying, Rows::Constant],
    };
    let mut candidates = std::iter::once(declared).chain(others.iter().copied());
    candidates.find(|&candidate| expected(candidate) == rows)
}
