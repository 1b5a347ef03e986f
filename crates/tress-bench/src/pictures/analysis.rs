//! What the program says of the groom that the project ships, in the pictures of
//! `docs/analysis.md`: colours with their legend, plots, and two grooms side by side.

use std::process::Command;

use crate::Outcome;
use crate::grooms::root;

pub(super) fn make() -> Outcome {
    let folder = tempfile::tempdir()?;
    let program = crate::process::program()?;
    let patch = root().join("fixtures/patch.hair");
    let done = |line: &str| -> Outcome {
        let patch = patch.to_string_lossy();
        let args = line.split(' ').map(|word| if word == "patch.hair" { &*patch } else { word });
        let mut command = Command::new(&program);
        let status = command.args(args).arg("--quiet").current_dir(folder.path()).status()?;
        if status.success() { Ok(()) } else { Err(format!("tress {line} failed").into()) }
    };
    done("analyze patch.hair --unit cm --png analysis-colors.png --quantity radius,beta")?;
    done("analyze patch.hair --unit cm --plot analysis-plots.png --quantity radius,beta")?;
    done("recoil patch.hair wider.hair --radius 1.3 --keep centerline")?;
    done("diff patch.hair wider.hair --unit cm --png analysis-diff.png")?;
    for name in ["analysis-colors.png", "analysis-plots.png", "analysis-diff.png"] {
        super::save_bytes(name, &std::fs::read(folder.path().join(name))?)?;
    }
    Ok(())
}
