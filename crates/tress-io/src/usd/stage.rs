//! The curves of a composed stage.

mod crate_file;
mod curves;
mod foreign;
mod layers;
mod transform;
mod values;

use std::path::Path;

use openusd::{sdf, usd};
use tress_geometry::{Groom, UpAxis};

use crate::basis_curves::join;
use foreign::{no_panic, one_line};
use crate::{ParseError, Place, Problem};

/// Reads the curves of a stage.
pub(super) fn read(path: &Path) -> Result<Groom, ParseError> {
    layers::check_root(path)?;
    no_panic("the USD library", || {
        let stage = layers::open(path)?;
        let mut prims = Vec::new();
        stage
            .traverse(usd::PrimPredicate::DEFAULT_PROXIES, |path| prims.push(path.clone()))
            .map_err(|error| unreadable(Place::File, &error))?;
        let mut parts = Vec::new();
        for path in &prims {
            let prim = stage.prim(path);
            let type_name = prim.type_name().map_err(|e| unreadable(part(path), &e))?;
            if type_name.is_some_and(|name| name.as_str() == "BasisCurves") {
                parts.push(curves::read(&prim)?);
            }
        }
        let groom =
            join(parts).map_err(|error| Problem::Unsupported(error.to_string()).at(Place::File))?;
        Ok(groom.in_space(unit(&stage), up_axis(&stage)))
    })
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
