//! Lines of flow with their derivatives by the parameters.
//!
//! Along `p' = E_T(theta, alpha theta)` the derivative `P` of `p` by a parameter obeys
//!
//! `P' = (cos phi E_N + alpha E_B) dtheta (+ theta E_B for alpha)`, `dtheta = grad theta . P + t`,
//!
//! where `t` is the derivative of `theta` at a fixed place: `Re(w/U)` for `kT`, `Im(w/U)` for `kN`,
//! `z` for `kB` and 0 for `alpha`. Position and derivatives go together by the classical
//! Runge-Kutta method of order 4. Steps are as long as the flow's turning lets them be, whatever
//! lies between: the points of a strand are read off cubics through the ends of a step.
//!
//! `theta` goes on by its own rate, `theta' = grad theta . E_T`, so that cycles count themselves,
//! and its sines by those of the small difference.

mod angles;

use glam::DVec3;

use crate::Helicoid;
use angles::Angles;

/// Radians that the flow may turn in one step while parameters are sought. The method errs by
/// `turn^4 / 120` of the arc length, the cubics between by `turn^4 / 384` of the radius of
/// curvature: by 1e-4, of which a tolerance sees nothing.
pub(super) const ROUGH: f64 = 0.2;

/// The same where points may come from a helicoid that is to be found again: 1e-6.
pub(super) const FINE: f64 = 0.1;

/// Steps of a piece at most, so that no parameters make a fit hang.
const MOST_STEPS: f64 = 256.0;

/// Clearance of a fitted line; nearer to its singular line steps of this length see nothing of it.
const CLEAR: f64 = 0.05;

/// What is known on a line of flow: the position, its direction there, and the position's
/// derivatives by the first `N` of `kT, kN, kB, alpha`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along<const N: usize> {
    pub(super) position: DVec3,
    pub(super) direction: DVec3,
    pub(super) by_k: [DVec3; N],
}

/// The end of a line of flow.
#[derive(Clone, Copy, Debug)]
pub(super) struct End<const N: usize> {
    pub(super) position: DVec3,
    /// The first angle, cycles counted.
    pub(super) theta: f64,
    pub(super) by_k: [DVec3; N],
}

/// Walks the line from the root over `length` and gives its end; `None` where it comes to its
/// singular line. In a step it may turn by so many radians. `visit` gets what is at each of the
/// `stops`, which ascend from 0 to `length`.
pub(super) fn walk<const N: usize>(
    k: &Helicoid,
    length: f64,
    turn: f64,
    stops: impl Iterator<Item = f64>,
    mut visit: impl FnMut(Along<N>),
) -> Option<End<N>> {
    let mut stops = stops.peekable();
    let tip = steps(k, length, turn, |from, to, step| {
        while let Some(stop) = stops.next_if(|&stop| step.is_last || stop <= step.begins + step.h) {
            visit(between(from, to, step.h, ((stop - step.begins) / step.h).min(1.0)));
        }
    })?;
    let End { position, by_k, .. } = tip.end;
    let at_tip = Along { position, direction: tip.rates.direction, by_k };
    stops.for_each(|_| visit(at_tip));
    position.is_finite().then_some(tip.end)
}

/// The mean curvature of the line over `length`, that of the root where there is none; `None` where
/// it comes to its singular line.
pub(crate) fn mean_curvature(k: &Helicoid, length: f64) -> Option<f64> {
    let mut turned = 0.0;
    let tip = steps::<0>(k, length, ROUGH, |from, to, step| {
        turned += 0.5 * step.h * (from.rates.turn + to.rates.turn);
    })?;
    Some(if 0.0 < length { turned / length } else { tip.rates.turn })
}

/// The end of a step, which begins the next one.
struct Node<const N: usize> {
    end: End<N>,
    angles: Angles,
    rates: Rates<N>,
}

/// Where a step begins, and how long it is.
struct Step {
    begins: f64,
    h: f64,
    is_last: bool,
}

/// Takes all steps of a line and shows `visit` the ends of each; gives the last one's end.
fn steps<const N: usize>(
    k: &Helicoid,
    length: f64,
    turn: f64,
    mut visit: impl FnMut(&Node<N>, &Node<N>, Step),
) -> Option<Node<N>> {
    let end = End { position: DVec3::ZERO, theta: 0.0, by_k: [DVec3::ZERO; N] };
    let angles = Angles::of(k, 0.0);
    let mut here = Node { end, angles, rates: end.rates(k, &angles)? };
    let mut s = 0.0;
    while s < length {
        let h = step_length(&here.rates, turn, length - s, length)?;
        let end = here.end.advance(k, &here.angles, &here.rates, h)?;
        let angles = here.angles.turned(k, end.theta - here.end.theta);
        let next = Node { end, angles, rates: end.rates(k, &angles)? };
        let is_last = length <= s + h;
        visit(&here, &next, Step { begins: s, h, is_last });
        here = next;
        s = if is_last { length } else { s + h };
    }
    Some(here)
}

/// How far the next step goes.
fn step_length<const N: usize>(rates: &Rates<N>, turn: f64, rest: f64, length: f64) -> Option<f64> {
    let steps = rates.turn.max(rates.nearing) * rest / turn;
    steps.is_finite().then(|| (rest / steps.ceil().max(1.0)).max(length / MOST_STEPS).min(rest))
}

/// What changes along the way.
struct Rates<const N: usize> {
    direction: DVec3,
    theta: f64,
    by_k: [DVec3; N],
    /// How fast the frame turns.
    turn: f64,
    /// How fast the singular line could come nearer, over the distance from it: next to it the flow
    /// begins to turn however straight it was.
    nearing: f64,
}

