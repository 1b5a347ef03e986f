//! The published centerline, [CC 3.2.1]: a low-pass of the strand's steps.
//!
//! With `x_i = p_(i+1) - p_i`, `i` in `0..N`, the three lowest coefficients
//! `X_k = sum_i x_i exp(-2 pi j i k / N)`, the mean among them, give back steps
//! `x*_i = (X_0 + 2 Re(X_1 e_1) + 2 Re(X_2 e_2)) / N`, `e_k = exp(2 pi j i k / N)`. Their sums
//! `p*_i` are moved by the mean of `p - p*`, [CC 1]. Three coefficients of `N` are three sums: no
//! fast transform would be faster.

use std::f64::consts::TAU;

use glam::DVec3;

/// Coefficients kept, the mean among them.
const KEPT: usize = 3;

/// The published centerline's points; `points` has two at least.
pub(super) fn low_pass(points: &[DVec3]) -> Vec<DVec3> {
    let n = points.len() - 1;
    let mut steps = vec![(points[n] - points[0]) / n as f64; n];
    for k in 1..KEPT.min(n / 2 + 1) {
        let turn = TAU * k as f64 / n as f64;
        let (mut real, mut imaginary) = (DVec3::ZERO, DVec3::ZERO);
        for (i, ends) in points.windows(2).enumerate() {
            let (sine, cosine) = (turn * i as f64).sin_cos();
            real += (ends[1] - ends[0]) * cosine;
            imaginary -= (ends[1] - ends[0]) * sine;
        }
        // The coefficient at half the sampling rate is its own mirror image.
        let share = if 2 * k == n { 1.0 } else { 2.0 } / n as f64;
        for (i, step) in steps.iter_mut().enumerate() {
            let (sine, cosine) = (turn * i as f64).sin_cos();
            *step += (real * cosine - imaginary * sine) * share;
        }
    }
    let mut line = Vec::with_capacity(points.len());
    line.push(DVec3::ZERO);
    for (i, step) in steps.iter().enumerate() {
        line.push(line[i] + step);
    }
    let off: DVec3 = points.iter().zip(&line).map(|(p, q)| *p - *q).sum();
    let mean = off / points.len() as f64;
    line.iter_mut().for_each(|point| *point += mean);
    line
}
