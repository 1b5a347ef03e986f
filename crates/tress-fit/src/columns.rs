//! Columns of attributes made of others.

use tress_geometry::Column;

/// A column of `rows` zeros of the kind of `column`.
pub(crate) fn zeros_like(column: &Column, rows: usize) -> Column {
    match column {
        Column::Float { components, .. } => {
            Column::Float { components: *components, values: vec![0.0; rows * components] }
        }
        Column::Int(_) => Column::Int(vec![0; rows]),
    }
}

/// The rows of one column behind those of another; `None` when they are of different kinds.
pub(crate) fn joined(first: &Column, second: &Column) -> Option<Column> {
    match (first, second) {
        (
            Column::Float { components: m, values: a },
            Column::Float { components: n, values: b },
        ) if m == n => Some(Column::Float { components: *m, values: [&a[..], &b[..]].concat() }),
        (Column::Int(a), Column::Int(b)) => Some(Column::Int([&a[..], &b[..]].concat())),
        _ => None,
    }
}
