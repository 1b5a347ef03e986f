//! Polylines to super-helices, and back.
//!
//! [`fit`] turns a [`Groom`](tress_geometry::Groom) into a
//! [`HelixGroom`](tress_geometry::HelixGroom), strand by strand; [`sample`] goes the other way.
//! Between them lies the curvature space in which strands are analysed and edited.
//!
//! | item | what it is |
//! |---|---|
//! | [`fit`], [`fit_with`], [`fit_strand`] | polylines to super-helices, by [`FitOptions`] |
//! | [`FitReport`] | how near the fit is, and which strands it passed by |
//! | [`sample`] | super-helices to polylines, as dense as [`Sampling`] says |
//! | [`HelixArc`] | the helix arc between two points with given tangents |
//! | [`float_points`], [`float_tangent`] | what makes such an arc possible |
//! | [`centerline`], [`Centerline`] | the line a strand coils about, and the strand seen from it |
//! | [`Spectra`] | a library of coils, as spectra of their offsets from their centerlines |
//! | [`Spline`] | the smooth curve through a polyline's points |
//!
//! The mathematics is that of [CSE 3.5] and of Derouet-Jourdan, Bertails-Descoubes and Thollot,
//! "Floating tangents for approximating spatial curves with G1 piecewise helices", CAGD 2013. On
//! those arcs follows a refinement by Gauss-Newton in linear time (see the sources of `refine`);
//! `docs/fit.md` says how near it comes and how its defaults were found.
//!
//! This crate never reads a file. It works on all strands at once through rayon's current thread
//! pool, and its results do not depend on the number of threads.
//!
//! ```
//! use glam::DVec3;
//! use tress_fit::{Elements, FitOptions, Sampling, fit, sample};
//! use tress_geometry::{Groom, Strands};
//!
//! // Three turns of a coil of radius 0.5, twelve points a turn.
//! let points = (0..=36).map(|i| {
//!     let angle = f64::from(i) * std::f64::consts::TAU / 12.0;
//!     DVec3::new(0.5 * angle.cos(), 0.5 * angle.sin(), 0.1 * angle)
//! });
//! let mut strands = Strands::default();
//! strands.push(points)?;
//! let groom = Groom::new(strands);
//!
//! let options = FitOptions { elements: Elements::Count(18), ..FitOptions::default() };
//! let fitted = fit(&groom, &options)?;
//! let strand = fitted.helices.strand(0);
//! assert_eq!(strand.elements.len(), 18);
//! assert!((strand.elements[9].radius() - 0.5).abs() < 1e-6);
//!
//! let back = sample(&fitted.helices, &Sampling::Points(37))?;
//! let distance = back.strands().points()[20].distance(groom.strands().points()[20]);
//! assert!(distance < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arc;
mod centerline;
mod columns;
mod direct;
mod draft;
mod fit;
mod floating_points;
mod floating_tangents;
mod measure;
mod options;
mod refine;
mod refined;
mod report;
mod sample;
mod spacing;
mod spectra;
mod spline;
mod strand;
mod tangents;
mod tolerance;

pub use arc::HelixArc;
pub use centerline::{
    Centerline, centerline, centerline_of_turns, fourier_centerline, rotation_minimizing_frames,
    rotation_minimizing_frames_from,
};
pub use fit::{FitError, Fitted, fit, fit_with};
pub use floating_points::float_points;
pub use floating_tangents::float_tangent;
pub use measure::{Deviation, deviation};
pub use options::{
    Elements, FitOptions, FitOptionsError, Floating, Refine, TangentRule, Tolerance,
};
pub use report::{FitReport, KeptReason};
pub use sample::{SampleError, Sampling, sample};
pub use spectra::{Harmonic, ReadSpectraError, Spectra, SpectraError, WriteSpectraError};
pub use spline::Spline;
pub use strand::{StrandFit, fit_strand};
