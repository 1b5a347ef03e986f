//! Generalized helicoids: one hair that knows its neighbours \[GH\].
//!
//! A *generalized helicoid* is a field of directions with four parameters. One line of its flow is
//! a hair; the lines beside it are the hairs of its wisp. Several joined end to end by their frames
//! are a *p-helicoid*, which describes a strand of any shape in a few numbers a piece, and those
//! numbers can be mixed: between guides that curl, what is mixed curls too.
//!
//! | item | what it is | source |
//! |---|---|---|
//! | [`Helicoid`] | the field: angles, frame, curvatures | [GH 1-2] |
//! | [`Tracing`] | how its lines are walked | [GH 3] |
//! | [`PHelicoid`], [`Piece`] | a hair of several helicoids | [GH 3.4] |
//! | [`HelicoidGroom`], [`sample`] | many of them, in RON; their polylines | |
//! | [`Waviness`], [`perturb`] | waves and disorder | [GH 4] |
//! | [`wisp`], [`wisps`] | the hairs beside a hair | [GH 3.3] |
//! | [`fill`], [`shepard`], [`mean_rotation`] | hairs between guides | [GH 4.1-4.3] |
//! | [`fit`], [`fit_strand`] | polylines to p-helicoids | [GH 5] |
//! | [`frechet`], [`frechet_at_most`] | how near two polylines are | [GH 5.1] |
//! | [`to_helices`], [`from_helices`] | super-helices, and back | |
//!
//! `[GH]` is Piuze, Kry and Siddiqi, "Generalized Helicoids for Modeling Hair Geometry",
//! Eurographics 2011; numbers are its equations and sections.
//!
//! This crate never reads a file. It works on all strands at once through rayon's current thread
//! pool; results depend on options and seeds, never on the number of threads.
//!
//! ```
//! use glam::DVec3;
//! use tress_geometry::{Groom, Strands};
//! use tress_helicoid::{FillOptions, FitOptions, Roots, Tracing, fill, fit, sample};
//!
//! // Two strands that bend the same way, one twice as much; a third is wanted half way.
//! let arc = |x: f64, radius: f64| (0..20).map(f64::from).map(move |i| {
//!     DVec3::new(x, radius * (0.1 * i / radius).sin(), radius - radius * (0.1 * i / radius).cos())
//! });
//! let mut strands = Strands::default();
//! strands.push(arc(0.0, 2.0))?;
//! strands.push(arc(1.0, 1.0))?;
//! let guides = fit(&Groom::new(strands), &FitOptions::default())?;
//! let roots = [DVec3::new(0.5, 0.0, 0.0)];
//! let filled = fill(&guides.hairs, Roots::Points(&roots), &FillOptions::default())?;
//! assert!((filled.hairs.hair(0).pieces[0].k.kt.abs() - 0.75).abs() < 1e-3);
//! let hair = sample(&filled.hairs, 20, Tracing::default())?;
//! assert_eq!(hair.strands().strand(0)[0], roots[0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bridge;
mod field;
mod fill;
mod fit;
mod frechet;
mod groom;
mod piecewise;
mod random;
mod trace;
mod waviness;
mod wisp;

pub use bridge::{BridgeError, elements, from_helices, to_helices};
pub use field::Helicoid;
pub use fill::{
    FillError, FillOptions, Filled, Mixing, Roots, fill, mean_rotation, normals_at, shepard,
};
pub use fit::{
    FitOptions, FitOptionsError, FitReport, Fitted, Method, Pieces, Roll, StrandFit, fit,
    fit_strand, fit_with,
};
pub use frechet::{frechet, frechet_at_most, least_total_leash};
pub use groom::{HelicoidGroom, HelicoidGroomError, SampleError, sample, sample_counts};
pub use piecewise::{PHelicoid, Piece, positive_tangential};
pub use trace::{TraceError, Tracing};
pub use waviness::{Waviness, perturb};
pub use wisp::{WispError, WispOptions, wisp, wisps};
