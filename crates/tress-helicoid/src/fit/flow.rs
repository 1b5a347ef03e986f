//! Lines of flow with their derivatives by the parameters.
//!
//! Along `p' = E_T(theta, alpha theta)` the derivative `P` of `p` by a parameter obeys
//!
//! `P' = (cos phi E_N + alpha E_B) dtheta (+ theta E_B for alpha)`, `dtheta = grad theta . P + t`,
//!
//! where `t` is the derivative of `theta` at a fixed place: `Re(w/U)` for `kT`, `Im(w/U)` for `kN`,
//! `z` for `kB` and 0 for `alpha`. Position and derivatives go together by the classical
//! Runge-Kutta method of order 4: in a fit the points are near each other.

use glam::DVec3;

use crate::Helicoid;
use crate::field::LEAST_CLEARANCE;

/// Radians that the flow may turn in one step; a step of half a radian errs by about 1e-4 of it.
const TURN: f64 = 0.35;

/// Steps between two points at most, so that no parameters make a fit hang.
const MOST_STEPS: usize = 24;

/// Clearance of a fitted line; nearer to its singular line steps of this length see nothing of it.
const CLEAR: f64 = 0.05;

/// A place on a line of flow, with derivatives by the first `N` of `kT, kN, kB, alpha`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along<const N: usize> {
    pub(super) position: DVec3,
    pub(super) theta: f64,
    pub(super) by_k: [DVec3; N],
}

/// What changes along the way.
struct Rates<const N: usize> {
    direction: DVec3,
    by_k: [DVec3; N],
    theta: f64,
    /// How fast the frame turns.
    turn: f64,
}

impl<const N: usize> Along<N> {
    pub(super) fn root() -> Self {
        Self { position: DVec3::ZERO, theta: 0.0, by_k: [DVec3::ZERO; N] }
    }

    /// Goes on by `h`; `None` where the line comes to its singular line.
    pub(super) fn advance(mut self, k: &Helicoid, h: f64) -> Option<Self> {
        let first = self.rates(k)?;
        let wanted = (first.turn * h / TURN).ceil();
        if !wanted.is_finite() {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, reason = "held to the most there may be")]
        let n = (wanted.max(1.0) as usize).min(MOST_STEPS);
        let step = h / n as f64;
        let mut first = Some(first);
        for _ in 0..n {
            let a = match first.take() {
                Some(rates) => rates,
                None => self.rates(k)?,
            };
            let b = self.ahead(&a, 0.5 * step).rates(k)?;
            let c = self.ahead(&b, 0.5 * step).rates(k)?;
            let d = self.ahead(&c, step).rates(k)?;
            let sixth = step / 6.0;
            let sum = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| (a + 2.0 * (b + c) + d) * sixth;
            self.position += sum(a.direction, b.direction, c.direction, d.direction);
            for j in 0..N {
                self.by_k[j] += sum(a.by_k[j], b.by_k[j], c.by_k[j], d.by_k[j]);
            }
            self.theta = k.theta_near(self.position, d.theta);
        }
        self.position.is_finite().then_some(self)
    }

    fn ahead(&self, rates: &Rates<N>, h: f64) -> Self {
        let mut by_k = self.by_k;
        for (p, rate) in by_k.iter_mut().zip(&rates.by_k) {
            *p += h * *rate;
        }
        Self { position: self.position + h * rates.direction, theta: rates.theta, by_k }
    }

    fn rates(&self, k: &Helicoid) -> Option<Rates<N>> {
        let theta = k.theta_near(self.position, self.theta);
        let (sine, cosine) = theta.sin_cos();
        let (rise, run) = k.phi(theta).sin_cos();
        let direction = DVec3::new(run * cosine, run * sine, rise);
        let e_n = DVec3::new(-sine, cosine, 0.0);
        let e_b = DVec3::new(-rise * cosine, -rise * sine, run);
        if k.clearance(self.position) < CLEAR {
            return None;
        }
        let gradient = k.gradient(self.position)?;
        let rate = gradient.dot(direction);
        let mut by_k = [DVec3::ZERO; N];
        if 0 < N {
            let fixed = by_parameter(k, self.position);
            let turn = run * e_n + k.alpha * e_b;
            for (j, change) in by_k.iter_mut().enumerate() {
                let more = if j == 3 { theta * e_b } else { DVec3::ZERO };
                *change = turn * (gradient.dot(self.by_k[j]) + fixed[j]) + more;
            }
        }
        let turn = rate.abs() * run.hypot(k.alpha);
        Some(Rates { direction, by_k, theta, turn })
    }
}

