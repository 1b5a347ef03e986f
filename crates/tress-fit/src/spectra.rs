//! Coils without the way they take: the offsets of strands from their centerlines, as spectra.
//!
//! [CC 3.2.2]: seen in frames along its centerline, a strand is two sequences, `alpha_i` along `u`
//! and `beta_i` along `v`. Their discrete Fourier transforms `w_k = sum_i x_i exp(-2 pi j i k / N)`
//! are held as amplitudes `|w_k|` and phases `arg w_k`, `k` in `0..=N/2`, as the paper's own
//! library is. A spectrum also says how far its samples are apart along the centerline, so that a
//! coil keeps its wavelength on a line of another length and another number of points.

mod file;

use glam::{DVec2, DVec3};
use num_complex::Complex64;
use rayon::prelude::*;
use realfft::RealFftPlanner;
use tress_geometry::{OffsetsError, Strands};

use crate::Centerline;
use crate::centerline::centerline;

pub use file::{ReadSpectraError, WriteSpectraError};

/// Amplitude and phase of one frequency along `u` and `v`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Harmonic {
    /// `|w_k|` along `u` and `v`, not divided by the number of samples.
    pub amplitude: [f32; 2],
    /// `arg w_k` along `u` and `v`, in radians.
    pub phase: [f32; 2],
}

/// A library of coils: for each the spectrum of its offsets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectra {
    /// `samples / 2 + 1` harmonics a coil.
    harmonics: Strands<Harmonic>,
    /// Samples of each coil: two at least.
    samples: Vec<u32>,
    /// Arc length of the centerline from sample to sample; 0 where it is not known.
    steps: Vec<f64>,
}

/// Why numbers are not a library of spectra.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpectraError {
    /// A coil has `samples / 2 + 1` harmonics of two samples at least.
    ///
    /// ```
    /// # use tress_fit::{Harmonic, Spectra, SpectraError};
    /// # use tress_geometry::Strands;
    /// let three = Strands::from_counts([3], vec![Harmonic::default(); 3])?;
    /// let error = Spectra::new(three, vec![6], vec![0.1]);
    /// assert_eq!(error, Err(SpectraError::Samples { spectrum: 0, harmonics: 3, samples: 6 }));
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[error("spectrum {spectrum} has {harmonics} harmonics, which {samples} samples do not make")]
    Samples {
        /// Which spectrum.
        spectrum: usize,
        /// Harmonics it has.
        harmonics: usize,
        /// Samples it is said to have.
        samples: usize,
    },
    /// Each spectrum has a number of samples and a step.
    #[error("{given} {of} for {spectra} spectra")]
    Count {
        /// What there are too many or too few of.
        of: &'static str,
        /// How many there are.
        given: usize,
        /// Spectra there are.
        spectra: usize,
    },
    /// A number that is not finite, an amplitude or a step below 0.
    #[error("spectrum {spectrum} holds a number that is not finite or is below 0")]
    Number {
        /// Which spectrum.
        spectrum: usize,
    },
    /// More harmonics than offsets can tell apart.
    #[error(transparent)]
    TooMany(#[from] OffsetsError),
}

impl Spectra {
    /// Spectra from their harmonics, their numbers of samples and the distances of these.
    ///
    /// # Errors
    ///
    /// See [`SpectraError`].
    pub fn new(
        harmonics: Strands<Harmonic>,
        samples: Vec<u32>,
        steps: Vec<f64>,
    ) -> Result<Self, SpectraError> {
        let spectra = harmonics.len();
        for (of, given) in [("numbers of samples", samples.len()), ("steps", steps.len())] {
            if given != spectra {
                return Err(SpectraError::Count { of, given, spectra });
            }
        }
        for (spectrum, (own, (&n, &step))) in
            harmonics.iter().zip(samples.iter().zip(&steps)).enumerate()
        {
            let n = n as usize;
            if n < 2 || own.len() != n / 2 + 1 {
                return Err(SpectraError::Samples { spectrum, harmonics: own.len(), samples: n });
            }
            let sound = |h: &Harmonic| {
                h.amplitude.iter().all(|a| a.is_finite() && *a >= 0.0)
                    && h.phase.iter().all(|p| p.is_finite())
            };
            if !(step.is_finite() && 0.0 <= step && own.iter().all(sound)) {
                return Err(SpectraError::Number { spectrum });
            }
        }
        Ok(Self { harmonics, samples, steps })
    }

    /// The spectra of the strands that coil; the others are left out.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_fit::Spectra;
    /// use tress_geometry::Strands;
    ///
    /// // Ten turns of radius 0.5, eight samples a turn; and a straight strand.
    /// let coil = (0..80).map(|i| f64::from(i) / 8.0 * std::f64::consts::TAU);
    /// let coil = coil.map(|a| DVec3::new(0.1 * a, 0.5 * a.cos(), 0.5 * a.sin()));
    /// let mut strands = Strands::from_counts([80], coil.collect())?;
    /// strands.push((0..20).map(|i| DVec3::X * f64::from(i)))?;
    ///
    /// let spectra = Spectra::of(&strands);
    /// assert_eq!(spectra.len(), 1);
    /// let strongest = |k: usize| spectra.harmonics(0)[k].amplitude[0];
    /// assert!((0..41).all(|k| strongest(k) <= strongest(10)));
    /// assert!((f64::from(strongest(10)) - 0.5 * 40.0).abs() < 0.5);
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[must_use]
    pub fn of(strands: &Strands<DVec3>) -> Self {
        let own: Vec<_> = (0..strands.len())
            .into_par_iter()
            .map_init(RealFftPlanner::new, |planner, i| {
                let points = strands.strand(i);
                let line = centerline(points).ok().filter(|line| line.turns() > 0.0)?;
                Some((harmonics_of(&line, points, planner)?, points.len(), step(&line)))
            })
            .collect();
        let mut spectra = Self::default();
        for (harmonics, samples, step) in own.into_iter().flatten() {
            let Ok(samples) = u32::try_from(samples) else { continue };
            // Half as many harmonics as points: offsets that told those apart tell these.
            if spectra.harmonics.push(harmonics).is_ok() {
                spectra.samples.push(samples);
                spectra.steps.push(step);
            }
        }
        spectra
    }

