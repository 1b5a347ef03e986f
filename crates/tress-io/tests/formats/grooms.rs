//! Grooms of every kind, ugly ones above all.

use glam::DVec3;
use proptest::collection::vec;
use proptest::prelude::*;
use tress_geometry::{Column, Groom, Strands};

/// Any number, ordinary ones most often.
pub(crate) fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0,
        1 => any::<f64>(),
        1 => prop::num::f64::ANY,
        1 => Just(-0.0),
    ]
}

/// Any number that 32 bits hold.
pub(crate) fn short_number() -> impl Strategy<Value = f64> {
    let short = prop_oneof![
        4 => -10.0_f32..10.0,
        1 => prop::num::f32::ANY,
        1 => Just(f32::INFINITY),
        1 => Just(-0.0),
    ];
    short.prop_map(f64::from)
}

/// Point counts of up to five strands of `least` to eight points.
pub(crate) fn counts(least: usize) -> impl Strategy<Value = Vec<usize>> {
    vec(least..9, 0..6)
}

/// Point counts that are all alike.
pub(crate) fn equal_counts(
    each: impl Strategy<Value = usize>,
) -> impl Strategy<Value = Vec<usize>> {
    (each, 0..5_usize).prop_map(|(each, strands)| vec![each; strands])
}

/// A groom of these counts without attributes.
pub(crate) fn bare<S: Strategy<Value = f64> + Clone + 'static>(
    counts: impl Strategy<Value = Vec<usize>>,
    number: impl Fn() -> S,
) -> impl Strategy<Value = Groom> {
    let number = number();
    counts.prop_flat_map(move |counts| {
        let n = counts.iter().sum::<usize>();
        let points = vec((number.clone(), number.clone(), number.clone()), n);
        points.prop_map(move |points| {
            let points = points.into_iter().map(DVec3::from).collect();
            Groom::new(Strands::from_counts(counts.iter().copied(), points).expect("their sum"))
        })
    })
}

/// As many values as a column of these rows has.
pub(crate) fn column(
    rows: usize,
    components: usize,
    number: impl Strategy<Value = f64>,
) -> impl Strategy<Value = Column> {
    vec(number, rows * components).prop_map(move |values| Column::Float { components, values })
}
