//! One curves object as a groom.

use glam::{DMat4, DVec3};
use tress_alembic::{Property, ReadObject};
use tress_geometry::curves::CubicBasis;
use tress_geometry::{Groom, Strands, names};

use super::parameters::FIELDS;
use super::scene::Scene;
use crate::basis_curves::{self, BasisCurves, CurveType, Rows, Wrap};
use crate::{ParseError, Place, Problem};

/// The width that Unreal reads where curves have none.
const GROOM_WIDTH: &str = "groom_width";
/// The parameters of the schema itself, and the columns they become.
const NATIVE: [(&str, &str); 2] = [("width", names::WIDTH), ("uv", names::ROOT_UV)];

/// The curves of `object`, evaluated and moved by `world`.
pub(super) fn read(
    scene: &Scene<'_>,
    object: &ReadObject,
    world: DMat4,
) -> Result<Groom, ParseError> {
    let place = Place::Part(object.path.clone());
    let Some(geometry) = scene.get(&object.properties, ".geom")? else {
        return Err(Problem::unexpected("a property .geom", "none").at(place));
    };
    let Some(curves) = topology(scene, &geometry, &place)? else {
        return Ok(Groom::new(Strands::default()));
    };
    let positions = positions(scene, &geometry, &curves, world, &place)?;
    let strands = Strands::from_counts(curves.strand_counts(), positions)
        .map_err(|error| Problem::Unsupported(error.to_string()).at(place.clone()))?;
    let mut groom = Groom::new(strands);
    if let Some(parameters) = scene.get(&geometry, ".arbGeomParams")? {
        for parameter in scene.properties(&parameters)? {
            let name = parameter.name.as_str();
            let field = FIELDS.iter().find(|field| field.theirs == name);
            let ours = match field {
                Some(field) => field.ours,
                None if name == GROOM_WIDTH => names::WIDTH,
                None => name,
            };
            attach(scene, &parameter, ours, &curves, &mut groom, &place)?;
        }
    }
    for (theirs, ours) in NATIVE {
        if let Some(parameter) = scene.get(&geometry, theirs)? {
            attach(scene, &parameter, ours, &curves, &mut groom, &place)?;
        }
    }
    Ok(groom)
}

/// Type, wrap and counts; nothing for an object without curves.
fn topology(
    scene: &Scene<'_>,
    geometry: &Property,
    place: &Place,
) -> Result<Option<BasisCurves>, ParseError> {
    let sample = |name: &str| match scene.get(geometry, name)? {
        Some(property) => scene.sample(&property),
        None => Ok(None),
    };
    let Some(counts) = sample("nVertices")? else { return Ok(None) };
    let Some(counts) = counts.integers() else {
        return Err(Problem::unexpected("counts of points", "other values").at(place.clone()));
    };
    let counts: Result<Vec<usize>, _> = counts.into_iter().map(usize::try_from).collect();
    let counts = counts.map_err(|_| {
        Problem::unexpected("numbers of points", "a negative number").at(place.clone())
    })?;
    let Some(kind) = sample("curveBasisAndType")?.and_then(|sample| sample.integers()) else {
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
    let numbers = |name: &str| Ok::<_, ParseError>(sample(name)?.and_then(|s| s.floats()));
    if let Some(weights) = numbers("w")?
        && !is_linear
        && weights.iter().any(|weight| (weight - 1.0).abs() > f64::from(f32::EPSILON))
    {
        return refuse("curves with weights");
    }
    if let Some(knots) = numbers(".knots")?
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
fn evenly_spaced(knots: &[f64]) -> bool {
    let steps = || knots.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| 0.0 <= *step);
    let first = steps().next().unwrap_or(0.0);
    steps().all(|step| (step - first).abs() <= 1e-4 * first)
}

/// The points of the result in the world.
fn positions(
    scene: &Scene<'_>,
    geometry: &Property,
    curves: &BasisCurves,
    world: DMat4,
    place: &Place,
) -> Result<Vec<DVec3>, ParseError> {
    let sample = match scene.get(geometry, "P")? {
        Some(property) => scene.sample(&property)?,
        None => None,
    };
    let controls: Vec<DVec3> = match sample.map(|sample| sample.vectors()) {
        Some(Some(points)) => points.map(|[x, y, z]| glam::Vec3::new(x, y, z).as_dvec3()).collect(),
        Some(None) => {
            let problem = Problem::unexpected("3D points of 32 bits", "other numbers");
            return Err(problem.at(place.clone()));
        }
        None => Vec::new(),
    };
    let rows = controls.len();
    if rows != curves.control_points() {
        let expected = format!("{} points, as the counts sum to", curves.control_points());
        return Err(Problem::unexpected(expected, rows.to_string()).at(place.clone()));
    }
    let mut points = curves.points(controls);
    // Not even the last bit changes where nothing moves.
    if world != DMat4::IDENTITY {
        points.iter_mut().for_each(|point| *point = world.transform_point3(*point));
    }
    Ok(points)
}

/// Adds a parameter to `groom` as `ours`, if it is numeric.
fn attach(
    scene: &Scene<'_>,
    parameter: &Property,
    ours: &str,
    curves: &BasisCurves,
    groom: &mut Groom,
    place: &Place,
) -> Result<(), ParseError> {
    let Some((column, rows)) = scene.column(parameter, place)? else { return Ok(()) };
    // Blender does not say what its widths are of.
    let uniform = column.rows() == curves.len() && column.rows() != curves.control_points();
    let rows = rows.unwrap_or(if uniform { Rows::Uniform } else { Rows::Vertex });
    basis_curves::attach(groom, curves, ours, column, rows).map_err(|error| {
        let name = match place {
            Place::Part(object) => format!("{object}.{}", parameter.name),
            _ => parameter.name.clone(),
        };
        Problem::Unsupported(error.to_string()).at(Place::Part(name))
    })
}