impl Along<4> {
    /// The vectors about which the frame turns when a parameter grows, in coordinates of the field.
    pub(super) fn turning(&self, k: &Helicoid) -> Option<[DVec3; 4]> {
        let gradient = k.gradient(self.position)?;
        let fixed = by_parameter(k, self.position);
        let (sine, cosine) = self.theta.sin_cos();
        let e_n = DVec3::new(-sine, cosine, 0.0);
        let mut turning = [DVec3::ZERO; 4];
        for (j, turn) in turning.iter_mut().enumerate() {
            let theta = gradient.dot(self.by_k[j]) + fixed[j];
            let more = if j == 3 { self.theta } else { 0.0 };
            *turn = theta * DVec3::Z - (k.alpha * theta + more) * e_n;
        }
        Some(turning)
    }
}

/// The derivatives of `theta` at a fixed place by `kT, kN, kB, alpha`.
fn by_parameter(k: &Helicoid, p: DVec3) -> [f64; 4] {
    let (re, im) = (1.0 + k.kn * p.x - k.kt * p.y, k.kt * p.x + k.kn * p.y);
    let square = (re * re + im * im).max(LEAST_CLEARANCE * LEAST_CLEARANCE);
    [(p.x * re + p.y * im) / square, (p.y * re - p.x * im) / square, p.z, 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(k: &Helicoid, j: usize, change: f64) -> Helicoid {
        let mut k = *k;
        *[&mut k.kt, &mut k.kn, &mut k.kb, &mut k.alpha][j] += change;
        k
    }

    fn along(k: &Helicoid, h: f64) -> Along<4> {
        let mut here = Along::root();
        for _ in 0..20 {
            here = here.advance(k, h / 20.0).expect("clear");
        }
        here
    }

    #[test]
    fn derivatives_are_those_of_the_line_and_its_frame() {
        let k = Helicoid::new(2.0, -0.3, 0.8, 0.7);
        let h = 1.4;
        let here = along(&k, h);
        let turning = here.turning(&k).expect("clear");
        let e = 1e-6;
        for (j, by_j) in turning.into_iter().enumerate() {
            let (up, down) = (with(&k, j, e), with(&k, j, -e));
            let (a, b) = (along(&up, h), along(&down, h));
            let slope = (a.position - b.position) / (2.0 * e);
            assert!(slope.distance(here.by_k[j]) < 1e-7, "parameter {j}");
            let turned = (up.frame(a.theta) - down.frame(b.theta)) * (0.5 / e);
            let spin = turned * k.frame(here.theta).transpose();
            let vector = DVec3::new(spin.y_axis.z, spin.z_axis.x, spin.x_axis.y);
            assert!(vector.distance(by_j) < 1e-7, "parameter {j}: {vector}");
        }
    }

    #[test]
    fn steps_agree_with_the_controlled_tracing() {
        use crate::{PHelicoid, Piece, Tracing};
        use tress_geometry::Frame;
        let pieces = [Piece { k: Helicoid::new(3.0, 0.2, -0.5, 0.9), length: 2.0 }];
        let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
        let tip = hair.tip(Tracing::Controlled(1e-11)).expect("clear");
        let here = Along::<0>::root().advance(&pieces[0].k, 2.0).expect("clear");
        assert!(here.position.distance(tip.position) < 2e-3);
        assert!(along(&pieces[0].k, 2.0).position.distance(tip.position) < 5e-5);
    }

    #[test]
    fn a_singular_line_ends_it() {
        let sink = Helicoid::new(0.0, -1.0, 0.0, 0.0);
        assert!(Along::<4>::root().advance(&sink, 1.0).is_none());
        let wild = Helicoid::new(f64::INFINITY, 0.0, 0.0, 0.0);
        assert!(Along::<0>::root().advance(&wild, 1.0).is_none());
    }
}
