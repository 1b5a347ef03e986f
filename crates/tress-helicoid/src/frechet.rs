//! The discrete Frechet distance between polylines [GH 5.1].
//!
//! A dog walks the points of one line, its owner those of the other, neither ever going back. The
//! distance is the shortest leash that lets them: over all such *couplings* the least greatest link
//! (Eiter and Mannila, "Computing discrete Frechet distance", TR CD-TR 94/64, TU Wien, 1994). By
//! dynamic programming, with `d` the distance of points,
//!
//! `c(i, j) = max(min(c(i-1, j), c(i-1, j-1), c(i, j-1)), d(i, j))`.
//!
//! \[GH\] describes the least *sum* of leashes in the same breath; that is [`least_total_leash`].

use glam::DVec3;

/// The discrete Frechet distance of two polylines; 0 for two without points, infinite where only
/// one has none.
///
/// ```
/// use glam::DVec3;
/// use tress_helicoid::frechet;
///
/// let line: Vec<_> = (0..5).map(|i| DVec3::new(f64::from(i), 0.0, 0.0)).collect();
/// let above: Vec<_> = line.iter().map(|p| p + 0.5 * DVec3::Z).collect();
/// assert_eq!(frechet(&line, &above), 0.5);
/// let back: Vec<_> = line.iter().rev().copied().collect();
/// assert_eq!(frechet(&line, &back), 4.0);
/// ```
#[must_use]
pub fn frechet(p: &[DVec3], q: &[DVec3]) -> f64 {
    let least = dynamic(p, q, |a, b| a.distance_squared(b), f64::max, |_, _| ());
    least.map_or_else(|| nothing(p, q), f64::sqrt)
}

/// The least sum of leashes over all couplings.
///
/// ```
/// use glam::DVec3;
/// use tress_helicoid::least_total_leash;
///
/// let line = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X];
/// assert_eq!(least_total_leash(&line, &line.map(|p| p + DVec3::Y)), 3.0);
/// ```
#[must_use]
pub fn least_total_leash(p: &[DVec3], q: &[DVec3]) -> f64 {
    dynamic(p, q, DVec3::distance, |a, b| a + b, |_, _| ()).unwrap_or_else(|| nothing(p, q))
}

/// For each point of `p` the Frechet distance of the polylines up to there, `q` up to the point of
/// the same number; as many as both have points.
pub(crate) fn frechet_of_prefixes(p: &[DVec3], q: &[DVec3]) -> Vec<f64> {
    let mut prefixes = Vec::with_capacity(p.len().min(q.len()));
    let keep = |i: usize, row: &[f64]| prefixes.extend(row.get(i).map(|square| square.sqrt()));
    dynamic(p, q, |a, b| a.distance_squared(b), f64::max, keep);
    prefixes
}

fn nothing(p: &[DVec3], q: &[DVec3]) -> f64 {
    if p.is_empty() && q.is_empty() { 0.0 } else { f64::INFINITY }
}

/// The table's last entry; `keep` sees every row.
fn dynamic(
    p: &[DVec3],
    q: &[DVec3],
    link: impl Fn(DVec3, DVec3) -> f64,
    join: impl Fn(f64, f64) -> f64,
    mut keep: impl FnMut(usize, &[f64]),
) -> Option<f64> {
    let mut row = vec![f64::INFINITY; q.len()];
    for (i, &a) in p.iter().enumerate() {
        let mut corner = f64::INFINITY;
        let mut left = f64::INFINITY;
        for (j, (&b, entry)) in q.iter().zip(&mut row).enumerate() {
            let d = link(a, b);
            let least = entry.min(corner).min(left);
            corner = *entry;
            left = if i == 0 && j == 0 { d } else { join(least, d) };
            *entry = left;
        }
        keep(i, &row);
    }
    if p.is_empty() { None } else { row.last().copied() }
}

