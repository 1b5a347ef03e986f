//! How strands are fitted.

use serde::{Deserialize, Serialize};

/// What finds the parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// Gauss-Newton on the traced points, from a local estimate of curvature; pieces are found one
    /// after the other and then moved together, with the root's frame and their lengths.
    #[default]
    Newton,
    /// Nelder and Mead's simplex on the Frechet distance, piece by piece, as published [GH 5.2].
    Simplex,
}

/// How many pieces a strand gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Pieces {
    /// As many as the tolerance takes, split as published [GH 5.3], and no more than this.
    UpTo(usize),
    /// This many, equally long: what guides are to have that are mixed piece by piece.
    Equal(usize),
}

/// How the root's frame stands about its tangent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Roll {
    /// `E_N` to where the strand first bends, as a Frenet frame has it [GH 5.2], and then free.
    #[default]
    Bend,
    /// Turned from one frame by the least rotation, so that neighbours' frames are neighbours: what
    /// guides are to have whose bends differ.
    Steady,
}

/// How [`fit`](crate::fit) trades accuracy against pieces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FitOptions {
    /// What finds the parameters.
    pub method: Method,
    /// How many pieces. Default at most 16.
    pub pieces: Pieces,
    /// How the root's frame stands. Default by the bend.
    pub roll: Roll,
    /// Frechet distance that is small enough, over the strand's length. Default 0.01.
    pub tolerance: f64,
    /// A strand is split where the Frechet distance so far is this part of the whole's. Default
    /// 0.6, as published: 1 would keep every fit whole, less makes more pieces.
    pub threshold: f64,
    /// Least length of a piece over the strand's. Default 0.05.
    pub shortest: f64,
    /// What parameters cost, lambda of [GH 5]: for the simplex over the piece's length, for
    /// Gauss-Newton as a distance at each point. Default 1e-3.
    pub regularization: f64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            method: Method::default(),
            pieces: Pieces::UpTo(16),
            roll: Roll::default(),
            tolerance: 0.01,
            threshold: 0.6,
            shortest: 0.05,
            regularization: 1e-3,
        }
    }
}

/// Why options cannot be followed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitOptionsError {
    /// A number outside its range, a missing one included.
    ///
    /// ```
    /// use tress_helicoid::{FitOptions, FitOptionsError};
    ///
    /// let options = FitOptions { threshold: 1.5, ..FitOptions::default() };
    /// let expected = "above 0, at most 1";
    /// let error = FitOptionsError::Range { name: "threshold", value: 1.5, expected };
    /// assert_eq!(options.validate(), Err(error));
    /// ```
    #[error("{name} is {value}, expected {expected}")]
    Range {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        expected: &'static str,
    },
    /// No piece at all, or more than a strand can do with.
    ///
    /// ```
    /// use tress_helicoid::{FitOptions, FitOptionsError, Pieces};
    ///
    /// let options = FitOptions { pieces: Pieces::Equal(0), ..FitOptions::default() };
    /// assert_eq!(options.validate(), Err(FitOptionsError::Pieces(0)));
    /// ```
    #[error("{0} pieces a strand, expected 1 to 1000")]
    Pieces(usize),
}

impl FitOptions {
    /// An error unless all options are in their range.
    ///
    /// # Errors
    ///
    /// See [`FitOptionsError`].
    pub fn validate(&self) -> Result<(), FitOptionsError> {
        let (Pieces::UpTo(n) | Pieces::Equal(n)) = self.pieces;
        if !(1..=1000).contains(&n) {
            return Err(FitOptionsError::Pieces(n));
        }
        let part = |value: f64| 0.0 < value && value <= 1.0;
        let numbers = [
            (
                "tolerance",
                self.tolerance,
                0.0 < self.tolerance && self.tolerance.is_finite(),
                "above 0",
            ),
            ("threshold", self.threshold, part(self.threshold), "above 0, at most 1"),
            ("shortest", self.shortest, part(self.shortest), "above 0, at most 1"),
            (
                "regularization",
                self.regularization,
                0.0 <= self.regularization && self.regularization.is_finite(),
                "at least 0",
            ),
        ];
        match numbers.into_iter().find(|(.., good, _)| !good) {
            Some((name, value, _, expected)) => {
                Err(FitOptionsError::Range { name, value, expected })
            }
            None => Ok(()),
        }
    }
}
