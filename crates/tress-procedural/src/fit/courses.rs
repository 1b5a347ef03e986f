//! The courses of strands: the lines that curls are wound about.
//!
//! Guides are what strands are on average, and an average of strands that curl together keeps their
//! curl. So where the chain curls, guides are found for the lines that strands coil about,
//! [`centerline`](tress_fit::centerline()), one strand at a time, and no smoothing along the guide
//! has to tell a curl from a wave of the guide's own.

use glam::DVec3;
use rayon::prelude::*;
use tress_fit::centerline;

use crate::EvenStrands;

/// The line that each strand coils about, from the strand's own root; the strand itself where it
/// does not coil.
pub(super) fn courses(strands: &EvenStrands) -> EvenStrands {
    let mut lines = strands.clone();
    lines.points_mut().par_chunks_mut(strands.points_each()).for_each(|strand| {
        let Ok(line) = centerline(strand) else { return };
        strand[1..].iter_mut().zip(line.points().skip(1)).for_each(|(x, on_line)| *x = on_line);
    });
    lines
}

/// The segments of a strand.
pub(super) fn segments(strand: &[DVec3]) -> impl Iterator<Item = DVec3> + '_ {
    strand.windows(2).map(|ends| ends[1] - ends[0])
}
