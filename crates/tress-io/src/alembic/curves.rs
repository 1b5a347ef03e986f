//! One curves object as a groom.

use glam::{DMat4, DVec3};
use ogawa_rs::{ObjectReader, PodArray, PropertyReader};
use tress_geometry::curves::CubicBasis;
use tress_geometry::{Column, Groom, Strands, names};

use super::parameters::FIELDS;
use super::{Hierarchy, properties};
use crate::basis_curves::{self, BasisCurves, CurveType, Rows, Wrap};
use crate::{ParseError, Place, Problem};

/// The width that Unreal reads where curves have none.
const GROOM_WIDTH: &str = "groom_width";
/// The parameters of the schema itself, and the columns they become.
const NATIVE: [(&str, &str); 2] = [("width", names::WIDTH), ("uv", names::ROOT_UV)];

/// The curves of `object`, evaluated and moved by `world`.
pub(super) fn read(
    hierarchy: &mut Hierarchy,
    object: &ObjectReader,
    world: DMat4,
) -> Result<Groom, ParseError> {
    let name = &object.header.full_name;
    let place = Place::Part(name.clone());
    let Some(geometry) = properties::of_object(hierarchy, object, ".geom")? else {
        return Err(Problem::unexpected("a property .geom", "none").at(place));
    };
    let Some(curves) = topology(hierarchy, &geometry, &place)? else {
        return Ok(Groom::new(Strands::default()));
    };
    let positions = positions(hierarchy, &geometry, &curves, world, &place)?;
    let strands = Strands::from_counts(curves.strand_counts(), positions)
        .map_err(|error| Problem::Unsupported(error.to_string()).at(place.clone()))?;
    let mut groom = Groom::new(strands);
    if let Some(parameters) = properties::get(hierarchy, &geometry, ".arbGeomParams", &place)? {
        for name in properties::names(&parameters) {
            let field = FIELDS.iter().find(|field| field.theirs == name);
            let ours = match field {
                Some(field) => field.ours,
                None if name == GROOM_WIDTH => names::WIDTH,
                None => name.as_str(),
            };
            attach(hierarchy, &parameters, &name, ours, &curves, &mut groom, &place)?;
        }
    }
    for (theirs, ours) in NATIVE {
        attach(hierarchy, &geometry, theirs, ours, &curves, &mut groom, &place)?;
    }
    Ok(groom)
}

/// Type, wrap and counts; nothing for an object without curves.
fn topology(
    hierarchy: &mut Hierarchy,
    geometry: &PropertyReader,
    place: &Place,
) -> Result<Option<BasisCurves>, ParseError> {
    let mut first = |name: &str| match properties::get(hierarchy, geometry, name, place)? {
        Some(property) => properties::sample(hierarchy, &property, place),
        None => Ok(None),
    };
    let Some(counts) = first("nVertices")? else { return Ok(None) };
    let PodArray::I32(counts) = counts else {
        return Err(Problem::unexpected("32-bit counts", "others").at(place.clone()));
    };
    let counts: Result<Vec<usize>, _> = counts.into_iter().map(usize::try_from).collect();
    let counts = counts.map_err(|_| {
        Problem::unexpected("numbers of points", "a negative number").at(place.clone())
    })?;
    let Some(PodArray::U8(kind)) = first("curveBasisAndType")? else {
        return Err(Problem::unexpected("a type of curves", "none").at(place.clone()));
    };
    let [kind, wrap, basis, ..] = kind[..] else {
        return Err(Problem::unexpected("type, wrap and basis", "fewer bytes").at(place.clone()));
    };
    let refuse = |what: &str| {
        let message = format!("{what} are not read: convert them to cubic or linear curves");
        Err(Problem::Unsupported(message).at(place.clone()))
    };
    // The numbers are those of the enums of the C++ library.
    let kind = match (kind, basis) {
        (0, 1) => CurveType::Cubic(CubicBasis::Bezier),
        (0, 2) => CurveType::Cubic(CubicBasis::BSpline),
        (0, 3) => CurveType::Cubic(CubicBasis::CatmullRom),
        (0, 4) => return refuse("Hermite curves"),
        (0, 5) => return refuse("power-basis curves"),
        (0, _) => return refuse("cubic curves without a basis"),
        (1, _) => CurveType::Linear,
        (2, _) => return refuse("curves of variable order"),
        (other, _) => {
            let found = format!("type {other}");
            return Err(Problem::unexpected("curves of type 0, 1 or 2", found).at(place.clone()));
        }
    };
    let is_linear = kind == CurveType::Linear;
    if let Some(PodArray::F32(weights)) = first("w")?
        && !is_linear
        && weights.iter().any(|weight| (weight - 1.0).abs() > f32::EPSILON)
    {
        return refuse("curves with weights");
    }
    if let Some(PodArray::F32(knots)) = first(".knots")?
        && !is_linear
        && !evenly_spaced(&knots)
    {
        return refuse("curves with knots that are not evenly spaced");
    }
    let wrap = if wrap == 1 { Wrap::Periodic } else { Wrap::Nonperiodic };
    Ok(Some(BasisCurves::new(kind, wrap, counts)))
}