/// Whether the discrete Frechet distance is at most `bound`: faster than finding it, for most pairs
/// of points are never looked at.
///
/// ```
/// use glam::DVec3;
/// use tress_helicoid::frechet_at_most;
///
/// let line = [DVec3::ZERO, DVec3::X];
/// assert!(frechet_at_most(&line, &line.map(|p| p + DVec3::Y), 1.0));
/// assert!(!frechet_at_most(&line, &line.map(|p| p + DVec3::Y), 0.99));
/// ```
#[must_use]
pub fn frechet_at_most(p: &[DVec3], q: &[DVec3], bound: f64) -> bool {
    let (Some(first), Some(last)) = (p.first(), p.last()) else { return q.is_empty() };
    let (Some(from), Some(to)) = (q.first(), q.last()) else { return false };
    let square = bound * bound;
    let near = |a: &DVec3, b: &DVec3| a.distance_squared(*b) <= square;
    if !(0.0 <= bound && near(first, from) && near(last, to)) {
        return false;
    }
    // Which points of `q` can be reached together with this point of `p`, from the first to the
    // last that can.
    let mut reach = vec![false; q.len()];
    let mut begins = 0;
    let mut corner_free = true;
    for a in p {
        let mut corner = corner_free;
        corner_free = false;
        let mut left = false;
        let mut any = None;
        for j in begins..q.len() {
            let from_below = reach[j];
            left = (from_below || corner || left) && near(a, &q[j]);
            corner = from_below;
            reach[j] = left;
            if left && any.is_none() {
                any = Some(j);
            }
        }
        let Some(j) = any else { return false };
        begins = j;
    }
    reach[q.len() - 1]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn line() -> impl Strategy<Value = Vec<DVec3>> {
        let point = (-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64);
        prop::collection::vec(point.prop_map(|(x, y, z)| DVec3::new(x, y, z)), 1..9)
    }

    /// The definition, over all couplings.
    fn by_trying(p: &[DVec3], q: &[DVec3]) -> (f64, f64) {
        let d = p[0].distance(q[0]);
        let tails = [
            (1 < p.len()).then(|| by_trying(&p[1..], q)),
            (1 < q.len()).then(|| by_trying(p, &q[1..])),
            (1 < p.len() && 1 < q.len()).then(|| by_trying(&p[1..], &q[1..])),
        ];
        let least =
            |pick: fn((f64, f64)) -> f64| tails.iter().flatten().map(|&t| pick(t)).reduce(f64::min);
        (least(|t| t.0).map_or(d, |t| t.max(d)), least(|t| t.1).map_or(d, |t| t + d))
    }

    proptest! {
        #[test]
        fn it_is_the_least_over_all_couplings(p in line(), q in line()) {
            let p = &p[..p.len().min(5)];
            let (greatest, total) = by_trying(p, &q);
            prop_assert!((frechet(p, &q) - greatest).abs() < 1e-12);
            prop_assert!((least_total_leash(p, &q) - total).abs() < 1e-12);
        }

        #[test]
        fn it_is_symmetric_and_bounded_by_the_decision(p in line(), q in line()) {
            let d = frechet(&p, &q);
            prop_assert!((d - frechet(&q, &p)).abs() < 1e-15);
            prop_assert!(frechet_at_most(&p, &q, d * (1.0 + 1e-12)));
            prop_assert!(!frechet_at_most(&p, &q, d * (1.0 - 1e-9) - 1e-15));
        }

        #[test]
        fn prefixes_end_at_the_whole(p in line(), q in line()) {
            let n = p.len().min(q.len());
            let prefixes = frechet_of_prefixes(&p[..n], &q[..n]);
            prop_assert_eq!(prefixes.len(), n);
            for i in 0..n {
                prop_assert!((prefixes[i] - frechet(&p[..=i], &q[..=i])).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn without_points_there_is_nothing_to_walk() {
        let line = [DVec3::ONE];
        assert_eq!((frechet(&[], &[]), frechet(&[], &line)), (0.0, f64::INFINITY));
        assert!(frechet_at_most(&[], &[], 0.0) && !frechet_at_most(&line, &[], 1e9));
        assert!(!frechet_at_most(&[], &line, 1e9) && !frechet_at_most(&line, &line, f64::NAN));
    }
}
