//! Scale: strands of random lengths.
//!
//! `x~_j = x_0 + (1 + eta u) (x_j - x_0)`, with `u` normal, truncated to -1 to 1.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Scratch, Setting, Sums, parameters};

/// Strands of random lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scale {
    /// `eta`: how much longer or shorter a strand may become, as a fraction. Default 0.
    pub random: f64,
}

parameters!(Scale {
    random: 0.0, 1.0, 0.3;
});

impl Scale {
    #[inline(always)]
    pub(super) fn apply(&self, at: &Setting<'_>, scratch: &mut Scratch) {
        let factor = 1.0 + self.random * at.numbers[0];
        for row in &mut scratch.rows {
            let root = row[0];
            row[1..].iter_mut().for_each(|x| *x = root + factor * (*x - root));
        }
    }

    pub(super) fn pull_back(
        &self,
        strand: &[DVec3],
        at: &Setting<'_>,
        gradient: &mut [DVec3],
        sums: &mut Sums<'_>,
    ) {
        let u = at.numbers[0];
        let factor = 1.0 + self.random * u;
        let mut by_factor = 0.0;
        let mut by_root = gradient[0];
        for (x, by_x) in strand[1..].iter().zip(&mut gradient[1..]) {
            by_factor += by_x.dot(*x - strand[0]);
            by_root += (1.0 - factor) * *by_x;
            *by_x *= factor;
        }
        gradient[0] = by_root;
        sums.parameters[0] += u * by_factor;
        sums.numbers[0] += self.random * by_factor;
    }
}
