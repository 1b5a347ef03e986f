//! What the crate promises, tested from outside.

mod against_adam;
mod common;
mod derivatives;
mod pose;
mod sculpt;
