//! Where the search for the angle in the middle begins.

use std::f64::consts::FRAC_PI_2;

/// Angles of solutions at `v = 0, 0.1, ... 1` for Poisson's ratios 0, 0.25 and 0.5.
const ANGLES: [[f64; 11]; 3] = [
    [0.0, 0.0865, 0.2174, 0.4224, 0.6429, 0.8244, 0.9785, 1.1197, 1.2576, 1.4018, FRAC_PI_2],
    [0.0, 0.0785, 0.1945, 0.3698, 0.5517, 0.7080, 0.8505, 0.9918, 1.1433, 1.3209, FRAC_PI_2],
    [0.0, 0.0708, 0.1740, 0.3269, 0.4840, 0.6237, 0.7571, 0.8964, 1.0548, 1.2543, FRAC_PI_2],
];

/// The angle in the middle, to a hundredth or better.
pub(super) fn theta(v: f64, poisson_ratio: f64) -> f64 {
    let x = 10.0 * v;
    // Four neighbours in v, three in Poisson's ratio.
    let first = [7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0].into_iter().find(|&i| i <= x - 1.0);
    let first = first.unwrap_or(0.0);
    let along = lagrange([first, first + 1.0, first + 2.0, first + 3.0], x);
    let across = lagrange([0.0, 0.25, 0.5], poisson_ratio);
    let rows = ANGLES.iter().zip(across);
    rows.map(|(row, share)| {
        let columns = row.iter().enumerate().skip_while(|(i, _)| (*i as f64) < first);
        share * columns.zip(along).map(|((_, angle), share)| angle * share).sum::<f64>()
    })
    .sum()
}

/// Shares of the values at `nodes` in the polynomial through them.
fn lagrange<const N: usize>(nodes: [f64; N], x: f64) -> [f64; N] {
    nodes.map(|node| {
        let others = nodes.iter().filter(|&&other| (other - node).abs() > 1e-9);
        others.map(|other| (x - other) / (node - other)).product()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_met_at_its_nodes_and_between() {
        assert!((theta(0.3, 0.25) - 0.3698).abs() < 1e-12);
        assert!((theta(1.0, 0.0) - FRAC_PI_2).abs() < 1e-12);
        assert!(theta(0.0, 0.1).abs() < 1e-12);
        // Solutions that are not in the table.
        assert!((theta(0.45, 0.5) - 0.555471).abs() < 3e-3);
        assert!((theta(0.66, 0.5) - 0.839196).abs() < 3e-3);
        assert!((theta(0.05, 0.5) - 0.032425).abs() < 5e-3);
        assert!((theta(0.95, 0.25) - 1.429852).abs() < 1.5e-2);
    }
}
