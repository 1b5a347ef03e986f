//! A rod in equilibrium under a force at its ends: the static Kirchhoff equations [CC 9-11].
//!
//! In the body frame `d1, d2, d3` (`d3` the tangent), with `kappa` in units of the rest curvature,
//! `m = (kappa1 - 1, kappa2, Gamma (kappa3 - kappa3_0))` and `f` the force,
//!
//! `m' = -kappa x m - e3 x f`, `f' = -kappa x f`.
//!
//! Written out (the second equation of [CC 10] is misprinted there):
//!
//! `kappa1' = f2 - (Gamma-1) kappa2 kappa3 + Gamma kappa3_0 kappa2`
//! `kappa2' = -f1 + (Gamma-1) kappa1 kappa3 + kappa3 - Gamma kappa3_0 kappa1`
//! `kappa3' = -kappa2 / Gamma`
//!
//! Three quantities do not change along the rod: `|f|`, `m . f`, and the energy
//! `1/2 m . K^-1 m + kappa^0 . m + f3`, with `K` the stiffnesses. The right-hand side is quadratic,
//! which is why Taylor series of any order are cheap (see [`crate::taylor`]).

use crate::Material;

/// Curvatures and force at one place: `(kappa1, kappa2, kappa3, f1, f2, f3)`.
pub(crate) type State = [f64; 6];

/// `y'` by arc length.
#[cfg(test)]
pub(crate) fn derivative(material: &Material, y: &State) -> State {
    let [k1, k2, k3, f1, f2, f3] = *y;
    let gamma = material.torsional();
    let rest = gamma * material.rest_twist;
    [
        f2 - (gamma - 1.0) * k2 * k3 + rest * k2,
        -f1 + (gamma - 1.0) * k1 * k3 + k3 - rest * k1,
        -k2 / gamma,
        f2 * k3 - f3 * k2,
        f3 * k1 - f1 * k3,
        f1 * k2 - f2 * k1,
    ]
}

/// How `y'` changes with `y` in a direction: `(dy'/dy) w`.
pub(crate) fn linearized(material: &Material, y: &State, w: &State) -> State {
    let [k1, k2, k3, f1, f2, f3] = *y;
    let [a1, a2, a3, b1, b2, b3] = *w;
    let gamma = material.torsional();
    let rest = gamma * material.rest_twist;
    [
        b2 - (gamma - 1.0) * (a2 * k3 + k2 * a3) + rest * a2,
        -b1 + (gamma - 1.0) * (a1 * k3 + k1 * a3) + a3 - rest * a1,
        -a2 / gamma,
        b2 * k3 + f2 * a3 - b3 * k2 - f3 * a2,
        b3 * k1 + f3 * a1 - b1 * k3 - f1 * a3,
        b1 * k2 + f1 * a2 - b2 * k1 - f2 * a1,
    ]
}

/// `|f|`, `m . f` and the energy: the same all along a rod in equilibrium.
#[cfg(test)]
pub(crate) fn invariants(material: &Material, y: &State) -> [f64; 3] {
    let [k1, k2, k3, f1, f2, f3] = *y;
    let gamma = material.torsional();
    let twist = k3 - material.rest_twist;
    let moment = [k1 - 1.0, k2, gamma * twist];
    let elastic = 0.5 * (moment[0].powi(2) + k2 * k2 + gamma * twist * twist);
    let rest = moment[0] + material.rest_twist * moment[2];
    [
        (f1 * f1 + f2 * f2 + f3 * f3).sqrt(),
        moment[0] * f1 + moment[1] * f2 + moment[2] * f3,
        elastic + rest + f3,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_linearized_equations_are_half_the_difference_of_quadratic_ones() {
        let material = Material { poisson_ratio: 0.3, rest_twist: 0.2 };
        let y = [0.9, 0.2, -0.3, 0.1, -0.2, 0.4];
        for w in [[0.5, -1.0, 2.0, 0.3, 0.7, -0.4], [-0.2, 0.6, 0.1, 1.5, -0.8, 0.9]] {
            let moved = |sign: f64| -> State { std::array::from_fn(|i| y[i] + sign * w[i]) };
            let (up, down) = (moved(1.0), moved(-1.0));
            let (up, down) = (derivative(&material, &up), derivative(&material, &down));
            let change = linearized(&material, &y, &w);
            for i in 0..6 {
                assert!((change[i] - 0.5 * (up[i] - down[i])).abs() < 1e-15, "{i}");
            }
        }
    }
}
