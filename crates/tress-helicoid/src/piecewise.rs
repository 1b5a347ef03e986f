//! p-helicoids: helicoids joined end to end by their frames [GH 3.4].
//!
//! Where one piece ends, the frame `[E_T E_N E_B]` of its field becomes the root frame of the next.
//! So the tangent is continuous (C1), and more than that the whole frame is; curvature jumps.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};
use tress_geometry::Frame;

use crate::trace::{Place, walk};
use crate::{Helicoid, TraceError, Tracing};

/// One piece of a hair: a helicoid, and how far along its flow the hair goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Piece {
    /// The parameters of the field, in the frame where the piece begins.
    pub k: Helicoid,
    /// Arc length of the piece, at least 0.
    pub length: f64,
}

/// A hair as a chain of helicoids; borrows its pieces.
///
/// ```
/// use std::f64::consts::PI;
/// use glam::DVec3;
/// use tress_geometry::Frame;
/// use tress_helicoid::{Helicoid, PHelicoid, Piece, Tracing};
///
/// // Two half circles of radius 1 that bend to opposite sides: an S from x = 0 to y = 4.
/// let half = |kt| Piece { k: Helicoid::new(kt, 0.0, 0.0, 0.0), length: PI };
/// let pieces = [half(1.0), half(-1.0)];
/// let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
/// let tip = hair.tip(Tracing::Controlled(1e-10))?;
/// assert!(tip.position.distance(DVec3::new(0.0, 4.0, 0.0)) < 1e-8);
/// # Ok::<(), tress_helicoid::TraceError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PHelicoid<'a> {
    /// The frame `Q` at the root, `[E_T E_N E_B]`.
    pub root: Frame,
    /// The pieces from root to tip.
    pub pieces: &'a [Piece],
}

impl PHelicoid<'_> {
    /// Total arc length.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.length).sum()
    }

    /// The frame at the tip.
    ///
    /// # Errors
    ///
    /// See [`TraceError`].
    pub fn tip(&self, tracing: Tracing) -> Result<Frame, TraceError> {
        self.walk(DVec3::ZERO, &[], tracing, |_, _| ())
    }

    /// The frames where pieces begin, and the tip's: one more than there are pieces.
    ///
    /// # Errors
    ///
    /// See [`TraceError`].
    pub fn joints(&self, tracing: Tracing) -> Result<Vec<Frame>, TraceError> {
        self.check()?;
        let steps = tracing.validate()?.for_length(self.length());
        let mut joints = vec![self.root];
        let mut base = self.root;
        for (i, piece) in self.pieces.iter().enumerate() {
            let start = Place { position: DVec3::ZERO, theta: 0.0 };
            let end = walk(&piece.k, start, piece.length, steps, &[], &mut |_, _| ());
            let end = end.map_err(|s| TraceError::Singular { piece: i, arc_length: s.0 })?;
            base = carry(&base, &piece.k, end);
            joints.push(base);
        }
        Ok(joints)
    }

    /// An error unless all numbers are finite and no length is negative.
    fn check(&self) -> Result<(), TraceError> {
        let good =
            |piece: &Piece| piece.k.is_finite() && 0.0 <= piece.length && piece.length.is_finite();
        match self.pieces.iter().position(|piece| !good(piece)) {
            Some(piece) => Err(TraceError::NotFinite { piece }),
            None => Ok(()),
        }
    }

    /// The frames at ascending arc lengths, which are held within the hair.
    ///
    /// # Errors
    ///
    /// See [`TraceError`].
    pub fn frames_at(
        &self,
        arc_lengths: &[f64],
        tracing: Tracing,
    ) -> Result<Vec<Frame>, TraceError> {
        let mut frames = vec![self.root; arc_lengths.len()];
        self.walk(DVec3::ZERO, arc_lengths, tracing, |i, stop| frames[i] = stop.frame())?;
        Ok(frames)
    }

    /// The positions at ascending arc lengths, which are held within the hair; one for each of
    /// them is written to `positions`.
    ///
    /// # Errors
    ///
    /// See [`TraceError`]; positions up to there are then written.
    pub fn positions_at(
        &self,
        arc_lengths: &[f64],
        tracing: Tracing,
        positions: &mut [DVec3],
    ) -> Result<(), TraceError> {
        self.streamline(DVec3::ZERO, arc_lengths, tracing, positions)
    }

    /// The positions at arc lengths `0, h, 2h, ... L`, as many as `positions` holds.
    ///
    /// # Errors
    ///
    /// See [`TraceError`]; positions up to there are then written.
    pub fn sample_evenly(
        &self,
        tracing: Tracing,
        positions: &mut [DVec3],
    ) -> Result<(), TraceError> {
        let steps = positions.len().saturating_sub(1).max(1) as f64;
        let length = self.length();
        let stops: Vec<f64> =
            (0..positions.len()).map(|i| length * (i as f64 / steps).min(1.0)).collect();
        self.positions_at(&stops, tracing, positions)
    }

    /// The neighbour that begins at `offset` from the root, in the root's frame: the line of flow
    /// of the first piece's field through there, and from its end on the further pieces.
    ///
    /// Further pieces are joined to the neighbour's own frame, so that it is C1 as the hair is.
    ///
    /// # Errors
    ///
    /// See [`TraceError`]; positions up to there are then written.
    pub fn streamline(
        &self,
        offset: DVec3,
        arc_lengths: &[f64],
        tracing: Tracing,
        positions: &mut [DVec3],
    ) -> Result<(), TraceError> {
        self.walk(offset, arc_lengths, tracing, |i, stop| {
            if let Some(position) = positions.get_mut(i) {
                *position = stop.position();
            }
        })?;
        Ok(())
    }

    /// Walks from `offset` to the tip and shows `visit` what is at each arc length.
    fn walk(
        &self,
        offset: DVec3,
        arc_lengths: &[f64],
        tracing: Tracing,
        mut visit: impl FnMut(usize, Stop<'_>),
    ) -> Result<Frame, TraceError> {
        self.check()?;
        let steps = tracing.validate()?.for_length(self.length());
        let mut base = self.root;
        let mut begins = 0.0;
        let mut next = 0;
        let mut stops = Vec::with_capacity(arc_lengths.len());
        for (i, piece) in self.pieces.iter().enumerate() {
            let last = i + 1 == self.pieces.len();
            let within = |&&s: &&f64| last || s <= begins + piece.length;
            let rest = arc_lengths[next..].iter().take_while(within);
            stops.clear();
            stops.extend(rest.map(|s| (s - begins).clamp(0.0, piece.length)));
            let position = if i == 0 { offset } else { DVec3::ZERO };
            let start = Place { position, theta: piece.k.theta(position) };
            let mut at = |j: usize, near| visit(next + j, Stop { base: &base, k: &piece.k, near });
            let end = walk(&piece.k, start, piece.length, steps, &stops, &mut at);
            let end = end.map_err(|s| TraceError::Singular { piece: i, arc_length: s.0 })?;
            base = carry(&base, &piece.k, end);
            begins += piece.length;
            next += stops.len();
        }
        let nowhere = Helicoid::default();
        let at_tip = Place { position: DVec3::ZERO, theta: 0.0 };
        for i in next..arc_lengths.len() {
            visit(i, Stop { base: &base, k: &nowhere, near: at_tip });
        }
        Ok(base)
    }
}

