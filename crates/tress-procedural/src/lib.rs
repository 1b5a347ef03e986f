//! Procedural grooms, forward and backward \[IPG\].
//!
//! A procedural groom is a few guides, strands instanced from them, and a chain of operators that
//! scale, clump, bend, curl and frizz the strands: what artists edit. Forward, a groom is built
//! from its description, bit for bit the same every time. Backward, the description is found for
//! strands that have none.
//!
//! `[IPG]`: Chang et al., "Transforming Unstructured Hair Strands into Procedural Hair Grooms", ACM
//! Transactions on Graphics 44(4), 2025. Equation numbers are the paper's own.
//!
//! `[CC]`: Wu et al., "Curly-Cue: Geometric Methods for Highly Coiled Hair", SIGGRAPH Asia 2024.

mod chain;
mod even;
mod file;
pub mod fit;
mod functions;
mod groom;
mod instancing;
mod noise;
mod numbers;
mod operators;
mod surface;
pub mod synthetic;
mod widths;

pub use chain::{Bound, Chain, ChainError, Gradients};
pub use even::{EvenError, EvenStrands};
pub use file::{DataError, FileError};
pub use groom::{BuildError, ProceduralGroom};
pub use instancing::{Instances, Instancing, Roots};
pub use numbers::draw;
pub use operators::{
    Bend, Clump, Convention, Curl, CurvatureError, Frizz, Operator, Parameter, ParameterError,
    Scale, Skip, SkipKeep, Straighten, Switchback,
};
pub use surface::{Surface, SurfaceError};
