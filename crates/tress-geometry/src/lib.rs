//! The ground floor of tress: strands as super-helices, and grooms as flat arrays.
//!
//! A strand is a curve `r(s)` with an orthonormal material frame `F = [t u v]` (columns), moved by
//! its material curvatures `q = (k0, k1, k2)`: twist about `t`, bending about `u` and `v`,
//!
//! `F' = F [q]x`, `r' = t`.
//!
//! A *super-helix* ([Bertails et al. 2006], [CSE 3]) holds `q` constant on each of its elements,
//! which makes every element an arc of a circular helix, known in closed form.
//!
//! | module item | what it is |
//! |---|---|
//! | [`Frame`] | a position and a material frame |
//! | [`Element`] | one helix arc: `q` and a length |
//! | [`SuperHelix`] | a root frame and a chain of elements: positions and frames at any arc length |
//! | [`jacobian`], [`adjoint`] | derivatives of the chain |
//! | [`Strands`] | many strands in one flat array |
//! | [`Groom`] | polylines with attributes, unit and up axis: what files hold |
//! | [`HelixGroom`] | the same groom as super-helices: what edits act on |
//! | [`Mesh`] | a triangle mesh: the scalp |
//! | [`polyline`], [`curves`] | lengths and defects of polylines; Catmull-Rom and other cubic curves |
//!
//! # Conventions
//!
//! Everything is `f64`. Lengths are in the groom's own unit (see [`Groom::unit`]), curvatures in
//! one over that unit, angles in radians. Coordinates are right-handed. Matrices hold frames as
//! columns `[t u v]`. A positive twist `k0` turns the frame counter-clockwise seen against `t`, so
//! a helix with `k0 > 0` is right-handed.
//!
//! # Paper names
//!
//! `[CSE]`: Shi et al., "Curvature Space Editing of Highly-Coiled Hair", SIGGRAPH 2026.
//! `[CC]`: Wu et al., "Curly-Cue: Geometric Methods for Highly Coiled Hair", SIGGRAPH Asia 2024.
//! `[IPG]`: Chang et al., "Inverse procedural grooms", 2025. `[GH]`: Piuze et al., "Generalized
//! Helicoids for Modeling Hair Geometry", 2011. Equation numbers are the papers' own.
//!
//! This crate never reads a file, never draws a random number and never starts a thread.

pub use glam;

mod attributes;
mod chain;
pub mod curves;
mod derivative;
mod element;
mod frame;
mod groom;
mod helix_groom;
mod mesh;
pub mod polyline;
mod rodrigues;
mod strands;

pub use attributes::{Attributes, Column, ColumnError, names};
pub use chain::{SuperHelix, align_frame};
pub use derivative::{ChainScratch, adjoint, jacobian};
pub use element::Element;
pub use frame::Frame;
pub use groom::{Groom, GroomError, JoinError, UpAxis};
pub use helix_groom::{HelixGroom, Kept};
pub use mesh::{Mesh, MeshError};
pub use rodrigues::factorial_series;
pub use strands::{OffsetsError, Strands};
