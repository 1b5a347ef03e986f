//! The operators of a procedural groom.
//!
//! An operator moves the points of one strand, given the operator guide the strand belongs to and
//! the strand's stored random numbers `u`. In the symbols of [IPG appendix A], a strand has points
//! `x_0 .. x_{m-1}`, segments `e_j = x_{j+1} - x_j` of lengths `l_j`, arc lengths
//! `s_j = l_0 + .. + l_{j-1}`, length `l` and normalized distances `v_j = s_j / l`. (The paper
//! counts from 1 and prints sums to `j`; for points they are read as sums over the segments before
//! the point, so that `v` is 0 at the root, where the clump's weight is said to be 0, and 1 at the
//! tip.)
//!
//! The derivative is a vector-Jacobian product: from the gradient of some loss by the points an
//! operator put out, the gradients by the points it was given, its operator guide, its parameters
//! and its random numbers. Recoil, ruffle, switchback and skip work on all strands at once and have
//! none.

mod bend;
mod clump;
mod curl;
mod curvature;
mod frizz;
mod guides;
mod scale;
mod skip;
mod straighten;
mod strand;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_edit::{RecoilOptions, RuffleOptions};

use crate::EvenStrands;

pub use bend::Bend;
pub use clump::Clump;
pub use curl::Curl;
pub use curvature::{CurvatureError, Switchback};
pub use frizz::Frizz;
pub(crate) use guides::{GuideRows, Guides};
pub use scale::Scale;
pub use skip::{Skip, SkipKeep};
pub use straighten::Straighten;
pub(crate) use strand::Scratch;

/// Which formulas the operators follow where two are in use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Convention {
    /// Those of [IPG appendix A].
    #[default]
    Paper,
    /// Those of the program its authors published, so that parameters found with it carry over:
    ///
    /// | | paper | published program |
    /// |---|---|---|
    /// | start of a bend | `sigmoid(10 (v - z))` | `sigmoid(20 (v - z + 0.05))` |
    /// | start of a curl | `sigmoid(10 (v - z))` | `sigmoid(10 (v - z + 0.05))` |
    /// | clump and frizz go by | arc length | the point's index |
    /// | octaves of frizz | `2/3 (n_1 + n_2 / 3)` | `(n_1 + n_2 / 2) / 1.5` |
    PublishedProgram,
}

/// One step of the chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Operator {
    /// Strands of random lengths.
    Scale(Scale),
    /// Strands drawn to their operator guide towards the tip.
    Clump(Clump),
    /// Strands bent about random axes.
    Bend(Bend),
    /// Strands curled about their operator guide.
    Curl(Curl),
    /// Noise on every strand.
    Frizz(Frizz),
    /// Strands pulled straight, their lengths kept.
    Straighten(Straighten),
    /// Coils made wider, narrower, tighter or looser, in curvature space.
    Recoil(RecoilOptions),
    /// Strands of an operator guide exchange pieces, in curvature space.
    Ruffle(RuffleOptions),
    /// Coils that change hands, in curvature space.
    Switchback(Switchback),
    /// Turns left out.
    Skip(Skip),
}

/// A parameter of an operator: its name and what it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// As in the file.
    pub name: &'static str,
    /// Least value.
    pub least: f64,
    /// Greatest value; may be infinite.
    pub greatest: f64,
    /// A value of ordinary size, to scale steps by; lengths have none of their own and say 1.
    pub typical: f64,
}

/// A parameter outside its range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{operator} {index}: {name} is {value}, expected {least} to {greatest}")]
pub struct ParameterError {
    /// The operator's name.
    pub operator: &'static str,
    /// Which operator of the chain, from 0.
    pub index: usize,
    /// The parameter's name.
    pub name: &'static str,
    /// The value it has.
    pub value: f64,
    /// Least value.
    pub least: f64,
    /// Greatest value.
    pub greatest: f64,
}

/// Names the parameters of an operator, with their ranges, in the order of its gradient.
macro_rules! parameters {
    ($operator:ident { $($field:ident: $least:expr, $greatest:expr, $typical:expr;)* }) => {
        impl $operator {
            /// The parameters, in the order of gradients.
            pub const PARAMETERS: &'static [$crate::operators::Parameter] = &[
                $($crate::operators::Parameter {
                    name: stringify!($field),
                    least: $least,
                    greatest: $greatest,
                    typical: $typical,
                },)*
            ];

            pub(crate) fn fields(&mut self) -> Vec<&mut f64> {
                vec![$(&mut self.$field,)*]
            }
        }
    };
}
pub(crate) use parameters;

/// How many random numbers an operator draws, and for what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Draws {
    None,
    /// One a strand, from the normal distribution truncated to -1 to 1.
    NormalPerStrand,
    /// One a strand, even in 0 to 1.
    EvenPerStrand,
    /// Two an operator guide: normal truncated to -1 to 1, then even in 0 to 1.
    TwoPerGuide,
}

/// What an operator knows of the strand it works on beside its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting<'a> {
    pub(crate) convention: Convention,
    /// The operator guide's points.
    pub(crate) guide: &'a [DVec3],
    /// The same in rows, with its normals.
    pub(crate) rows: GuideRows<'a>,
    /// The random numbers: the strand's in `[0]`, or the operator guide's.
    pub(crate) numbers: [f64; 2],
}

/// Where the gradients of one strand are added up.
#[derive(Debug)]
pub(crate) struct Sums<'a> {
    pub(crate) guide: &'a mut [DVec3],
    pub(crate) parameters: &'a mut [f64],
    pub(crate) numbers: [f64; 2],
}

