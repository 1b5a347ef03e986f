//! The stored random numbers of the operators.
//!
//! Each operator has a column of numbers: one a strand, or two an operator guide. They are drawn
//! once, from one stream a strand (or operator guide) keyed by the seed, the operator's name, its
//! place among the operators of that name, and the strand; from then on they are part of the groom.

use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use tress_edit::strand_rng;

use crate::Operator;
use crate::operators::Draws;

/// The numbers of each operator of a chain, in the chain's order.
///
/// Scale and bend have one a strand, normal, truncated to -1 to 1; frizz one a strand, even in 0 to
/// 1; curl two an operator guide, one of each kind; the others none.
///
/// ```
/// use tress_procedural::{Curl, Operator, Scale, draw};
///
/// let chain = [Operator::Scale(Scale { random: 0.2 }), Operator::Curl(Curl::default())];
/// let numbers = draw(&chain, 100, 7, 1);
/// assert_eq!((numbers[0].len(), numbers[1].len()), (100, 14));
/// assert!(numbers[0].iter().all(|u| u.abs() <= 1.0));
/// assert_eq!(numbers, draw(&chain, 100, 7, 1));
/// ```
#[must_use]
pub fn draw(
    operators: &[Operator],
    strands: usize,
    operator_guides: usize,
    seed: u64,
) -> Vec<Vec<f64>> {
    (0..operators.len()).map(|o| draw_one(operators, o, strands, operator_guides, seed)).collect()
}

/// The numbers of operator `o` alone.
pub(crate) fn draw_one(
    operators: &[Operator],
    o: usize,
    strands: usize,
    operator_guides: usize,
    seed: u64,
) -> Vec<f64> {
    let key = stream(operators, o, seed);
    match operators[o].draws() {
        Draws::None => Vec::new(),
        Draws::NormalPerStrand => (0..strands)
            .into_par_iter()
            .map(|i| truncated_normal(&mut strand_rng(key, i)))
            .collect(),
        Draws::EvenPerStrand => {
            (0..strands).into_par_iter().map(|i| strand_rng(key, i).random()).collect()
        }
        Draws::TwoPerGuide => (0..operator_guides)
            .flat_map(|i| {
                let mut rng = strand_rng(key, i);
                [truncated_normal(&mut rng), rng.random()]
            })
            .collect(),
    }
}

/// The seed of operator `o`'s own numbers.
pub(crate) fn stream(operators: &[Operator], o: usize, seed: u64) -> u64 {
    seed ^ fingerprint(label(operators, o).as_bytes())
}

/// An operator's name and its place among those of that name: `bend.0`, `bend.1`.
pub(crate) fn label(operators: &[Operator], o: usize) -> String {
    let name = operators[o].name();
    let before = operators[..o].iter().filter(|operator| operator.name() == name).count();
    format!("{name}.{before}")
}

/// How many numbers an operator has.
pub(crate) fn count(operator: &Operator, strands: usize, operator_guides: usize) -> usize {
    match operator.draws() {
        Draws::None => 0,
        Draws::NormalPerStrand | Draws::EvenPerStrand => strands,
        Draws::TwoPerGuide => 2 * operator_guides,
    }
}

/// The two numbers of an operator for a strand and its operator guide.
#[inline]
pub(crate) fn of_strand(
    operator: &Operator,
    numbers: &[f64],
    strand: usize,
    guide: usize,
) -> [f64; 2] {
    match operator.draws() {
        Draws::None => [0.0; 2],
        Draws::NormalPerStrand | Draws::EvenPerStrand => [numbers[strand], 0.0],
        Draws::TwoPerGuide => [numbers[2 * guide], numbers[2 * guide + 1]],
    }
}

/// A normal number, drawn again until it is within -1 to 1 (twice in three it is at once).
fn truncated_normal(rng: &mut impl Rng) -> f64 {
    loop {
        let x: f64 = StandardNormal.sample(rng);
        if x.abs() <= 1.0 {
            return x;
        }
    }
}

/// The FNV-1a hash of 64 bits.
pub(crate) fn fingerprint(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &b| {
        (hash ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bend, Frizz, Scale};

    #[test]
    fn numbers_of_an_operator_do_not_depend_on_the_others() {
        let scale = Operator::Scale(Scale::default());
        let bend = Operator::Bend(Bend::default());
        let alone = draw(std::slice::from_ref(&scale), 20, 0, 5);
        let after = draw(&[bend.clone(), scale.clone(), bend], 20, 0, 5);
        assert_eq!(alone[0], after[1]);
        assert_ne!(after[0], after[2]);
    }

    #[test]
    fn numbers_have_the_moments_of_their_distributions() {
        let chain = [Operator::Scale(Scale::default()), Operator::Frizz(Frizz::default())];
        let numbers = draw(&chain, 40_000, 0, 9);
        let moments = |numbers: &[f64]| {
            let n = numbers.len() as f64;
            let mean = numbers.iter().sum::<f64>() / n;
            (mean, numbers.iter().map(|u| (u - mean).powi(2)).sum::<f64>() / n)
        };
        // The normal density cut at +-1 has variance 1 - 2 phi(1) / (2 Phi(1) - 1) = 0.29112.
        let (mean, variance) = moments(&numbers[0]);
        assert!(mean.abs() < 0.01 && (variance - 0.29112).abs() < 0.005, "{mean} {variance}");
        let (mean, variance) = moments(&numbers[1]);
        assert!((mean - 0.5).abs() < 0.01 && (variance - 1.0 / 12.0).abs() < 0.002);
    }
}
