//! The sliced Wasserstein loss on segments and on their spectra [IPG 11, 12], as least squares.
//!
//! Two sets of strands are compared as distributions: every strand gives one number a slice, the
//! projection of its segments, or of the absolute values of their Fourier transform, on a
//! direction; the numbers of either set are sorted, and the differences of equal ranks are what is
//! to vanish. Ranks are averaged in [`RANKS`] blocks. That is a sum of squares, so that a few
//! parameters are found by Gauss-Newton steps and not by thousands of gradient steps.
//!
//! Departures from the paper, each because it measured better. Segments are taken relative to the
//! mean of the strand's [patch](super::sample), and apart from them relative to its neighbour's, in
//! the frame of the guide's root: what is wrong with the guides and what varies over the head is
//! then not in the way of what varies from strand to strand. Spectra are taken through Hann's
//! window: without it the jump from a strand's tip back to its root leaks into all frequencies,
//! where a bend hides frizz. Slices reach over a random stretch of the strand (or band of
//! frequencies) where the paper's reach over all of it, so that the start of a curl and its
//! frequency show in some of them; and each slice is divided by the spread of the target's numbers.

use std::ops::Range;

use glam::{DMat3, DVec3};
use rand::RngExt;
use rayon::prelude::*;
use realfft::RealFftPlanner;
use tress_edit::strand_rng;
use tress_geometry::Frame;

use super::sample::Sample;
use crate::EvenStrands;

/// Blocks of equal ranks that a slice is averaged in.
pub(crate) const RANKS: usize = 24;
/// Share of the spread of all slices of a kind that is added to a slice's own: where strands are
/// alike, at the root, what is left of the errors of guides would otherwise outweigh everything
/// else.
const FLOOR: f64 = 0.25;
/// The most that a difference of ranks counts for, in spreads.
const FAR: f64 = 3.0;

/// A direction that strands are projected on: weights over a stretch of segments or band of
/// frequencies, times a direction in space.
struct Slice {
    first: usize,
    weights: Vec<f64>,
    direction: DVec3,
}

impl Slice {
    /// Weights in the shape of a bell about a random middle, of a random width.
    fn random(count: usize, nonnegative: bool, seed: u64, index: usize) -> Self {
        let mut rng = strand_rng(seed, index);
        let n = count as f64;
        let half = (n * 0.5).powf(rng.random_range(0.3..1.0)).max(1.0);
        let middle = rng.random_range(0.0..n);
        let bell = |j: f64| {
            let x = (j + 0.5 - middle) / half;
            if x.abs() < 1.0 { 0.5 + 0.5 * (std::f64::consts::PI * x).cos() } else { 0.0 }
        };
        let first = (0..count).find(|&j| bell(j as f64) > 0.0).unwrap_or(0);
        let weights: Vec<f64> =
            (first..count).map(|j| bell(j as f64)).take_while(|&weight| weight > 0.0).collect();
        let direction = loop {
            let d = DVec3::from_array(std::array::from_fn(|_| rng.random_range(-1.0..1.0)));
            if (0.01..1.0).contains(&d.length_squared()) {
                break d.normalize();
            }
        };
        let direction = if nonnegative { direction.abs() } else { direction };
        Self { first, weights, direction }
    }

    fn project(&self, row: &[DVec3]) -> f64 {
        let sum: DVec3 =
            self.weights.iter().zip(&row[self.first..]).map(|(weight, x)| *weight * *x).sum();
        sum.dot(self.direction)
    }
}

/// Slices and the target's ranks in them.
pub(crate) struct Slices {
    segments: Vec<Slice>,
    spectra: Vec<Slice>,
    /// Hann's window.
    window: Vec<f64>,
    /// Frame of the guide's root for each strand.
    frames: Vec<DMat3>,
    /// What strands are compared with beside their mates.
    course: Course,
    mates: Vec<[usize; 2]>,
    /// The target's ranks, and one over their spread, slice after slice.
    ranks: Vec<f64>,
    factors: Vec<f64>,
}

/// The course that strands are seen from.
enum Course {
    /// The mean of the patch a strand is of.
    Patch(Vec<Range<usize>>),
    /// The strand's instanced guide, for as many strands.
    Guide(EvenStrands),
}

