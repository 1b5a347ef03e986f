//! Polylines to p-helicoids [GH 5].
//!
//! [`fit`] takes a groom, [`fit_strand`] one polyline. What is small enough is the discrete Frechet
//! distance between the polyline and the fit traced at the same arc lengths; `docs/helicoid.md`
//! tells how the two methods compare.

mod chain;
mod flow;
mod fragment;
mod levenberg;
mod options;
mod simplex;
mod split;
mod target;

use glam::DVec3;
use rayon::prelude::*;
use tress_geometry::polyline::Defect;
use tress_geometry::{Frame, Groom, Strands};

pub(crate) use chain::KN;
pub(crate) use flow::mean_curvature;
pub use options::{FitOptions, FitOptionsError, Method, Pieces, Roll};

use crate::frechet::frechet;
use crate::{Helicoid, HelicoidGroom, PHelicoid, Piece, Tracing};
use chain::{Chain, Points};
use target::Target;

/// A fitted strand and how near it is.
#[derive(Clone, Debug, PartialEq)]
pub struct StrandFit {
    /// The root frame.
    pub root: Frame,
    /// The pieces.
    pub pieces: Vec<Piece>,
    /// Discrete Frechet distance from the polyline, in its unit.
    pub frechet: f64,
    /// Root mean square distance of the polyline's points from the fit at their arc lengths.
    pub rms: f64,
    /// Length of the smooth curve through the polyline's points.
    pub length: f64,
}

/// A groom as p-helicoids, and how near they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The p-helicoids.
    pub hairs: HelicoidGroom,
    /// What the fit came to.
    pub report: FitReport,
}

/// What a fit came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FitReport {
    /// Strands that no helicoid can describe, kept as they are, and why.
    pub kept: Vec<(usize, Defect)>,
    /// Frechet distance of each strand, in the groom's unit; 0 for a kept one.
    pub frechet: Vec<f64>,
    /// Root mean square distance of each strand; 0 for a kept one.
    pub rms: Vec<f64>,
    /// Pieces of each strand; 0 for a kept one.
    pub pieces: Vec<usize>,
    /// Strands whose Frechet distance is above the tolerance: their pieces were used up.
    pub above_tolerance: usize,
}

/// Fits a polyline of two points or more. The options are taken as valid.
///
/// Fewer than four points do not determine four parameters; what they leave open stays 0.
///
/// ```
/// use glam::DVec3;
/// use tress_helicoid::{FitOptions, fit_strand};
///
/// let arc: Vec<_> = (0..20).map(|i| f64::from(i) * 0.1)
///     .map(|a| DVec3::new(3.0 * a.sin(), 3.0 - 3.0 * a.cos(), 0.0)).collect();
/// let fit = fit_strand(&arc, &FitOptions::default())?;
/// assert_eq!(fit.pieces.len(), 1);
/// assert!((fit.pieces[0].k.kt - 1.0 / 3.0).abs() < 1e-4 && fit.frechet < 1e-4);
/// # Ok::<(), tress_geometry::polyline::Defect>(())
/// ```
///
/// # Errors
///
/// If the polyline has a [`Defect`].
pub fn fit_strand(points: &[DVec3], options: &FitOptions) -> Result<StrandFit, Defect> {
    let fewest = match options.pieces {
        Pieces::UpTo(_) => 0,
        Pieces::Equal(n) => n * SEGMENTS,
    };
    let target = Target::new(points, fewest)?;
    let mut chain = traceable(&target, options).ok_or(Defect::NotFinite)?;
    chain.turn = flow::FINE;
    let behind = Points {
        positions: &target.polyline[1..],
        arc_lengths: &target.at_polyline[1..],
        window: 1,
        end: None,
    };
    let mut traced = vec![DVec3::ZERO];
    chain.trace(behind, &mut traced).ok_or(Defect::NotFinite)?;
    let unit = target.length;
    let square: f64 =
        target.polyline.iter().zip(&traced).map(|(p, q)| p.distance_squared(*q)).sum();
    let pieces = chain.pieces.iter().map(|piece| {
        let k = Helicoid {
            kt: piece.k.kt / unit,
            kn: piece.k.kn / unit,
            kb: piece.k.kb / unit,
            alpha: piece.k.alpha,
        };
        Piece { k, length: piece.length * unit }
    });
    Ok(StrandFit {
        root: Frame { position: target.origin, axes: chain.root.axes },
        pieces: pieces.collect(),
        frechet: unit * frechet(&target.polyline, &traced),
        rms: unit * (square / target.polyline.len() as f64).sqrt(),
        length: unit,
    })
}

/// Segments to a piece at least where pieces are given: fewer leave its parameters open.
const SEGMENTS: usize = 4;

/// Effort of a hold: what further steps change is less than the mean of guides is good for.
const HOLD: levenberg::Effort = levenberg::Effort { steps: 8, gain: 1e-2 };

