//! Grooms of every shape, for round trips through formats that hold everything.

use glam::DVec3;
use proptest::prelude::*;
use tress_geometry::{Column, Groom, Strands, UpAxis, names};

/// A groom with everything that a file holds, from numbers that 32 bits hold exactly.
pub(crate) fn any_groom() -> impl Strategy<Value = Groom> {
    let number = any::<i16>().prop_map(|i| f64::from(i) / 64.0);
    let odd = prop_oneof![
        30 => number.clone(),
        1 => Just(f64::INFINITY),
        1 => Just(f64::from(f32::MIN_POSITIVE)),
        1 => Just(-0.0),
        1 => Just(1e30_f32.into()),
    ];
    (prop::collection::vec(0..6_usize, 0..8), any::<(bool, bool, bool)>()).prop_flat_map(
        move |(counts, (is_known, has_widths, of_points))| {
            let (points, strands) = (counts.iter().sum::<usize>(), counts.len());
            let rows = if of_points { points } else { strands };
            let positions = prop::collection::vec(prop::array::uniform3(odd.clone()), points);
            let columns = prop::collection::vec(number.clone(), rows * (1 + 2 + 3 + 4 + 7));
            let ids = prop::collection::vec(any::<i64>(), rows);
            let counts = Just(counts);
            (counts, positions, columns, ids).prop_map(move |(counts, positions, columns, ids)| {
                let points = positions.into_iter().map(DVec3::from_array).collect();
                let strands = Strands::from_counts(counts, points).expect("counts sum to points");
                let space = (is_known.then_some(0.01), is_known.then_some(UpAxis::Z));
                let mut groom = Groom::new(strands).in_space(space.0, space.1);
                let mut insert = |name: &str, column| {
                    if of_points {
                        groom.insert_point_attribute(name, column).expect("a row a point");
                    } else {
                        groom.insert_strand_attribute(name, column).expect("a row a strand");
                    }
                };
                insert("id", Column::Int(ids.clone()));
                insert("small", Column::Int(ids.iter().map(|id| id >> 40).collect()));
                let mut start = 0;
                let names = ["width", names::ROOT_UV, names::COLOR, "four", "seven"];
                for (name, components) in names.into_iter().zip([1, 2, 3, 4, 7]) {
                    let end = start + rows * components;
                    let values = columns[start..end].to_vec();
                    start = end;
                    if name != "width" || has_widths {
                        insert(name, Column::Float { components, values });
                    }
                }
                groom
            })
        },
    )
}

/// What was read of a file of `groom`, less the width that hair without one is given.
pub(crate) fn without_given_width(mut read: Groom, groom: &Groom) -> Groom {
    let own = groom.strand_attributes().get("width").or(groom.point_attributes().get("width"));
    if own.is_none() && !groom.strands().is_empty() {
        let width = read.remove_strand_attribute("width").expect("a width that is given");
        assert!(width.first_components().all(|w| 0.0 < w), "{width:?}");
    } else if own.is_none() {
        read.remove_strand_attribute("width");
    }
    read
}