/// What is at an arc length: a place in the field of a piece.
struct Stop<'a> {
    base: &'a Frame,
    k: &'a Helicoid,
    near: Place,
}

impl Stop<'_> {
    fn position(&self) -> DVec3 {
        self.base.position + self.base.axes * self.near.position
    }

    fn frame(&self) -> Frame {
        let theta = self.k.theta_near(self.near.position, self.near.theta);
        carry(self.base, self.k, Place { theta, ..self.near })
    }
}

/// The frame of a field at a place, in the space where the field's own frame is `base`.
fn carry(base: &Frame, k: &Helicoid, place: Place) -> Frame {
    Frame {
        position: base.position + base.axes * place.position,
        axes: base.axes * k.frame(place.theta),
    }
}

/// Gives the first piece that bends a `kT` that is not negative, without changing the hair: the
/// root is turned by half a turn about its tangent, and every piece is
/// [mirrored](Helicoid::mirrored) [GH 4.1].
///
/// Two guides that are alike up to such a turn are then alike in their parameters, so that what is
/// interpolated between them is not straight. True if it was necessary.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::Frame;
/// use tress_helicoid::{Helicoid, PHelicoid, Piece, Tracing, positive_tangential};
///
/// let mut root = Frame::IDENTITY;
/// let mut pieces = [Piece { k: Helicoid::new(-1.0, -0.1, 0.3, 1.0), length: 2.0 }];
/// let tip = PHelicoid { root, pieces: &pieces }.tip(Tracing::default())?;
/// assert!(positive_tangential(&mut root, &mut pieces));
/// assert_eq!(pieces[0].k.kt, 1.0);
/// let same = PHelicoid { root, pieces: &pieces }.tip(Tracing::default())?;
/// assert!(same.position.distance(tip.position) < 1e-14);
/// # Ok::<(), tress_helicoid::TraceError>(())
/// ```
pub fn positive_tangential(root: &mut Frame, pieces: &mut [Piece]) -> bool {
    let first = pieces.iter().map(|piece| piece.k.kt).find(|&kt| kt != 0.0);
    if !first.is_some_and(|kt| kt < 0.0) {
        return false;
    }
    let [t, n, b] = [root.axes.x_axis, root.axes.y_axis, root.axes.z_axis];
    root.axes = DMat3::from_cols(t, -n, -b);
    for piece in pieces {
        piece.k = piece.k.mirrored();
    }
    true
}

#[cfg(test)]
mod tests;
