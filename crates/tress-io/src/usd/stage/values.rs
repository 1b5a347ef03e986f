//! openusd's typed values as plain numbers.

use openusd::sdf::Value;
use tress_geometry::Column;

/// A number of any type.
pub(super) fn scalar(value: &Value) -> Option<f64> {
    Some(match value {
        Value::Double(x) => *x,
        Value::Float(x) => f64::from(*x),
        Value::Half(x) => x.to_f64(),
        Value::Int(i) => f64::from(*i),
        Value::Uint(i) => f64::from(*i),
        Value::Int64(i) => *i as f64,
        Value::Uint64(i) => *i as f64,
        _ => return None,
    })
}

/// How many, by a number of any type: text has no type where the value of a key stands.
#[expect(clippy::cast_possible_truncation, reason = "the nearest count is as good")]
pub(super) fn count(value: &Value) -> Option<usize> {
    scalar(value).map(|number| number as usize)
}

/// Numbers of any type, one or many, as rows; `None` for what is not numbers or vectors of them.
pub(super) fn column(value: Value) -> Option<Column> {
    fn ints<T>(values: Vec<T>) -> Column
    where
        i64: From<T>,
    {
        Column::Int(values.into_iter().map(i64::from).collect())
    }
    macro_rules! rows {
        ($values:expr, $($component:ident),+ => $number:expr) => {{
            const COMPONENTS: usize = [$(stringify!($component)),+].len();
            let numbers = $values.into_iter().flat_map(|v| [$($number(v.$component)),+]);
            Column::Float { components: COMPONENTS, values: numbers.collect() }
        }};
    }
    let half = |x: openusd::gf::f16| x.to_f64();
    let whole = |i: i32| f64::from(i);
    Some(match value {
        Value::Bool(b) => ints(vec![b]),
        Value::BoolVec(v) => ints(v),
        Value::Uchar(i) => ints(vec![i]),
        Value::UcharVec(v) => ints(v),
        Value::Int(i) => ints(vec![i]),
        Value::IntVec(v) => ints(v),
        Value::Uint(i) => ints(vec![i]),
        Value::UintVec(v) => ints(v),
        Value::Int64(i) => ints(vec![i]),
        Value::Int64Vec(v) => ints(v),
        Value::Uint64(i) => unsigned(vec![i]),
        Value::Uint64Vec(v) => unsigned(v),
        Value::Half(x) => Column::scalar(vec![half(x)]),
        Value::HalfVec(v) => Column::scalar(v.into_iter().map(half).collect()),
        Value::Float(x) => Column::scalar(vec![x.into()]),
        Value::FloatVec(v) => Column::scalar(v.into_iter().map(f64::from).collect()),
        Value::Double(x) => Column::scalar(vec![x]),
        Value::DoubleVec(v) => Column::scalar(v),
        Value::Vec2h(v) => rows!([v], x, y => half),
        Value::Vec2hVec(v) => rows!(v, x, y => half),
        Value::Vec2f(v) => rows!([v], x, y => f64::from),
        Value::Vec2fVec(v) => rows!(v, x, y => f64::from),
        Value::Vec2d(v) => rows!([v], x, y => f64::from),
        Value::Vec2dVec(v) => rows!(v, x, y => f64::from),
        Value::Vec2i(v) => rows!([v], x, y => whole),
        Value::Vec2iVec(v) => rows!(v, x, y => whole),
        Value::Vec3h(v) => rows!([v], x, y, z => half),
        Value::Vec3hVec(v) => rows!(v, x, y, z => half),
        Value::Vec3f(v) => rows!([v], x, y, z => f64::from),
        Value::Vec3fVec(v) => rows!(v, x, y, z => f64::from),
        Value::Vec3d(v) => rows!([v], x, y, z => f64::from),
        Value::Vec3dVec(v) => rows!(v, x, y, z => f64::from),
        Value::Vec3i(v) => rows!([v], x, y, z => whole),
        Value::Vec3iVec(v) => rows!(v, x, y, z => whole),
        Value::Vec4h(v) => rows!([v], x, y, z, w => half),
        Value::Vec4hVec(v) => rows!(v, x, y, z, w => half),
        Value::Vec4f(v) => rows!([v], x, y, z, w => f64::from),
        Value::Vec4fVec(v) => rows!(v, x, y, z, w => f64::from),
        Value::Vec4d(v) => rows!([v], x, y, z, w => f64::from),
        Value::Vec4dVec(v) => rows!(v, x, y, z, w => f64::from),
        Value::Vec4i(v) => rows!([v], x, y, z, w => whole),
        Value::Vec4iVec(v) => rows!(v, x, y, z, w => whole),
        _ => return None,
    })
}

/// Whole numbers, or floating-point ones where a number is too large for 63 bits.
fn unsigned(values: Vec<u64>) -> Column {
    let whole: Result<Vec<i64>, _> = values.iter().map(|&i| i64::try_from(i)).collect();
    match whole {
        Ok(whole) => Column::Int(whole),
        Err(_) => Column::scalar(values.into_iter().map(|i| i as f64).collect()),
    }
}
