//! Editing coiled hair in curvature space.
//!
//! tress holds a strand as a *super-helix*: a chain of circular helix arcs with constant material
//! curvatures. This crate is the whole of it under one roof; each layer can also be used alone.
//!
//! | layer | what it does |
//! |---|---|
//! | [`geometry`] | frames, elements, chains and their derivatives; grooms as flat arrays |
//! | [`fit`] | polylines to super-helices and back |
//! | [`analysis`] | coil radius, turns, handedness, defects, clusters |
//! | [`edit`] | ruffle, blend and other edits of curvatures |
//! | [`optimize`] | sculpting: strands moved to anchors |
//! | [`switchback`] | coils that change hands: their equilibrium, and into strands |
//! | [`grow`] | guides to a head of hair: phase locking, period skipping, roots |
//! | [`helicoid`] | generalized helicoids: hairs that know their neighbours |
//! | [`procedural`] | guides and operators to strands, and back |
//! | [`io`] | files: .obj .hair .data .bin .ply .tfx .npy .npz .usda .usdc .abc .tress |
//! | [`view`] | pictures |
//!
//! # A tour
//!
//! A groom is polylines; the fit makes super-helices of them:
//!
//! ```
//! use tress::geometry::glam::DVec3;
//! use tress::geometry::{Groom, Strands};
//! use tress::fit::{Elements, FitOptions, Sampling};
//!
//! // Two coils of ten turns, eight points a turn: one to the right, one to the left.
//! let coil = |hand: f64| (0..=80).map(move |i| {
//!     let angle = f64::from(i) * std::f64::consts::TAU / 8.0;
//!     DVec3::new(0.5 * angle.cos(), 0.08 * angle, hand * -0.5 * angle.sin())
//! });
//! let mut strands = Strands::default();
//! strands.push(coil(1.0))?;
//! strands.push(coil(-1.0))?;
//! let groom = Groom::new(strands);
//!
//! let options = FitOptions { elements: Elements::Count(60), ..FitOptions::default() };
//! let fitted = tress::fit::fit(&groom, &options)?;
//! # let helices = fitted.helices;
//! // Curvatures say what the hair is like, whatever its sampling.
//! let summary = tress::analysis::summarize(&helices);
//! assert_eq!((summary.right_handed, summary.left_handed), (1, 1));
//! let radius = summary.coil_radius.expect("both strands are coiled").median;
//! assert!((radius - 0.5).abs() < 0.02, "coil radius {radius}");
//!
//! // An edit acts on curvatures; positions follow.
//! use tress::edit::{RuffleOptions, ruffle};
//! let options = RuffleOptions { probability: 0.3, keep: 20, ..RuffleOptions::default() };
//! let (ruffled, report) = ruffle(&helices, &[0, 0], &options, 1)?;
//! assert_eq!(report.candidates, 80);
//!
//! // Back to points, as many as came in.
//! let back = tress::fit::sample(&ruffled, &Sampling::Points(81))?;
//! assert_eq!(back.strands().points().len(), 162);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Conventions (units, axes, frames) are those of [`geometry`].

pub use tress_analysis as analysis;
pub use tress_edit as edit;
pub use tress_fit as fit;
pub use tress_geometry as geometry;
pub use tress_grow as grow;
pub use tress_helicoid as helicoid;
pub use tress_io as io;
pub use tress_optimize as optimize;
pub use tress_procedural as procedural;
pub use tress_switchback as switchback;
pub use tress_view as view;
