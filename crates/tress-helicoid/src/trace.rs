//! Tracing: the line of flow through the root [GH 3].
//!
//! The line is the solution of `p' = E_T(theta(p), phi(p))`, cycles of `theta` counted on the way.
//! \[GH\] walks it by forward Euler. That bends every coil open: on a circle each step leaves along
//! the tangent, so the radius grows by `h/2` a radian whatever else is done. The default is
//! therefore Dormand and Prince's pair of orders 5 and 4 ("A family of embedded Runge-Kutta
//! formulae", 1980) with the step chosen by the pair's difference and positions between steps from
//! Shampine's interpolant of order 4; `docs/helicoid.md` tells how far apart the two end.

mod euler;
mod pair;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::Helicoid;

/// How lines of flow are walked.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Tracing {
    /// Forward Euler as published: this many steps a piece, straight between them.
    Euler(u32),
    /// Order 5 with error control: what each step may err by, over the length of the strand.
    Controlled(f64),
}

impl Default for Tracing {
    /// Controlled, `1e-7`.
    fn default() -> Self {
        Self::Controlled(1e-7)
    }
}

/// Why a line of flow could not be walked.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TraceError {
    /// The line runs into the line where its field has no direction, or winds too tightly to be
    /// followed.
    ///
    /// ```
    /// use tress_geometry::Frame;
    /// use tress_helicoid::{Helicoid, PHelicoid, Piece, TraceError, Tracing};
    ///
    /// // With kN = -2 all lines of flow meet at x = 0.5.
    /// let sink = [Piece { k: Helicoid::new(0.0, -2.0, 0.0, 0.0), length: 0.8 }];
    /// let hair = PHelicoid { root: Frame::IDENTITY, pieces: &sink };
    /// let error = hair.tip(Tracing::default()).unwrap_err();
    /// let TraceError::Singular { arc_length, .. } = error else { unreachable!() };
    /// assert!((arc_length - 0.5).abs() < 1e-3);
    /// ```
    #[error(
        "piece {piece} runs into its singular line, or winds too tightly, at arc length {arc_length}"
    )]
    Singular {
        /// Which piece it is, from 0.
        piece: usize,
        /// Where, from the beginning of the piece.
        arc_length: f64,
    },
    /// A parameter, length or frame that is not finite, or a negative length.
    ///
    /// ```
    /// use tress_geometry::Frame;
    /// use tress_helicoid::{Helicoid, PHelicoid, Piece, TraceError, Tracing};
    ///
    /// let pieces = [Piece { k: Helicoid::new(f64::NAN, 0.0, 0.0, 0.0), length: 1.0 }];
    /// let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
    /// assert_eq!(hair.tip(Tracing::default()), Err(TraceError::NotFinite { piece: 0 }));
    /// ```
    #[error("piece {piece} has a parameter or length that is not finite, or a negative length")]
    NotFinite {
        /// Which piece it is, from 0.
        piece: usize,
    },
    /// An error allowed, or a number of steps, that is not above 0.
    ///
    /// ```
    /// use tress_geometry::Frame;
    /// use tress_helicoid::{PHelicoid, TraceError, Tracing};
    ///
    /// let hair = PHelicoid { root: Frame::IDENTITY, pieces: &[] };
    /// assert_eq!(hair.tip(Tracing::Controlled(0.0)), Err(TraceError::Tracing));
    /// ```
    #[error("expected a tolerance or a number of steps above 0")]
    Tracing,
}

impl Tracing {
    pub(crate) fn validate(self) -> Result<Self, TraceError> {
        let good = match self {
            Self::Euler(steps) => 0 < steps,
            Self::Controlled(tolerance) => 0.0 < tolerance && tolerance.is_finite(),
        };
        if good { Ok(self) } else { Err(TraceError::Tracing) }
    }

    /// The step rule for strands of this length.
    pub(crate) fn for_length(self, length: f64) -> Steps {
        match self {
            Self::Euler(steps) => Steps::Even(steps),
            Self::Controlled(tolerance) => Steps::Within(tolerance * length),
        }
    }
}

/// How the steps of one piece are chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Steps {
    /// So many Euler steps.
    Even(u32),
    /// Controlled ones, each of which errs by at most this length.
    Within(f64),
}

/// A place on a line of flow, in coordinates of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) position: DVec3,
    /// The first angle, cycles counted.
    pub(crate) theta: f64,
}

/// The arc length at which a line runs into its singular line, or can be followed no longer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Singular(pub(crate) f64);

/// Walks the line of flow from `start` over `length`, and gives its end.
///
/// `visit` gets the positions at `stops`, which ascend within `0..=length`, each with its index and
/// the angle at a place shortly before, from which cycles can be counted on.
pub(crate) fn walk(
    k: &Helicoid,
    start: Place,
    length: f64,
    steps: Steps,
    stops: &[f64],
    visit: &mut impl FnMut(usize, Place),
) -> Result<Place, Singular> {
    match steps {
        Steps::Even(n) => euler::walk(k, start, length, n, stops, visit),
        Steps::Within(error) => pair::walk(k, start, length, error, stops, visit),
    }
}

#[cfg(test)]
mod tests;
