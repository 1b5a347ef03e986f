//! The ruffle [CSE 4.3.1]: strands of a group exchange elements.
//!
//! Beyond the first `keep` elements (`N_m` in the paper) each element's curvatures and length are
//! replaced, with a probability `rho`, by those of the element with the same index of a strand
//! drawn from the group. What is shuffled is real curl, so radii and frequencies of the result are
//! those of the groom, where noise on positions would smear them. Early elements steer all that
//! follows them, so keeping some holds the wisps together at the root.
//!
//! Strands may differ in their number of elements: an element is drawn among the strands that have
//! one with its index, and no strand changes its number of elements.

use std::collections::BTreeMap;

use rand::RngExt;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::{Element, HelixGroom};

use crate::strand_rng;

/// How strands are ruffled.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RuffleOptions {
    /// Chance of an element to be replaced, `rho`, 0 to 1. Default 0.05, as in [CSE Fig. 1].
    pub probability: f64,
    /// Elements at the root that are never replaced, `N_m`. Default 30, as in [CSE Fig. 1], where
    /// strands have 90.
    pub keep: usize,
    /// From the groom as it is (0) to the ruffled groom (1). Default 1.
    pub blend: f64,
}

impl Default for RuffleOptions {
    fn default() -> Self {
        Self { probability: 0.05, keep: 30, blend: 1.0 }
    }
}

/// What a ruffle did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RuffleReport {
    /// Groups with at least one strand.
    pub groups: usize,
    /// Strands that are the only one of their group, which have no one to exchange with.
    pub alone: usize,
    /// Strands with no element beyond the ones kept (polylines passed through among them).
    pub untouched: usize,
    /// Elements beyond the ones kept.
    pub candidates: usize,
    /// Elements replaced by those of another strand.
    pub replaced: usize,
    /// Whether strands of one group have different numbers of elements.
    pub unequal: bool,
}

/// Why a groom cannot be ruffled.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RuffleError {
    /// The probability is not one.
    #[error("the probability of a ruffle is {0}, expected 0 to 1")]
    Probability(f64),
    /// The blend is outside its range.
    #[error("the blend of a ruffle is {0}, expected 0 to 1")]
    Blend(f64),
    /// Not one group a strand.
    #[error("{groups} group numbers for {strands} strands")]
    Groups {
        /// Group numbers given.
        groups: usize,
        /// Strands in the groom.
        strands: usize,
    },
}

impl RuffleOptions {
    fn validate(&self) -> Result<(), RuffleError> {
        if !(0.0..=1.0).contains(&self.probability) {
            return Err(RuffleError::Probability(self.probability));
        }
        if !(0.0..=1.0).contains(&self.blend) {
            return Err(RuffleError::Blend(self.blend));
        }
        Ok(())
    }
}

/// Ruffles a groom; `groups[i]` is the group of strand `i`, any number.
///
/// The same seed draws the same strands whatever the probability: raising it replaces further
/// elements and leaves those already replaced as they were.
///
/// ```
/// use tress_edit::{RuffleOptions, ruffle};
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
///
/// let coil = |radius, n| vec![Element { length: 0.1, ..Element::coil(radius, 0.3) }; n];
/// let elements = [coil(0.5, 40), coil(0.7, 40)].concat();
/// let elements = Strands::from_counts([40, 40], elements)?;
/// let groom = HelixGroom::new(vec![Frame::IDENTITY; 2], elements)?;
/// let options = RuffleOptions { probability: 0.5, keep: 10, ..Default::default() };
/// let (ruffled, report) = ruffle(&groom, &[0, 0], &options, 7)?;
/// assert_eq!(ruffled.strand(0).elements[..10], groom.strand(0).elements[..10]);
/// assert_eq!(report.candidates, 60);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If an option is out of range or there is not one group a strand.
pub fn ruffle(
    groom: &HelixGroom,
    groups: &[u32],
    options: &RuffleOptions,
    seed: u64,
) -> Result<(HelixGroom, RuffleReport), RuffleError> {
    options.validate()?;
    if groups.len() != groom.len() {
        return Err(RuffleError::Groups { groups: groups.len(), strands: groom.len() });
    }
    let donors = Donors::new(groom, groups);
    let mut ruffled = groom.clone();
    let strands: Vec<(usize, &mut [Element])> =
        ruffled.elements_mut().iter_mut().enumerate().collect();
    let counts: Vec<(usize, usize)> = strands
        .into_par_iter()
        .map(|(i, elements)| {
            let donors = donors.group(groups[i]);
            ruffle_strand(groom, i, donors, options, seed, elements)
        })
        .collect();
    let mut report = donors.report();
    for (candidates, replaced) in counts {
        report.untouched += usize::from(candidates == 0);
        report.candidates += candidates;
        report.replaced += replaced;
    }
    Ok((ruffled, report))
}

/// Replaces elements of strand `i`; gives how many could be replaced, and how many were.
fn ruffle_strand(
    groom: &HelixGroom,
    i: usize,
    donors: &[u32],
    options: &RuffleOptions,
    seed: u64,
    elements: &mut [Element],
) -> (usize, usize) {
    let mut rng = strand_rng(seed, i);
    let mut replaced = 0;
    let candidates = elements.len().saturating_sub(options.keep);
    for (j, element) in elements.iter_mut().enumerate().skip(options.keep) {
        // Both numbers are drawn whether or not they are used: see `ruffle`.
        let (chance, draw) = (rng.random::<f64>(), rng.random::<f64>());
        if options.probability <= chance {
            continue;
        }
        let n = donors.partition_point(|&d| j < groom.strand(d as usize).elements.len());
        #[expect(clippy::cast_possible_truncation, reason = "below the number of donors")]
        let donor = donors[((draw * n as f64) as usize).min(n - 1)] as usize;
        *element = mix(element, &groom.strand(donor).elements[j], options.blend);
        replaced += usize::from(donor != i);
    }
    (candidates, replaced)
}

/// An element between two, in curvature and length.
pub(crate) fn mix(a: &Element, b: &Element, t: f64) -> Element {
    Element {
        curvature: a.curvature + (b.curvature - a.curvature) * t,
        length: a.length + (b.length - a.length) * t,
    }
}

/// The strands of each group, those with the most elements first.
struct Donors {
    groups: BTreeMap<u32, Vec<u32>>,
    unequal: bool,
}

impl Donors {
    fn new(groom: &HelixGroom, groups: &[u32]) -> Self {
        let mut members: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (i, &group) in (0..).zip(groups) {
            if groom.kept_polyline(i as usize).is_none() {
                members.entry(group).or_default().push(i);
            }
        }
        let count = |i: &u32| groom.strand(*i as usize).elements.len();
        let mut unequal = false;
        for group in members.values_mut() {
            group.sort_by_key(|i| std::cmp::Reverse(count(i)));
            unequal |= group.first().map(count) != group.last().map(count);
        }
        Self { groups: members, unequal }
    }

    fn group(&self, group: u32) -> &[u32] {
        self.groups.get(&group).map_or(&[], Vec::as_slice)
    }

    fn report(&self) -> RuffleReport {
        RuffleReport {
            groups: self.groups.len(),
            alone: self.groups.values().filter(|group| group.len() == 1).count(),
            unequal: self.unequal,
            ..RuffleReport::default()
        }
    }
}

#[cfg(test)]
mod tests;