/// Whether knots lie one apart, by the first two; each curve begins anew, below where the last
/// ended.
fn evenly_spaced(knots: &[f32]) -> bool {
    let steps = || knots.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| 0.0 <= *step);
    let first = steps().next().unwrap_or(0.0);
    steps().all(|step| (step - first).abs() <= 1e-4 * first)
}

/// The points of the result in the world.
fn positions(
    hierarchy: &mut Hierarchy,
    geometry: &PropertyReader,
    curves: &BasisCurves,
    world: DMat4,
    place: &Place,
) -> Result<Vec<DVec3>, ParseError> {
    let controls = match properties::get(hierarchy, geometry, "P", place)? {
        Some(property) => properties::column(hierarchy, &property, place)?,
        None => None,
    };
    let controls = match controls {
        Some((column @ Column::Float { components: 3, .. }, _)) => column,
        Some(_) => {
            let problem = Problem::unexpected("3D points of 32 bits", "other numbers");
            return Err(problem.at(place.clone()));
        }
        None => Column::Float { components: 3, values: Vec::new() },
    };
    let rows = controls.rows();
    if rows != curves.control_points() {
        let expected = format!("{} points, as the counts sum to", curves.control_points());
        return Err(Problem::unexpected(expected, rows.to_string()).at(place.clone()));
    }
    let Column::Float { values, .. } = curves.at_control_points(controls) else {
        return Ok(Vec::new());
    };
    let points = values.chunks_exact(3).map(DVec3::from_slice);
    // Not even the last bit changes where nothing moves.
    Ok(if world == DMat4::IDENTITY {
        points.collect()
    } else {
        points.map(|point| world.transform_point3(point)).collect()
    })
}

/// Adds the parameter `theirs` of a compound to `groom` as `ours`, if it is there and numeric.
fn attach(
    hierarchy: &mut Hierarchy,
    compound: &PropertyReader,
    theirs: &str,
    ours: &str,
    curves: &BasisCurves,
    groom: &mut Groom,
    place: &Place,
) -> Result<(), ParseError> {
    let Some(property) = properties::get(hierarchy, compound, theirs, place)? else {
        return Ok(());
    };
    let Some((column, rows)) = properties::column(hierarchy, &property, place)? else {
        return Ok(());
    };
    // Blender does not say what its widths are of.
    let uniform = column.rows() == curves.len() && column.rows() != curves.control_points();
    let rows = rows.unwrap_or(if uniform { Rows::Uniform } else { Rows::Vertex });
    basis_curves::attach(groom, curves, ours, column, rows).map_err(|error| {
        let name = match place {
            Place::Part(object) => format!("{object}.{theirs}"),
            _ => theirs.to_owned(),
        };
        Problem::Unsupported(error.to_string()).at(Place::Part(name))
    })
}
