//! Formats: what is written is read, real files are read, broken ones are refused with a word.

#[path = "../common/mod.rs"]
mod common;

mod bad_input;
mod files;
mod grooms;
#[cfg(unix)]
mod places;
mod ply_and_tfx;
mod polylines;
mod real_grooms;
mod round_trip;
