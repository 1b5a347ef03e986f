//! Scale and clump set to where the correlations of neighbours agree.

use super::correlation::{Likeness, Patches, crossing};
use super::parameters::{LossError, ParameterOptions, StageError};
use super::ranges::{Handle, MOST_CLUMP, MOST_SCALE};
use super::sample::spread;
use super::search::Problem;
use crate::instancing::nearest;
use crate::{EvenStrands, Operator, ProceduralGroom};

/// Strands of a patch, as many as there may be: [IPG 6] takes the lesser of 200 and a hundredth.
const PATCH: usize = 60;
/// Halvings of the range of scale and clump: to a thousandth of it.
const HALVINGS: usize = 10;

/// The patches whose correlations decide scale and clump.
pub(super) struct Correlations {
    options: ParameterOptions,
    problem: Problem,
    lengths: Patches,
    distances: Patches,
}

impl Correlations {
    pub(super) fn new(
        groom: &ProceduralGroom,
        instanced: &EvenStrands,
        targets: &EvenStrands,
        sound: &[usize],
        options: &ParameterOptions,
    ) -> Self {
        let places = groom.roots.places(&groom.roots);
        let sound_places: Vec<_> = sound.iter().map(|&i| places[i]).collect();
        let middles: Vec<_> =
            spread(sound, options.patches).into_iter().map(|i| places[i]).collect();
        let size = PATCH.min(sound.len().max(1));
        let near = nearest(&sound_places, &middles, size);
        let mut strands = Vec::new();
        let mut patches = Vec::new();
        for patch in near {
            let first = strands.len();
            strands.extend(patch.iter().map(|&(_, k)| sound[k as usize]));
            patches.push((first..strands.len()).collect::<Vec<usize>>());
        }
        let targets = targets.select(&strands);
        Self {
            options: *options,
            problem: Problem::new(groom, instanced, &strands),
            lengths: Patches::new(&targets, patches.clone(), Likeness::Length),
            distances: Patches::new(&targets, patches, Likeness::Distance),
        }
    }

    /// Sets scale and clump to where the target's correlations are met.
    pub(super) fn settle(&self, operators: &mut [Operator]) -> Result<(), StageError> {
        for o in 0..operators.len() {
            if !self.options.correlates(&operators[o]) {
                continue;
            }
            let (patches, greatest) = match operators[o] {
                Operator::Scale(_) => (&self.lengths, MOST_SCALE),
                Operator::Clump(_) => (&self.distances, MOST_CLUMP),
                _ => continue,
            };
            let handle = Handle {
                operator: o,
                index: 0,
                least: 0.0,
                greatest,
                step: 0.0,
                by_ratio: false,
                fineness: 1,
            };
            let mut trial = operators.to_vec();
            let found = crossing(0.0, greatest, HALVINGS, |value| {
                handle.set(&mut trial, value);
                let excess = patches.excess(&self.problem.strands(&trial)?);
                if excess.is_finite() {
                    return Ok(excess);
                }
                let place = format!("in the correlations at {} {value}", trial[o].name());
                Err(StageError::from(LossError { place }))
            })?;
            handle.set(operators, found);
        }
        Ok(())
    }
}
