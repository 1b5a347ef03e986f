//! Straighten: strands pulled straight, their lengths kept. An operator of tress's own.
//!
//! Every segment turns towards the chord of its surroundings and keeps its length `l_j`:
//!
//! `e'_j = l_j q_j / |q_j|`, `q_j = (1 - t) e_j / l_j + t D_j`,
//!
//! `D_j` the direction from the point `h` before to the point `h` behind the segment; near the ends
//! it is that of as many points at the end. Coils shorter than the surroundings unwind along the
//! line they wind about, and the strand reaches as much farther as ironed hair does.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::strand::by_vector;
use super::{Scratch, Sums, parameters};

/// Strands pulled straight, their lengths kept.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Straighten {
    /// `t`: 0 leaves a strand as it is, 1 leaves no curl shorter than the surroundings. Default 0.
    pub amount: f64,
    /// What counts as a segment's surroundings, as a fraction of the strand's points: bends longer
    /// than this stay. Default 0.25.
    pub span: f64,
}

impl Default for Straighten {
    fn default() -> Self {
        Self { amount: 0.0, span: 0.25 }
    }
}

// The span counts points and has no derivative: its gradient is 0.
parameters!(Straighten {
    amount: 0.0, 1.0, 0.5;
    span: 0.0, 1.0, 0.25;
});

impl Straighten {
    /// Points that the surroundings reach beyond a segment on either side, of a strand of `n`.
    fn reach(&self, n: usize) -> usize {
        let points = (0.5 * self.span * (n - 1) as f64).round();
        #[expect(clippy::cast_possible_truncation, reason = "the span is a checked fraction of n")]
        #[expect(clippy::cast_sign_loss, reason = "the span is a checked fraction of n")]
        let reach = points as usize;
        reach
    }

    /// The ends of the surroundings of segment `j` of a strand of `n` points.
    fn surroundings(&self, j: usize, n: usize) -> (usize, usize) {
        let reach = self.reach(n);
        let segments = (2 * reach + 1).min(n - 1);
        let first = j.saturating_sub(reach).min(n - 1 - segments);
        (first, first + segments)
    }

    pub(super) fn apply(&self, scratch: &mut Scratch) {
        let mut points = std::mem::take(&mut scratch.points);
        scratch.store(&mut points);
        let mut end = points[0];
        for j in 0..points.len() - 1 {
            let (e, _, q) = self.turned(&points, j);
            end += q.normalize_or_zero() * e.length();
            for (row, x) in scratch.rows.iter_mut().zip(end.to_array()) {
                row[j + 1] = x;
            }
        }
        scratch.points = points;
    }

    /// Segment `j`, the direction of its surroundings, and `q_j`.
    fn turned(&self, points: &[DVec3], j: usize) -> (DVec3, DVec3, DVec3) {
        let (first, last) = self.surroundings(j, points.len());
        let e = points[j + 1] - points[j];
        let chord = (points[last] - points[first]).normalize_or_zero();
        (e, chord, (1.0 - self.amount) * e.normalize_or_zero() + self.amount * chord)
    }

    pub(super) fn pull_back(
        &self,
        strand: &[DVec3],
        gradient: &mut [DVec3],
        sums: &mut Sums<'_>,
        scratch: &mut Scratch,
    ) {
        let n = strand.len();
        let by_points = &mut scratch.points[..n];
        by_points.fill(DVec3::ZERO);
        let mut behind = DVec3::ZERO;
        for j in (0..n - 1).rev() {
            behind += gradient[j + 1];
            let (e, chord, q) = self.turned(strand, j);
            let (length, d) = (e.length(), e.normalize_or_zero());
            let direction = q.normalize_or_zero();
            let by_q = by_vector(direction, q.length(), length * behind);
            sums.parameters[0] += by_q.dot(chord - d);
            let by_e = d * direction.dot(behind) + by_vector(d, length, (1.0 - self.amount) * by_q);
            by_points[j + 1] += by_e;
            by_points[j] -= by_e;
            let (first, last) = self.surroundings(j, n);
            let reach = strand[last].distance(strand[first]);
            let by_chord = by_vector(chord, reach, self.amount * by_q);
            by_points[last] += by_chord;
            by_points[first] -= by_chord;
        }
        by_points[0] += gradient[0] + behind;
        gradient.copy_from_slice(by_points);
    }
}
