//! Forward Euler, as published [GH 3]: `p_{i+1} = p_i + h E_T(theta(p_i), phi(p_i))`.

use super::{Place, Singular};
use crate::Helicoid;
use crate::field::LEAST_CLEARANCE;

pub(super) fn walk(
    k: &Helicoid,
    start: Place,
    length: f64,
    steps: u32,
    stops: &[f64],
    visit: &mut impl FnMut(usize, Place),
) -> Result<Place, Singular> {
    let h = length / f64::from(steps);
    let mut here = start;
    let mut next = 0;
    for step in 0..steps {
        let begins = h * f64::from(step);
        let direction = k.direction(here.theta);
        let last = step + 1 == steps;
        while let Some(&stop) = stops.get(next)
            && (last || stop < begins + h)
        {
            visit(next, Place { position: here.position + direction * (stop - begins), ..here });
            next += 1;
        }
        let position = here.position + h * direction;
        if k.clearance(position) < LEAST_CLEARANCE {
            return Err(Singular(begins + h));
        }
        here = Place { position, theta: k.theta_near(position, here.theta) };
    }
    Ok(here)
}