impl Slices {
    /// Slices of the sample's target strands; `guides` are their instanced guides. `count` of
    /// segments and of spectra.
    pub(crate) fn new(
        targets: &EvenStrands,
        guides: &EvenStrands,
        sample: &Sample,
        count: usize,
        seed: u64,
    ) -> Self {
        let n = targets.points_each() - 1;
        let frame = |guide: &[DVec3]| {
            let reach = guide[(guide.len() / 10).max(1)] - guide[0];
            Frame::along(DVec3::ZERO, reach).map_or(DMat3::IDENTITY, |f| f.axes.transpose())
        };
        let turn = |j: usize| std::f64::consts::PI * (j as f64 + 0.5) / n as f64;
        let alone: Vec<usize> = (0..sample.strands.len() - sample.mates.len()).collect();
        let mut slices = Self {
            segments: (0..count).map(|k| Slice::random(n, false, seed, k)).collect(),
            spectra: (0..count).map(|k| Slice::random(n / 2 + 1, true, !seed, k)).collect(),
            window: (0..n).map(|j| turn(j).sin().powi(2)).collect(),
            frames: guides.iter().map(frame).collect(),
            course: if sample.patches.is_empty() {
                Course::Guide(guides.select(&alone))
            } else {
                Course::Patch(sample.patches.clone())
            },
            mates: sample.mates.clone(),
            ranks: Vec::new(),
            factors: Vec::new(),
        };
        slices.ranks = slices.ranks_of(targets);
        slices.factors = slices.ranks.chunks(RANKS * count).flat_map(factors).collect();
        slices
    }

    /// The differences of ranks, over their spreads: their mean square is the loss.
    pub(crate) fn residuals(&self, strands: &EvenStrands) -> Vec<f64> {
        let ranks = self.ranks_of(strands);
        let pairs = ranks.chunks(RANKS).zip(self.ranks.chunks(RANKS)).zip(&self.factors);
        pairs
            .flat_map(|((a, b), factor)| a.iter().zip(b).map(move |(a, b)| near((a - b) * factor)))
            .collect()
    }

    /// The mean ranks of every slice: of strands against their courses, of segments and then of
    /// spectra, and as many again of strands against their mates.
    fn ranks_of(&self, strands: &EvenStrands) -> Vec<f64> {
        let e = |i: usize, j: usize| strands.strand(i)[j + 1] - strands.strand(i)[j];
        let mut ranks = match &self.course {
            Course::Patch(patches) => {
                let (patch_of, means) = means(strands, patches);
                self.ranks_of_rows(patch_of.len(), |k, j| {
                    let mean = means.strand(patch_of[k]);
                    self.frames[k] * (e(k, j) - (mean[j + 1] - mean[j]))
                })
            }
            Course::Guide(guides) => self.ranks_of_rows(guides.len(), |k, j| {
                let guide = guides.strand(k);
                self.frames[k] * (e(k, j) - (guide[j + 1] - guide[j]))
            }),
        };
        ranks.extend(self.ranks_of_rows(self.mates.len(), |k, j| {
            let [a, b] = self.mates[k];
            self.frames[a] * (e(a, j) - e(b, j))
        }));
        ranks
    }

    /// The mean ranks of every slice over `rows` rows of segments.
    fn ranks_of_rows(
        &self,
        rows: usize,
        segment: impl Fn(usize, usize) -> DVec3 + Sync,
    ) -> Vec<f64> {
        let n = self.window.len();
        let slices = self.segments.len() + self.spectra.len();
        let fft = RealFftPlanner::<f64>::new().plan_fft_forward(n);
        // Row after row, a number a slice.
        let mut projections = vec![0.0; rows * slices];
        projections.par_chunks_mut(slices).with_min_len(32).enumerate().for_each_init(
            || (vec![DVec3::ZERO; n], vec![DVec3::ZERO; n / 2 + 1], Spectrum::new(&fft)),
            |(row, spectrum, work), (i, out)| {
                row.iter_mut().enumerate().for_each(|(j, e)| *e = segment(i, j));
                let (first, last) = out.split_at_mut(self.segments.len());
                first.iter_mut().zip(&self.segments).for_each(|(p, s)| *p = s.project(row));
                row.iter_mut().zip(&self.window).for_each(|(e, weight)| *e *= *weight);
                work.absolute(&fft, row, spectrum);
                last.iter_mut().zip(&self.spectra).for_each(|(p, s)| *p = s.project(spectrum));
            },
        );
        let ranks: Vec<Vec<f64>> = (0..slices)
            .into_par_iter()
            .map(|k| {
                let mut column: Vec<f64> =
                    projections.iter().skip(k).step_by(slices).copied().collect();
                column.sort_unstable_by(f64::total_cmp);
                mean_ranks(&column)
            })
            .collect();
        ranks.concat()
    }
}

