//! All strands of a groom at once, with what belongs to them.

use rayon::prelude::*;
use tress_geometry::polyline::place;
use tress_geometry::{Attributes, Element, Frame, Groom, HelixGroom, Kept, Strands};

use crate::columns::zeros_like;
use crate::measure::Sums;
use crate::{FitOptions, FitOptionsError, FitReport, KeptReason, fit_strand};

/// A groom of super-helices and what the fit came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The super-helices, strand by strand those of the groom.
    pub helices: HelixGroom,
    /// How near they are.
    pub report: FitReport,
}

/// Strands that one task works on: enough that handing them out costs nothing, few enough that
/// threads end together.
const CHUNK: usize = 32;

/// Fits every strand of a groom.
///
/// Strand attributes are carried over, point attributes interpolated to joints. Strands that
/// cannot become super-helices are kept as they are, see [`KeptReason`].
///
/// ```
/// use glam::DVec3;
/// use tress_fit::{FitOptions, fit};
/// use tress_geometry::{Groom, Strands};
///
/// let points = vec![DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y];
/// let groom = Groom::new(Strands::from_counts([3, 1], points)?);
/// let fitted = fit(&groom, &FitOptions::default())?;
/// assert_eq!(fitted.helices.strand(0).elements.len(), 2);
/// assert_eq!(fitted.helices.kept().strands, [1]);
/// assert_eq!(fitted.report.kept[0].1, 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the options cannot be followed, or ask for more elements than offsets can number.
pub fn fit(groom: &Groom, options: &FitOptions) -> Result<Fitted, FitError> {
    fit_with(groom, options, |_| ())
}

/// Like [`fit`], and says as it goes on how many more strands are done.
///
/// `done` is called by whichever thread did them, a few strands at a time; the numbers it gets add
/// up to the strands of the groom.
///
/// ```
/// use std::sync::atomic::{AtomicUsize, Ordering};
/// use tress_fit::{FitOptions, fit_with};
/// use tress_geometry::glam::DVec3;
/// use tress_geometry::{Groom, Strands};
///
/// let groom = Groom::new(Strands::from_counts([2; 99], vec![DVec3::ZERO; 198])?);
/// let total = AtomicUsize::new(0);
/// fit_with(&groom, &FitOptions::default(), |more| {
///     total.fetch_add(more, Ordering::Relaxed);
/// })?;
/// assert_eq!(total.into_inner(), 99);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// As [`fit`].
pub fn fit_with(
    groom: &Groom,
    options: &FitOptions,
    done: impl Fn(usize) + Sync,
) -> Result<Fitted, FitError> {
    options.validate()?;
    let n = groom.strands().len();
    let parts: Vec<Part> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let strands = chunk * CHUNK..n.min((chunk + 1) * CHUNK);
            let count = strands.len();
            let part = Part::fit(groom, strands, options);
            done(count);
            part
        })
        .collect();
    assemble(groom, parts)
}

