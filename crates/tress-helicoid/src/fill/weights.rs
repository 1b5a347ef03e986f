//! Shepard's weights.

use glam::DVec3;

use super::FillOptions;

/// The weights of the guides that count at `position`, nearest first, each with its index; they sum
/// to 1.
///
/// A guide at the very place takes all the weight, shared with others that stand there too. What
/// stood in `weights` is dropped.
///
/// ```
/// use glam::DVec3;
/// use tress_helicoid::{FillOptions, shepard};
///
/// let guides = [DVec3::ZERO, 3.0 * DVec3::X];
/// let mut weights = Vec::new();
/// shepard(DVec3::X, &guides, &FillOptions::default(), &mut weights);
/// assert!((weights[0].1 - 8.0 / 9.0).abs() < 1e-15 && weights[1].0 == 1);
/// shepard(3.0 * DVec3::X, &guides, &FillOptions::default(), &mut weights);
/// assert_eq!(weights, [(1, 1.0)]);
/// ```
pub fn shepard(
    position: DVec3,
    guides: &[DVec3],
    options: &FillOptions,
    weights: &mut Vec<(usize, f64)>,
) {
    weights.clear();
    weights.extend(guides.iter().map(|guide| guide.distance(position)).enumerate());
    let nearer = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0));
    let most = if options.neighbors == 0 { guides.len() } else { options.neighbors };
    if most < weights.len() {
        weights.select_nth_unstable_by(most, nearer);
        weights.truncate(most);
    }
    weights.sort_unstable_by(nearer);
    let Some(&(_, least)) = weights.first() else { return };
    if least == 0.0 {
        let here = weights.partition_point(|&(_, distance)| distance == 0.0);
        weights.truncate(here);
        weights.iter_mut().for_each(|(_, weight)| *weight = 1.0 / here as f64);
        return;
    }
    // Distances over the least one: no power of them overflows.
    let mut sum = 0.0;
    for (_, weight) in weights.iter_mut() {
        *weight = (*weight / least).powf(-options.exponent);
        sum += *weight;
    }
    weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
}