/// A difference that is far off counts for less, at most for [`FAR`]: a guide that points along the
/// axis where a curl's normals turn over can tear its strands, and nothing else is to be bent for
/// that.
fn near(difference: f64) -> f64 {
    difference / (1.0 + (difference / FAR).powi(2)).sqrt()
}

/// Which patch each strand is of, and the mean of each patch.
fn means(strands: &EvenStrands, patches: &[Range<usize>]) -> (Vec<usize>, EvenStrands) {
    let mut means = EvenStrands::zeros(patches.len(), strands.points_each());
    let mut patch_of = Vec::new();
    for (p, patch) in patches.iter().enumerate() {
        patch_of.extend(patch.clone().map(|_| p));
        for i in patch.clone() {
            let sums = means.strand_mut(p).iter_mut().zip(strands.strand(i));
            sums.for_each(|(sum, x)| *sum += *x / patch.len() as f64);
        }
    }
    (patch_of, means)
}

/// One over the spread of the target's ranks, for slices of a kind.
fn factors(ranks: &[f64]) -> Vec<f64> {
    let spreads: Vec<f64> = ranks
        .chunks(RANKS)
        .map(|ranks| {
            let mean = ranks.iter().sum::<f64>() / RANKS as f64;
            (ranks.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / RANKS as f64).sqrt()
        })
        .collect();
    let floor = FLOOR * spreads.iter().sum::<f64>() / spreads.len().max(1) as f64;
    let factor = |spread: &f64| if spread + floor > 0.0 { 1.0 / (spread + floor) } else { 1.0 };
    spreads.iter().map(factor).collect()
}

/// Means of sorted numbers in blocks of equal count.
fn mean_ranks(sorted: &[f64]) -> Vec<f64> {
    let n = sorted.len();
    (0..RANKS)
        .map(|block| {
            let (from, to) =
                (block * n / RANKS, ((block + 1) * n / RANKS).max(block * n / RANKS + 1));
            let part = &sorted[from.min(n)..to.min(n)];
            part.iter().sum::<f64>() / part.len().max(1) as f64
        })
        .collect()
}

/// Work space of a Fourier transform of rows of vectors.
pub(crate) struct Spectrum {
    input: Vec<f64>,
    output: Vec<realfft::num_complex::Complex<f64>>,
    scratch: Vec<realfft::num_complex::Complex<f64>>,
}

type Fft = std::sync::Arc<dyn realfft::RealToComplex<f64>>;

impl Spectrum {
    pub(crate) fn new(fft: &Fft) -> Self {
        Self {
            input: fft.make_input_vec(),
            output: fft.make_output_vec(),
            scratch: fft.make_scratch_vec(),
        }
    }

    /// The transform of one coordinate of the row; it stays until the next call.
    pub(crate) fn transform(
        &mut self,
        fft: &Fft,
        row: impl Iterator<Item = f64>,
    ) -> &mut [realfft::num_complex::Complex<f64>] {
        self.input.iter_mut().zip(row).for_each(|(to, from)| *to = from);
        let done = fft.process_with_scratch(&mut self.input, &mut self.output, &mut self.scratch);
        debug_assert!(done.is_ok(), "the buffers are the plan's own");
        &mut self.output
    }

