//! From each point of a groom to the nearest place of another.
//!
//! The nearest place is looked for on the segments that meet at the nearest point (k-d tree): the
//! distance is never too short, and exact where segments are short against the distance or the
//! grooms are nearly alike.

use glam::DVec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;
use tress_geometry::Groom;

/// The distance from each point of `from` to `to`; NaN for points that are not finite, infinite if
/// `to` has no finite point.
#[must_use]
pub fn nearest_distances(from: &Groom, to: &Groom) -> Vec<f64> {
    let strands = to.strands();
    // For each finite point where it lies among all, and whether a segment leaves or reaches it.
    let mut places = Vec::with_capacity(strands.points().len());
    for i in 0..strands.len() {
        let range = strands.range(i);
        let finite = range.clone().filter(|&k| strands.points()[k].is_finite());
        places.extend(finite.map(|k| (k, range.start < k, k + 1 < range.end)));
    }
    if places.is_empty() {
        return vec![f64::INFINITY; from.strands().points().len()];
    }
    let points: Vec<[f64; 3]> =
        places.iter().map(|&(k, ..)| strands.points()[k].to_array()).collect();
    let tree: ImmutableKdTree<f64, 3> = ImmutableKdTree::new_from_slice(&points);
    let distance = |point: &DVec3| {
        if !point.is_finite() {
            return f64::NAN;
        }
        let found = tree.nearest_one::<SquaredEuclidean>(&point.to_array());
        let Some(&(k, before, behind)) =
            usize::try_from(found.item).ok().and_then(|item| places.get(item))
        else {
            return f64::NAN;
        };
        let all = strands.points();
        let mut least = found.distance;
        if before {
            least = least.min(square_to_segment(*point, all[k - 1], all[k]));
        }
        if behind {
            least = least.min(square_to_segment(*point, all[k], all[k + 1]));
        }
        least.sqrt()
    };
    from.strands().points().par_iter().map(distance).collect()
}

/// Square of the distance to a segment; infinite if an end is not finite.
fn square_to_segment(point: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (along, square) = (b - a, a.distance_squared(b));
    let t = if 0.0 < square { ((point - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    let distance = point.distance_squared(a + t * along);
    if distance.is_finite() { distance } else { f64::INFINITY }
}
