//! Where a prim stands: the `xformOp`s of the prim and its ancestors.
//!
//! openusd can compose these (its feature `geom`), but only at a time code; here each op is read
//! as everything else is, see `Moment`.
//!
//! USD multiplies row vectors, `p' = p M`; glam multiplies column vectors. The rows of USD's
//! matrices are glam's columns, and `xformOpOrder`, whose last op is applied first, is a product
//! written from left to right.

use glam::{DMat4, DQuat, DVec3};
use openusd::sdf::{self, Value};
use openusd::usd::Prim;

use super::curves::text;
use super::{Moment, part, unreadable, values};
use crate::{ParseError, Problem};

/// Takes no transform from the ancestors.
const RESET: &str = "!resetXformStack!";
/// Applies the inverse of the op that follows.
const INVERT: &str = "!invert!";

/// What takes the points of `prim` to the stage.
pub(super) fn local_to_world(prim: &Prim, moment: Moment) -> Result<DMat4, ParseError> {
    let mut world = DMat4::IDENTITY;
    let paths = std::iter::successors(Some(prim.path().clone()), sdf::Path::parent);
    for path in paths.take_while(|path| *path != sdf::Path::abs_root()) {
        let ancestor = prim.stage().prim(path);
        let (local, resets) = local_to_parent(&ancestor, moment)?;
        world = local * world;
        if resets {
            break;
        }
    }
    Ok(world)
}

/// What takes the points of `prim` to its parent, and whether that is the stage.
fn local_to_parent(prim: &Prim, moment: Moment) -> Result<(DMat4, bool), ParseError> {
    let type_name = prim.type_name().map_err(|e| unreadable(part(prim.path()), &e))?;
    // Only these have no transform, whatever attributes they carry.
    let fixed = type_name.is_none_or(|name| matches!(name.as_str(), "" | "Scope"));
    let order = if fixed { None } else { moment.value(prim, "xformOpOrder")? };
    let ops = match order {
        Some(Value::TokenVec(ops)) => ops,
        _ => return Ok((DMat4::IDENTITY, false)),
    };
    let mut matrix = DMat4::IDENTITY;
    let mut resets = false;
    for op in &ops {
        if op == RESET {
            (matrix, resets) = (DMat4::IDENTITY, true);
            continue;
        }
        let (name, inverse) = match op.strip_prefix(INVERT) {
            Some(name) => (name, true),
            None => (op.as_str(), false),
        };
        let Some(value) = moment.value(prim, name)? else { continue };
        let Some(step) = op_matrix(name, &value) else {
            let expected = "a translate, rotate, scale, orient or transform with its numbers";
            let place = part(&prim.path().append_property(name).unwrap_or_default());
            return Err(Problem::unexpected(expected, text(&value)).at(place));
        };
        matrix *= if inverse { step.inverse() } else { step };
    }
    Ok((matrix, resets))
}

/// The matrix of `xformOp:KIND` or `xformOp:KIND:SUFFIX`.
fn op_matrix(name: &str, value: &Value) -> Option<DMat4> {
    let kind = name.strip_prefix("xformOp:")?.split(':').next()?;
    let along = |axis: DVec3| values::scalar(value).map(|x| x * axis);
    let about = |axis: DVec3| {
        let turn = |degrees: f64| DMat4::from_axis_angle(axis, degrees.to_radians());
        values::scalar(value).map(turn)
    };
    Some(match kind {
        "translate" => DMat4::from_translation(vector(value)?),
        "translateX" => DMat4::from_translation(along(DVec3::X)?),
        "translateY" => DMat4::from_translation(along(DVec3::Y)?),
        "translateZ" => DMat4::from_translation(along(DVec3::Z)?),
        "scale" => DMat4::from_scale(vector(value)?),
        "scaleX" => DMat4::from_scale(along(DVec3::X)? + DVec3::new(0.0, 1.0, 1.0)),
        "scaleY" => DMat4::from_scale(along(DVec3::Y)? + DVec3::new(1.0, 0.0, 1.0)),
        "scaleZ" => DMat4::from_scale(along(DVec3::Z)? + DVec3::new(1.0, 1.0, 0.0)),
        "rotateX" => about(DVec3::X)?,
        "rotateY" => about(DVec3::Y)?,
        "rotateZ" => about(DVec3::Z)?,
        "orient" => DMat4::from_quat(quaternion(value)?),
        "transform" => match value {
            Value::Matrix4d(matrix) => DMat4::from_cols_array(&matrix.0),
            _ => return None,
        },
        _ => euler(kind.strip_prefix("rotate")?, vector(value)?)?,
    })
}

/// Turns by the angles (in degrees) about the axes named, first letter first.
fn euler(axes: &str, degrees: DVec3) -> Option<DMat4> {
    let about = |axis: DVec3| DMat4::from_axis_angle(axis, degrees.dot(axis).to_radians());
    let (x, y, z) = (about(DVec3::X), about(DVec3::Y), about(DVec3::Z));
    Some(match axes {
        "XYZ" => z * y * x,
        "XZY" => y * z * x,
        "YXZ" => z * x * y,
        "YZX" => x * z * y,
        "ZXY" => y * x * z,
        "ZYX" => x * y * z,
        _ => return None,
    })
}

fn vector(value: &Value) -> Option<DVec3> {
    match values::column(value.clone())? {
        tress_geometry::Column::Float { components: 3, values } => {
            values.try_into().ok().map(DVec3::from_array)
        }
        _ => None,
    }
}

fn quaternion(value: &Value) -> Option<DQuat> {
    let [w, x, y, z] = match value {
        Value::Quatd(q) => [q.w, q.x, q.y, q.z],
        Value::Quatf(q) => [q.w, q.x, q.y, q.z].map(f64::from),
        Value::Quath(q) => [q.w, q.x, q.y, q.z].map(|x| x.to_f64()),
        _ => return None,
    };
    let q = DQuat::from_xyzw(x, y, z, w);
    (0.0 < q.length_squared() && q.is_finite()).then(|| q.normalize())
}