impl Operator {
    /// The operator's name as in the file, but lower case.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Scale(_) => "scale",
            Self::Clump(_) => "clump",
            Self::Bend(_) => "bend",
            Self::Curl(_) => "curl",
            Self::Frizz(_) => "frizz",
            Self::Straighten(_) => "straighten",
            Self::Recoil(_) => "recoil",
            Self::Ruffle(_) => "ruffle",
            Self::Switchback(_) => "switchback",
            Self::Skip(_) => "skip",
        }
    }

    /// The parameters there are gradients by, in their order; none where the operator
    /// [has no derivative](Self::is_differentiable).
    #[must_use]
    pub fn parameters(&self) -> &'static [Parameter] {
        match self {
            Self::Scale(_) => Scale::PARAMETERS,
            Self::Clump(_) => Clump::PARAMETERS,
            Self::Bend(_) => Bend::PARAMETERS,
            Self::Curl(_) => Curl::PARAMETERS,
            Self::Frizz(_) => Frizz::PARAMETERS,
            Self::Straighten(_) => Straighten::PARAMETERS,
            _ => &[],
        }
    }

    /// The values of [`Self::parameters`], to be changed.
    pub fn values_mut(&mut self) -> Vec<&mut f64> {
        match self {
            Self::Scale(scale) => scale.fields(),
            Self::Clump(clump) => clump.fields(),
            Self::Bend(bend) => bend.fields(),
            Self::Curl(curl) => curl.fields(),
            Self::Frizz(frizz) => frizz.fields(),
            Self::Straighten(straighten) => straighten.fields(),
            _ => Vec::new(),
        }
    }

    /// The values of [`Self::parameters`].
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.clone().values_mut().into_iter().map(|value| *value).collect()
    }

    /// Whether the operator has a derivative. Recoil, ruffle, switchback and skip have none: they
    /// go through a fit, or choose by chance what they change.
    #[must_use]
    pub fn is_differentiable(&self) -> bool {
        match self {
            Self::Scale(_)
            | Self::Clump(_)
            | Self::Bend(_)
            | Self::Curl(_)
            | Self::Frizz(_)
            | Self::Straighten(_) => true,
            Self::Recoil(_) | Self::Ruffle(_) | Self::Switchback(_) | Self::Skip(_) => false,
        }
    }

    pub(crate) fn draws(&self) -> Draws {
        match self {
            Self::Scale(_) | Self::Bend(_) => Draws::NormalPerStrand,
            Self::Curl(_) => Draws::TwoPerGuide,
            Self::Frizz(_) => Draws::EvenPerStrand,
            _ => Draws::None,
        }
    }

    /// An error if a parameter is outside its range; `index` is the operator's place in the chain.
    pub(crate) fn check(&self, index: usize) -> Result<(), ParameterError> {
        let check = |name, value: f64, least, greatest| {
            if value.is_finite() && (least..=greatest).contains(&value) {
                return Ok(());
            }
            Err(ParameterError { operator: self.name(), index, name, value, least, greatest })
        };
        for (parameter, value) in self.parameters().iter().zip(self.values()) {
            check(parameter.name, value, parameter.least, parameter.greatest)?;
        }
        match self {
            Self::Skip(skip) => check("probability", skip.probability, 0.0, 1.0),
            _ => Ok(()),
        }
    }

    /// Moves the points of the strand that `scratch` holds; an operator that has no derivative
    /// leaves them as they are.
    #[inline(always)]
    pub(crate) fn apply(&self, at: &Setting<'_>, scratch: &mut Scratch) {
        match self {
            Self::Scale(scale) => scale.apply(at, scratch),
            Self::Clump(clump) => clump.apply(at, scratch),
            Self::Bend(bend) => bend.apply(at, scratch),
            Self::Curl(curl) => curl.apply(at, scratch),
            Self::Frizz(frizz) => frizz.apply(at, scratch),
            Self::Straighten(straighten) => straighten.apply(scratch),
            _ => {}
        }
    }

    /// Changes all strands by an operator that has no derivative; `operator_of[i]` is the group of
    /// strand `i`. If it fails there are no strands left.
    pub(crate) fn apply_to_all(
        &self,
        strands: &mut EvenStrands,
        operator_of: &[u32],
        seed: u64,
    ) -> Result<(), CurvatureError> {
        if let Self::Skip(skip) = self {
            skip.apply(strands, seed);
        } else {
            let none = EvenStrands::zeros(0, strands.points_each());
            let given = std::mem::replace(strands, none);
            *strands = curvature::apply(self, given, operator_of, seed)?;
        }
        Ok(())
    }

    /// The gradient by the strand given, in place of that by the strand put out; the rest is added
    /// to `sums`.
    pub(crate) fn pull_back(
        &self,
        strand: &[DVec3],
        at: &Setting<'_>,
        gradient: &mut [DVec3],
        sums: &mut Sums<'_>,
        scratch: &mut Scratch,
    ) {
        match self {
            Self::Scale(scale) => scale.pull_back(strand, at, gradient, sums),
            Self::Clump(clump) => clump.pull_back(strand, at, gradient, sums, scratch),
            Self::Bend(bend) => bend.pull_back(strand, at, gradient, sums, scratch),
            Self::Curl(curl) => curl.pull_back(strand, at, gradient, sums, scratch),
            Self::Frizz(frizz) => frizz.pull_back(strand, at, gradient, sums, scratch),
            Self::Straighten(straighten) => straighten.pull_back(strand, gradient, sums, scratch),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests;
