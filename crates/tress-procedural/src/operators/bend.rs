//! Bend: strands bent about random axes.
//!
//! With `e` the operator guide's first segment, `aux` an axis away from it and
//! `n = e x aux / |e x aux|`, a strand bends about
//!
//! `a = cos(pi u) n + sin(pi u) (e/|e| x n)`,  `e'_j = R(a, theta v'_j) e_j`,
//!
//! `v'_j = sum_{i <= j} l_i z_i / sum l_i z_i`,  `z_j = sigmoid(10 (v_{j+1} - zeta))`,
//!
//! and its points are the sums of the turned segments. `u` is normal, truncated to -1 to 1.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::strand::{by_vector, running_sums};
use super::{Convention, Scratch, Setting, Sums, parameters};
use crate::functions::{sigmoid, sin_cos_turns};

/// Strands bent about random axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bend {
    /// `theta`: by how many degrees the tip is turned. Default 0.
    pub angle_degrees: f64,
    /// `zeta`: where on the strand the bend sets in, 0 (root) to 1 (tip). Default 0.
    pub start: f64,
}

parameters!(Bend {
    angle_degrees: 0.0, 360.0, 60.0;
    start: 0.0, 1.0, 0.5;
});

/// The axis a strand bends about, with what it is made of.
struct Axis {
    axis: DVec3,
    sine: f64,
    cosine: f64,
    /// The guide's first segment, its direction and length.
    e: DVec3,
    t: DVec3,
    aux: DVec3,
    /// `e x aux`, its direction and length.
    n: DVec3,
    n_length: f64,
}

impl Axis {
    #[inline(always)]
    fn new(guide: &[DVec3], u: f64) -> Self {
        let e = guide[1] - guide[0];
        let t = e.normalize_or_zero();
        let aux = if e.y.abs() < 0.1 { DVec3::Y } else { DVec3::X };
        let p = e.cross(aux);
        let n = p.normalize_or_zero();
        let (sine, cosine) = sin_cos_turns(0.5 * u);
        Self {
            axis: cosine * n + sine * t.cross(n),
            sine,
            cosine,
            e,
            t,
            aux,
            n,
            n_length: p.length(),
        }
    }

    /// Adds the gradients by the guide's first two points and by `u`.
    fn pull_back(&self, by_axis: DVec3, sums: &mut Sums<'_>) {
        let aside = self.t.cross(self.n);
        sums.numbers[0] += PI * by_axis.dot(self.cosine * aside - self.sine * self.n);
        let by_n = self.cosine * by_axis + self.sine * by_axis.cross(self.t);
        let by_t = self.sine * self.n.cross(by_axis);
        let by_p = by_vector(self.n, self.n_length, by_n);
        let by_e = self.aux.cross(by_p) + by_vector(self.t, self.e.length(), by_t);
        sums.guide[1] += by_e;
        sums.guide[0] -= by_e;
    }
}

/// `R(axis, phi) e` from the sine and cosine of `phi`.
#[inline(always)]
fn rotated(axis: DVec3, sine: f64, cosine: f64, e: DVec3) -> DVec3 {
    cosine * e + sine * axis.cross(e) + ((1.0 - cosine) * axis.dot(e)) * axis
}

impl Bend {
    /// Slope and shift of the start's sigmoid.
    fn onset(convention: Convention) -> (f64, f64) {
        match convention {
            Convention::Paper => (10.0, 0.0),
            Convention::PublishedProgram => (20.0, 0.05),
        }
    }

    /// Fills `weight` with `z`, `by_length` with the sums of `l z`, sine and cosine with those of
    /// each segment's angle; gives one over the length and one over `l'`.
    #[inline(always)]
    fn angles(&self, at: &Setting<'_>, scratch: &mut Scratch) -> (f64, f64) {
        let one_over_length = scratch.measure();
        let (steep, shift) = Self::onset(at.convention);
        let shift = steep * (shift - self.start);
        let steep = steep * one_over_length;
        let bent = &mut scratch.moved[0];
        let segments = scratch.weight.iter_mut().zip(&scratch.arc[1..]).zip(&scratch.lengths);
        for (((z, s), length), bent) in segments.zip(bent.iter_mut()) {
            *z = sigmoid(steep * s + shift);
            *bent = *z * length;
        }
        let sum = running_sums(0.0, bent, &mut scratch.by_length);
        let one_over_sum = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        let turns = self.angle_degrees / 360.0 * one_over_sum;
        let turning = scratch.sine.iter_mut().zip(&mut scratch.cosine);
        for ((sine, cosine), sum) in turning.zip(&scratch.by_length) {
            (*sine, *cosine) = sin_cos_turns(turns * *sum);
        }
        (one_over_length, one_over_sum)
    }

