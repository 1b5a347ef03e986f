//! Measures of one strand, from its elements.
//!
//! An element of curvatures `q` turns `|q| l / 2 pi` times about its axis with radius
//! `R = k / |q|^2` [CSE 12]. Taken element by element these are noisy: the twist of a short, nearly
//! straight arc is hardly observable, and its square enters `|q|`. So curvatures are first
//! averaged,
//! in the material frame, over the turn about each element ([`smoothed`]): noise cancels there, a
//! coil does not, and a strand that turns less than once is averaged as a whole.
//!
//! The coil radius of a strand is the median of its elements' radii, each counted by how far it
//! turns: straight stretches have no say in it. The hand is the sign of the total twist
//! `sum k0 l`; twist that changes sign along the strand (a switchback) makes it less certain.

use std::f64::consts::PI;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_geometry::{Element, SuperHelix};

/// Which way a strand winds, root to tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Hand {
    /// Like a common screw: twist is positive.
    Right,
    /// The mirror image: twist is negative.
    Left,
    /// It hardly turns, or winds as much one way as the other.
    Neither,
}

/// What is measured on one strand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrandMeasures {
    /// Arc length, in the groom's unit.
    pub length: f64,
    /// Distance from root to tip, in the groom's unit.
    pub reach: f64,
    /// Turns of all elements together, as `sum |q| l / 2 pi`.
    pub turns: f64,
    /// Median coil radius in the groom's unit; `None` below one turn, where there is no coil.
    pub coil_radius: Option<f64>,
    /// Which way it winds.
    pub hand: Hand,
    /// `sum k0 l / sum |k0| l`, from -1 (all left) over 0 (as much either way) to 1 (all right).
    pub hand_balance: f64,
}

/// Below this balance of twist a strand has no hand: a strand that changes hand at its middle, or
/// one whose twist is noise.
const LEAST_BALANCE: f64 = 0.2;

/// Measures one strand.
///
/// ```
/// use tress_analysis::{Hand, measure};
/// use tress_geometry::{Element, Frame, SuperHelix};
///
/// let coil = Element { length: 20.0, ..Element::coil(0.5, 0.3) };
/// let strand = SuperHelix { root: Frame::IDENTITY, elements: &[coil] };
/// let measures = measure(&strand);
/// assert_eq!(measures.hand, Hand::Right);
/// assert!((measures.coil_radius.expect("many turns") - 0.5).abs() < 1e-12);
/// assert!((measures.turns - 20.0 / (std::f64::consts::PI).hypot(0.3)).abs() < 1e-9);
/// ```
#[must_use]
pub fn measure(strand: &SuperHelix<'_>) -> StrandMeasures {
    let elements = smoothed(strand.elements);
    let turns = elements.iter().map(Element::turns).sum();
    let twist: f64 = elements.iter().map(|e| e.twist() * e.length).sum();
    let absolute: f64 = elements.iter().map(|e| e.twist().abs() * e.length).sum();
    let hand_balance = if absolute == 0.0 { 0.0 } else { twist / absolute };
    let coiled = 1.0 <= turns;
    let hand = match hand_balance {
        _ if !coiled => Hand::Neither,
        balance if LEAST_BALANCE <= balance => Hand::Right,
        balance if balance <= -LEAST_BALANCE => Hand::Left,
        _ => Hand::Neither,
    };
    StrandMeasures {
        length: strand.length(),
        reach: strand.tip().position.distance(strand.root.position),
        turns,
        coil_radius: if coiled { median_radius(&elements) } else { None },
        hand,
        hand_balance,
    }
}

