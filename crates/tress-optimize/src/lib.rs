//! Sculpting: super-helices moved to anchors by optimisation.

mod adam;
mod apply;
mod armature;
mod batch;
mod chain;
mod control;
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
pub use control::{Control, ControlError};
pub use objective::Objective;
pub use options::{Adam, OptionsError, SculptOptions, Solver, Stiffness};
pub use pose::{Clustering, Fingerprint, Group, Joint, Pose, PoseAnchor, Select};
pub use report::{Energy, Report, Stop};
pub use sculpt::{SculptError, Sculpted, Sculptor, sculpt, solve};
