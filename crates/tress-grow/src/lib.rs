//! From guides to a head of coils.
//!
//! A few guide strands, simulated or styled, become a head of hair: each root is given a guide
//! ([`assign`]), and on it grows a hair that leaves the scalp loosely and then falls into its
//! guide's coil, the *phase locking* of [CC 3] ([`grow`], [`Plan`]). Hairs may leave turns out,
//! its *period skipping* ([`Skip`]).
//!
//! | item | what it is |
//! |---|---|
//! | [`grow`], [`Plan`] | hairs from guides and roots; the same hairs on every frame |
//! | [`GrowOptions`], [`preset`] | how they grow |
//! | [`skip_periods`] | turns of one hair left out |
//! | [`Coils`] | a library of coils for the loose part |
//! | [`assign`], [`read_groups`] | which guide a root follows |
//! | [`scatter`] | roots on a mesh, evenly spaced |
//! | [`joint_report`] | whether the joint of the two parts can be seen |
//!
//! A hair begins at its root. Up to its joint it runs along a cubic to the guide's centerline and
//! carries offsets from the library, which open from the root on and become the guide's own before
//! the joint; from there it is the guide moved aside by `w(t) (alpha u + beta v)`, [CC 2]. Frames
//! do not turn about the lines they are carried along, and those of a hair are carried back from
//! its guide's at the joint, so that nothing jumps there. `docs/grow.md` shows what comes of it.
//!
//! Where this departs from the paper: hairs begin at their roots and not a coil's radius off them;
//! the library's coil is turned to be in phase with the guide's at the joint; frames are rotation
//! minimising and not made of the x axis [CC 27]; places in a wisp are even over a disc and not
//! over a square.
//!
//! This crate never reads a file. It works on all hairs at once through rayon's current thread
//! pool; its results depend on the seed and not on the number of threads.

mod assign;
mod coils;
mod curve;
mod grow;
mod guide;
mod joint;
mod lines;
mod loose;
mod options;
mod plan;
mod presets;
mod scatter;
mod skip;

pub use assign::{AssignError, Assignment, assign, read_groups};
pub use coils::Coils;
pub use curve::{Curve, CurveError};
pub use grow::{GUIDE, GrowFromError, GrowReport, grow};
pub use joint::{JointReport, joint_report};
pub use options::{CoilScale, GrowOptions, GrowOptionsError, Skip, SkipUnit};
pub use plan::{GrowError, Plan};
pub use presets::{preset, preset_names, preset_text};
pub use scatter::{Density, ScatterError, scatter};
pub use skip::{SkipScratch, skip_periods};
