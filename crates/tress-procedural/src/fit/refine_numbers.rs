//! The random numbers of single strands [IPG 5.6].
//!
//! With the operators' parameters found, each strand's numbers are moved so that the strand comes
//! near its own target, by the loss of [IPG 19]: absolute spectra of segment directions, the
//! directions themselves, and lengths. The loss has many valleys (a phase, an axis), so gradients
//! get noise [IPG 20, 21] that fades; the best numbers met on the way are kept.

use glam::DVec3;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use tress_edit::strand_rng;

use super::courses::segments;
use super::parameters::{LossError, StageError};
use super::slices::Spectrum;
use crate::operators::Draws;
use crate::{Bound, EvenStrands, ProceduralGroom};

/// How random numbers are refined.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NumberOptions {
    /// Steps of Adam. Default 40; the paper takes 3,000, of which the first do most.
    pub steps: usize,
    /// Length of a step. Default 0.1.
    pub rate: f64,
    /// Noise on gradients over their mean size, at the first step; it fades by 1 to the last.
    /// Default 1.5; 0 for none.
    pub noise: f64,
    /// Weight of directions against spectra. Default 2.
    pub directions: f64,
    /// Weight of lengths, over the square of the mean length. Default 1.
    pub lengths: f64,
}

impl Default for NumberOptions {
    fn default() -> Self {
        Self { steps: 40, rate: 0.1, noise: 1.5, directions: 2.0, lengths: 1.0 }
    }
}

/// Moves the groom's random numbers so that strand `i` comes near target `i`; flawed strands, those
/// not in `sound`, keep theirs.
///
/// `watch` is told the loss of every step. Gives the loss of the numbers kept.
///
/// # Errors
///
/// If the groom cannot be built or the loss is not a number; the groom then has the best numbers
/// met.
pub fn refine_numbers(
    groom: &mut ProceduralGroom,
    targets: &EvenStrands,
    sound: &[usize],
    options: &NumberOptions,
    watch: &mut dyn FnMut(f64),
) -> Result<f64, StageError> {
    groom.check()?;
    let instanced = groom.instances()?.instance(&groom.guides, &groom.roots.positions);
    let guides = groom.operator_guide_points();
    let loss = StrandLoss::new(targets, sound, options);
    let mut numbers = groom.numbers.clone();
    let mut moments: Vec<Vec<[f64; 2]>> =
        numbers.iter().map(|numbers| vec![[0.0; 2]; numbers.len()]).collect();
    let mut best = f64::INFINITY;
    for step in 0..=options.steps {
        let bound = Bound { guides: &guides, operator_of: &groom.operator_of, numbers: &numbers };
        let mut strands = instanced.clone();
        groom.chain.apply(&mut strands, &bound, groom.seed)?;
        let (value, gradient) = loss.evaluate(&strands, targets);
        if !value.is_finite() {
            let place = format!("at step {step} of the random numbers");
            return Err(LossError { place }.into());
        }
        watch(value);
        if value < best {
            best = value;
            groom.numbers.clone_from(&numbers);
        }
        if step == options.steps {
            break;
        }
        let gradients = groom.chain.pull_back(&instanced, &bound, &gradient)?.numbers;
        let fade = options.noise - step as f64 / options.steps as f64;
        for (o, gradients) in gradients.iter().enumerate() {
            let noise =
                if options.noise > 0.0 { fade.max(0.0) * mean_size(gradients) } else { 0.0 };
            let draws = groom.chain.operators[o].draws();
            let seed = groom.seed ^ ((o as u64) << 32) ^ step as u64;
            let rows = numbers[o].par_iter_mut().zip(&mut moments[o]).zip(gradients);
            rows.enumerate().for_each(|(k, ((number, moments), gradient))| {
                let normal: f64 = StandardNormal.sample(&mut strand_rng(seed, k));
                *number -= options.rate * adam(moments, gradient + noise * normal, step + 1);
                *number = match draws {
                    Draws::EvenPerStrand => number.clamp(0.0, 1.0),
                    Draws::TwoPerGuide if k % 2 == 1 => number.clamp(0.0, 1.0),
                    _ => number.clamp(-1.0, 1.0),
                };
            });
        }
    }
    Ok(best)
}

