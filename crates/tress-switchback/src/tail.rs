//! How a rod approaches a coil, and how it leaves it: the equations linearized there.
//!
//! The linearized system `w' = A w` has the eigenvalue 0 twice (the pull and the torque, which do
//! not change) and four that come as `+-a +-ib`, or as `+-a1, +-a2` for coils pulled nearly
//! straight: two decaying, two growing. The polynomials
//!
//! `P = A^2 (A^2 -+ sum A + product)`, `sum = a1 + a2`, `product = a1 a2`
//!
//! project onto the plane of the decaying pair (upper sign) and of the growing pair, since they
//! annihilate all others; `sum` and `product` follow from the traces of `A^2` and `A^4`. No
//! eigenvector is computed, so nothing happens where a pair meets. On a plane the deviation `x` of
//! `kappa3` obeys `x'' +- sum x' + product x = 0`, and `(x, x')` are the coordinates used.

use crate::Material;
use crate::rod::{State, linearized};

/// Deviation of `kappa3` from the coil, and its derivative.
pub(crate) type Deviation = [f64; 2];

/// The planes of decaying and of growing deviations from a coil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tail {
    coil: State,
    /// Change of the state by `x` and by `x'` on the decaying plane.
    basis: [State; 2],
    /// What a change of the state means for `x` and `x'` of its decaying part.
    decaying: [State; 2],
    /// The same for its growing part.
    growing: [State; 2],
    sum: f64,
    product: f64,
}

impl Tail {
    /// The tail of the coil with this state; `None` where deviations do not decay (a coil that is
    /// not pulled).
    pub(crate) fn new(material: &Material, coil: State) -> Option<Self> {
        let a = |w: &State| linearized(material, &coil, w);
        let units: [State; 6] =
            std::array::from_fn(|j| std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 }));
        let (mut trace2, mut trace4) = (0.0, 0.0);
        for (j, unit) in units.iter().enumerate() {
            let twice = a(&a(unit));
            trace2 += twice[j];
            trace4 += a(&a(&twice))[j];
        }
        // Sum and sum of squares of the squared eigenvalues of one sign.
        let (squares, fourths) = (0.5 * trace2, 0.5 * trace4);
        let product = (0.5 * (squares * squares - fourths)).sqrt();
        let sum = (squares + 2.0 * product).sqrt();
        if !(0.0 < product && 0.0 < sum) {
            return None;
        }
        let projected = |w: &State, sum: f64| -> State {
            let (w1, w2) = (a(w), a(&a(w)));
            let factor = std::array::from_fn(|i| w2[i] - sum * w1[i] + product * w[i]);
            a(&a(&factor))
        };
        // On its plane a projection is `-2 sum S^3`, with `S = (0, 1; -product, -sum)` the rate.
        let coordinates = |sum: f64| {
            let columns = units.map(|unit| {
                let image = projected(&unit, sum);
                let (mut x, mut slope) = (image[2], a(&image)[2]);
                for _ in 0..3 {
                    (x, slope) = (-(sum * x + slope) / product, x);
                }
                [-x / (2.0 * sum), -slope / (2.0 * sum)]
            });
            [columns.map(|column| column[0]), columns.map(|column| column[1])]
        };
        // Two vectors of the plane, the second the derivative of the first.
        let p = projected(&units[2], sum);
        let q = a(&p);
        let curve = a(&q)[2];
        let determinant = p[2] * curve - q[2] * q[2];
        let basis = [
            std::array::from_fn(|i| (p[i] * curve - q[i] * q[2]) / determinant),
            std::array::from_fn(|i| (q[i] * p[2] - p[i] * q[2]) / determinant),
        ];
        let (decaying, growing) = (coordinates(sum), coordinates(-sum));
        determinant.is_normal().then_some(Self { coil, basis, decaying, growing, sum, product })
    }

    /// The mean of the two rates at which deviations decay.
    pub(crate) fn decay(&self) -> f64 {
        0.5 * self.sum
    }

    /// The slower of the two rates.
    pub(crate) fn slowest(&self) -> f64 {
        let a = self.decay();
        a - (a * a - self.product).max(0.0).sqrt()
    }

    /// The state with this decaying deviation.
    pub(crate) fn state(&self, deviation: Deviation) -> State {
        let [x, slope] = deviation;
        std::array::from_fn(|i| self.coil[i] + x * self.basis[0][i] + slope * self.basis[1][i])
    }

    /// The decaying part of a state's deviation.
    pub(crate) fn decaying(&self, y: &State) -> Deviation {
        self.decaying.map(|row| (0..6).map(|i| row[i] * (y[i] - self.coil[i])).sum())
    }

    /// The growing part of a state's deviation.
    pub(crate) fn growing(&self, y: &State) -> Deviation {
        self.growing.map(|row| (0..6).map(|i| row[i] * (y[i] - self.coil[i])).sum())
    }

    /// A decaying deviation `s` further on.
    pub(crate) fn decay_by(&self, deviation: Deviation, s: f64) -> Deviation {
        flow(deviation, s, self.sum, self.product)
    }

    /// A growing deviation `s` further on.
    pub(crate) fn grow_by(&self, deviation: Deviation, s: f64) -> Deviation {
        flow(deviation, s, -self.sum, self.product)
    }
}

