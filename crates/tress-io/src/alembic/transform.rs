//! Where a transform object puts what lies below it.
//!
//! `.ops` holds a byte an operation, its kind in the upper four bits; `.vals` holds the numbers of
//! all of them. As in USD the last operation is applied first, so that in matrices of columns the
//! operations are a product written from left to right. `.inherits` says whether the parent's
//! transform counts.

use glam::{DMat4, DVec3};
use tress_alembic::ReadObject;

use super::scene::Scene;
use crate::{ParseError, Place, Problem};

/// What takes points below `object` to the world, where `parent` does so for points beside it.
pub(super) fn world(
    scene: &Scene<'_>,
    object: &ReadObject,
    parent: DMat4,
) -> Result<DMat4, ParseError> {
    let Some(xform) = scene.get(&object.properties, ".xform")? else { return Ok(parent) };
    let sample = |name: &str| match scene.get(&xform, name)? {
        Some(property) => scene.sample(&property),
        None => Ok(None),
    };
    let inherits = sample(".inherits")?.and_then(|sample| sample.integers()?.first().copied());
    let ops = sample(".ops")?.and_then(|sample| sample.integers());
    let values = sample(".vals")?.and_then(|sample| sample.floats());
    let local = match (ops, values) {
        (Some(ops), Some(values)) => product(&ops, &values).ok_or_else(|| {
            let found = format!("{} operations with {} numbers", ops.len(), values.len());
            let place = Place::Part(object.path.clone());
            Problem::unexpected("operations that match their numbers", found).at(place)
        })?,
        _ => DMat4::IDENTITY,
    };
    Ok(if inherits == Some(0) { local } else { parent * local })
}

/// The operations one after the other; nothing if they do not use up the values.
fn product(ops: &[i64], mut values: &[f64]) -> Option<DMat4> {
    let mut matrix = DMat4::IDENTITY;
    for op in ops {
        let count = match op >> 4 {
            0 | 1 => 3,
            2 => 4,
            3 => 16,
            4..=6 => 1,
            _ => return None,
        };
        let (own, rest) = values.split_at_checked(count)?;
        values = rest;
        let about = |axis: DVec3| DMat4::from_axis_angle(axis, own[0].to_radians());
        matrix *= match op >> 4 {
            0 => DMat4::from_scale(DVec3::from_slice(own)),
            1 => DMat4::from_translation(DVec3::from_slice(own)),
            2 => {
                let axis = DVec3::from_slice(own).normalize_or(DVec3::X);
                DMat4::from_axis_angle(axis, own[3].to_radians())
            }
            3 => DMat4::from_cols_slice(own),
            4 => about(DVec3::X),
            5 => about(DVec3::Y),
            _ => about(DVec3::Z),
        };
    }
    values.is_empty().then_some(matrix)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_operation_is_applied_first() {
        // Translate, rotate about Z, scale: as exporters order them.
        let ops = [0x10, 0x60, 0x00];
        let matrix = product(&ops, &[5.0, 0.0, 0.0, 90.0, 2.0, 2.0, 2.0]).expect("seven numbers");
        let moved = matrix.transform_point3(DVec3::X);
        assert!(moved.distance(DVec3::new(5.0, 2.0, 0.0)) < 1e-15, "{moved}");
    }

    #[test]
    fn a_matrix_has_its_translation_in_the_last_row() {
        let mut values = DMat4::IDENTITY.to_cols_array();
        values[12..15].copy_from_slice(&[1.0, 2.0, 3.0]);
        let matrix = product(&[0x30], &values).expect("sixteen numbers");
        assert_eq!(matrix.transform_point3(DVec3::ZERO), DVec3::new(1.0, 2.0, 3.0));
    }

    #[test]
    fn an_axis_turns_by_degrees() {
        let matrix = product(&[0x20], &[0.0, 2.0, 0.0, 90.0]).expect("four numbers");
        assert!(matrix.transform_point3(DVec3::Z).distance(DVec3::X) < 1e-15);
    }

    #[test]
    fn numbers_too_few_or_too_many_are_refused() {
        assert_eq!(product(&[0x10], &[1.0, 2.0]), None);
        assert_eq!(product(&[0x10], &[1.0, 2.0, 3.0, 4.0]), None);
        assert_eq!(product(&[0x70], &[1.0]), None);
    }
}