/// Why a groom is not fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The options cannot be followed.
    ///
    /// ```
    /// # use tress_fit::{Elements, FitError, FitOptions, FitOptionsError, fit};
    /// # use tress_geometry::{Groom, Strands};
    /// let none = FitOptions { elements: Elements::Count(0), ..FitOptions::default() };
    /// let error = fit(&Groom::new(Strands::default()), &none);
    /// assert_eq!(error, Err(FitError::Options(FitOptionsError::NoElements)));
    /// ```
    #[error(transparent)]
    Options(#[from] FitOptionsError),
    /// Strands times elements are more than a groom can hold: some 50,000 strands of
    /// 100,000 elements.
    #[error(transparent)]
    TooMany(#[from] tress_geometry::OffsetsError),
}

/// The fits of some neighbouring strands.
#[derive(Default)]
struct Part {
    roots: Vec<Frame>,
    counts: Vec<usize>,
    elements: Vec<Element>,
    /// For each joint the row of the point attributes it is at, and how far to the next.
    places: Vec<(usize, f64)>,
    kept: Vec<(usize, KeptReason)>,
    sums: Sums,
}

impl Part {
    fn fit(groom: &Groom, strands: std::ops::Range<usize>, options: &FitOptions) -> Self {
        let mut part = Self::default();
        for i in strands {
            part.add(groom, i, options);
        }
        part
    }

    fn add(&mut self, groom: &Groom, i: usize, options: &FitOptions) {
        let points = groom.strands().strand(i);
        let first_row = groom.strands().range(i).start;
        let wants_places = !groom.point_attributes().is_empty();
        match fit_strand(points, options) {
            Ok(fit) => {
                if options.measure {
                    self.sums.add(Sums::of(&fit.super_helix(), points, &fit.arc_lengths));
                }
                if wants_places {
                    let mut s = 0.0;
                    self.places.push((first_row, 0.0));
                    self.places.extend(fit.elements.iter().map(|element| {
                        s += element.length;
                        let (row, beyond) = place(&fit.arc_lengths, s);
                        (first_row + row, beyond)
                    }));
                }
                self.roots.push(fit.root);
                self.counts.push(fit.elements.len());
                self.elements.extend(fit.elements);
            }
            Err(reason) => {
                let position = points.first().copied().unwrap_or_default();
                self.roots.push(Frame { position, ..Frame::IDENTITY });
                self.counts.push(0);
                if wants_places {
                    self.places.push((first_row, 0.0));
                }
                self.kept.push((i, reason));
            }
        }
    }
}

fn assemble(groom: &Groom, parts: Vec<Part>) -> Result<Fitted, FitError> {
    let n_elements = parts.iter().map(|part| part.elements.len()).sum();
    let n_strands = groom.strands().len();
    let mut all = Part { elements: Vec::with_capacity(n_elements), ..Part::default() };
    for part in parts {
        all.roots.extend(part.roots);
        all.counts.extend(part.counts);
        all.elements.extend(part.elements);
        all.places.extend(part.places);
        all.kept.extend(part.kept);
        all.sums.add(part.sums);
    }
    let report = FitReport {
        strands: n_strands,
        elements: n_elements,
        kept: tally(&all.kept),
        deviation: all.sums.deviation(),
    };
    let elements = Strands::from_counts(all.counts, all.elements)?;
    let joints = joint_attributes(groom, &all.places, n_elements + n_strands);
    let kept = kept_strands(groom, &all.kept);
    let strand_attributes = groom.strand_attributes().clone();
    let helices = HelixGroom::with_attributes(all.roots, elements, strand_attributes, joints, kept)
        .expect("one root, count and row of attributes was made for every strand");
    Ok(Fitted { helices: helices.in_space(groom.unit, groom.up), report })
}

fn tally(kept: &[(usize, KeptReason)]) -> Vec<(KeptReason, usize)> {
    let mut counts = std::collections::BTreeMap::new();
    for (_, reason) in kept {
        *counts.entry(*reason).or_insert(0) += 1;
    }
    counts.into_iter().collect()
}

fn joint_attributes(groom: &Groom, places: &[(usize, f64)], rows: usize) -> Attributes {
    let last = groom.point_attributes().rows().checked_sub(1);
    groom.point_attributes().map(rows, |column| match last {
        Some(last) => column.interpolate(places.iter().map(|&(row, f)| (row.min(last), f))),
        None => zeros_like(column, rows),
    })
}

fn kept_strands(groom: &Groom, kept: &[(usize, KeptReason)]) -> Kept {
    let named = || kept.iter().map(|&(i, _)| i);
    let polylines = groom.strands().select(named());
    let rows = polylines.points().len();
    let point_attributes = groom
        .point_attributes()
        .map(rows, |column| column.select(named().flat_map(|i| groom.strands().range(i))));
    let strands = named().map(|i| u32::try_from(i).expect("offsets number the strands")).collect();
    Kept { strands, polylines, point_attributes }
}

#[cfg(test)]
mod tests;