/// The solution of `x'' + sum x' + product x = 0` after `s`.
fn flow([x, slope]: Deviation, s: f64, sum: f64, product: f64) -> Deviation {
    let a = 0.5 * sum;
    let square = product - a * a;
    let b = square.abs().sqrt();
    // exp(-a s) times cos(b s) and sin(b s)/b, or the hyperbolic pair.
    let (c, d) = if b * s.abs() < 1e-8 {
        ((-a * s).exp(), s * (-a * s).exp())
    } else if 0.0 < square {
        let (sine, cosine) = (b * s).sin_cos();
        ((-a * s).exp() * cosine, (-a * s).exp() * sine / b)
    } else {
        let (slow, fast) = ((-(a - b) * s).exp(), (-(a + b) * s).exp());
        (0.5 * (slow + fast), 0.5 * (slow - fast) / b)
    };
    [x * c + (slope + a * x) * d, slope * c - (a * slope + product * x) * d]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Coil;

    fn tail(v: f64) -> (Material, Tail) {
        let m = Material { poisson_ratio: 0.2, rest_twist: 0.0 };
        let coil = Coil::new(v, &m).expect("a coil");
        (m, Tail::new(&m, coil.state()).expect("a coil that is pulled"))
    }

    #[test]
    fn the_plane_is_invariant_and_flows_as_said() {
        // 0.97: a coil whose deviations decay without swinging.
        for v in [0.05, 0.3, 0.7, 0.97] {
            let (m, tail) = tail(v);
            let start = [0.7, -0.4];
            let w: State = std::array::from_fn(|i| tail.state(start)[i] - tail.coil[i]);
            let rate = linearized(&m, &tail.coil, &w);
            let h = 1e-5;
            let (up, down) = (tail.decay_by(start, h), tail.decay_by(start, -h));
            for (i, rate) in rate.iter().enumerate() {
                let change = (tail.state(up)[i] - tail.state(down)[i]) / (2.0 * h);
                assert!((rate - change).abs() < 1e-8, "{v} {i}: {rate} {change}");
            }
            let once = tail.decay_by(start, 0.8);
            let twice = tail.decay_by(tail.decay_by(start, 0.3), 0.5);
            assert!((once[0] - twice[0]).abs() + (once[1] - twice[1]).abs() < 1e-13);
        }
    }

    #[test]
    fn decaying_and_growing_parts_are_told_apart() {
        for v in [0.05, 0.3, 0.7, 0.97] {
            let (_, tail) = tail(v);
            let y = tail.state([0.7, -0.4]);
            let [x, slope] = tail.decaying(&y);
            assert!((x - 0.7).abs() + (slope + 0.4).abs() < 1e-9, "{v}: {x} {slope}");
            let [x, slope] = tail.growing(&y);
            assert!(x.abs() + slope.abs() < 1e-9, "{v}: {x} {slope}");
        }
    }

    #[test]
    fn the_slowest_deviation_decays_at_the_slower_rate() {
        // A coil whose deviations do not swing has one that only shrinks.
        let (_, stiff) = tail(0.97);
        let rate = stiff.slowest();
        assert!(0.0 < rate && rate < stiff.decay());
        let [x, slope] = stiff.decay_by([1.0, -rate], 2.0);
        let left = (-2.0 * rate).exp();
        assert!((x - left).abs() + (slope + rate * left).abs() < 1e-12);
        // Where they swing both rates are one.
        let (_, swinging) = tail(0.3);
        assert!((swinging.slowest() - swinging.decay()).abs() < 1e-15);
    }

    #[test]
    fn nothing_decays_where_nothing_pulls() {
        let m = Material::default();
        let ring = Coil::new(0.0, &m).expect("a ring");
        assert_eq!(Tail::new(&m, ring.state()), None);
        let pushed = Material { rest_twist: 0.5, ..m };
        let coil = Coil::new(0.2, &pushed).expect("a coil");
        assert!(coil.pull() < 0.0);
        assert_eq!(Tail::new(&pushed, coil.state()), None);
    }
}
