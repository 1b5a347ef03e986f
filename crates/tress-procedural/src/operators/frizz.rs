//! Frizz: Perlin noise on every strand.
//!
//! `x~_j = x_j + alpha/2 eps_j`, `j > 0`, with
//! `eps^c = 2/3 (perlin(chi + xi^c) + 1/3 perlin(2 (chi + xi^c)))`, `chi_j = omega s_j + 10 u`, one
//! offset `xi^c` for each of x, y, z, and `u` even in 0 to 1.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Convention, Scratch, Setting, Sums, parameters};
use crate::noise::{perlin, perlin_and_slope};

/// Noise on every strand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Frizz {
    /// `omega`: cells of noise in a unit of length. Default 0.
    pub frequency: f64,
    /// `alpha`: width of the band the noise fills, in the groom's unit. Default 0.
    pub amplitude: f64,
}

parameters!(Frizz {
    frequency: 0.0, f64::INFINITY, 1.0;
    amplitude: 0.0, f64::INFINITY, 1.0;
});

/// `xi`: offsets that no two axes share a stretch of noise after, for strands of up to 60 cells.
const OFFSETS: [f64; 3] = [0.0, 85.37, 170.73];
/// How far along the noise `u` shifts a strand, as printed.
const SHIFT: f64 = 10.0;

/// Factors of the two octaves.
fn octaves(convention: Convention) -> [f64; 2] {
    match convention {
        Convention::Paper => [2.0 / 3.0, 2.0 / 9.0],
        Convention::PublishedProgram => [1.0 / 1.5, 0.5 / 1.5],
    }
}

impl Frizz {
    /// Fills `weight` with the arc lengths that the noise goes by; gives the step between points
    /// over the strand's length where it goes by index.
    #[inline(always)]
    fn place(at: &Setting<'_>, scratch: &mut Scratch) -> f64 {
        scratch.measure();
        match at.convention {
            Convention::Paper => {
                scratch.weight.copy_from_slice(&scratch.arc);
                0.0
            }
            Convention::PublishedProgram => {
                let last = scratch.arc.len() - 1;
                let step = 1.0 / last as f64;
                let length = scratch.arc[last];
                let mut index = 0.0;
                for place in &mut scratch.weight {
                    *place = index * step * length;
                    index += 1.0;
                }
                step
            }
        }
    }

    #[inline(always)]
    pub(super) fn apply(&self, at: &Setting<'_>, scratch: &mut Scratch) {
        Self::place(at, scratch);
        let [first, second] = octaves(at.convention).map(|factor| 0.5 * self.amplitude * factor);
        for (row, offset) in scratch.rows.iter_mut().zip(OFFSETS) {
            let shift = SHIFT * at.numbers[0] + offset;
            for (x, s) in row[1..].iter_mut().zip(&scratch.weight[1..]) {
                let chi = self.frequency * s + shift;
                *x += first * perlin(chi) + second * perlin(2.0 * chi);
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
        let step = Self::place(at, scratch);
        let [first, second] = octaves(at.convention);
        let last = strand.len() - 1;
        let mut index = 0.0;
        #[expect(clippy::needless_range_loop, reason = "many arrays run along")]
        for j in 1..=last {
            index += 1.0;
            let s = scratch.weight[j];
            let chi = self.frequency * s + SHIFT * at.numbers[0];
            let mut by_chi = 0.0;
            for (offset, by_x) in OFFSETS.iter().zip(gradient[j].to_array()) {
                let (coarse, coarse_slope) = perlin_and_slope(chi + offset);
                let (fine, fine_slope) = perlin_and_slope(2.0 * (chi + offset));
                sums.parameters[1] += 0.5 * by_x * (first * coarse + second * fine);
                by_chi += by_x * (first * coarse_slope + 2.0 * second * fine_slope);
            }
            by_chi *= 0.5 * self.amplitude;
            sums.parameters[0] += s * by_chi;
            sums.numbers[0] += SHIFT * by_chi;
            match at.convention {
                Convention::Paper => scratch.by_arc[j] += self.frequency * by_chi,
                Convention::PublishedProgram => {
                    scratch.by_arc[last] += index * step * self.frequency * by_chi;
                }
            }
        }
        scratch.pull_back(strand, gradient);
    }
}