/// What a change of curvature costs a hair that is held. With less, hairs come nearer to the mean
/// of points, which is too straight or too curved; with more they keep what was mixed.
const KEPT: f64 = 0.7;

/// Bends a hair so that it passes points, given from its root at equal parts of its length, as well
/// as it can with the length it has; only the means of so many points in a row count.
pub(crate) fn hold(
    hair: &PHelicoid<'_>,
    points: &[DVec3],
    window: usize,
) -> Option<(Frame, Vec<Piece>)> {
    let length = hair.length();
    let scaled = |piece: &Piece, by: f64| {
        let Helicoid { kt, kn, kb, alpha } = piece.k;
        Piece { k: Helicoid::new(kt * by, kn * by, kb * by, alpha), length: piece.length / by }
    };
    let mut breaks = vec![0.0];
    breaks.extend(hair.pieces.iter().scan(0.0, |s, piece| {
        *s += piece.length / length;
        Some(*s)
    }));
    let root = Frame { position: DVec3::ZERO, ..hair.root };
    let pieces = hair.pieces.iter().map(|piece| scaled(piece, length)).collect();
    let mut chain = Chain { root, pieces, breaks, turn: flow::ROUGH };
    let positions: Vec<DVec3> = points.iter().map(|p| p / length).collect();
    let parts = 1..=points.len();
    let arc_lengths: Vec<f64> = parts.map(|i| i as f64 / points.len() as f64).collect();
    let points = Points { positions: &positions, arc_lengths: &arc_lengths, window, end: None };
    let prior = levenberg::Prior {
        curvature: 0.0,
        stretch: 0.1,
        keep: KEPT,
        free_root: true,
        free_roll: false,
    };
    if !levenberg::refine(&mut chain, points, prior, HOLD) {
        return None;
    }
    let root = Frame { position: hair.root.position, ..chain.root };
    Some((root, chain.pieces.iter().map(|piece| scaled(piece, 1.0 / length)).collect()))
}

/// How much more parameters cost where a fit came out singular between its points, time after time.
const DEARER: [f64; 3] = [1.0, 30.0, 1000.0];

/// The fit with the least cost of parameters that can be traced.
fn traceable(target: &Target, options: &FitOptions) -> Option<Chain> {
    DEARER.into_iter().find_map(|times| {
        let regularization = times * options.regularization.max(1e-6);
        let chain = split::fit(target, &FitOptions { regularization, ..*options })?;
        let hair = PHelicoid { root: chain.root, pieces: &chain.pieces };
        hair.tip(Tracing::Controlled(1e-5)).is_ok().then_some(chain)
    })
}

/// Fits every strand of a groom; attributes of strands go along, those of points do not.
///
/// # Errors
///
/// If an option is out of its range.
pub fn fit(groom: &Groom, options: &FitOptions) -> Result<Fitted, FitOptionsError> {
    fit_with(groom, options, |_| ())
}

/// Like [`fit`], and says as it goes on how many more strands are done.
///
/// # Errors
///
/// As [`fit`].
pub fn fit_with(
    groom: &Groom,
    options: &FitOptions,
    done: impl Fn(usize) + Sync,
) -> Result<Fitted, FitOptionsError> {
    options.validate()?;
    let strands: Vec<&[DVec3]> = groom.strands().iter().collect();
    let fits: Vec<Result<StrandFit, Defect>> = strands
        .par_iter()
        .with_min_len(16)
        .map(|points| {
            let fit = fit_strand(points, options);
            done(1);
            fit
        })
        .collect();
    let mut report = FitReport::default();
    let mut roots = Vec::with_capacity(fits.len());
    let mut pieces = Strands::default();
    let mut kept = std::collections::BTreeMap::new();
    for (i, fit) in fits.into_iter().enumerate() {
        let fit = fit.unwrap_or_else(|defect| {
            report.kept.push((i, defect));
            kept.insert(u32::try_from(i).unwrap_or(u32::MAX), strands[i].to_vec());
            let root = Frame::IDENTITY;
            StrandFit { root, pieces: Vec::new(), frechet: 0.0, rms: 0.0, length: 0.0 }
        });
        report.above_tolerance += usize::from(options.tolerance * fit.length < fit.frechet);
        report.frechet.push(fit.frechet);
        report.rms.push(fit.rms);
        report.pieces.push(fit.pieces.len());
        roots.push(fit.root);
        // A strand has at most 1,000 pieces, and never more than segments.
        pieces.push(fit.pieces).map_err(|_| FitOptionsError::Pieces(usize::MAX))?;
    }
    let attributes = groom.strand_attributes().clone();
    let hairs = HelicoidGroom::with_attributes(roots, pieces, attributes, kept)
        .expect("a root, pieces and a row each were made for every strand")
        .in_space(groom.unit, groom.up);
    Ok(Fitted { hairs, report })
}

#[cfg(test)]
mod tests;
