//! What makes objects transforms and curves: the schemas of `AbcGeom`.

use crate::values::{Numbers, Values};

/// What lies between the points of curves. None is periodic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Straight segments.
    Linear,
    /// A uniform cubic B-spline.
    BSpline,
    /// A Catmull-Rom spline.
    CatmullRom,
    /// Cubic Bezier segments that share their ends.
    Bezier,
}

impl Kind {
    /// Type, wrap and, twice, the basis, as the enums of the C++ library number them.
    pub(crate) fn bytes(self) -> [u8; 4] {
        match self {
            Self::Linear => [1, 0, 0, 0],
            Self::Bezier => [0, 0, 1, 1],
            Self::BSpline => [0, 0, 2, 2],
            Self::CatmullRom => [0, 0, 3, 3],
        }
    }
}

/// What a parameter has a row for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// All curves of the object together; any number of rows that readers agree on, mostly one.
    Constant,
    /// Each curve.
    Uniform,
    /// Each point.
    Vertex,
}

impl Scope {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Constant => "con",
            Self::Uniform => "uni",
            Self::Vertex => "vtx",
        }
    }
}

/// A geometry parameter: an attribute of curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter<'a> {
    /// Its name.
    pub name: &'a str,
    /// What it has a row for.
    pub scope: Scope,
    /// The rows.
    pub values: Values<'a>,
}

impl<'a> Parameter<'a> {
    /// A parameter.
    #[must_use]
    pub fn new(name: &'a str, scope: Scope, values: Values<'a>) -> Self {
        Self { name, scope, values }
    }
}

/// Curves at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurvesSample<'a> {
    /// The points of all curves, one after the other.
    pub points: &'a [[f32; 3]],
    /// How many points each curve has; they sum to the number of points.
    pub counts: &'a [i32],
    /// Diameters.
    pub widths: Option<(Scope, &'a [f32])>,
    /// Texture coordinates.
    pub uvs: Option<(Scope, &'a [[f32; 2]])>,
    /// Everything else; each sample has those that the first has, of the same types, but a
    /// parameter may be left out of all samples behind the first: it then does not change.
    pub parameters: &'a [Parameter<'a>],
}

/// What an object says of itself, the property that its schema lies in, and what that says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Schema {
    pub(crate) object: &'static str,
    pub(crate) property: &'static str,
    pub(crate) meta_data: &'static str,
}

/// A transform.
pub(crate) const TRANSFORM: Schema = Schema {
    object: "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform",
    property: ".xform",
    meta_data: "schema=AbcGeom_Xform_v3",
};

/// Curves.
pub(crate) const CURVES: Schema = Schema {
    object: "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1;\
             schemaObjTitle=AbcGeom_Curve_v2:.geom",
    property: ".geom",
    meta_data: "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1",
};

/// An object that stands for another one.
pub(crate) const INSTANCE: Schema =
    Schema { object: "isInstance=1", property: ".instanceSource", meta_data: "" };

/// The operation that multiplies by a matrix.
pub(crate) const MATRIX: Values<'static> =
    Values { numbers: Numbers::U8(&[0x30]), extent: 1, interpretation: "" };
/// Yes.
pub(crate) const YES: Values<'static> =
    Values { numbers: Numbers::Bool(&[true]), extent: 1, interpretation: "" };

/// The box around finite points; one that is inside out if there are none.
pub(crate) fn bounds(points: &[[f32; 3]]) -> [f64; 6] {
    let bounds = bounds_of_numbers(points);
    if bounds.iter().all(|x| x.is_finite()) {
        return bounds;
    }
    let finite = points.iter().filter(|point| point.iter().all(|x| x.is_finite()));
    bounds_of_numbers(&finite.copied().collect::<Vec<_>>())
}

/// The box around all numbers that are not NaN, which no comparison is true of. Four points at a
/// time: the compiler then uses wide registers.
fn bounds_of_numbers(points: &[[f32; 3]]) -> [f64; 6] {
    let (mut low, mut high) = ([f32::MAX; 12], [f32::MIN; 12]);
    let (blocks, rest) = points.as_flattened().as_chunks::<12>();
    let mut block_of_rest = [f32::NAN; 12];
    block_of_rest[..rest.len()].copy_from_slice(rest);
    for block in blocks.iter().chain([&block_of_rest]) {
        for i in 0..12 {
            low[i] = if block[i] < low[i] { block[i] } else { low[i] };
            high[i] = if high[i] < block[i] { block[i] } else { high[i] };
        }
    }
    let lowest = |axis: usize| (axis..12).step_by(3).map(|i| low[i]).fold(f32::MAX, f32::min);
    let highest = |axis: usize| (axis..12).step_by(3).map(|i| high[i]).fold(f32::MIN, f32::max);
    let is_empty = (0..3).any(|axis| highest(axis) < lowest(axis));
    // What the C++ library calls empty.
    if is_empty {
        return [f64::MAX, f64::MAX, f64::MAX, f64::MIN, f64::MIN, f64::MIN];
    }
    let corners = [lowest(0), lowest(1), lowest(2), highest(0), highest(1), highest(2)];
    corners.map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::bounds;

    #[test]
    fn bounds_are_around_what_is_finite() {
        let nan = f32::NAN;
        let points: Vec<[f32; 3]> = (0..9_u8).map(|i| [f32::from(i), 1.0, -2.0]).collect();
        let bits = |points: &[[f32; 3]]| bounds(points).map(f64::to_bits);
        let expected = |corners: [f64; 6]| corners.map(f64::to_bits);
        assert_eq!(bits(&points), expected([0.0, 1.0, -2.0, 8.0, 1.0, -2.0]));
        let odd = [[1.0, 2.0, 3.0], [f32::INFINITY, 0.0, 0.0], [nan, nan, nan]];
        assert_eq!(bits(&odd), expected([1.0, 2.0, 3.0, 1.0, 2.0, 3.0]));
        let (low, high) = (f64::MIN, f64::MAX);
        assert_eq!(bits(&[]), expected([high, high, high, low, low, low]));
        assert_eq!(bits(&[[nan, 0.0, 0.0]]), bits(&[]));
    }
}
