//! A coil taken out of a strand by regression.
//!
//! Over a window of two turns about `c`, with `x = (s - c) / h` in -1 to 1 and `w` the coil's
//! frequency, the points are fitted by least squares with
//!
//! `p(s) = a_0 + a_1 x + a_2 x^2 + (b_0 + b_1 x) cos w (s - c) + (d_0 + d_1 x) sin w (s - c)`:
//!
//! a parabola is the centerline, the rest a coil whose radius and plane change evenly. Where the
//! window's frequency is `w + e`, the coil is `b_0 cos + d_0 sin + e (s - c) (d_0 cos - b_0 sin)`,
//! so that `e h = (d_0 . b_1 - b_0 . d_1) / (|b_0|^2 + |d_0|^2)`: a step of Gauss-Newton with what
//! the fit has found anyway. Windows half a turn apart are blended, the first and the last
//! reaching the ends. The end of a strand is inside its window: nothing is taken as periodic or as
//! mirrored, which is what bends the ends of filtered lines.

use std::f64::consts::TAU;

use glam::DVec3;

/// Half a window, in turns. Below 1, parabola and coil are hard to tell apart; above, a bend is
/// no parabola.
const HALF_WINDOW: f64 = 1.0;

/// Distance of windows, in turns.
const WINDOW_STEP: f64 = 0.5;

/// Weight of a point at the window's ends; at its middle it is 1. Less of it and noise moves the
/// strand's own ends more; more, and windows jump as points come in.
const EDGE_WEIGHT: f64 = 0.4;

/// Share of the window's weight that holds the coil's change back. Ten times more, and a coil that
/// opens moves the line; none, and noise does.
const CHANGE_RIDGE: f64 = 5e-3;

/// The same for the other unknowns: only keeps windows of too few points solvable.
const RIDGE: f64 = 1e-9;

/// Unknowns of a window, for each coordinate.
const N: usize = 7;

/// The centerline's points of a strand with so many turns, two points at least.
pub(super) fn windowed(points: &[DVec3], turns: f64) -> Vec<DVec3> {
    let mut s = Vec::with_capacity(points.len());
    tress_geometry::polyline::arc_lengths(points, &mut s);
    let length = s[s.len() - 1];
    let turn = length / turns;
    let half = (HALF_WINDOW * turn).min(0.5 * length);
    let n_steps = ((length - 2.0 * half) / (WINDOW_STEP * turn) - 1e-9).ceil().max(0.0);
    let step = if n_steps > 0.0 { (length - 2.0 * half) / n_steps } else { length };
    let mut line = vec![DVec3::ZERO; points.len()];
    let mut k = 0.0;
    while k <= n_steps {
        let center = half + step * k;
        let inside = window(&s, center - half * (1.0 + 1e-9), center + half * (1.0 + 1e-9));
        let fit = Window { center, half, frequency: TAU / turn };
        let parabola = fit.centerline(&s[inside.clone()], &points[inside]);
        let from = if k > 0.0 { center - step } else { 0.0 };
        let to = if k < n_steps { center + step } else { length };
        for i in window(&s, from, to) {
            let beyond = (s[i] - center).abs() / step;
            let at_end = (s[i] < center && k <= 0.0) || (center < s[i] && n_steps <= k);
            let y = if at_end { 0.0 } else { beyond.min(1.0) };
            let share = 1.0 - y * y * (3.0 - 2.0 * y);
            let x = (s[i] - center) / half;
            line[i] += share * (parabola[0] + x * (parabola[1] + x * parabola[2]));
        }
        k += 1.0;
    }
    line
}

/// The points with arc length from `from` to `to`.
fn window(s: &[f64], from: f64, to: f64) -> std::ops::Range<usize> {
    s.partition_point(|&s| s < from)..s.partition_point(|&s| s <= to)
}

struct Window {
    center: f64,
    half: f64,
    frequency: f64,
}

impl Window {
    /// The parabola's coefficients, from the fit at a frequency that one step has put right.
    fn centerline(mut self, s: &[f64], points: &[DVec3]) -> [DVec3; 3] {
        let [.., b0, d0, b1, d1] = self.fit(s, points);
        let off = (d0.dot(b1) - b0.dot(d1)) / (b0.length_squared() + d0.length_squared());
        if off.is_finite() {
            let off = off / self.half;
            self.frequency += off.clamp(-0.4 * self.frequency, 0.6 * self.frequency);
        }
        let [a0, a1, a2, ..] = self.fit(s, points);
        [a0, a1, a2]
    }

    fn fit(&self, s: &[f64], points: &[DVec3]) -> [DVec3; N] {
        // From the window's own points, so that a strand far from the origin loses no digits.
        let Some(&origin) = points.get(points.len() / 2) else { return [DVec3::ZERO; N] };
        let mut gram = [[0.0; N]; N];
        let mut right = [DVec3::ZERO; N];
        let mut total = 0.0;
        for (&s, &p) in s.iter().zip(points) {
            let x = (s - self.center) / self.half;
            let weight = EDGE_WEIGHT + (1.0 - EDGE_WEIGHT) * (1.0 - x.abs()).max(0.0);
            let (sine, cosine) = (self.frequency * (s - self.center)).sin_cos();
            let basis = [1.0, x, x * x, cosine, sine, x * cosine, x * sine];
            total += weight;
            for i in 0..N {
                let weighted = weight * basis[i];
                right[i] += weighted * (p - origin);
                for j in 0..=i {
                    gram[i][j] += weighted * basis[j];
                }
            }
        }
        for (i, row) in gram.iter_mut().enumerate() {
            row[i] += total * if i < 5 { RIDGE } else { CHANGE_RIDGE };
        }
        solve(&mut gram, &mut right);
        right[0] += origin;
        right
    }
}

/// Solves by Cholesky's factors of the lower triangle of `gram`, in place.
fn solve(gram: &mut [[f64; N]; N], right: &mut [DVec3; N]) {
    for i in 0..N {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| gram[i][k] * gram[j][k]).sum();
            let left = gram[i][j] - known;
            gram[i][j] =
                if i == j { left.max(f64::MIN_POSITIVE).sqrt() } else { left / gram[j][j] };
        }
    }
    for i in 0..N {
        for k in 0..i {
            right[i] -= gram[i][k] * right[k];
        }
        right[i] /= gram[i][i];
    }
    for i in (0..N).rev() {
        for k in i + 1..N {
            right[i] -= gram[k][i] * right[k];
        }
        right[i] /= gram[i][i];
    }
}
