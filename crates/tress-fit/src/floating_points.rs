//! Floating points: moves points as little as possible until neighbours are co-helical.
//!
//! With tangents kept, `d_i = t_{i+1} - t_i`, the problem
//!
//! `min sum w_i |q_i - p_i|^2` subject to `d_i . (q_{i+1} - q_i) = 0`
//!
//! has, with `v_i = 1/w_i`, multipliers that solve a symmetric tridiagonal system,
//!
//! `|d_i|^2 (v_i + v_{i+1}) mu_i - v_i (d_{i-1}.d_i) mu_{i-1} - v_{i+1} (d_i.d_{i+1}) mu_{i+1}
//! = d_i . (p_{i+1} - p_i)`, `q_i = p_i - v_i (d_{i-1} mu_{i-1} - d_i mu_i)`,
//!
//! positive definite where no `d_i` vanishes: `O(N)`. This is the variant of [CSE 3.5]. Here all
//! `v_i` are 1 but the root's, which is 0: the root stays.

use glam::DVec3;

/// Added to the diagonal in units of `|d_i|^2`, so that a run of equal tangents, for which the
/// constraint says nothing, moves nothing. Larger, and constraints are missed by as much.
const RIDGE: f64 = 1e-14;

/// Moves `points`, but for the first, by the least sum of squares that makes each pair of
/// neighbours co-helical with their `tangents`.
///
/// ```
/// use glam::DVec3;
/// use tress_fit::float_points;
///
/// let tangents = [DVec3::X, DVec3::Y, DVec3::Z];
/// let mut points = [DVec3::ZERO, DVec3::new(1.0, 0.8, 0.0), DVec3::new(1.0, 1.8, 1.3)];
/// float_points(&mut points, &tangents);
/// for i in 0..2 {
///     let residual = (tangents[i + 1] - tangents[i]).dot(points[i + 1] - points[i]);
///     assert!(residual.abs() < 1e-13);
/// }
/// assert_eq!(points[0], DVec3::ZERO);
/// ```
///
/// # Panics
///
/// If there are not as many tangents as points.
pub fn float_points(points: &mut [DVec3], tangents: &[DVec3]) {
    assert_eq!(points.len(), tangents.len(), "one tangent a point");
    let n = points.len().saturating_sub(1);
    let d: Vec<DVec3> = tangents.windows(2).map(|t| t[1] - t[0]).collect();
    let mut mu = multipliers(points, &d);
    mu.push(0.0);
    for i in 1..=n {
        let behind = if i < n { d[i] * mu[i] } else { DVec3::ZERO };
        points[i] -= d[i - 1] * mu[i - 1] - behind;
    }
}

/// Solves the tridiagonal system by elimination from the root and substitution from the tip.
fn multipliers(points: &[DVec3], d: &[DVec3]) -> Vec<f64> {
    let n = d.len();
    let mut mu = Vec::with_capacity(n + 1);
    // What remains of the row above the diagonal after elimination, divided by the pivot.
    let mut upper = Vec::with_capacity(n);
    for i in 0..n {
        let square = d[i].length_squared();
        let weight = if i == 0 { 1.0 } else { 2.0 };
        let (mut pivot, mut right) =
            (square * (weight + RIDGE), d[i].dot(points[i + 1] - points[i]));
        if 0 < i {
            let lower = -d[i - 1].dot(d[i]);
            pivot -= lower * upper[i - 1];
            right -= lower * mu[i - 1];
        }
        let above = if i + 1 < n { -d[i].dot(d[i + 1]) } else { 0.0 };
        // Equal tangents, or tangents that turn to and fro so that nothing is left to move.
        let inverse = if RIDGE * square < pivot { 1.0 / pivot } else { 0.0 };
        let inverse = if inverse.is_finite() { inverse } else { 0.0 };
        upper.push(above * inverse);
        mu.push(right * inverse);
    }
    for i in (0..n.saturating_sub(1)).rev() {
        mu[i] -= upper[i] * mu[i + 1];
    }
    mu
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn coil(n: usize) -> (Vec<DVec3>, Vec<DVec3>) {
        let angles = (0..n).map(|i| 0.9 * i as f64);
        let points =
            angles.clone().map(|a| DVec3::new(a.cos(), 1.3 * a.sin(), 0.02 * a * a)).collect();
        let tangents = angles.map(|a| DVec3::new(-a.sin(), a.cos(), 0.04 * a).normalize());
        (points, tangents.collect())
    }

    fn residual(points: &[DVec3], tangents: &[DVec3]) -> f64 {
        let pairs = points.windows(2).zip(tangents.windows(2));
        pairs.map(|(p, t)| (t[1] - t[0]).dot(p[1] - p[0]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn neighbours_become_co_helical_and_the_root_stays() {
        let (mut points, tangents) = coil(60);
        assert!(0.005 < residual(&points, &tangents));
        let root = points[0];
        float_points(&mut points, &tangents);
        assert!(residual(&points, &tangents) < 1e-12);
        assert_eq!(points[0], root);
    }

    #[test]
    fn no_smaller_move_does() {
        // At the minimum, every move along the constraints' null space lengthens the way.
        let (points, tangents) = coil(4);
        let mut moved = points.clone();
        float_points(&mut moved, &tangents);
        let square = |q: &[DVec3]| -> f64 {
            q.iter().zip(&points).map(|(q, p)| q.distance_squared(*p)).sum()
        };
        let least = square(&moved);
        // Moving the last point along the last constraint's null space keeps all constraints.
        let d = tangents[3] - tangents[2];
        for along in [d.any_orthogonal_vector(), d.cross(d.any_orthogonal_vector())] {
            for step in [1e-3, -1e-3] {
                let mut other = moved.clone();
                other[3] += step * along;
                assert!(least < square(&other));
            }
        }
    }

    #[test]
    fn equal_and_opposite_tangents_move_nothing_wildly() {
        let points = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X, DVec3::X];
        for tangents in [
            [DVec3::X; 4],
            [DVec3::X, DVec3::X, DVec3::X, DVec3::NEG_X],
            [DVec3::X, DVec3::NEG_X, DVec3::X, DVec3::NEG_X],
        ] {
            let mut moved = points;
            float_points(&mut moved, &tangents);
            let worst = moved.iter().zip(points).map(|(a, b)| a.distance(b)).fold(0.0, f64::max);
            assert!(worst <= 4.0, "{moved:?}");
        }
        float_points(&mut [], &[]);
        float_points(&mut [DVec3::ONE], &[DVec3::X]);
    }

    proptest! {
        #[test]
        fn any_tangents_give_finite_points(
            raw in prop::collection::vec(prop::array::uniform6(-1.0..1.0_f64), 2..30)
        ) {
            let mut points: Vec<_> = raw.iter().map(|r| DVec3::new(r[0], r[1], r[2])).collect();
            let tangents: Vec<_> =
                raw.iter().map(|r| DVec3::new(r[3], r[4], r[5]).normalize_or(DVec3::X)).collect();
            float_points(&mut points, &tangents);
            prop_assert!(points.iter().all(|p| p.is_finite()));
            prop_assert!(residual(&points, &tangents) < 1e-8);
        }
    }
}
