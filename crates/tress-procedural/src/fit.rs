//! Backward: a procedural groom for strands that have none [IPG 5].
//!
//! The stages, each a module with its mathematics: guides are clustered and smoothed, strands learn
//! their instancing weights, guides are refined, operators find their parameters, and last the
//! random numbers of single strands. [`Fitter`] runs them one at a time, so that a fit can be
//! watched, stopped and taken up again.

mod checkpoint;
mod clusters;
mod correlation;
mod courses;
mod fitter;
mod flaws;
mod guides;
mod heat;
mod options;
mod parameters;
mod parting;
mod ranges;
mod refine_numbers;
mod sample;
mod search;
mod settle;
mod slices;
mod stage;
mod weights;

pub use clusters::{Initial, InitialError, initialize, medoids};
pub use fitter::{Fitter, FitterError};
pub use flaws::{FlawOptions, Flaws, find_flaws};
pub use guides::{GuideOptions, refine_guides};
pub use heat::Smoothing;
pub use options::StageOptions;
pub use parameters::{LossError, ParameterOptions, StageError, Watch, fit_parameters};
pub use parting::avoid_head;
pub use refine_numbers::{NumberOptions, refine_numbers};
pub use stage::{Progress, Record, Stage};
pub use weights::fit_weights;
