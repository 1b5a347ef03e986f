//! Curl: strands wound about their operator guide.
//!
//! With `t` the operator guide's tangents, `n = (t_y, -t_x, 0)` made a unit vector (x where `t` is
//! along z) and `b = t x n`,
//!
//! `x~_j = x_j + z_j rho_j (sin(2 pi theta_j) n_j + cos(2 pi theta_j) b_j)`,  `j > 0`,
//!
//! `rho_j = rho (0.43 + 0.79 v_j)`, `z_j = sigmoid(10 (v_j - zeta))`,
//! `theta_j = omega' s_j + 3.9 u_2`, `omega' = max(3 (omega + omega_rand u_1), 0)`.
//!
//! `u_1` (normal, truncated to -1 to 1) and `u_2` (even in 0 to 1) are one for all strands of an
//! operator guide, so that they curl together.

use std::f64::consts::TAU;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::strand::by_vector;
use super::{Convention, GuideRows, Scratch, Setting, Sums, parameters};
use crate::functions::{sigmoid, sin_cos_turns};

/// Strands wound about their operator guide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Curl {
    /// `rho`: radius, in the groom's unit; 0.43 times this at the root, 1.22 times at the tip.
    /// Default 0.
    pub radius: f64,
    /// `omega`: a third of the turns in a unit of length. Default 0.
    pub frequency: f64,
    /// `omega_rand`: how much the frequency of an operator guide's strands may differ. Default 0.
    pub random_frequency: f64,
    /// `zeta`: where on the strand curls set in, 0 (root) to 1 (tip). Default 0.
    pub start: f64,
}

parameters!(Curl {
    radius: 0.0, f64::INFINITY, 1.0;
    frequency: 0.0, f64::INFINITY, 1.0;
    random_frequency: 0.0, f64::INFINITY, 0.3;
    start: 0.0, 1.0, 0.5;
});

/// Turns that `u_2` can shift a curl by, as printed.
const PHASE: f64 = 3.9;
/// Radius at the root over `rho`, and how much it grows towards the tip, as printed.
const RADIUS: [f64; 2] = [0.43, 0.79];

/// The two points whose difference is the tangent at point `j` of `n`.
fn neighbors(j: usize, n: usize) -> (usize, usize) {
    (j.saturating_sub(1), (j + 1).min(n - 1))
}

/// `(t_y, -t_x, 0)`, or nothing where it is too short to have a direction.
fn across(t: DVec3) -> Option<DVec3> {
    (t.x.abs() + t.y.abs() >= 1e-4).then(|| DVec3::new(t.y, -t.x, 0.0))
}

/// Normal and binormal at point `j` of an operator guide; the normal's z is 0.
pub(super) fn normals(guide: &[DVec3], j: usize) -> [DVec3; 2] {
    let (first, last) = neighbors(j, guide.len());
    let t = (guide[last] - guide[first]).normalize_or_zero();
    let n = across(t).map_or(DVec3::X, DVec3::normalize);
    [n, t.cross(n)]
}

impl Curl {
    /// Turns in a unit of length.
    fn turns(&self, u: f64) -> f64 {
        (3.0 * (self.frequency + self.random_frequency * u)).max(0.0)
    }

    /// Slope and shift of the start's sigmoid.
    fn onset(convention: Convention) -> (f64, f64) {
        let shift = if convention == Convention::Paper { 0.0 } else { 0.05 };
        (10.0, shift)
    }

    /// Fills `weight` with `z`, sine and cosine with those of the turning; gives one over length.
    #[inline(always)]
    fn wind(&self, at: &Setting<'_>, scratch: &mut Scratch) -> f64 {
        let one_over_length = scratch.measure();
        let (steep, shift) = Self::onset(at.convention);
        let shift = steep * (shift - self.start);
        let steep = steep * one_over_length;
        for (z, s) in scratch.weight.iter_mut().zip(&scratch.arc) {
            *z = sigmoid(steep * s + shift);
        }
        let (turns, phase) = (self.turns(at.numbers[0]), PHASE * at.numbers[1]);
        let turning = scratch.sine.iter_mut().zip(&mut scratch.cosine);
        for ((sine, cosine), s) in turning.zip(&scratch.arc) {
            (*sine, *cosine) = sin_cos_turns(turns * s + phase);
        }
        one_over_length
    }

