//! Switchbacks put into strands.
//!
//! The strand's own coil about the place decides: its turning `|q|` and frequency `v = k0 / |q|`,
//! averaged over two turns, say which switchback of which size leads from it to the same coil of
//! the other hand. Three curves with material frames are at work:
//!
//! - the strand itself, `F(s)`;
//! - the strand *straightened*, `C(s)`: its curvatures averaged over a turn, which keeps the coil
//!   and drops what bends its axis. `A = F C^T` is then the frame that the axis carries along;
//! - the straightened strand with a switchback, `S(s)`: `C` before the room of the switchback,
//!   equilibrium within, and behind it `C` in a mirror that holds its axis.
//!
//! The result is `A S`: the same axis by arc length, the coil of the other hand around it. Before
//! the room nothing changes at all; behind it twist and windings change sign while bending and
//! radius stay, and the rest of the strand is moved along the axis, because a switchback is not as
//! long as the turns it takes the place of. [CC 4.3] inserts into ideal helices only.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_analysis::Hand;
use tress_geometry::{Element, SuperHelix};

mod groom;
mod local;
mod shapes;
mod surgery;

pub use groom::{InsertGroomError, InsertReport, Placing, insert};
use shapes::Shapes;

/// How switchbacks are shaped when they are put into strands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct InsertOptions {
    /// Poisson's ratio of the hair, 0 to 0.5. Default 0.4.
    pub poisson_ratio: f64,
    /// How much of the coil's curvature a switchback may still be off at the ends of its room,
    /// over 0 to 0.5. Default 0.05: smaller is smoother and takes more room.
    pub share: f64,
    /// Elements to a turn within the room. Default 24.
    pub elements_per_turn: usize,
}

impl Default for InsertOptions {
    fn default() -> Self {
        Self { poisson_ratio: 0.4, share: 0.05, elements_per_turn: 24 }
    }
}

/// A switchback that is in a strand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placed {
    /// Arc length of its middle from the root, in the groom's unit.
    pub arc_length: f64,
    /// Arc length from its middle to either end of its room.
    pub half_width: f64,
    /// Coil frequency of the strand about it; positive where the coil before it is right-handed.
    pub v: f64,
    /// Coil radius of the strand about it.
    pub radius: f64,
    /// The hand of the coil before it; behind it is the other.
    pub hand_before: Hand,
}

/// Why a switchback cannot be put into a strand.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InsertError {
    /// An option is out of its range.
    ///
    /// ```
    /// # use tress_geometry::{Element, Frame, SuperHelix};
    /// # use tress_switchback::{InsertError, InsertOptions, insert_at};
    /// # let elements = [Element { length: 60.0, ..Element::coil(0.5, 1.0) }];
    /// # let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    /// let options = InsertOptions { share: 0.9, ..Default::default() };
    /// let error = insert_at(&strand, 30.0, &options).unwrap_err();
    /// assert_eq!(error.to_string(), "the share left at the ends is 0.9, expected over 0 to 0.5");
    /// ```
    #[error("{name} is {value}, expected {expected}")]
    Option {
        /// What it is called.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What is expected.
        expected: &'static str,
    },
    /// The place is not on the strand.
    #[error("a switchback at {arc_length} on a strand that is {length} long")]
    OffStrand {
        /// Where it was asked for.
        arc_length: f64,
        /// The strand's length.
        length: f64,
    },
    /// The strand has no coil there whose hand could change: it is straight, or a flat wave.
    ///
    /// ```
    /// # use tress_geometry::{Element, Frame, SuperHelix};
    /// # use tress_switchback::{InsertError, InsertOptions, insert_at};
    /// let straight = [Element { length: 60.0, ..Element::default() }];
    /// let strand = SuperHelix { root: Frame::IDENTITY, elements: &straight };
    /// let error = insert_at(&strand, 30.0, &InsertOptions::default());
    /// assert_eq!(error, Err(InsertError::NoCoil { arc_length: 30.0, v: 0.0 }));
    /// ```
    #[error("no coil at {arc_length}: its frequency is {v}, expected 0.02 to 0.98 of either sign")]
    NoCoil {
        /// Where it was asked for.
        arc_length: f64,
        /// Coil frequency found there.
        v: f64,
    },
    /// The strand is too short on one side.
    ///
    /// ```
    /// # use tress_geometry::{Element, Frame, SuperHelix};
    /// # use tress_switchback::{InsertError, InsertOptions, insert_at};
    /// # let elements = [Element { length: 60.0, ..Element::coil(0.5, 1.0) }];
    /// # let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
    /// let error = insert_at(&strand, 2.0, &InsertOptions::default());
    /// let Err(InsertError::NoRoom { needed, before, behind }) = error else { panic!() };
    /// assert!(2.0 < needed && (before, behind) == (2.0, 58.0));
    /// ```
    #[error(
        "no room: {needed} is needed on either side, there is {before} before, {behind} behind"
    )]
    NoRoom {
        /// Arc length needed on either side.
        needed: f64,
        /// Arc length from the place towards the root, to its end or to another switchback.
        before: f64,
        /// Arc length from the place to the tip.
        behind: f64,
    },
}