    #[inline(always)]
    pub(super) fn apply(&self, at: &Setting<'_>, scratch: &mut Scratch) {
        self.angles(at, scratch);
        let a = Axis::new(at.guide, at.numbers[0]).axis;
        let n = scratch.lengths.len();
        let (sine, cosine) = (&scratch.sine[..n], &scratch.cosine[..n]);
        {
            let [xs, ys, zs] = &scratch.rows;
            let (x, x_next) = (&xs[..n], &xs[1..=n]);
            let (y, y_next) = (&ys[..n], &ys[1..=n]);
            let (z, z_next) = (&zs[..n], &zs[1..=n]);
            let [turned_x, turned_y, turned_z] = &mut scratch.moved;
            let turned = turned_x.iter_mut().zip(turned_y).zip(turned_z);
            for (k, ((turned_x, turned_y), turned_z)) in turned.enumerate() {
                let e = DVec3::new(x_next[k] - x[k], y_next[k] - y[k], z_next[k] - z[k]);
                let turned = rotated(a, sine[k], cosine[k], e);
                (*turned_x, *turned_y, *turned_z) = (turned.x, turned.y, turned.z);
            }
        }
        for (row, turned) in scratch.rows.iter_mut().zip(&scratch.moved) {
            running_sums(row[0], turned, &mut row[1..]);
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
        scratch.load(strand);
        let (one_over_length, one_over_sum) = self.angles(at, scratch);
        let frame = Axis::new(at.guide, at.numbers[0]);
        let a = frame.axis;
        let n = strand.len() - 1;
        // From the tip: the gradients by turned segments, hence by segments, axis and angles.
        let mut behind = DVec3::ZERO;
        let mut by_axis = DVec3::ZERO;
        scratch.points[n] = DVec3::ZERO;
        for k in (0..n).rev() {
            behind += gradient[k + 1];
            let (sine, cosine) = (scratch.sine[k], scratch.cosine[k]);
            let e = strand[k + 1] - strand[k];
            let turned = rotated(a, sine, cosine, e);
            // The gradient by the angle takes the place of the sine.
            scratch.sine[k] = behind.dot(a.cross(turned));
            let along = a.dot(behind) * e + a.dot(e) * behind;
            by_axis += sine * e.cross(behind) + (1.0 - cosine) * along;
            scratch.points[k] = rotated(a, -sine, cosine, behind);
        }
        gradient[0] += behind - scratch.points[0];
        for k in 0..n {
            gradient[k + 1] = scratch.points[k] - scratch.points[k + 1];
        }
        frame.pull_back(by_axis, sums);
        self.pull_back_angles(strand, at, gradient, sums, scratch, [one_over_length, one_over_sum]);
    }

    /// What the gradients by the angles, held in `scratch.sine`, come to.
    fn pull_back_angles(
        &self,
        strand: &[DVec3],
        at: &Setting<'_>,
        gradient: &mut [DVec3],
        sums: &mut Sums<'_>,
        scratch: &mut Scratch,
        [one_over_length, one_over_sum]: [f64; 2],
    ) {
        let n = strand.len() - 1;
        let angle = self.angle_degrees.to_radians();
        // angle_k = theta S_k / S, S the last of the sums S_k.
        let mut by_total = 0.0;
        let mut by_angle = 0.0;
        for k in 0..n {
            let v = scratch.by_length[k] * one_over_sum;
            by_angle += scratch.sine[k] * v;
            by_total -= angle * scratch.sine[k] * v * one_over_sum;
        }
        sums.parameters[0] += by_angle * (TAU / 360.0);
        scratch.by_arc.fill(0.0);
        let (steep, _) = Self::onset(at.convention);
        let mut by_sum = by_total;
        for k in (0..n).rev() {
            by_sum += angle * scratch.sine[k] * one_over_sum;
            let z = scratch.weight[k];
            let by_sigmoid = by_sum * scratch.lengths[k] * steep * z * (1.0 - z);
            sums.parameters[1] -= by_sigmoid;
            scratch.by_fraction(k + 1, by_sigmoid, one_over_length);
            scratch.by_length[k] = by_sum * z;
        }
        scratch.pull_back(strand, gradient);
    }
}
