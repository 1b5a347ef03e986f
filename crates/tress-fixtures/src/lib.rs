//! Grooms made from a seed, for tests, benches and the demo.
//!
//! [`coily_patch`] grows wisps of coily hair on a curved patch of scalp. Its numbers are those of
//! simulated coily guides (see [`PatchOptions`]); it is a stand-in for real hair where none can be
//! shipped, and owes it frizz, breakage and tangles.
//!
//! [`scalp`] is the mesh of that patch.
//!
//! The same options and seed give the same points on every machine that rounds as IEEE 754 says,
//! up to the last bits of `sin` and `cos`.

mod noise;
mod patch;
mod scalp;

pub use patch::{PatchOptions, coily_patch};
pub use scalp::scalp;
