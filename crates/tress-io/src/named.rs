//! Columns under names that a format can spell.

use std::collections::BTreeSet;

use tress_geometry::{Column, Groom};

/// A column as a file names it.
pub(crate) struct Named<'a> {
    pub(crate) name: String,
    pub(crate) column: &'a Column,
    /// Whether it has a row a point, not a row a strand.
    pub(crate) of_points: bool,
}

/// Every column but those that the format has another place for, each under a name of its own.
///
/// A column of strands steps aside as `NAME_strand` where one of points has its name; where two
/// names are spelled alike, the second gets a number.
pub(crate) fn named<'a>(
    groom: &'a Groom,
    has_place: impl Fn(&str, &Column) -> bool,
    spell: impl Fn(&str) -> String,
) -> Vec<Named<'a>> {
    let (points, strands) = (groom.point_attributes(), groom.strand_attributes());
    let mut taken = BTreeSet::new();
    let mut named = Vec::new();
    for (name, column) in points.iter().filter(|(name, column)| !has_place(name, column)) {
        named.push(Named { name: free(spell(name), &mut taken), column, of_points: true });
    }
    for (name, column) in strands.iter() {
        let spelled = match points.get(name) {
            Some(_) => spell(&format!("{name}_strand")),
            None if has_place(name, column) => continue,
            None => spell(name),
        };
        named.push(Named { name: free(spelled, &mut taken), column, of_points: false });
    }
    named
}

/// The name, or with a number behind it if it is taken already.
fn free(stem: String, taken: &mut BTreeSet<String>) -> String {
    let mut name = stem.clone();
    let mut next = 2;
    while !taken.insert(name.clone()) {
        name = format!("{stem}_{next}");
        next += 1;
    }
    name
}
