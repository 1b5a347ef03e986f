//! Switchbacks: coils that change hands, exact and as published.
//!
//! A coil that is pulled out and cannot turn at its ends changes hands somewhere: right-handed on
//! one side, left-handed on the other, and between them a short stretch that hardly winds at all.
//! Botanists call it a perversion of a tendril; in coily hair it is everywhere ([CC 4]).

mod coil;
mod exact;
mod insert;
mod material;
mod profile;
mod ritz;
mod rod;
mod shoot;
mod tail;
mod taylor;

pub use coil::{Coil, CoilError};
pub use exact::{Switchback, SwitchbackError};
pub use insert::{
    InsertError, InsertGroomError, InsertOptions, InsertReport, Placed, Placing, insert, insert_at,
};
pub use material::Material;
pub use profile::{Profile, arcs, coil_frame, material_curvature};
pub use ritz::{Ritz, RitzOptions, greatest_distance};