/// Adam's direction for one number (Kingma and Ba 2015, with their defaults).
fn adam(moments: &mut [f64; 2], gradient: f64, step: usize) -> f64 {
    let step = i32::try_from(step).unwrap_or(i32::MAX);
    moments[0] = 0.9 * moments[0] + 0.1 * gradient;
    moments[1] = 0.999 * moments[1] + 0.001 * gradient * gradient;
    let first = moments[0] / (1.0 - 0.9_f64.powi(step));
    let second = moments[1] / (1.0 - 0.999_f64.powi(step));
    first / (second.sqrt() + 1e-12)
}

fn mean_size(gradients: &[f64]) -> f64 {
    gradients.iter().map(|g| g.abs()).sum::<f64>() / gradients.len().max(1) as f64
}

/// [IPG 19].
struct StrandLoss {
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    sound: Vec<bool>,
    /// One over the number of sound strands.
    share: f64,
    directions: f64,
    lengths: f64,
}

impl StrandLoss {
    fn new(targets: &EvenStrands, sound: &[usize], options: &NumberOptions) -> Self {
        let n = targets.points_each() - 1;
        let mut planner = RealFftPlanner::<f64>::new();
        let mut flags = vec![false; targets.len()];
        sound.iter().for_each(|&i| flags[i] = true);
        let length = |strand: &[DVec3]| segments(strand).map(DVec3::length).sum::<f64>();
        let mean = targets.iter().map(length).sum::<f64>() / targets.len().max(1) as f64;
        Self {
            forward: planner.plan_fft_forward(n),
            backward: planner.plan_fft_inverse(n),
            sound: flags,
            share: 1.0 / sound.len().max(1) as f64,
            directions: options.directions,
            lengths: options.lengths * n as f64 / (mean * mean).max(f64::MIN_POSITIVE),
        }
    }

    /// The loss, and its gradient by the strands' points.
    fn evaluate(&self, strands: &EvenStrands, targets: &EvenStrands) -> (f64, EvenStrands) {
        let m = strands.points_each();
        let mut gradient = EvenStrands::zeros(strands.len(), m);
        let losses: Vec<f64> = gradient
            .points_mut()
            .par_chunks_mut(m)
            .enumerate()
            .map_init(
                || Work::new(&self.forward, &self.backward),
                |work, (i, gradient)| {
                    if !self.sound[i] {
                        return 0.0;
                    }
                    self.strand(strands.strand(i), targets.strand(i), gradient, work)
                },
            )
            .collect();
        (losses.iter().sum::<f64>() * self.share, gradient)
    }

    /// One strand's loss; its gradient is put into `gradient`.
    fn strand(
        &self,
        strand: &[DVec3],
        target: &[DVec3],
        gradient: &mut [DVec3],
        work: &mut Work,
    ) -> f64 {
        let direction = |e: DVec3| e.normalize_or_zero();
        work.own.clear();
        work.own.extend(segments(strand).map(direction));
        work.other.clear();
        work.other.extend(segments(target).map(direction));
        work.by_direction.clear();
        work.by_direction.extend(work.other.iter().map(|d| -self.directions * *d));
        let aligned: f64 = work.own.iter().zip(&work.other).map(|(a, b)| 1.0 - a.dot(*b)).sum();
        let mut loss = self.directions * aligned;
        for axis in 0..3 {
            loss += self.spectrum(axis, work);
        }
        let length = |strand: &[DVec3]| segments(strand).map(DVec3::length).sum::<f64>();
        let longer = length(strand) - length(target);
        loss += self.lengths * longer * longer;
        let by_length = 2.0 * self.lengths * longer;
        for (j, e) in segments(strand).enumerate() {
            let (d, size) = (work.own[j], e.length());
            let by_direction = work.by_direction[j];
            let across = by_direction - d * d.dot(by_direction);
            let by_e = if size > 0.0 { across / size + by_length * d } else { DVec3::ZERO };
            gradient[j + 1] += self.share * by_e;
            gradient[j] -= self.share * by_e;
        }
        loss
    }

    /// The squared differences of absolute spectra of one coordinate, over the number of segments;
    /// adds the gradient by directions.
    fn spectrum(&self, axis: usize, work: &mut Work) -> f64 {
        let n = work.own.len();
        let scale = 1.0 / n as f64;
        let other = work.spectrum.transform(&self.forward, work.other.iter().map(|d| d[axis]));
        work.sizes.clear();
        work.sizes.extend(other.iter().map(|bin| bin.norm()));
        let own = work.spectrum.transform(&self.forward, work.own.iter().map(|d| d[axis]));
        let mut loss = 0.0;
        for (k, bin) in own.iter_mut().enumerate() {
            let size = bin.norm();
            let over = size - work.sizes[k];
            loss += scale * over * over;
            // The inverse transform counts every bin twice but those that are their own mirror.
            let twice = if k == 0 || 2 * k == n { 1.0 } else { 0.5 };
            *bin *= if size > 0.0 { 2.0 * scale * over / size * twice } else { 0.0 };
            if k == 0 || 2 * k == n {
                bin.im = 0.0;
            }
        }
        let done = self.backward.process_with_scratch(own, &mut work.back, &mut work.scratch);
        debug_assert!(done.is_ok(), "the buffers are the plan's own, and real bins are real");
        for (by_direction, back) in work.by_direction.iter_mut().zip(&work.back) {
            by_direction[axis] += back;
        }
        loss
    }
}

