//! What a fit is asked for.

use serde::{Deserialize, Serialize};

/// How [`fit`](crate::fit) turns a polyline into a super-helix.
///
/// ```
/// use tress_fit::{Elements, FitOptions, Tolerance};
///
/// let options = FitOptions { elements: Elements::Count(90), ..FitOptions::default() };
/// assert!(options.validate().is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FitOptions {
    /// How many elements a strand gets. Default: one a segment.
    pub elements: Elements,
    /// How tangents at the points are found. Default: from the helix through five.
    pub tangents: TangentRule,
    /// What moves to make neighbours co-helical. Default: the points.
    pub floating: Floating,
    /// The refinement; `None` leaves the arcs as they are, which is ten times as fast. Default:
    /// refined. A tolerance, and a count at which elements turn half round or more, are refined in
    /// any case.
    pub refine: Option<Refine>,
    /// Whether [`fit`](crate::fit) measures how near it came. Default yes; without it the report's
    /// deviation is empty, and a fit that is not refined takes half the time.
    pub measure: bool,
}

/// How many elements a strand gets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Elements {
    /// One for each segment of the polyline that has a length.
    #[default]
    PerSegment,
    /// Exactly so many for every strand, however many points it has.
    Count(usize),
    /// As few as keep all points this near.
    Tolerance(Tolerance),
}

impl Elements {
    /// The same for strands divided by `size`.
    pub(crate) fn scaled(self, size: f64) -> Self {
        match self {
            Self::Tolerance(Tolerance::Length(length)) => {
                Self::Tolerance(Tolerance::Length(length / size))
            }
            other => other,
        }
    }
}

/// How far a point may be from the fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Tolerance {
    /// A length, in the unit of the groom.
    Length(f64),
    /// A fraction of the strand's own coil radius: 0.02 is 2 %.
    OfRadius(f64),
}

/// How tangents at the points of a polyline are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum TangentRule {
    /// Uniform Catmull-Rom: along the chord between the neighbours.
    Uniform,
    /// Centripetal Catmull-Rom: knots spaced by the square roots of segments' lengths.
    Centripetal,
    /// The tangent of the circle through a point and its neighbours (chordal Catmull-Rom).
    Circle,
    /// The tangent of the helix that five points, if they are even, were taken from; where they
    /// are not, that of the circle.
    #[default]
    Helix,
}

impl TangentRule {
    /// The power of a segment's length by which its knots are spaced.
    #[must_use]
    pub fn knot_exponent(self) -> f64 {
        match self {
            Self::Uniform => 0.0,
            Self::Centripetal => 0.5,
            Self::Circle | Self::Helix => 1.0,
        }
    }
}

/// What moves to make neighbouring points and tangents co-helical.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Floating {
    /// Points move, tangents stay.
    #[default]
    Points,
    /// Tangents turn, points stay.
    Tangents,
}

/// How a fit is refined against the points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Refine {
    /// Greatest number of steps. Coils take 4 or 5, strands that turn sharply up to all of them.
    pub steps: usize,
    /// How strongly the curvatures of neighbouring elements are held together; a pure number.
    /// 1 weighs the shift that a jump of curvature brings about from one point to the next as
    /// much as a point missed by that shift.
    pub prior: f64,
    /// Whether the lengths of elements change too.
    pub lengths: bool,
    /// Whether the tangent at the root changes too; the root's position never does.
    pub root: bool,
}

impl Default for Refine {
    fn default() -> Self {
        Self { steps: 30, prior: 1e-3, lengths: true, root: true }
    }
}

impl Refine {
    fn validate(&self) -> Result<(), FitOptionsError> {
        let value = self.prior;
        if 0.0 < value && value.is_finite() {
            return Ok(());
        }
        Err(FitOptionsError::Prior { value })
    }
}

/// Why options cannot be followed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitOptionsError {
    /// A strand needs an element.
    ///
    /// ```
    /// # use tress_fit::{Elements, FitOptions, FitOptionsError};
    /// let none = FitOptions { elements: Elements::Count(0), ..FitOptions::default() };
    /// assert_eq!(none.validate(), Err(FitOptionsError::NoElements));
    /// ```
    #[error("a strand cannot have 0 elements")]
    NoElements,
    /// More elements a strand than a groom can number.
    ///
    /// ```
    /// # use tress_fit::{Elements, FitOptions, FitOptionsError};
    /// let many = FitOptions { elements: Elements::Count(1 << 20), ..FitOptions::default() };
    /// assert_eq!(many.validate(), Err(FitOptionsError::TooManyElements { count: 1 << 20 }));
    /// ```
    #[error("{count} elements a strand are more than {}", FitOptions::MOST_ELEMENTS)]
    TooManyElements {
        /// Elements asked for.
        count: usize,
    },
    /// A tolerance must be a positive number.
    ///
    /// ```
    /// # use tress_fit::{Elements, FitOptions, FitOptionsError, Tolerance};
    /// let elements = Elements::Tolerance(Tolerance::Length(0.0));
    /// let exact = FitOptions { elements, ..FitOptions::default() };
    /// assert_eq!(exact.validate(), Err(FitOptionsError::Tolerance { value: 0.0 }));
    /// ```
    #[error("the tolerance {value} is not a positive number")]
    Tolerance {
        /// The tolerance given.
        value: f64,
    },
    /// The prior must be a positive number: without it what lies between points is open.
    ///
    /// ```
    /// # use tress_fit::{FitOptions, FitOptionsError, Refine};
    /// let refine = Some(Refine { prior: 0.0, ..Refine::default() });
    /// let none = FitOptions { refine, ..FitOptions::default() };
    /// assert_eq!(none.validate(), Err(FitOptionsError::Prior { value: 0.0 }));
    /// ```
    #[error("the prior {value} is not a positive number")]
    Prior {
        /// The prior given.
        value: f64,
    },
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            elements: Elements::default(),
            tangents: TangentRule::default(),
            floating: Floating::default(),
            refine: Some(Refine::default()),
            measure: true,
        }
    }
}

impl FitOptions {
    /// More elements a strand are refused: a slip of the hand would otherwise fill the memory.
    pub const MOST_ELEMENTS: usize = 100_000;

    /// Whether the options can be followed.
    ///
    /// # Errors
    ///
    /// See [`FitOptionsError`].
    pub fn validate(&self) -> Result<(), FitOptionsError> {
        match self.elements {
            Elements::Count(0) => Err(FitOptionsError::NoElements),
            Elements::Count(count) if Self::MOST_ELEMENTS < count => {
                Err(FitOptionsError::TooManyElements { count })
            }
            Elements::Tolerance(Tolerance::Length(value) | Tolerance::OfRadius(value))
                if !(0.0 < value && value.is_finite()) =>
            {
                Err(FitOptionsError::Tolerance { value })
            }
            _ => self.refine.map_or(Ok(()), |refine| refine.validate()),
        }
    }
}
