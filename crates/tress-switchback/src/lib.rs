//! Switchbacks: coils that change hands, exact and as published.
//!
//! A coil that is pulled out and cannot turn at its ends changes hands somewhere: right-handed on
//! one side, left-handed on the other, and between them a short stretch that hardly winds at all.
//! Botanists call it a perversion of a tendril; in coily hair it is everywhere ([CC 4]).
//!
//! | item | what it is |
//! |---|---|
//! | [`Material`], [`Coil`] | the rod, and its coils under tension in closed form |
//! | [`Switchback`] | the equilibrium between both hands, to 1e-8 |
//! | [`DoubleSwitchback`] | two at once, for rods that rest as a circle or as a helix |
//! | [`Ritz`] | the published approximation of eleven parameters |
//! | [`Profile`], [`arcs`], [`strand`] | curvatures along the strand, and helix arcs made of them |
//! | [`insert_at`], [`insert`] | switchbacks put into strands, and into the wisps of a groom |
//!
//! ```
//! use tress_geometry::{Element, Frame, SuperHelix};
//! use tress_switchback::{InsertOptions, insert_at};
//!
//! // A right-handed coil of 25 turns; left-handed from its middle on.
//! let coil = Element::coil(0.5, 0.8);
//! let turn = std::f64::consts::TAU / coil.curvature.length();
//! let elements = vec![Element { length: turn / 6.0, ..coil }; 150];
//! let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
//! let (elements, placed) = insert_at(&strand, 12.5 * turn, &InsertOptions::default())?;
//! assert!(placed.half_width < 4.0 * turn);
//! assert!((elements[elements.len() - 1].twist() + coil.twist()).abs() < 1e-6);
//! # Ok::<(), tress_switchback::InsertError>(())
//! ```
//!
//! Curvatures are in units of the rod's curvature at rest where a rod is spoken of, and in one over
//! the groom's unit where strands are. This crate never reads a file; random places come from a
//! seed that the caller gives.

mod coil;
mod double;
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
pub use double::DoubleSwitchback;
pub use exact::{Switchback, SwitchbackError};
pub use insert::{
    InsertError, InsertGroomError, InsertOptions, InsertReport, Placed, Placing, insert, insert_at,
};
pub use material::Material;
pub use profile::{Profile, arcs, coil_frame, material_curvature, strand};
pub use ritz::{Ritz, RitzOptions, greatest_distance};