    /// How many spectra there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty()
    }

    /// The harmonics of spectrum `i`, from the mean on.
    #[must_use]
    pub fn harmonics(&self, i: usize) -> &[Harmonic] {
        self.harmonics.strand(i)
    }

    /// How many samples spectrum `i` was taken from.
    #[must_use]
    pub fn samples(&self, i: usize) -> usize {
        self.samples[i] as usize
    }

    /// Arc length of the centerline from sample to sample of spectrum `i`; 0 where it is not known.
    #[must_use]
    pub fn step(&self, i: usize) -> f64 {
        self.steps[i]
    }

    /// Root mean square of the offsets of spectrum `i`, by Parseval's theorem: the coil's radius.
    #[must_use]
    pub fn radius(&self, i: usize) -> f64 {
        let n = self.samples(i);
        let power = |(k, h): (usize, &Harmonic)| {
            let share = if 2 * k == n { 1.0 } else { 2.0 };
            share * h.amplitude.iter().map(|a| f64::from(*a) * f64::from(*a)).sum::<f64>()
        };
        let own = self.harmonics(i).iter().enumerate().skip(1).map(power);
        own.sum::<f64>().sqrt() / n as f64
    }

    /// The offsets along `u` and `v` of every spectrum, each sample divided into `finer`.
    ///
    /// A sequence is one period of its transform: it may be read round and round.
    #[must_use]
    pub fn offsets(&self, finer: usize) -> Strands<DVec2> {
        let finer = finer.max(1);
        let all: Vec<Vec<DVec2>> = (0..self.len())
            .into_par_iter()
            .map_init(RealFftPlanner::new, |planner, i| {
                inverse(self.harmonics(i), self.samples(i), finer, planner)
            })
            .collect();
        let mut strands = Strands::default();
        for own in all {
            // Past 32 bits of samples nothing is added; no library comes near.
            if strands.push(own).is_err() {
                break;
            }
        }
        strands
    }
}

/// Mean arc length from sample to sample.
fn step(line: &Centerline) -> f64 {
    line.length() / line.arc_lengths().len().saturating_sub(1).max(1) as f64
}

fn harmonics_of(
    line: &Centerline,
    points: &[DVec3],
    planner: &mut RealFftPlanner<f64>,
) -> Option<Vec<Harmonic>> {
    let offsets = line.offsets(points);
    let forward = planner.plan_fft_forward(points.len());
    let mut harmonics = vec![Harmonic::default(); points.len() / 2 + 1];
    let mut spectrum = forward.make_output_vec();
    for (c, of) in [|o: &DVec3| o.y, |o: &DVec3| o.z].into_iter().enumerate() {
        let mut samples: Vec<f64> = offsets.iter().map(of).collect();
        forward.process(&mut samples, &mut spectrum).ok()?;
        for (harmonic, w) in harmonics.iter_mut().zip(&spectrum) {
            (harmonic.amplitude[c], harmonic.phase[c]) = (single(w.norm()), single(w.arg()));
        }
    }
    Some(harmonics)
}

#[expect(clippy::cast_possible_truncation, reason = "spectra are kept to seven digits")]
fn single(x: f64) -> f32 {
    x as f32
}

/// `finer` times as many samples as the spectrum was taken from: frequencies above its own are 0.
fn inverse(
    harmonics: &[Harmonic],
    samples: usize,
    finer: usize,
    planner: &mut RealFftPlanner<f64>,
) -> Vec<DVec2> {
    let n = samples * finer;
    let inverse = planner.plan_fft_inverse(n);
    let mut offsets = vec![DVec2::ZERO; n];
    let (mut spectrum, mut values) = (inverse.make_input_vec(), inverse.make_output_vec());
    for c in 0..2 {
        spectrum.fill(Complex64::ZERO);
        for (k, (w, h)) in spectrum.iter_mut().zip(harmonics).enumerate() {
            // The mirror image of the highest frequency of an even number comes into its own.
            let share = if 2 * k == samples && 1 < finer { 0.5 } else { 1.0 };
            let amplitude = share * f64::from(h.amplitude[c]);
            *w = Complex64::from_polar(amplitude, f64::from(h.phase[c]));
        }
        // Rounding leaves an imaginary part where a real sequence has none.
        spectrum[0].im = 0.0;
        if n.is_multiple_of(2) {
            spectrum[n / 2].im = 0.0;
        }
        if inverse.process(&mut spectrum, &mut values).is_err() {
            continue;
        }
        for (offset, value) in offsets.iter_mut().zip(&values) {
            offset[c] = value / samples as f64;
        }
    }
    offsets
}

#[cfg(test)]
mod tests;
