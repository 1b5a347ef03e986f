//! The program `tress`.
fn main() {}