impl InsertOptions {
    fn validate(&self) -> Result<(), InsertError> {
        let wrong = |name, value, expected| Err(InsertError::Option { name, value, expected });
        if !(0.0..=0.5).contains(&self.poisson_ratio) {
            return wrong("Poisson's ratio", self.poisson_ratio, "0 to 0.5");
        }
        if !(0.0 < self.share && self.share <= 0.5) {
            return wrong("the share left at the ends", self.share, "over 0 to 0.5");
        }
        if self.elements_per_turn < 8 {
            let count = self.elements_per_turn as f64;
            return wrong("the number of elements to a turn", count, "8 or more");
        }
        Ok(())
    }
}

/// Puts one switchback into a strand, its middle at `arc_length`; gives the elements that take the
/// place of the strand's, root and length being the same.
///
/// ```
/// use tress_geometry::{Element, Frame, SuperHelix};
/// use tress_switchback::{InsertOptions, insert_at};
///
/// let coil = vec![Element { length: 0.5, ..Element::coil(0.5, 1.0) }; 120];
/// let strand = SuperHelix { root: Frame::IDENTITY, elements: &coil };
/// let (elements, placed) = insert_at(&strand, 30.0, &InsertOptions::default())?;
/// assert!((placed.radius - 0.5).abs() < 1e-12);
/// let length: f64 = elements.iter().map(|element| element.length).sum();
/// assert!((length - 60.0).abs() < 1e-9);
/// // Right-handed at the root as before, left-handed at the tip, bent as much.
/// let (first, last) = (elements[0], elements[elements.len() - 1]);
/// assert_eq!(first, coil[0]);
/// assert!((last.twist() + first.twist()).abs() < 1e-6);
/// assert!((last.bending() - first.bending()).abs() < 1e-6);
/// # Ok::<(), tress_switchback::InsertError>(())
/// ```
///
/// # Errors
///
/// If an option is out of range, or the strand has no coil there or no room.
pub fn insert_at(
    strand: &SuperHelix<'_>,
    arc_length: f64,
    options: &InsertOptions,
) -> Result<(Vec<Element>, Placed), InsertError> {
    options.validate()?;
    insert_shape(strand, arc_length, 0.0, &Shapes::new(*options))
}

/// [`insert_at`] where the room begins at `from`, with shapes that are kept for the next strand.
fn insert_shape(
    strand: &SuperHelix<'_>,
    arc_length: f64,
    from: f64,
    shapes: &Shapes,
) -> Result<(Vec<Element>, Placed), InsertError> {
    let length = strand.length();
    if !(length.is_finite() && (0.0..=length).contains(&arc_length)) {
        return Err(InsertError::OffStrand { arc_length, length });
    }
    let straightened = local::straighten(strand.elements);
    let coil = local::coil(&straightened, arc_length);
    let v = if coil == DVec3::ZERO { 0.0 } else { coil.x / coil.length() };
    let shape = shapes.get(v).ok_or(InsertError::NoCoil { arc_length, v })?;
    // Rest curvature of the rod whose coil this would be.
    let rest = coil.length() / shape.turning;
    let half_width = shape.half_width / rest;
    let (before, behind) = (arc_length - from, length - arc_length);
    if before < half_width || behind < half_width {
        return Err(InsertError::NoRoom { needed: half_width, before, behind });
    }
    let elements = surgery::operate(strand, &straightened, arc_length, coil, rest, shape);
    let placed = Placed {
        arc_length,
        half_width,
        v,
        radius: Element { curvature: coil, length: 0.0 }.radius(),
        hand_before: if 0.0 < v { Hand::Right } else { Hand::Left },
    };
    Ok((elements, placed))
}

#[cfg(test)]
mod tests;
