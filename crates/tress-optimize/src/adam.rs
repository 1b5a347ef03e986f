//! Adam as [CSE 6.5.1] uses it: for comparison with what replaces it.
//!
//! The step size is in units of curvature, so that the same groom in another unit takes another
//! road; that is how it was published. "Residual" is taken to be the energy. The lowest energy on
//! the road is the result, not the last.

use glam::DVec3;
use tress_geometry::Element;

use crate::{Adam, Objective, Report, Stop};

/// Minimises the energy from `elements` on, which are replaced by the best found.
pub(crate) fn minimise(
    objective: &mut Objective<'_>,
    elements: &mut [Element],
    options: &Adam,
) -> Report {
    let mut state = Moments::new(elements.len());
    let mut gradient = vec![DVec3::ZERO; elements.len()];
    let mut current = elements.to_vec();
    let start = objective.evaluate(&current, &mut gradient);
    let start_length = length(&gradient);
    let (mut best, mut best_length, mut waited, mut steps) = (start, start_length, 0, 0);
    let stop = loop {
        if best.total() < options.residual {
            break Stop::Residual;
        }
        if steps == options.max_steps {
            break Stop::MaxIterations;
        }
        if waited == options.patience {
            break Stop::NoImprovement;
        }
        steps += 1;
        state.step(steps, &gradient, options, &mut current);
        let energy = objective.evaluate(&current, &mut gradient);
        waited += 1;
        if energy.total() < best.total() {
            (best, best_length, waited) = (energy, length(&gradient), 0);
            elements.copy_from_slice(&current);
        }
    };
    objective.evaluate(elements, &mut gradient);
    Report {
        start,
        end: best,
        iterations: u32::try_from(steps + 1).unwrap_or(u32::MAX),
        stop,
        gradient: if start_length == 0.0 { 0.0 } else { best_length / start_length },
        anchor_distance: objective.anchor_distance(),
        unreachable: u32::try_from(objective.unreachable()).unwrap_or(u32::MAX),
    }
}

/// Decaying means of the gradient and of its square.
struct Moments {
    first: Vec<DVec3>,
    second: Vec<DVec3>,
}

impl Moments {
    fn new(n_elements: usize) -> Self {
        Self { first: vec![DVec3::ZERO; n_elements], second: vec![DVec3::ZERO; n_elements] }
    }

    /// Step number `t`, from 1 on [Kingma and Ba 2017, algorithm 1].
    fn step(&mut self, t: usize, gradient: &[DVec3], options: &Adam, elements: &mut [Element]) {
        let t = t as f64;
        let first_bias = 1.0 - options.beta1.powf(t);
        let second_bias = 1.0 - options.beta2.powf(t);
        let moments = self.first.iter_mut().zip(&mut self.second);
        for ((element, &g), (m, v)) in elements.iter_mut().zip(gradient).zip(moments) {
            *m = *m * options.beta1 + g * (1.0 - options.beta1);
            *v = *v * options.beta2 + g * g * (1.0 - options.beta2);
            let deviation = (*v / second_bias).map(f64::sqrt) + options.epsilon;
            element.curvature -= options.step * (*m / first_bias) / deviation;
        }
    }
}

fn length(gradient: &[DVec3]) -> f64 {
    gradient.iter().map(|g| g.length_squared()).sum::<f64>().sqrt()
}
