//! Generalized helicoids: one hair that knows its neighbours.

mod field;
mod fill;
mod fit;
mod frechet;
mod groom;
mod piecewise;
mod trace;

pub use field::Helicoid;
pub use fill::{
    FillError, FillOptions, Filled, Mixing, Roots, fill, mean_rotation, shepard,
};
pub use fit::{
    FitOptions, FitOptionsError, FitReport, Fitted, Method, Pieces, Roll, StrandFit, fit,
    fit_strand, fit_with,
};
pub use frechet::{frechet, frechet_at_most, least_total_leash};
pub use groom::{HelicoidGroom, HelicoidGroomError, SampleError, sample, sample_counts};
pub use piecewise::{PHelicoid, Piece, positive_tangential};
pub use trace::{TraceError, Tracing};