    /// Absolute values of the transforms of x, y and z.
    fn absolute(&mut self, fft: &Fft, row: &[DVec3], out: &mut [DVec3]) {
        for axis in 0..3 {
            let bins = self.transform(fft, row.iter().map(|e| e[axis]));
            out.iter_mut().zip(bins).for_each(|(out, bin)| out[axis] = bin.norm());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bound, Chain, Curl, Frizz, Operator, draw};

    fn curled(radius: f64, seed: u64) -> (EvenStrands, EvenStrands) {
        let line = (0..64).map(|j| DVec3::Y * (0.1 * f64::from(j)));
        let guides = EvenStrands::new(64, line.clone().cycle().take(64 * 300).collect());
        let guides = guides.expect("300 strands");
        let operators = vec![
            Operator::Curl(Curl { radius, frequency: 0.3, ..Curl::default() }),
            Operator::Frizz(Frizz { frequency: 2.0, amplitude: 0.1 }),
        ];
        let numbers = draw(&operators, 300, 1, seed);
        let one = guides.select(&[0]);
        let operator_of = vec![0; 300];
        let bound = Bound { guides: &one, operator_of: &operator_of, numbers: &numbers };
        let mut strands = guides.clone();
        let chain = Chain { operators, ..Chain::default() };
        chain.apply(&mut strands, &bound, 0).expect("a sound chain");
        (strands, guides)
    }

    #[test]
    fn the_loss_ignores_the_order_of_strands_and_grows_with_the_difference() {
        let (targets, guides) = curled(0.3, 1);
        let sample = Sample { strands: (0..300).collect(), patches: Vec::new(), mates: Vec::new() };
        let slices = Slices::new(&targets, &guides, &sample, 24, 5);
        let loss =
            |strands: &EvenStrands| slices.residuals(strands).iter().map(|r| r * r).sum::<f64>();
        let backwards: Vec<usize> = (0..300).rev().collect();
        assert!(loss(&targets.select(&backwards)) < 1e-20);
        let at: Vec<f64> = [0.3, 0.33, 0.4, 0.6].map(|radius| loss(&curled(radius, 2).0)).to_vec();
        assert!(at.windows(2).all(|pair| pair[0] < pair[1]), "{at:?}");
    }
    #[test]
    fn what_a_patch_has_in_common_does_not_show() {
        let (targets, guides) = curled(0.3, 1);
        let sample = Sample {
            strands: (0..300).collect(),
            patches: vec![0..20, 20..40, 40..60],
            mates: (0..60).map(|i| [i, 20 * (i / 20) + (i + 1) % 20]).collect(),
        };
        let slices = Slices::new(&targets, &guides, &sample, 24, 5);
        let loss =
            |strands: &EvenStrands| slices.residuals(strands).iter().map(|r| r * r).sum::<f64>();
        let mut moved = targets.clone();
        for i in 0..300 {
            let strand = moved.strand_mut(i).iter_mut().zip(0..);
            strand.for_each(|(x, j)| *x += DVec3::X * (f64::from(j) * 0.1).sin() * (i / 20) as f64);
        }
        assert!(loss(&moved) < 1e-20);
        moved.strand_mut(7).iter_mut().for_each(|x| x.y *= 1.2);
        assert!(loss(&moved) > 1e-3);
    }

    #[test]
    fn a_bend_does_not_hide_frizz() {
        // Strands bend by different amounts, far more than they are frizzy.
        let strands = |amplitude: f64| {
            let point = |i: u32, j: u32| {
                let s = 0.1 * f64::from(j);
                let aside = 0.05 * f64::from(i % 10) * s * s;
                let noise = (2.1 * f64::from(j) + f64::from(i)).sin();
                DVec3::new(aside + amplitude * noise, s, 0.0)
            };
            let points = (0..100).flat_map(|i| (0..64).map(move |j| point(i, j))).collect();
            EvenStrands::new(64, points).expect("100 strands")
        };
        let targets = strands(0.01);
        let sample = Sample {
            strands: (0..100).collect(),
            patches: (0..10).map(|p| 10 * p..10 * p + 10).collect(),
            mates: Vec::new(),
        };
        let slices = Slices::new(&targets, &strands(0.0), &sample, 64, 3);
        let residuals = slices.residuals(&strands(0.02));
        let spectra = &residuals[64 * RANKS..];
        let loss = spectra.iter().map(|r| r * r).sum::<f64>() / spectra.len() as f64;
        assert!(loss > 0.15, "{loss}");
    }

    #[test]
    fn differences_that_are_far_off_are_bounded() {
        assert!((near(1e9) - FAR).abs() < 1e-6 && (near(-1e9) + FAR).abs() < 1e-6);
        assert!((near(0.1) - 0.1).abs() < 1e-3);
    }
}
