//! Controls: points of a strand and the anchors they are drawn to.

use std::cmp::Ordering;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_geometry::SuperHelix;

/// A point of a strand and where it should go.
///
/// ```
/// use glam::DVec3;
/// use tress_optimize::Control;
///
/// let tip = Control::new(12.0, DVec3::new(0.0, -3.0, 1.0));
/// assert_eq!(tip.weight, 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Control {
    /// `lambda`: arc length from the root, within the strand; in the groom's unit.
    pub arc_length: f64,
    /// `a`: where the point should go, in the groom's space.
    pub anchor: DVec3,
    /// Weight of the squared distance; 1 unless one anchor matters more than another.
    pub weight: f64,
}

impl Control {
    /// A control of weight 1.
    #[must_use]
    pub fn new(arc_length: f64, anchor: DVec3) -> Self {
        Self { arc_length, anchor, weight: 1.0 }
    }
}

/// Why a strand's controls cannot be followed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ControlError {
    /// An arc length, an anchor or a weight is NaN or infinite.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_geometry::{Element, Frame, SuperHelix};
    /// use tress_optimize::{Control, ControlError, SculptError, SculptOptions, solve};
    ///
    /// let elements = [Element { length: 1.0, ..Element::default() }];
    /// let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    /// let nowhere = [Control::new(1.0, DVec3::NAN)];
    /// let error = solve(&strand, &nowhere, &SculptOptions::default()).unwrap_err();
    /// let expected = ControlError::NotFinite { control: 0 };
    /// assert_eq!(error, SculptError::Control { strand: 0, source: expected });
    /// ```
    #[error("control {control} is not finite")]
    NotFinite {
        /// The control's place among the strand's.
        control: usize,
    },
    /// The arc length is negative or greater than the strand's length: `Control::new(2.0, ...)` on
    /// a strand of length 1.
    #[error(
        "control {control} at arc length {arc_length} lies outside the strand of length {length}"
    )]
    Outside {
        /// The control's place among the strand's.
        control: usize,
        /// Where it is.
        arc_length: f64,
        /// The strand's length.
        length: f64,
    },
    /// The weight is negative: `Control { weight: -1.0, ..control }`.
    #[error("control {control} has the negative weight {weight}")]
    Weight {
        /// The control's place among the strand's.
        control: usize,
        /// The weight.
        weight: f64,
    },
    /// Two anchors for one point: `Control::new(1.0, a)` and `Control::new(1.0, b)`.
    #[error(
        "controls {first} and {second} draw the point at arc length {arc_length} to two places"
    )]
    Contradiction {
        /// The one control.
        first: usize,
        /// The other.
        second: usize,
        /// Where both are.
        arc_length: f64,
    },
}

/// An arc length this much greater than the strand's length, in parts of it, still is the tip:
/// lengths summed in another order differ by less.
const TIP_SLACK: f64 = 1e-9;

/// An anchor out of reach is drawn back to this part of the reach: at the reach itself the strand
/// would have to be straight to the last bit, and no derivative moves a straight strand's tip
/// along itself. Nearer to 1 takes more steps, farther from it leaves a wave that is seen.
const REACH: f64 = 0.999;

/// Controls of one strand, checked, in the order of their arc lengths, relative to the root.
#[derive(Clone, Debug, Default)]
pub(crate) struct Prepared {
    /// Arc lengths ascend, anchors are relative to the root's position and within reach.
    pub(crate) controls: Vec<Control>,
    /// Anchors as they were asked for, relative to the root's position.
    pub(crate) asked: Vec<DVec3>,
    /// How many anchors were drawn back.
    pub(crate) unreachable: usize,
    order: Vec<usize>,
}

