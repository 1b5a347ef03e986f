//! Files under `fixtures/` that the project makes for itself.

use tress::io::WriteOptions;
use tress_fixtures::{PatchOptions, coily_patch};

use crate::Outcome;
use crate::grooms::root;
use crate::metric::say;

/// The seed of the groom that the demo shows.
const DEMO_SEED: u64 = 7;

/// Makes them all again.
pub(crate) fn make() -> Outcome {
    let path = root().join("fixtures/patch.hair");
    let groom = coily_patch(&PatchOptions::default(), DEMO_SEED);
    tress::io::write(&path, &groom, &WriteOptions::default())?;
    let (strands, points) = (groom.strands().len(), groom.strands().points().len());
    say(&format!("fixtures/patch.hair: {strands} strands, {points} points, seed {DEMO_SEED}"));
    Ok(())
}
