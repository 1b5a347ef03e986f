//! Wisps found in grooms of which it is known what is a wisp.

use tress_analysis::{Analysis, Wisps, adjusted_rand};
use tress_fixtures::{PatchOptions, coily_patch};
use tress_geometry::{Column, Groom, names};

/// Wisps found, and how well they agree with those that the strands were made in.
fn found(groom: &Groom) -> (Wisps, f64) {
    let wisps = Wisps::of(groom, &Analysis::of(groom));
    let Some(Column::Int(known)) = groom.strand_attributes().get(names::GROUP) else {
        panic!("the groom says which strand is of which wisp");
    };
    let agreement = adjusted_rand(known, &wisps.wisp);
    (wisps, agreement)
}

#[test]
fn wisps_of_a_fixture_are_found() {
    for seed in [1, 3] {
        let options = PatchOptions { wisps: 4, strands_per_wisp: 5, ..PatchOptions::default() };
        let (wisps, agreement) = found(&coily_patch(&options, seed));
        let big = wisps.sizes.iter().filter(|&&size| 3 <= size).count();
        assert!(big == 4 && 0.85 < agreement, "seed {seed}: {:?} {agreement}", wisps.sizes);
    }
    let options = PatchOptions { wisps: 12, ..PatchOptions::default() };
    let (wisps, agreement) = found(&coily_patch(&options, 7));
    assert!(0.8 < agreement, "{:?} {agreement}", wisps.sizes);
}
