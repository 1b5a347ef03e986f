//! Sculpting: super-helices moved to anchors by optimisation [CSE 5].
//!
//! A strand is bent so that points on it, its [controls](Control), come to their anchors:
//!
//! `E(q) = sum_k w_k |S(lambda_k) - a_k|^2 + c sum_j |W_j^(1/2) (q_j - q0_j)|^2`
//!
//! is made least over the curvatures `q` alone, so that no strand gets longer or shorter.
//!
//! | item | what it does |
//! |---|---|
//! | [`sculpt`], [`solve`] | a groom, or one strand, to its anchors |
//! | [`Sculptor`] | the same again and again while a joint is dragged |
//! | [`armature()`], [`Pose`], [`apply_pose`] | joints that move many strands |
//! | [`SculptOptions`], [`Stiffness`] | what bending costs, and which solver |
//! | [`Report`], [`Sculpted`] | what became of strands |
//! | [`Objective`], [`GroomObjective`] | energy and gradient, for other optimisers |
//!
//! # How
//!
//! Strands are solved side by side in the lanes of SIMD registers (chosen at run time), batches of
//! them on all threads: the private modules hold, from the bottom up, `lanes` (numbers of several
//! strands), `chain` (the walk along a strand that yields `J J^T` without a Jacobian), `normal`
//! (the `3M x 3M` equations), `newton` (Newton's step by dynamic programming), `levenberg` (the
//! solver) and `batch` (strands into lanes and back).
//!
//! **Invariant**: a strand's result depends on nothing but itself, its controls, the options and
//! the machine's instruction set: not on other strands, their order, or the number of threads.
//!
//! This crate never reads a file. `[CSE]` is Shi et al., "Curvature Space Editing of Highly-Coiled
//! Hair", SIGGRAPH 2026.

mod adam;
mod apply;
mod armature;
mod batch;
mod centerline;
mod chain;
mod control;
mod gradient;
mod lanes;
mod levenberg;
mod newton;
mod normal;
mod objective;
mod options;
mod pose;
mod report;
mod sculpt;

pub use apply::{PoseError, apply_pose};
pub use armature::{ArmatureOptions, armature};
pub use centerline::hold_centerlines;
pub use control::{Control, ControlError};
pub use gradient::GroomObjective;
pub use objective::Objective;
pub use options::{Adam, OptionsError, SculptOptions, Solver, Stiffness};
pub use pose::{Clustering, Fingerprint, Group, Joint, Pose, PoseAnchor, Select};
pub use report::{Energy, Report, Sculpted, Stop, Summary};
pub use sculpt::{SculptError, Sculptor, sculpt, solve};
