//! Makes the library of coils that ships with the crate, into the file named:
//! `cargo run -p tress-grow --example default_spectra -- default.tress-spectra`.

use std::error::Error;

use tress_fit::Spectra;
use tress_fixtures::{PatchOptions, coily_patch};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("where to?")?;
    let options =
        PatchOptions { wisps: 192, strands_per_wisp: 1, length: 8.0, ..PatchOptions::default() };
    let spectra = Spectra::of(coily_patch(&options, 20_241).strands());
    std::fs::write(path, spectra.to_bytes()?)?;
    Ok(())
}
