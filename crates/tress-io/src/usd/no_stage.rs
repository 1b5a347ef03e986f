//! What stands in for the reading of stages where the feature `usd` is off.

use std::path::Path;

use tress_geometry::Groom;

use crate::{ParseError, Place, Problem};

/// Says that this build reads no USD.
pub(super) fn read(_: &Path) -> Result<Groom, ParseError> {
    let problem =
        "USD is not read by this program: it was built without the feature usd of tress-io";
    Err(Problem::Unsupported(problem.into()).at(Place::File))
}
