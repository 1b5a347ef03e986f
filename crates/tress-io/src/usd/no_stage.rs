//! What stands in for the reading of stages where the feature `usd` is off.

use std::path::Path;

use tress_geometry::Groom;

use crate::{ParseError, Place, Problem};

/// Says that this build reads no USD.
pub(super) fn read(_: &Path, _: Option<f64>) -> Result<Groom, ParseError> {
    Err(absent())
}

/// Says that this build reads no USD.
pub(super) fn times(_: &Path) -> Result<(Vec<f64>, f64), ParseError> {
    Err(absent())
}

fn absent() -> ParseError {
    let problem =
        "USD is not read by this program: it was built without the feature usd of tress-io";
    Problem::Unsupported(problem.into()).at(Place::File)
}
