//! The operators of a procedural groom, each with its exact derivative.
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
//! and its random numbers.

mod bend;
mod clump;
mod curl;
mod curvature;
mod frizz;
mod measure;
mod scale;
mod straighten;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_edit::{RecoilOptions, RuffleOptions};

pub use bend::Bend;
pub use clump::Clump;
pub use curl::Curl;
pub(crate) use curl::{Normals, normals};
pub use curvature::CurvatureError;
pub(crate) use curvature::apply as apply_in_curvature_space;
pub use frizz::Frizz;
pub(crate) use measure::Scratch;
pub use scale::Scale;
pub use straighten::Straighten;

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
    /// Normal and binormal at each of them; empty where nothing curls.
    pub(crate) normals: &'a [Normals],
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
        }
    }

    /// The parameters there are gradients by, in their order; none for recoil and ruffle.
    #[must_use]
    pub fn parameters(&self) -> &'static [Parameter] {
        match self {
            Self::Scale(_) => Scale::PARAMETERS,
            Self::Clump(_) => Clump::PARAMETERS,
            Self::Bend(_) => Bend::PARAMETERS,
            Self::Curl(_) => Curl::PARAMETERS,
            Self::Frizz(_) => Frizz::PARAMETERS,
            Self::Straighten(_) => Straighten::PARAMETERS,
            Self::Recoil(_) | Self::Ruffle(_) => &[],
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
            Self::Recoil(_) | Self::Ruffle(_) => Vec::new(),
        }
    }

    /// The values of [`Self::parameters`].
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.clone().values_mut().into_iter().map(|value| *value).collect()
    }

    /// Whether the operator moves each strand by itself, and so has a derivative here.
    #[must_use]
    pub fn is_differentiable(&self) -> bool {
        !matches!(self, Self::Recoil(_) | Self::Ruffle(_))
    }

    pub(crate) fn draws(&self) -> Draws {
        match self {
            Self::Scale(_) | Self::Bend(_) => Draws::NormalPerStrand,
            Self::Curl(_) => Draws::TwoPerGuide,
            Self::Frizz(_) => Draws::EvenPerStrand,
            Self::Clump(_) | Self::Straighten(_) | Self::Recoil(_) | Self::Ruffle(_) => Draws::None,
        }
    }

    /// An error if a parameter is outside its range; `index` is the operator's place in the chain.
    pub(crate) fn check(&self, index: usize) -> Result<(), ParameterError> {
        for (parameter, value) in self.parameters().iter().zip(self.values()) {
            let Parameter { name, least, greatest, .. } = *parameter;
            if !(value.is_finite() && (least..=greatest).contains(&value)) {
                let operator = self.name();
                return Err(ParameterError { operator, index, name, value, least, greatest });
            }
        }
        Ok(())
    }

    /// Moves the points of one strand; those in curvature space leave them as they are.
    #[inline]
    pub(crate) fn apply(&self, strand: &mut [DVec3], at: &Setting<'_>, scratch: &mut Scratch) {
        match self {
            Self::Scale(scale) => scale.apply(strand, at),
            Self::Clump(clump) => clump.apply(strand, at, scratch),
            Self::Bend(bend) => bend.apply(strand, at, scratch),
            Self::Curl(curl) => curl.apply(strand, at, scratch),
            Self::Frizz(frizz) => frizz.apply(strand, at, scratch),
            Self::Straighten(straighten) => straighten.apply(strand, scratch),
            Self::Recoil(_) | Self::Ruffle(_) => {}
        }
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
            Self::Recoil(_) | Self::Ruffle(_) => {}
        }
    }
}

#[cfg(test)]
mod tests;
