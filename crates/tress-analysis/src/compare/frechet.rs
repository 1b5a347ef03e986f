//! The discrete Frechet distance: how long a leash must be that joins two walkers, each going from
//! point to point of its polyline and never back (Eiter and Mannila, "Computing discrete Frechet
//! distance", 1994).

use glam::DVec3;

/// The discrete Frechet distance of two polylines; infinite if just one is empty, 0 if both are.
///
/// ```
/// use glam::DVec3;
/// use tress_analysis::discrete_frechet;
///
/// let there = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X];
/// let back: Vec<DVec3> = there.iter().rev().copied().collect();
/// assert_eq!(discrete_frechet(&there, &there), 0.0);
/// // As sets of points they are the same; as ways they are not.
/// assert_eq!(discrete_frechet(&there, &back), 2.0);
/// ```
#[must_use]
pub fn discrete_frechet(a: &[DVec3], b: &[DVec3]) -> f64 {
    if a.is_empty() || b.is_empty() {
        return if a.len() == b.len() { 0.0 } else { f64::INFINITY };
    }
    // The leash (squared) that takes the walkers to a[i] and b[j], for one i at a time.
    let mut row = vec![f64::INFINITY; b.len()];
    for (i, p) in a.iter().enumerate() {
        let mut diagonal = if i == 0 { 0.0 } else { f64::INFINITY };
        let mut left = f64::INFINITY;
        for (cell, q) in row.iter_mut().zip(b) {
            let reached = diagonal.min(left).min(*cell);
            diagonal = *cell;
            left = reached.max(p.distance_squared(*q));
            *cell = left;
        }
    }
    row[b.len() - 1].sqrt()
}
