//! Nelder and Mead's simplex on the Frechet distance, as published [GH 5].
//!
//! Minimizes `C(h, H(k)) + lambda |k|` over the four parameters, the frame and the length fixed.
//! Parameters and distance are taken in lengths of the piece, so that `|k|` is a number.

use argmin::core::{CostFunction, Error, Executor, State};
use argmin::solver::neldermead::NelderMead;

use super::fragment::Fragment;
use crate::Helicoid;
use crate::frechet::frechet;

/// Steps at most; from about 100 on the distance no longer changes by a percent.
const STEPS: u64 = 120;

/// The simplex is small enough when its costs differ by this, in lengths of the piece.
const SPREAD: f64 = 1e-4;

/// Where the field is singular on the path.
const REFUSED: f64 = 1e3;

struct Distance<'a> {
    fragment: Fragment<'a>,
    length: f64,
    regularization: f64,
}

impl CostFunction for Distance<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        let chain = self.fragment.chain(helicoid(x, self.length));
        let Some(traced) = self.fragment.traced(&chain) else { return Ok(REFUSED) };
        let Fragment { target, first, last, .. } = self.fragment;
        let distance = frechet(&target.points[first..=last], &traced) / self.length;
        let size = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        Ok(distance + self.regularization * size)
    }
}

fn helicoid(x: &[f64], length: f64) -> Helicoid {
    match *x {
        [kt, kn, kb, alpha] => Helicoid::new(kt / length, kn / length, kb / length, alpha),
        _ => Helicoid::default(),
    }
}

/// The helicoid that brings the cost down from where the fragment's first bend suggests.
pub(super) fn minimize(fragment: &Fragment<'_>, regularization: f64) -> Helicoid {
    let length = fragment.length();
    let seed = fragment.estimate();
    let start = vec![seed.kt * length, 0.0, 0.0, seed.alpha.clamp(-2.0, 2.0)];
    let mut simplex = vec![start.clone(); 5];
    for (j, corner) in simplex[1..].iter_mut().enumerate() {
        corner[j] += 0.5;
    }
    let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(SPREAD) else {
        return helicoid(&start, length);
    };
    let problem = Distance { fragment: *fragment, length, regularization };
    let run = Executor::new(problem, solver).configure(|state| state.max_iters(STEPS)).run();
    let best = run.ok().and_then(|result| result.state().get_best_param().cloned());
    helicoid(&best.unwrap_or(start), length)
}
