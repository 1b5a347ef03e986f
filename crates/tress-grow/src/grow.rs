//! Hairs along their guides.

use glam::DVec3;
use rayon::prelude::*;
use tress_geometry::{Column, Groom, Strands};

use crate::guide::Guide;
use crate::loose::LooseLine;
use crate::plan::{Choice, Draw};
use crate::skip::{SkipScratch, skip_periods};
use crate::{AssignError, Coils, GrowError, GrowOptions, Plan, assign};

/// The attribute of strands that says which guide a hair follows.
pub const GUIDE: &str = "guide";

/// What was grown on what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GrowReport {
    /// Hairs grown.
    pub hairs: usize,
    /// Guides that hairs follow.
    pub guides: usize,
    /// Guides among them with no coil: their hairs duplicate them.
    pub straight_guides: usize,
    /// Hairs that are a root and nothing more: their guide is no strand, or their root no place.
    pub bare_roots: usize,
    /// Roots farther from their guide's root than its centerline is long.
    pub far_roots: usize,
}

impl Plan {
    /// Grows the hairs on the guides they were planned on. Strands stand in the order of the roots
    /// and have the attribute [`GUIDE`].
    ///
    /// # Errors
    ///
    /// If there are other guides or roots than were planned for, or more points than offsets can
    /// tell apart.
    pub fn grow(&self, guides: &Strands<DVec3>, roots: &[DVec3]) -> Result<Groom, GrowError> {
        self.check(guides, roots)?;
        let counts: Vec<usize> = self.counts().collect();
        let total: usize = counts.iter().sum();
        let mut strands = Strands::from_counts(counts, vec![DVec3::ZERO; total])?;
        self.lay(guides, roots, &mut strands);
        let mut groom = Groom::new(strands);
        let names = self.guides().map(i64::from).collect();
        groom.insert_strand_attribute(GUIDE, Column::Int(names)).expect("a guide a hair");
        Ok(groom)
    }

    /// The same hairs on guides that have moved: another frame of an animation.
    ///
    /// # Errors
    ///
    /// If there are other guides, other numbers of points, or other roots than were planned for.
    pub fn moved(self, guides: &Strands<DVec3>) -> Result<Self, GrowError> {
        self.check_guides(guides)?;
        Ok(Self { lines: self.lines.moved(guides), ..self })
    }

    /// What there is to say of the hairs.
    #[must_use]
    pub fn report(&self, guides: &Strands<DVec3>, roots: &[DVec3]) -> GrowReport {
        let mut followed = vec![false; guides.len()];
        let mut report = GrowReport { hairs: self.len(), ..GrowReport::default() };
        let lengths: Vec<f64> =
            self.lines.points.iter().map(tress_geometry::polyline::length).collect();
        for (choice, root) in self.choices.iter().zip(roots) {
            let guide = choice.guide as usize;
            followed[guide] = true;
            report.bare_roots += usize::from(choice.tip == 0);
            let first = guides.strand(guide).first();
            let far = first.is_some_and(|first| first.distance(*root) > lengths[guide]);
            report.far_roots += usize::from(choice.tip > 0 && far);
        }
        for (rest, _) in self.lines.rests.iter().zip(&followed).filter(|(_, followed)| **followed) {
            report.guides += 1;
            report.straight_guides += usize::from(rest.sound && rest.turns <= 0.0);
        }
        report
    }

    fn check(&self, guides: &Strands<DVec3>, roots: &[DVec3]) -> Result<(), GrowError> {
        self.check_guides(guides)?;
        let (found, expected) = (roots.len(), self.len());
        if found == expected {
            Ok(())
        } else {
            Err(GrowError::Frame { of: "roots", found, expected })
        }
    }

    fn check_guides(&self, guides: &Strands<DVec3>) -> Result<(), GrowError> {
        let planned = &self.lines.points;
        let (found, expected) = (guides.len(), planned.len());
        if found != expected {
            return Err(GrowError::Frame { of: "guides", found, expected });
        }
        match guides.counts().zip(planned.counts()).find(|(found, expected)| found != expected) {
            Some((found, expected)) => {
                Err(GrowError::Frame { of: "points in one guide", found, expected })
            }
            None => Ok(()),
        }
    }