    #[inline(always)]
    pub(super) fn apply(&self, at: &Setting<'_>, scratch: &mut Scratch) {
        let one_over_length = self.wind(at, scratch);
        let [start, growth] = RADIUS.map(|factor| factor * self.radius);
        let growth = growth * one_over_length;
        let turning = scratch.sine.iter_mut().zip(&mut scratch.cosine);
        for ((sine, cosine), (z, s)) in turning.zip(scratch.weight.iter().zip(&scratch.arc)) {
            let radius = z * (start + growth * s);
            *sine *= radius;
            *cosine *= radius;
        }
        let (sine, cosine) = (&scratch.sine[1..], &scratch.cosine[1..]);
        let GuideRows { normals: [nx, ny], binormals, .. } = at.rows;
        let [x, y, z] = &mut scratch.rows;
        for (row, normals, binormals) in [(x, nx, binormals[0]), (y, ny, binormals[1])] {
            let axes = normals[1..].iter().zip(&binormals[1..]);
            for ((x, (n, b)), (sine, cosine)) in
                row[1..].iter_mut().zip(axes).zip(sine.iter().zip(cosine))
            {
                *x += sine * n + cosine * b;
            }
        }
        for ((z, b), cosine) in z[1..].iter_mut().zip(&binormals[2][1..]).zip(cosine) {
            *z += cosine * b;
        }
    }

    pub(super) fn pull_back(
        &self,
        strand: &[DVec3],
        at: &Setting<'_>,
        gradient: &mut [DVec3],
        sums: &mut Sums<'_>,
        scratch: &mut Scratch,
    ) {
        scratch.clear();
        scratch.load(strand);
        let one_over_length = self.wind(at, scratch);
        let turns = self.turns(at.numbers[0]);
        let (steep, _) = Self::onset(at.convention);
        let mut by_turns = 0.0;
        #[expect(clippy::needless_range_loop, reason = "many arrays run along")]
        for j in 1..strand.len() {
            let (z, sine, cosine) = (scratch.weight[j], scratch.sine[j], scratch.cosine[j]);
            let (s, by_x, [n, b]) = (scratch.arc[j], gradient[j], at.rows.normals(j));
            let swell = RADIUS[0] + RADIUS[1] * s * one_over_length;
            let (along_n, along_b) = (by_x.dot(n), by_x.dot(b));
            let radial = sine * along_n + cosine * along_b;
            let by_sigmoid = self.radius * swell * radial * steep * z * (1.0 - z);
            let by_angle = z * self.radius * swell * TAU * (cosine * along_n - sine * along_b);
            sums.parameters[0] += z * swell * radial;
            sums.parameters[3] -= by_sigmoid;
            sums.numbers[1] += PHASE * by_angle;
            by_turns += s * by_angle;
            scratch.by_arc[j] += turns * by_angle;
            let by_fraction = by_sigmoid + z * self.radius * RADIUS[1] * radial;
            scratch.by_fraction(j, by_fraction, one_over_length);
            let radius = z * self.radius * swell;
            pull_back_normals(at.guide, j, radius * sine * by_x, radius * cosine * by_x, sums);
        }
        if turns > 0.0 {
            sums.parameters[1] += 3.0 * by_turns;
            sums.parameters[2] += 3.0 * at.numbers[0] * by_turns;
            sums.numbers[0] += 3.0 * self.random_frequency * by_turns;
        }
        scratch.pull_back(strand, gradient);
    }
}

/// Adds the gradients by the guide's points from those by normal and binormal at point `j`.
fn pull_back_normals(guide: &[DVec3], j: usize, by_n: DVec3, by_b: DVec3, sums: &mut Sums<'_>) {
    let (first, last) = neighbors(j, guide.len());
    let step = guide[last] - guide[first];
    let t = step.normalize_or_zero();
    let across = across(t);
    let n = across.map_or(DVec3::X, DVec3::normalize);
    let by_n = by_n + by_b.cross(t);
    let mut by_t = n.cross(by_b);
    if let Some(p) = across {
        let by_p = by_vector(n, p.length(), by_n);
        by_t.y += by_p.x;
        by_t.x -= by_p.y;
    }
    let by_step = by_vector(t, step.length(), by_t);
    sums.guide[last] += by_step;
    sums.guide[first] -= by_step;
}
