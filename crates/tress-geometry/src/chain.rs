//! The super-helix: a root frame and a chain of helix arcs that meet with one frame [CSE 3.3-3.4].
//!
//! Every element moves the frame by a fixed rigid motion of its own (an element of SE(3)), so the
//! chain is walked by composing them: one rotation product and one rotated displacement each
//! [CSE 4-8]. Positions and frames are continuous, curvatures jump at the joints.

use glam::{DMat3, DVec2, DVec3, Vec3Swizzles};

use crate::{Element, Frame};

/// A strand as a chain of helix arcs; borrows its elements.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Element, Frame, SuperHelix};
///
/// // Two half circles of radius 1 that bend to opposite sides: an S from x = 0 to y = 4.
/// let half = |k2| Element { curvature: DVec3::new(0.0, 0.0, k2), length: std::f64::consts::PI };
/// let elements = [half(1.0), half(-1.0)];
/// let s = SuperHelix { root: Frame::IDENTITY, elements: &elements };
/// assert!(s.tip().position.distance(DVec3::new(0.0, 4.0, 0.0)) < 1e-14);
/// assert!(s.position_at(0.5 * s.length()).distance(DVec3::new(0.0, 2.0, 0.0)) < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SuperHelix<'a> {
    /// The frame at the root.
    pub root: Frame,
    /// The arcs from root to tip.
    pub elements: &'a [Element],
}

impl SuperHelix<'_> {
    /// Total arc length.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.elements.iter().map(|element| element.length).sum()
    }

    /// Turns of all elements together, `sum |q_i| l_i / 2 pi`.
    #[must_use]
    pub fn turns(&self) -> f64 {
        self.elements.iter().map(Element::turns).sum()
    }

    /// The frames where elements begin, and the tip's: one more than there are elements.
    pub fn joints(&self) -> impl Iterator<Item = Frame> {
        let mut frame = self.root;
        let rest = self.elements.iter().map(move |element| {
            frame = element.advance(&frame);
            frame
        });
        std::iter::once(self.root).chain(rest)
    }

    /// The frame at the tip.
    #[must_use]
    pub fn tip(&self) -> Frame {
        self.elements.iter().fold(self.root, |frame, element| element.advance(&frame))
    }

    /// The frame at arc length `s`, held within the strand.
    ///
    /// Walks from the root: for many arc lengths use [`frames_at`](Self::frames_at).
    #[must_use]
    pub fn frame_at(&self, s: f64) -> Frame {
        self.frames_at([s]).next().unwrap_or(self.root)
    }

    /// The position at arc length `s`, held within the strand.
    #[must_use]
    pub fn position_at(&self, s: f64) -> DVec3 {
        self.frame_at(s).position
    }

    /// The frames at ascending arc lengths, in one walk along the strand.
    ///
    /// An arc length outside the strand gives the frame at its root or tip, one below its
    /// predecessor the element of the predecessor, extended backwards.
    pub fn frames_at(
        &self,
        arc_lengths: impl IntoIterator<Item = f64>,
    ) -> impl Iterator<Item = Frame> {
        let mut walk = Walk::new(*self);
        arc_lengths.into_iter().map(move |s| walk.frame_at(s))
    }

    /// The position at arc lengths `0, h, 2h, ... L`, as many as `positions` holds.
    ///
    /// A single position is the root. The last one is the tip exactly.
    pub fn sample_evenly(&self, positions: &mut [DVec3]) {
        let Some(steps) = positions.len().checked_sub(1) else { return };
        let length = self.length();
        let mut walk = Walk::new(*self);
        for (i, position) in positions.iter_mut().enumerate() {
            let s = if i == steps && 0 < steps {
                length
            } else {
                length * (i as f64 / steps.max(1) as f64)
            };
            *position = walk.frame_at(s).position;
        }
    }
}

/// Turns the material frame about the tangent so that the strand's first turn bends about `v`
/// (`k1 = 0`, `k2 > 0` in the mean); the curve stays as it is.
///
/// Where the frame stands about the tangent is not a matter of shape: all curvatures `(k1, k2)` of
/// a strand turn together with it. Fixed by the strand's own bend, curvatures do not change when
/// the strand is moved or turned, and those of strands alike in shape are alike, so that they can
/// be exchanged and mixed. A strand that does not bend is left as it is.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Element, Frame, align_frame};
///
/// let mut root = Frame::IDENTITY;
/// let mut elements = [Element { curvature: DVec3::new(1.0, -2.0, 0.0), length: 9.0 }];
/// let tip = elements[0].advance(&root).position;
/// align_frame(&mut root, &mut elements);
/// assert!(elements[0].curvature.distance(DVec3::new(1.0, 0.0, 2.0)) < 1e-15);
/// assert!(elements[0].advance(&root).position.distance(tip) < 1e-14);
/// ```
pub fn align_frame(root: &mut Frame, elements: &mut [Element]) {
    let mut turned = 0.0;
    let mut bend = DVec2::ZERO;
    for element in elements.iter() {
        bend += element.curvature.yz() * element.length;
        turned += element.curvature.length() * element.length;
        if std::f64::consts::TAU <= turned {
            break;
        }
    }
    let Some(bend) = bend.try_normalize() else { return };
    let (cosine, sine) = (bend.y, -bend.x);
    let [t, u, v] = [root.axes.x_axis, root.axes.y_axis, root.axes.z_axis];
    root.axes = DMat3::from_cols(t, u * cosine + v * sine, v * cosine - u * sine);
    for element in elements {
        let q = element.curvature;
        let (k1, k2) = (q.y * cosine + q.z * sine, q.z * cosine - q.y * sine);
        element.curvature = DVec3::new(q.x, k1, k2);
    }
}

/// A walk along the chain: the element under way, where it begins and with which frame.
struct Walk<'a> {
    strand: SuperHelix<'a>,
    index: usize,
    begins: f64,
    base: Frame,
}

impl<'a> Walk<'a> {
    fn new(strand: SuperHelix<'a>) -> Self {
        Self { strand, index: 0, begins: 0.0, base: strand.root }
    }

    fn frame_at(&mut self, s: f64) -> Frame {
        let elements = self.strand.elements;
        while let Some(element) = elements.get(self.index)
            && self.index + 1 < elements.len()
            && self.begins + element.length < s
        {
            self.base = element.advance(&self.base);
            self.begins += element.length;
            self.index += 1;
        }
        match elements.get(self.index) {
            Some(element) => {
                let from = if self.index == 0 { 0.0 } else { f64::NEG_INFINITY };
                element.frame_at(&self.base, (s - self.begins).min(element.length).max(from))
            }
            None => self.base,
        }
    }
}

#[cfg(test)]
mod tests;