impl<const N: usize> End<N> {
    /// One step of the Runge-Kutta method from here, where `angles` and `first` are.
    fn advance(&self, k: &Helicoid, angles: &Angles, first: &Rates<N>, h: f64) -> Option<Self> {
        let stage = |slope: &Rates<N>, h: f64| {
            let ahead = self.ahead(slope, h);
            let turned = angles.turned(k, h * slope.theta);
            ahead.rates(k, &turned)
        };
        let b = stage(first, 0.5 * h)?;
        let c = stage(&b, 0.5 * h)?;
        let d = stage(&c, h)?;
        let sixth = h / 6.0;
        let position = self.position
            + sixth * (first.direction + 2.0 * (b.direction + c.direction) + d.direction);
        let theta = self.theta + sixth * (first.theta + 2.0 * (b.theta + c.theta) + d.theta);
        let mut by_k = self.by_k;
        for (j, p) in by_k.iter_mut().enumerate() {
            *p += sixth * (first.by_k[j] + 2.0 * (b.by_k[j] + c.by_k[j]) + d.by_k[j]);
        }
        Some(Self { position, theta, by_k })
    }

    fn ahead(&self, slope: &Rates<N>, h: f64) -> Self {
        let mut by_k = self.by_k;
        for (p, rate) in by_k.iter_mut().zip(&slope.by_k) {
            *p += h * *rate;
        }
        Self {
            position: self.position + h * slope.direction,
            theta: self.theta + h * slope.theta,
            by_k,
        }
    }

    fn rates(&self, k: &Helicoid, angles: &Angles) -> Option<Rates<N>> {
        let field = Field::at(k, self.position)?;
        let direction = angles.e_t();
        let theta = field.gradient.dot(direction);
        let mut by_k = [DVec3::ZERO; N];
        if 0 < N {
            let e_b = angles.e_b();
            let across = angles.run * angles.e_n() + k.alpha * e_b;
            for (j, change) in by_k.iter_mut().enumerate() {
                let more = if j == 3 { self.theta * e_b } else { DVec3::ZERO };
                *change = across * field.dtheta(j, self.by_k[j]) + more;
            }
        }
        let turn = theta.abs() * (angles.run * angles.run + k.alpha * k.alpha).sqrt();
        Some(Rates { direction, theta, by_k, turn, nearing: field.nearing })
    }
}

impl End<4> {
    /// The vectors about which the frame turns when a parameter grows, in coordinates of the field.
    pub(super) fn turning(&self, k: &Helicoid) -> [DVec3; 4] {
        let Some(field) = Field::at(k, self.position) else { return [DVec3::ZERO; 4] };
        let e_n = Angles::of(k, self.theta).e_n();
        let mut turning = [DVec3::ZERO; 4];
        for (j, turn) in turning.iter_mut().enumerate() {
            let theta = field.dtheta(j, self.by_k[j]);
            let more = if j == 3 { self.theta } else { 0.0 };
            *turn = theta * DVec3::Z - (k.alpha * theta + more) * e_n;
        }
        turning
    }
}

/// What the field is at a place, but for its angles.
struct Field {
    gradient: DVec3,
    /// Derivatives of `theta` there by `kT, kN, kB, alpha`.
    by_parameter: [f64; 4],
    nearing: f64,
}

impl Field {
    fn at(k: &Helicoid, p: DVec3) -> Option<Self> {
        let (re, im) = (1.0 + k.kn * p.x - k.kt * p.y, k.kt * p.x + k.kn * p.y);
        let square = re * re + im * im;
        if !(CLEAR * CLEAR < square && square.is_finite()) {
            return None;
        }
        let inverse = square.recip();
        Some(Self {
            gradient: DVec3::new(
                (k.kt * re - k.kn * im) * inverse,
                (k.kn * re + k.kt * im) * inverse,
                k.kb,
            ),
            by_parameter: [
                (p.x * re + p.y * im) * inverse,
                (p.y * re - p.x * im) * inverse,
                p.z,
                0.0,
            ],
            nearing: ((k.kt * k.kt + k.kn * k.kn) * inverse).sqrt(),
        })
    }

    /// How `theta` changes with parameter `j` where the place changes by `by_k`.
    fn dtheta(&self, j: usize, by_k: DVec3) -> f64 {
        self.gradient.dot(by_k) + self.by_parameter[j]
    }
}

/// What is at the part `t` of a step of length `h`, on the cubics through its ends.
fn between<const N: usize>(from: &Node<N>, to: &Node<N>, h: f64, t: f64) -> Along<N> {
    let (p, q) = (&from.end, &to.end);
    let (v, w) = (&from.rates, &to.rates);
    let r = 1.0 - t;
    let (a, b) = (r * r * (1.0 + 2.0 * t), t * t * (1.0 + 2.0 * r));
    let (c, d) = (h * r * r * t, -h * t * t * r);
    let mut by_k = [DVec3::ZERO; N];
    for (j, by) in by_k.iter_mut().enumerate() {
        *by = a * p.by_k[j] + b * q.by_k[j] + c * v.by_k[j] + d * w.by_k[j];
    }
    let chord = (q.position - p.position) / h;
    Along {
        position: a * p.position + b * q.position + c * v.direction + d * w.direction,
        direction: 6.0 * t * r * chord
            + r * (r - 2.0 * t) * v.direction
            + t * (t - 2.0 * r) * w.direction,
        by_k,
    }
}

#[cfg(test)]
mod tests;
