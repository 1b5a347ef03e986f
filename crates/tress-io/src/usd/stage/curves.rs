//! One `BasisCurves` prim as a groom.

use glam::DVec3;
use openusd::sdf::Value;
use openusd::usd::Prim;
use tress_geometry::curves::CubicBasis;
use tress_geometry::{Column, Groom, Strands, names};

use super::{Moment, part, transform, unreadable, values};
use crate::basis_curves::{self, BasisCurves, CurveType, Rows, Wrap};
use crate::{ParseError, Place, Problem};

const PRIMVARS: &str = "primvars:";
/// What the array of indices into an indexed primvar is called behind the primvar's name.
const INDICES: &str = ":indices";

/// The curves of `prim`, evaluated and moved to where they stand on the stage.
pub(super) fn read(prim: &Prim, moment: Moment) -> Result<Groom, ParseError> {
    let Some(curves) = topology(prim, moment)? else {
        return Ok(Groom::new(Strands::default()));
    };
    let positions = positions(prim, moment, &curves)?;
    let strands = Strands::from_counts(curves.strand_counts(), positions)
        .map_err(|error| Problem::Unsupported(error.to_string()).at(part(prim.path())))?;
    let mut groom = Groom::new(strands);
    let mut uv_found = false;
    for property in prim.property_names().map_err(|e| unreadable(part(prim.path()), &e))? {
        let property = property.as_str();
        let Some(primvar) = property.strip_prefix(PRIMVARS) else { continue };
        if primvar.ends_with(INDICES) {
            continue;
        }
        let name = match primvar {
            "displayColor" => names::COLOR,
            "displayOpacity" => names::OPACITY,
            "st" => names::ROOT_UV,
            // `st` is what USD's own tools look for.
            "uv" if uv_found => continue,
            other => other,
        };
        uv_found |= name == names::ROOT_UV;
        attach(&mut groom, (prim, moment), &curves, property, name, Rows::Constant)?;
    }
    attach(&mut groom, (prim, moment), &curves, "widths", names::WIDTH, Rows::Vertex)?;
    Ok(groom)
}

/// Type, wrap and counts, checked against the number of points; nothing for a prim without curves.
fn topology(prim: &Prim, moment: Moment) -> Result<Option<BasisCurves>, ParseError> {
    let counts = match moment.value(prim, "curveVertexCounts")? {
        Some(Value::IntVec(counts)) => counts,
        None if moment.value(prim, "points")?.is_none() => return Ok(None),
        other => return Err(unexpected(prim, "curveVertexCounts", "an array of int", other)),
    };
    let counts: Result<Vec<usize>, _> = counts.iter().map(|&n| usize::try_from(n)).collect();
    let counts = counts.map_err(|_| {
        let problem = Problem::unexpected("numbers of points", "a negative number");
        problem.at(property(prim, "curveVertexCounts"))
    })?;
    let token = |name: &'static str, fallback: &'static str| {
        Ok::<_, ParseError>(match moment.value(prim, name)? {
            Some(Value::Token(token)) => token.as_str().to_owned(),
            Some(other) => return Err(unexpected(prim, name, "a token", Some(other))),
            None => fallback.to_owned(),
        })
    };
    // The fallbacks are those of the schema.
    let (kind, basis, wrap) =
        (token("type", "cubic")?, token("basis", "bezier")?, token("wrap", "nonperiodic")?);
    let wrong = |name: &str, expected: &str, found: &str| {
        Problem::unexpected(expected, format!("{found:?}")).at(property(prim, name))
    };
    let basis = match basis.as_str() {
        "bezier" => CubicBasis::Bezier,
        "bspline" => CubicBasis::BSpline,
        "catmullRom" => CubicBasis::CatmullRom,
        _ if kind == "linear" => CubicBasis::Bezier,
        other => return Err(wrong("basis", "bezier, bspline or catmullRom", other)),
    };
    let kind = match kind.as_str() {
        "linear" => CurveType::Linear,
        "cubic" => CurveType::Cubic(basis),
        other => return Err(wrong("type", "linear or cubic", other)),
    };
    let wrap = match wrap.as_str() {
        "nonperiodic" => Wrap::Nonperiodic,
        "pinned" => Wrap::Pinned,
        "periodic" => Wrap::Periodic,
        other => return Err(wrong("wrap", "nonperiodic, pinned or periodic", other)),
    };
    Ok(Some(BasisCurves::new(kind, wrap, counts)))
}

