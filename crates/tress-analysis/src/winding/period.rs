//! The turn of a strand as its spectrum has it: where the rounds of the winding begin.
//!
//! Positions, less a cubic (the centerline's gross shape) and tapered by a Hann window, have their
//! coil as a peak of power. Powers are weighted by frequency to 1.5: positions alone are all
//! centerline, tangents (weight 2) would let white frizz win on finely sampled strands. They are
//! summed over bands of constant width in octaves, so that a coil whose turns vary along the strand
//! is not outdone by a line of less power.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec3;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

/// Fourier transforms, kept from strand to strand.
pub(crate) struct Spectra {
    planner: RealFftPlanner<f64>,
    /// Hann's windows by their lengths, of which there are few.
    windows: BTreeMap<usize, Vec<f64>>,
    input: Vec<f64>,
    output: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    power: Vec<f64>,
}

impl Default for Spectra {
    fn default() -> Self {
        Self {
            planner: RealFftPlanner::new(),
            windows: BTreeMap::new(),
            input: vec![],
            output: vec![],
            scratch: vec![],
            power: vec![],
        }
    }
}

/// Half the width of a band, as a factor of its middle.
const BAND: f64 = 1.2;

/// Above so many radians of bending a coil has turns enough for a cubic to leave it alone. Below,
/// a cubic may take the coil with it, and a line may leave a bow that outweighs the coil.
const MUCH_BENDING: f64 = 4.0 * TAU;

/// Periods nearer to each other than this factor lead to the same winding.
const SAME: f64 = 1.25;

impl Spectra {
    /// Stations in one turn, by the strongest band; a second guess where what is left of the strand
    /// without a cubic turns faster than without a line. None where nothing is left of it but its
    /// gross shape.
    pub(super) fn dominant_periods(&mut self, points: &[DVec3], bending: f64) -> [Option<f64>; 2] {
        let by_cubic = self.dominant_period(points, 3);
        if MUCH_BENDING <= bending {
            return [by_cubic, None];
        }
        let by_line = self.dominant_period(points, 1);
        let other = |cubic: &f64| by_line.is_none_or(|line| SAME * cubic < line);
        [by_line, by_cubic.filter(other)]
    }

    fn dominant_period(&mut self, points: &[DVec3], degree: usize) -> Option<f64> {
        let n = points.len() - 1;
        let flat = without_trend(&points[..n], degree);
        let power = self.power(&flat);
        let weight = |k: usize| k as f64 * (k as f64).sqrt();
        let weighted: Vec<f64> = power.iter().enumerate().map(|(k, p)| p * weight(k)).collect();
        let mut sums = vec![[0.0; 2]];
        for (k, p) in weighted.iter().enumerate() {
            let [sum, moment] = sums[k];
            sums.push([sum + p, moment + p * k as f64]);
        }
        let band = |k: usize| {
            let (low, high) = ((k as f64 / BAND).ceil(), (k as f64 * BAND).floor());
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below n")]
            let (a, b) = (low as usize, (high as usize + 1).min(weighted.len()));
            [0, 1].map(|i| sums[b][i] - sums[a][i])
        };
        let strongest =
            (1..=n / 4).map(band).fold([0.0; 2], |best, b| if best[0] < b[0] { b } else { best });
        (0.0 < strongest[0]).then(|| n as f64 * strongest[0] / strongest[1])
    }

    /// Power at each whole number of cycles, of three components together, Hann-tapered.
    pub(crate) fn power(&mut self, values: &[DVec3]) -> &[f64] {
        let n = values.len();
        let transform = self.planner.plan_fft_forward(n);
        let window = self.windows.entry(n).or_insert_with(|| hann(n));
        self.input.resize(n, 0.0);
        self.output.resize(n / 2 + 1, Complex::default());
        self.scratch.resize(transform.get_scratch_len(), Complex::default());
        self.power.clear();
        self.power.resize(n / 2 + 1, 0.0);
        for axis in 0..3 {
            for ((x, value), share) in self.input.iter_mut().zip(values).zip(&*window) {
                *x = share * value[axis];
            }
            let done = transform.process_with_scratch(
                &mut self.input,
                &mut self.output,
                &mut self.scratch,
            );
            // The lengths were made to fit just above.
            if done.is_ok() {
                for (p, z) in self.power.iter_mut().zip(&self.output) {
                    *p += z.norm_sqr();
                }
            }
        }
        &self.power
    }
}

/// Hann's window of `n` values.
fn hann(n: usize) -> Vec<f64> {
    (0..n).map(|i| 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / n as f64).cos()).collect()
}

/// The values less their projections on Legendre polynomials up to a degree (three at most).
fn without_trend(values: &[DVec3], degree: usize) -> Vec<DVec3> {
    let n = values.len() as f64;
    let at = |i: usize| 2.0 * (i as f64 + 0.5) / n - 1.0;
    let legendre = |x: f64| [1.0, x, 1.5 * x * x - 0.5, x * (2.5 * x * x - 1.5)];
    let mut coefficients = [DVec3::ZERO; 4];
    for (i, value) in values.iter().enumerate() {
        let p = legendre(at(i));
        for (j, coefficient) in coefficients.iter_mut().enumerate().take(degree + 1) {
            *coefficient += *value * (p[j] * (2.0 * j as f64 + 1.0) / n);
        }
    }
    let rest = |(i, value): (usize, &DVec3)| {
        let p = legendre(at(i));
        coefficients.iter().zip(p).fold(*value, |rest, (c, p)| rest - *c * p)
    };
    values.iter().enumerate().map(rest).collect()
}
