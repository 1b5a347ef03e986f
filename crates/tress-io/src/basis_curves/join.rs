//! Several batches of curves as one groom.

use std::collections::BTreeSet;

use tress_geometry::{Attributes, Column, Groom, OffsetsError, Strands, names};

/// Name of the column that tells batches apart where `group` is taken.
const PRIM: &str = "prim";

/// The strands of all parts, in order.
///
/// A column stays if every part with strands has it with the same number of components: a strand
/// of a part without it would have no value. Where one part has it for each strand and another for
/// each point, it becomes one for each point. Where there are several parts with strands, the
/// strand column `group` says which part a strand is from; where that name is taken, `prim` does.
///
/// # Errors
///
/// If there are more points than 32 bits tell apart.
pub(crate) fn join(mut parts: Vec<Groom>) -> Result<Groom, OffsetsError> {
    if 1 < parts.len() {
        parts.retain(|part| !part.strands().is_empty());
    }
    if parts.len() <= 1 {
        return Ok(parts.pop().unwrap_or_else(|| Groom::new(Strands::default())));
    }
    let counts: Vec<usize> = parts.iter().flat_map(|part| part.strands().counts()).collect();
    let points = parts.iter().flat_map(|part| part.strands().points().iter().copied()).collect();
    let mut joined = Groom::new(Strands::from_counts(counts, points)?);

    let tables = parts.iter().flat_map(|part| [part.point_attributes(), part.strand_attributes()]);
    let columns: BTreeSet<&str> = tables.flat_map(|table| table.iter().map(|row| row.0)).collect();
    for &name in &columns {
        let of_strands = collect(&parts, |part| column(part.strand_attributes(), name));
        let (column, of_strands) = match of_strands {
            Some(column) => (Some(column), true),
            None => (collect(&parts, |part| point_column(part, name)), false),
        };
        let inserted = match column {
            Some(column) if of_strands => joined.insert_strand_attribute(name, column),
            Some(column) => joined.insert_point_attribute(name, column),
            None => Ok(()),
        };
        inserted.expect("the parts' rows are the joined rows");
    }
    let groups = parts
        .iter()
        .zip(0_i64..)
        .flat_map(|(part, i)| std::iter::repeat_n(i, part.strands().len()));
    let groups = Column::Int(groups.collect());
    let taken = columns.contains(names::GROUP);
    let name = if taken { PRIM } else { names::GROUP };
    joined.insert_strand_attribute(name, groups).expect("one number a strand");
    Ok(joined)
}

fn column(attributes: &Attributes, name: &str) -> Option<Column> {
    attributes.get(name).cloned()
}

/// A column of points, or one of strands with each row given to all points of its strand.
fn point_column(part: &Groom, name: &str) -> Option<Column> {
    column(part.point_attributes(), name).or_else(|| {
        let strands = part.strands();
        let rows = (0..strands.len()).flat_map(|i| std::iter::repeat_n(i, strands.range(i).len()));
        part.strand_attributes().get(name).map(|column| column.select(rows))
    })
}

/// The columns one after the other, if every part has one and they are of one kind.
fn collect(parts: &[Groom], get: impl Fn(&Groom) -> Option<Column>) -> Option<Column> {
    let mut all: Option<Column> = None;
    for part in parts {
        let next = get(part)?;
        all = Some(match (all, next) {
            (None, next) => next,
            (Some(Column::Int(mut values)), Column::Int(next)) => {
                values.extend(next);
                Column::Int(values)
            }
            (Some(before), next) if before.components() == next.components() => {
                let components = next.components();
                let mut values = floats(before);
                values.extend(floats(next));
                Column::Float { components, values }
            }
            _ => return None,
        });
    }
    all
}

fn floats(column: Column) -> Vec<f64> {
    match column {
        Column::Float { values, .. } => values,
        Column::Int(values) => values.into_iter().map(|i| i as f64).collect(),
    }
}