impl Prepared {
    /// Replaces what is there by the controls of `strand`; no memory is freed.
    pub(crate) fn prepare(
        &mut self,
        strand: &SuperHelix<'_>,
        controls: &[Control],
    ) -> Result<(), ControlError> {
        let length = strand.length();
        check(length, controls)?;
        self.order.clear();
        self.order.extend(0..controls.len());
        self.order.sort_by(|&i, &j| controls[i].arc_length.total_cmp(&controls[j].arc_length));
        self.controls.clear();
        self.asked.clear();
        self.unreachable = 0;
        for pair in self.order.windows(2) {
            let (first, second) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
            let (a, b) = (&controls[first], &controls[second]);
            let same = a.arc_length.partial_cmp(&b.arc_length).is_some_and(Ordering::is_eq);
            if same && a.anchor != b.anchor {
                let arc_length = a.arc_length;
                return Err(ControlError::Contradiction { first, second, arc_length });
            }
        }
        for &i in &self.order {
            let Control { arc_length, anchor, weight } = controls[i];
            let arc_length = arc_length.min(length);
            let asked = anchor - strand.root.position;
            let anchor = match within_reach(asked, arc_length) {
                Some(anchor) => anchor,
                None => {
                    self.unreachable += 1;
                    asked * (REACH * arc_length / asked.length())
                }
            };
            self.asked.push(asked);
            self.controls.push(Control { arc_length, anchor, weight });
        }
        Ok(())
    }
}

/// The anchor, if a strand of this arc length gets there.
fn within_reach(anchor: DVec3, arc_length: f64) -> Option<DVec3> {
    (anchor.length() <= arc_length * (1.0 + TIP_SLACK)).then_some(anchor)
}

fn check(length: f64, controls: &[Control]) -> Result<(), ControlError> {
    for (control, &Control { arc_length, anchor, weight }) in controls.iter().enumerate() {
        if !(arc_length.is_finite() && anchor.is_finite() && weight.is_finite()) {
            return Err(ControlError::NotFinite { control });
        }
        if arc_length < 0.0 || length * (1.0 + TIP_SLACK) < arc_length {
            return Err(ControlError::Outside { control, arc_length, length });
        }
        if weight < 0.0 {
            return Err(ControlError::Weight { control, weight });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use tress_geometry::{Element, Frame};

    use super::*;

    fn prepared(controls: &[Control]) -> Result<Prepared, ControlError> {
        let elements = [Element { length: 2.0, ..Element::default() }];
        let root = Frame { position: DVec3::ONE, ..Frame::IDENTITY };
        let mut prepared = Prepared::default();
        prepared.prepare(&SuperHelix { root, elements: &elements }, controls)?;
        Ok(prepared)
    }

    #[test]
    fn every_bad_control_is_named() {
        let good = Control::new(1.0, DVec3::ONE);
        let with = |bad| prepared(&[good, bad]).unwrap_err();
        assert_eq!(
            with(Control::new(f64::NAN, DVec3::ONE)),
            ControlError::NotFinite { control: 1 }
        );
        assert_eq!(
            with(Control::new(1.0, DVec3::INFINITY)),
            ControlError::NotFinite { control: 1 }
        );
        for arc_length in [-0.1, 2.1] {
            let outside = ControlError::Outside { control: 1, arc_length, length: 2.0 };
            assert_eq!(with(Control::new(arc_length, DVec3::ONE)), outside);
        }
        let negative = Control { weight: -1.0, ..good };
        assert_eq!(with(negative), ControlError::Weight { control: 1, weight: -1.0 });
        let twice = ControlError::Contradiction { first: 0, second: 1, arc_length: 1.0 };
        assert_eq!(with(Control::new(1.0, DVec3::X)), twice);
    }

    #[test]
    fn controls_are_sorted_and_drawn_back_to_what_the_strand_reaches() {
        let far = Control::new(2.0 * (1.0 + 1e-12), DVec3::ONE + 9.0 * DVec3::Y);
        let near = Control::new(0.5, DVec3::ONE + 0.5 * DVec3::X);
        let p = prepared(&[far, near, near]).expect("an anchor may be named twice");
        assert_eq!(p.controls[0], Control::new(0.5, 0.5 * DVec3::X));
        assert_eq!(p.controls[2], Control::new(2.0, 2.0 * REACH * DVec3::Y));
        assert_eq!((p.unreachable, p.asked[2]), (1, 9.0 * DVec3::Y));
    }
}
