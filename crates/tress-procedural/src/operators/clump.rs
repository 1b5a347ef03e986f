//! Clump: strands drawn to their operator guide towards the tip.
//!
//! `x~_j = (1 - w_j) x_j + w_j g_j`, with `w_j = 1 - exp(-a v_j)` and `g` the operator guide.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Convention, Scratch, Setting, Sums, parameters};
use crate::functions::exp;

/// Strands drawn to their operator guide towards the tip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Clump {
    /// `a`: how early strands meet; 0 leaves them, 3 brings tips within 5 % of their distance.
    /// Default 0.
    pub profile: f64,
}

parameters!(Clump {
    profile: 0.0, 100.0, 1.0;
});

impl Clump {
    /// Fills `scratch.cosine` with `v` and `scratch.weight` with `exp(-a v)`; gives one over the
    /// length where `v` goes by it.
    #[inline(always)]
    fn weigh(&self, at: &Setting<'_>, scratch: &mut Scratch) -> f64 {
        let one_over_length = match at.convention {
            Convention::Paper => {
                let one_over_length = scratch.measure();
                for (v, s) in scratch.cosine.iter_mut().zip(&scratch.arc) {
                    *v = s * one_over_length;
                }
                one_over_length
            }
            Convention::PublishedProgram => {
                let step = 1.0 / (scratch.arc.len() - 1) as f64;
                let mut index = 0.0;
                for v in &mut scratch.cosine {
                    *v = index * step;
                    index += 1.0;
                }
                0.0
            }
        };
        let a = self.profile;
        for (weight, v) in scratch.weight.iter_mut().zip(&scratch.cosine) {
            *weight = exp(-a * v);
        }
        one_over_length
    }

    #[inline(always)]
    pub(super) fn apply(&self, at: &Setting<'_>, scratch: &mut Scratch) {
        self.weigh(at, scratch);
        // The root's weight is 1: it stays to the last bit.
        let weights = &scratch.weight[1..];
        for (row, guide) in scratch.rows.iter_mut().zip(at.rows.points) {
            for ((x, g), w) in row[1..].iter_mut().zip(&guide[1..]).zip(weights) {
                *x = g + (*x - g) * w;
            }
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
        let one_over_length = self.weigh(at, scratch);
        for j in 0..strand.len() {
            let (v, w, by_x) = (scratch.cosine[j], scratch.weight[j], gradient[j]);
            let by_exponent = -w * by_x.dot(strand[j] - at.guide[j]);
            sums.parameters[0] += by_exponent * v;
            sums.guide[j] += (1.0 - w) * by_x;
            gradient[j] = w * by_x;
            if at.convention == Convention::Paper {
                scratch.by_fraction(j, by_exponent * self.profile, one_over_length);
            }
        }
        if at.convention == Convention::Paper {
            scratch.pull_back(strand, gradient);
        }
    }
}