/// The elements with their curvatures averaged, by length, over the turn about each: from half a
/// turn of bending before its middle to half a turn behind it, or as far as the strand goes.
#[must_use]
pub fn smoothed(elements: &[Element]) -> Vec<Element> {
    // Bending angle at the middle of each element, and sums of q l and l before each.
    let mut middles = Vec::with_capacity(elements.len());
    let mut sums = vec![(DVec3::ZERO, 0.0)];
    let (mut angle, mut curvature, mut length) = (0.0, DVec3::ZERO, 0.0);
    for element in elements {
        let bend = element.bending() * element.length;
        middles.push(angle + 0.5 * bend);
        angle += bend;
        curvature += element.curvature * element.length;
        length += element.length;
        sums.push((curvature, length));
    }
    let (mut first, mut end) = (0, 0);
    let mut averages = Vec::with_capacity(elements.len());
    for (element, middle) in elements.iter().zip(&middles) {
        while middles[first] < middle - PI {
            first += 1;
        }
        while end < elements.len() && middles[end] <= middle + PI {
            end += 1;
        }
        let (before, behind) = (sums[first], sums[end]);
        let length = behind.1 - before.1;
        let mean = (behind.0 - before.0) / length;
        let curvature = if mean.is_finite() { mean } else { element.curvature };
        averages.push(Element { curvature, length: element.length });
    }
    averages
}

/// The radius that half of the turning is done at or below.
fn median_radius(elements: &[Element]) -> Option<f64> {
    let mut radii: Vec<(f64, f64)> = elements.iter().map(|e| (e.radius(), e.turns())).collect();
    radii.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * radii.iter().map(|&(_, turns)| turns).sum::<f64>();
    let mut below = 0.0;
    radii.into_iter().find_map(|(radius, turns)| {
        below += turns;
        (half <= below).then_some(radius)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tress_geometry::{Element, Frame};

    fn strand(elements: &[Element]) -> StrandMeasures {
        measure(&SuperHelix { root: Frame::IDENTITY, elements })
    }

    fn coil(pitch: f64, length: f64) -> Element {
        Element { length, ..Element::coil(0.5, pitch) }
    }

    #[test]
    fn a_straight_strand_has_no_radius_and_no_hand() {
        let straight = strand(&[Element { length: 3.0, ..Element::default() }]);
        assert_eq!((straight.coil_radius, straight.hand), (None, Hand::Neither));
        assert_eq!((straight.length, straight.reach, straight.turns), (3.0, 3.0, 0.0));
        assert_eq!(strand(&[]).hand, Hand::Neither);
    }

    #[test]
    fn a_planar_wave_and_a_change_of_hand_have_no_hand() {
        assert_eq!(strand(&[coil(0.0, 10.0)]).hand, Hand::Neither);
        let switchback = strand(&[coil(1.0, 10.0), coil(-1.0, 9.0)]);
        assert_eq!(switchback.hand, Hand::Neither);
        assert_eq!(strand(&[coil(1.0, 10.0), coil(-1.0, 2.0)]).hand, Hand::Right);
    }

    #[test]
    fn noise_of_twist_and_bend_is_not_taken_for_a_coil() {
        // A straight hair of 15 segments whose bends and twists are rounding of its points.
        let noise = |i: usize| {
            let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
            Element { curvature: DVec3::new(3.0 * sign, 0.1 * sign, -0.1 * sign), length: 1.0 }
        };
        let straight = strand(&(0..15).map(noise).collect::<Vec<_>>());
        assert_eq!((straight.coil_radius, straight.hand), (None, Hand::Neither));
        assert!(straight.turns < 0.5, "{} turns", straight.turns);
        // A coil whose twist is off by as much as its bend, to and fro.
        let mut coil = vec![coil(1.0, 0.5); 60];
        let off = coil[0].bending();
        for (i, element) in coil.iter_mut().enumerate() {
            element.curvature.x += if i.is_multiple_of(2) { off } else { -off };
        }
        let noisy = strand(&coil);
        assert!((noisy.coil_radius.expect("a coil") - 0.5).abs() < 0.03);
        assert_eq!(noisy.hand, Hand::Right);
    }

    #[test]
    fn straight_stretches_have_no_say_in_the_radius() {
        let straight = Element { length: 100.0, ..Element::default() };
        let radius = strand(&[straight, coil(1.0, 10.0), straight]).coil_radius;
        assert!((radius.expect("it turns") - 0.5).abs() < 1e-12);
    }
}
