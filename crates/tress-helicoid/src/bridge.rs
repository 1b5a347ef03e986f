//! Between p-helicoids and super-helices.
//!
//! A super-helix holds its material curvatures constant on each element, a helicoid changes them
//! along the way. The element that turns the frame at its beginning exactly into the frame at its
//! end has `q l = log(F_0^T F_1)`; with such elements all frames at joints are exact, and positions
//! between joints are off by the third power of an element's length. The way back is a fit to the
//! super-helix's own positions.

use glam::{DQuat, DVec3};
use tress_fit::{SampleError as HelixSampleError, Sampling, sample};
use tress_geometry::{
    Attributes, Element, Frame, GroomError, HelixGroom, Kept, OffsetsError, Strands, SuperHelix,
};

use crate::fit::fit;
use crate::{FitOptions, FitOptionsError, Fitted, HelicoidGroom, PHelicoid, TraceError, Tracing};

/// Why p-helicoids cannot become super-helices, or the other way about.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BridgeError {
    /// A hair that cannot be traced.
    #[error("strand {strand}: {source}")]
    Trace {
        /// Which strand.
        strand: usize,
        /// Why.
        source: TraceError,
    },
    /// No element at all was asked for.
    ///
    /// ```
    /// use tress_geometry::Strands;
    /// use tress_helicoid::{BridgeError, HelicoidGroom, to_helices};
    ///
    /// let none = HelicoidGroom::new(vec![], Strands::default())?;
    /// assert_eq!(to_helices(&none, 0).unwrap_err(), BridgeError::NoElement);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[error("a strand cannot have no element")]
    NoElement,
    /// More elements or points than offsets can tell apart.
    #[error(transparent)]
    Offsets(#[from] OffsetsError),
    /// Parts that do not match.
    #[error(transparent)]
    Parts(#[from] GroomError),
    /// Positions that cannot be sampled.
    #[error(transparent)]
    Sample(#[from] HelixSampleError),
    /// Options of the fit that cannot be followed.
    #[error(transparent)]
    Options(#[from] FitOptionsError),
}

/// The elements of a hair as a super-helix, each piece cut into `per_piece` of equal length; the
/// root frame is the hair's own.
///
/// ```
/// use tress_geometry::{Frame, SuperHelix};
/// use tress_helicoid::{Helicoid, PHelicoid, Piece, Tracing, elements};
///
/// let pieces = [Piece { k: Helicoid::new(1.0, 0.2, 0.3, 0.8), length: 2.0 }];
/// let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
/// let helix = elements(&hair, 20)?;
/// let tip = SuperHelix { root: hair.root, elements: &helix }.tip();
/// assert!(tip.position.distance(hair.tip(Tracing::default())?.position) < 2e-3);
/// # Ok::<(), tress_helicoid::TraceError>(())
/// ```
///
/// # Errors
///
/// See [`TraceError`].
pub fn elements(hair: &PHelicoid<'_>, per_piece: usize) -> Result<Vec<Element>, TraceError> {
    let mut stops = Vec::with_capacity(hair.pieces.len() * per_piece);
    let mut begins = 0.0;
    for piece in hair.pieces {
        let at = |i: usize| begins + piece.length * (i as f64 / per_piece as f64);
        stops.extend((1..=per_piece).map(at));
        begins += piece.length;
    }
    let frames = hair.frames_at(&stops, Tracing::Controlled(1e-9))?;
    let mut before = hair.root;
    let mut elements = Vec::with_capacity(frames.len());
    for (i, frame) in frames.into_iter().enumerate() {
        let length = hair.pieces[i / per_piece].length / per_piece as f64;
        let turn = DQuat::from_mat3(&(before.axes.transpose() * frame.axes)).normalize();
        let turn = if turn.w < 0.0 { -turn } else { turn };
        let curvature = if 0.0 < length { turn.to_scaled_axis() / length } else { DVec3::ZERO };
        elements.push(Element { curvature, length });
        before = frame;
    }
    Ok(elements)
}

/// A groom of p-helicoids as super-helices, each piece cut into `per_piece` elements.
///
/// # Errors
///
/// See [`BridgeError`].
pub fn to_helices(hairs: &HelicoidGroom, per_piece: usize) -> Result<HelixGroom, BridgeError> {
    if per_piece == 0 {
        return Err(BridgeError::NoElement);
    }
    let mut all = Strands::default();
    for (strand, hair) in hairs.iter().enumerate() {
        let chain = elements(&hair, per_piece);
        all.push(chain.map_err(|source| BridgeError::Trace { strand, source })?)?;
    }
    let mut polylines = Strands::default();
    for points in hairs.kept().values() {
        polylines.push(points.iter().copied())?;
    }
    let kept = Kept {
        strands: hairs.kept().keys().copied().collect(),
        point_attributes: Attributes::new(polylines.points().len()),
        polylines,
    };
    let joints = Attributes::new(all.points().len() + all.len());
    let roots: Vec<Frame> = hairs.roots().to_vec();
    let attributes = hairs.strand_attributes().clone();
    let groom = HelixGroom::with_attributes(roots, all, attributes, joints, kept)?;
    Ok(groom.in_space(hairs.unit, hairs.up))
}

/// Points a turn that a super-helix is sampled with for a fit.
const POINTS_PER_TURN: f64 = 24.0;

/// Points of a strand at most, which time grows with the square of: for 40 turns, where a piece of
/// a p-helicoid follows one or two.
const MOST_POINTS: f64 = 1000.0;

/// Super-helices as p-helicoids: a fit to their positions.
///
/// # Errors
///
/// See [`BridgeError`].
pub fn from_helices(helices: &HelixGroom, options: &FitOptions) -> Result<Fitted, BridgeError> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let of_turns = |turns: f64| (turns * POINTS_PER_TURN).ceil().clamp(2.0, MOST_POINTS) as usize;
    let count = |strand: SuperHelix<'_>| of_turns(strand.turns()).max(strand.elements.len() + 1);
    let counts: Vec<usize> = helices.iter().map(count).collect();
    let polylines = sample(helices, &Sampling::Counts(&counts))?;
    Ok(fit(&polylines, options)?)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::{Helicoid, Piece};

    fn groom() -> HelicoidGroom {
        let piece = |kt, alpha| Piece { k: Helicoid::new(kt, 0.1, 0.2, alpha), length: 1.0 };
        let chain = vec![piece(1.0, 0.5), piece(-1.2, 0.8), piece(0.7, -0.4), piece(2.0, 0.0)];
        let strands = Strands::from_counts([3, 0, 1], chain).expect("counts sum to 4");
        let kept = BTreeMap::from([(1, vec![DVec3::ONE])]);
        let roots = vec![Frame::along(DVec3::ONE, DVec3::ONE).expect("a direction"); 3];
        HelicoidGroom::with_attributes(roots, strands, Attributes::new(3), kept).expect("match")
    }

    #[test]
    fn finer_elements_come_nearer_by_their_order() {
        let groom = groom();
        let tip = groom.hair(0).tip(Tracing::Controlled(1e-11)).expect("clear");
        let off = |n| {
            let helices = to_helices(&groom, n).expect("clear");
            let end = helices.strand(0).tip();
            assert!(end.tangent().distance(tip.tangent()) < 1e-6, "frames are exact");
            end.position.distance(tip.position)
        };
        assert!(off(32) < 1e-3);
        let order = (off(16) / off(32)).log2();
        assert!(1.8 < order, "order {order}");
    }

    #[test]
    fn there_and_back_is_the_same_hair() {
        let groom = groom();
        let helices = to_helices(&groom, 40).expect("clear");
        assert!(helices.kept_polyline(1).is_some());
        let fitted = from_helices(&helices, &FitOptions::default()).expect("good options");
        assert_eq!(fitted.hairs.len(), 3);
        assert_eq!(fitted.hairs.kept().get(&1), Some(&vec![DVec3::ONE]));
        for i in [0, 2] {
            let tip = |hair: PHelicoid<'_>| hair.tip(Tracing::default()).expect("clear").position;
            let apart = tip(groom.hair(i)).distance(tip(fitted.hairs.hair(i)));
            assert!(apart < 0.03, "strand {i} ends {apart} away");
        }
    }
}
