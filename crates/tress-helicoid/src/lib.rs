//! Generalized helicoids: one hair that knows its neighbours.

mod field;
mod groom;
mod piecewise;
mod trace;

pub use field::Helicoid;
pub use groom::{HelicoidGroom, HelicoidGroomError, SampleError, sample, sample_counts};
pub use piecewise::{PHelicoid, Piece, positive_tangential};
pub use trace::{TraceError, Tracing};