/// Work space of one thread.
struct Work {
    spectrum: Spectrum,
    own: Vec<DVec3>,
    other: Vec<DVec3>,
    by_direction: Vec<DVec3>,
    sizes: Vec<f64>,
    back: Vec<f64>,
    scratch: Vec<realfft::num_complex::Complex<f64>>,
}

impl Work {
    fn new(forward: &Arc<dyn RealToComplex<f64>>, backward: &Arc<dyn ComplexToReal<f64>>) -> Self {
        Self {
            spectrum: Spectrum::new(forward),
            own: Vec::new(),
            other: Vec::new(),
            by_direction: Vec::new(),
            sizes: Vec::new(),
            back: backward.make_output_vec(),
            scratch: backward.make_scratch_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bend, Operator, Roots, Scale};

    fn strands(points: usize, seed: u64) -> EvenStrands {
        use rand::RngExt;
        let mut all = Vec::new();
        for i in 0..6 {
            let mut rng = strand_rng(seed, i);
            let mut x = DVec3::new(i as f64, 0.0, 0.0);
            for _ in 0..points {
                all.push(x);
                let mut number = || rng.random_range(-0.5..0.5);
                x += DVec3::new(number(), 1.0 + number(), number());
            }
        }
        EvenStrands::new(points, all).expect("whole strands")
    }

    #[test]
    fn the_gradient_agrees_with_differences() {
        // An even and an odd number of segments: the last bin is its own mirror or is not.
        for points in [13, 14] {
            let (targets, mut own) = (strands(points, 1), strands(points, 2));
            let options = NumberOptions::default();
            let loss = StrandLoss::new(&targets, &[0, 1, 2, 4, 5], &options);
            let (_, gradient) = loss.evaluate(&own, &targets);
            for k in [0, 5, 17, 30, 3 * points + 2, 5 * points - 1] {
                for axis in 0..3 {
                    let mut at = |h: f64| {
                        own.points_mut()[k][axis] += h;
                        let value = loss.evaluate(&own, &targets).0;
                        own.points_mut()[k][axis] -= h;
                        value
                    };
                    let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
                    let exact = gradient.points()[k][axis];
                    assert!((difference - exact).abs() < 1e-7, "{difference} against {exact}");
                }
            }
        }
    }

    #[test]
    fn numbers_come_nearer_to_those_that_made_the_targets() {
        let line = (0..24).map(|j| DVec3::Y * f64::from(j)).collect();
        let positions = (0..80).map(|i| DVec3::X * (0.1 * f64::from(i))).collect();
        let guides = EvenStrands::new(24, line).expect("a strand");
        let mut groom =
            ProceduralGroom::new(guides, Roots { positions, uv: None }).expect("sound guides");
        groom.chain.operators = vec![
            Operator::Scale(Scale { random: 0.4 }),
            Operator::Bend(Bend { angle_degrees: 50.0, start: 0.3 }),
        ];
        groom.seed = 1;
        groom.draw_missing();
        let (targets, truth) = (groom.build().expect("a sound groom"), groom.numbers.clone());
        groom.seed = 2;
        groom.numbers.clear();
        groom.draw_missing();
        // Of scale; a bend's axis may come the other way round.
        let error = |groom: &ProceduralGroom| -> f64 {
            groom.numbers[0].iter().zip(&truth[0]).map(|(a, b)| (a - b).abs()).sum::<f64>() / 80.0
        };
        let before = error(&groom);
        let sound: Vec<usize> = (0..80).collect();
        let mut losses = Vec::new();
        let options = NumberOptions { steps: 80, ..NumberOptions::default() };
        let best =
            refine_numbers(&mut groom, &targets, &sound, &options, &mut |loss| losses.push(loss))
                .expect("finite losses");
        assert!(best < 0.3 * losses[0], "{best} from {}", losses[0]);
        assert!(error(&groom) < 0.2 * before);
    }
}
