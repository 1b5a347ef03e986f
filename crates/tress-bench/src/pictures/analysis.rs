//! What the program says of a groom, in the pictures of `docs/analysis.md`: colours with their
//! legend, plots, and two grooms side by side.

use std::path::Path;
use std::process::Command;

use tress::io::WriteOptions;
use tress_fixtures::{PatchOptions, coily_patch};

use crate::Outcome;

pub(super) fn make() -> Outcome {
    let folder = tempfile::tempdir()?;
    let groom = coily_patch(&PatchOptions { wisps: 36, ..PatchOptions::default() }, 4);
    tress::io::write(folder.path().join("before.usdc"), &groom, &WriteOptions::default())?;
    let done = |line: &str| run(folder.path(), line);
    done("analyze before.usdc --png analysis-colors.png --quantity radius,beta")?;
    done("analyze before.usdc --plot analysis-plots.png --quantity radius,beta")?;
    done("recoil before.usdc after.usdc --radius 0.8")?;
    done("diff before.usdc after.usdc --png analysis-diff.png")?;
    for name in ["analysis-colors.png", "analysis-plots.png", "analysis-diff.png"] {
        super::save_bytes(name, &std::fs::read(folder.path().join(name))?)?;
    }
    Ok(())
}

/// Runs the program in a folder.
fn run(folder: &Path, line: &str) -> Outcome {
    let mut command = Command::new(crate::process::program()?);
    let status =
        command.args(line.split_whitespace()).arg("--quiet").current_dir(folder).status()?;
    if status.success() { Ok(()) } else { Err(format!("tress {line} failed").into()) }
}