    /// Lays every hair into its place: the pieces are shared out among threads.
    fn lay(&self, guides: &Strands<DVec3>, roots: &[DVec3], strands: &mut Strands<DVec3>) {
        let mut places: Vec<Option<&mut [DVec3]>> = strands.iter_mut().map(Some).collect();
        let mut work = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces {
            let own = piece.iter().filter_map(|hair| Some((*hair, places[*hair as usize].take()?)));
            work.push(own.collect::<Vec<_>>());
        }
        drop(places);
        work.into_par_iter().for_each_init(SkipScratch::default, |scratch, piece| {
            let Some(first) = piece.first().map(|(hair, _)| *hair as usize) else { return };
            let guide = self.guide(guides, self.choices[first].guide);
            for (hair, place) in piece {
                let (hair, root) = (hair as usize, roots[hair as usize]);
                match &guide {
                    Some(guide) if self.choices[hair].tip > 0 => {
                        self.lay_hair(guide, hair, root, place, scratch);
                    }
                    _ => place.fill(root),
                }
            }
        });
    }

    fn lay_hair(
        &self,
        guide: &Guide<'_>,
        hair: usize,
        root: DVec3,
        place: &mut [DVec3],
        scratch: &mut SkipScratch,
    ) {
        let Choice { joint, loose, turn, .. } = self.choices[hair];
        let (joint, turn) = (joint as usize, f64::from(turn));
        let (draw, mut rng) = Draw::new(self.seed, hair);
        let (spongy, strict) = place.split_at_mut(loose as usize);
        if joint > 0 {
            let line = LooseLine::new(guide, joint, root);
            self.loose(guide, joint, root, &draw, turn).lay(guide, &line, spongy);
        }
        for (i, point) in (joint..).zip(strict.iter_mut()) {
            *point = guide.points[i] + guide.displacement(i, root, draw.place);
        }
        if let (0, Some(first)) = (joint, strict.first_mut()) {
            *first = root;
        }
        let per_turn = guide.points_per_turn();
        skip_periods(strict, &self.options.skip, per_turn, &mut rng, scratch);
    }
}

/// Why hairs cannot be grown from guides and roots alone.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GrowFromError {
    /// Roots are given no guides.
    #[error(transparent)]
    Assign(#[from] AssignError),
    /// Hairs do not grow.
    #[error(transparent)]
    Grow(#[from] GrowError),
}

/// Grows a hair on each root, with guides assigned as the options say.
///
/// ```
/// use glam::DVec3;
/// use tress_grow::{Coils, GrowOptions, grow};
/// use tress_geometry::Strands;
///
/// // One guide of ten turns, and three roots about it.
/// let guide = (0..=60).map(|i| {
///     let (sine, cosine) = (f64::from(i) / 6.0 * std::f64::consts::TAU).sin_cos();
///     DVec3::new(0.5 * cosine, -0.1 * f64::from(i), 0.5 * sine)
/// });
/// let mut guides = Strands::default();
/// guides.push(guide)?;
/// let roots = [DVec3::X, DVec3::Z, DVec3::NEG_X];
///
/// let groom = grow(&guides, &roots, Coils::shipped()?, &GrowOptions::default(), 7)?;
/// for (strand, root) in groom.strands().iter().zip(&roots) {
///     assert_eq!(strand[0], *root);
///     // Where its wisp has formed, a hair is near its guide.
///     let near = |p: &DVec3| guides.points().iter().any(|q| p.distance(*q) < 0.31);
///     assert!(strand[40..].iter().all(near));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// See [`GrowFromError`].
pub fn grow(
    guides: &Strands<DVec3>,
    roots: &[DVec3],
    coils: Coils,
    options: &GrowOptions,
    seed: u64,
) -> Result<Groom, GrowFromError> {
    let nowhere = DVec3::NAN;
    let firsts: Vec<DVec3> =
        guides.iter().map(|points| points.first().copied().unwrap_or(nowhere)).collect();
    let assigned = assign(roots, &firsts, options.assignment, seed)?;
    let plan = Plan::new(guides, roots, &assigned, coils, options, seed)?;
    Ok(plan.grow(guides, roots)?)
}

#[cfg(test)]
mod tests;
