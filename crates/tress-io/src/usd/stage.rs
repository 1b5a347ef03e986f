//! The curves of a composed stage.

mod crate_file;
mod curves;
mod layers;
mod no_panic;
mod transform;
mod values;

use std::path::Path;

use openusd::{sdf, usd};
use tress_geometry::{Groom, UpAxis};

use crate::basis_curves::join;
use crate::{ParseError, Place, Problem};
use no_panic::{no_panic, one_line};

/// Reads the curves of a stage: at a time code, or at the default, else the first sample, of each
/// attribute.
pub(super) fn read(path: &Path, code: Option<f64>) -> Result<Groom, ParseError> {
    let moment = Moment(code.map(usd::TimeCode::new));
    layers::check_root(path)?;
    no_panic(|| {
        let stage = layers::open(path)?;
        let prims = curve_prims(&stage)?;
        let parts = prims.iter().map(|prim| curves::read(prim, moment));
        let parts = parts.collect::<Result<Vec<_>, _>>()?;
        let groom =
            join(parts).map_err(|error| Problem::Unsupported(error.to_string()).at(Place::File))?;
        Ok(groom.in_space(unit(&stage), up_axis(&stage)))
    })
}

/// The time codes of the samples of the points of the prim that has most, and their rate.
pub(super) fn times(path: &Path) -> Result<(Vec<f64>, f64), ParseError> {
    layers::check_root(path)?;
    no_panic(|| {
        let stage = layers::open(path)?;
        let mut codes: Vec<f64> = Vec::new();
        for prim in curve_prims(&stage)? {
            let points = prim.attribute("points");
            let samples = points.time_samples_in_interval(f64::MIN..=f64::MAX);
            let own = samples.map_err(|error| unreadable(part(prim.path()), &error))?;
            if codes.len() < own.len() {
                codes = own;
            }
        }
        Ok((codes, stage.time_codes_per_second()))
    })
}

/// Every `BasisCurves` prim, in the order of traversal.
fn curve_prims(stage: &usd::Stage) -> Result<Vec<usd::Prim>, ParseError> {
    let mut paths = Vec::new();
    stage
        .traverse(usd::PrimPredicate::DEFAULT_PROXIES, |path| paths.push(path.clone()))
        .map_err(|error| unreadable(Place::File, &error))?;
    let mut prims = Vec::new();
    for path in &paths {
        let prim = stage.prim(path);
        let type_name = prim.type_name().map_err(|e| unreadable(part(path), &e))?;
        if type_name.is_some_and(|name| name.as_str() == "BasisCurves") {
            prims.push(prim);
        }
    }
    Ok(prims)
}

/// When attributes are read: at a time code, or by their default, else their first sample.
#[derive(Clone, Copy)]
struct Moment(Option<usd::TimeCode>);

impl Moment {
    /// The value of an attribute; nothing where it has none or is blocked.
    fn value(self, prim: &usd::Prim, name: &str) -> Result<Option<sdf::Value>, ParseError> {
        let attribute = prim.attribute(name);
        let failed = |e| unreadable(curves::property(prim, name), &e);
        let value = match self.0 {
            Some(code) => attribute.get_at::<sdf::Value>(code).map_err(failed)?,
            None => match attribute.get::<sdf::Value>().map_err(failed)? {
                None => attribute.get_at::<sdf::Value>(usd::TimeCode::EARLIEST).map_err(failed)?,
                some => some,
            },
        };
        Ok(value.filter(|value| !matches!(value, sdf::Value::ValueBlock | sdf::Value::None)))
    }
}

fn unit(stage: &usd::Stage) -> Option<f64> {
    let value = stage.stage_metadata("metersPerUnit").ok()??;
    values::scalar(&value).filter(|metres| 0.0 < *metres && metres.is_finite())
}

fn up_axis(stage: &usd::Stage) -> Option<UpAxis> {
    match stage.stage_metadata("upAxis").ok()?? {
        sdf::Value::Token(axis) if axis == "Y" => Some(UpAxis::Y),
        sdf::Value::Token(axis) if axis == "Z" => Some(UpAxis::Z),
        _ => None,
    }
}

/// The place of a prim or of a property.
fn part(path: &sdf::Path) -> Place {
    Place::Part(path.as_str().to_owned())
}

/// What openusd said.
fn unreadable(place: Place, error: &impl std::fmt::Display) -> ParseError {
    Problem::Unsupported(one_line(&format!("{error:#}"))).at(place)
}