/// The points of the result on the stage.
fn positions(prim: &Prim, moment: Moment, curves: &BasisCurves) -> Result<Vec<DVec3>, ParseError> {
    let value = moment.value(prim, "points")?;
    let expected = "an array of 3D points";
    let (rows, controls) = match value.and_then(values::column) {
        Some(column @ Column::Float { components: 3, .. }) => (column.rows(), column),
        Some(_) => {
            return Err(Problem::unexpected(expected, "other numbers").at(property(prim, "points")));
        }
        None => (0, Column::Float { components: 3, values: Vec::new() }),
    };
    if rows != curves.control_points() {
        let expected = format!("{} points, as the counts sum to", curves.control_points());
        return Err(Problem::unexpected(expected, rows.to_string()).at(property(prim, "points")));
    }
    let Column::Float { values, .. } = curves.at_control_points(controls) else {
        return Ok(Vec::new());
    };
    let matrix = transform::local_to_world(prim, moment)?;
    let points = values.chunks_exact(3).map(DVec3::from_slice);
    // Not even the last bit changes where nothing moves.
    Ok(if matrix == glam::DMat4::IDENTITY {
        points.collect()
    } else {
        points.map(|point| matrix.transform_point3(point)).collect()
    })
}

/// Adds the attribute `property` to `groom` under `name`, if it is there and numeric.
fn attach(
    groom: &mut Groom,
    (prim, moment): (&Prim, Moment),
    curves: &BasisCurves,
    property_name: &str,
    name: &str,
    fallback: Rows,
) -> Result<(), ParseError> {
    let Some(column) = moment.value(prim, property_name)?.and_then(values::column) else {
        return Ok(());
    };
    let attribute = prim.attribute(property_name);
    let size = attribute.get_metadata::<Value>("elementSize").ok().flatten();
    let column = wide_rows(column, size.as_ref().and_then(values::count).unwrap_or(1));
    let column = indexed(column, (prim, moment), property_name)?;
    let declared = match attribute.get_metadata::<Value>("interpolation").ok().flatten() {
        Some(Value::Token(token)) => match token.as_str() {
            "constant" => Rows::Constant,
            "uniform" => Rows::Uniform,
            "varying" => Rows::Varying,
            "vertex" => Rows::Vertex,
            _ => fallback,
        },
        _ => fallback,
    };
    basis_curves::attach(groom, curves, name, column, declared)
        .map_err(|error| Problem::Unsupported(error.to_string()).at(property(prim, property_name)))
}

/// The column with `size` rows made one, if that comes out even.
fn wide_rows(column: Column, size: usize) -> Column {
    match column {
        Column::Float { components, values } if 1 < size => {
            let wide = components.saturating_mul(size);
            let even = values.len().is_multiple_of(wide);
            Column::Float { components: if even { wide } else { components }, values }
        }
        other => other,
    }
}

/// The rows that `NAME:indices` picks, where the attribute has such indices.
fn indexed(
    column: Column,
    (prim, moment): (&Prim, Moment),
    property_name: &str,
) -> Result<Column, ParseError> {
    let name = format!("{property_name}{INDICES}");
    let Some(Value::IntVec(indices)) = moment.value(prim, &name)? else { return Ok(column) };
    let rows = column.rows();
    let indices: Option<Vec<usize>> =
        indices.iter().map(|&i| usize::try_from(i).ok().filter(|i| *i < rows)).collect();
    match indices {
        Some(indices) => Ok(column.select(indices)),
        None => {
            let problem = Problem::unexpected(format!("indices below {rows}"), "one outside");
            Err(problem.at(property(prim, &name)))
        }
    }
}

/// The kind of a value, for messages.
pub(super) fn text(value: &Value) -> &'static str {
    value.into()
}

fn unexpected(prim: &Prim, name: &str, expected: &str, found: Option<Value>) -> ParseError {
    let found = found.as_ref().map_or("nothing", text);
    Problem::unexpected(expected, found).at(property(prim, name))
}

/// The place of an attribute.
pub(super) fn property(prim: &Prim, name: &str) -> Place {
    Place::Part(format!("{}.{name}", prim.path()))
}
