//! The Python package, built, installed into a folder of its own and tested.

use std::env;
use std::ffi::OsString;
use std::process::{Command, Stdio};

use crate::extension::{build_wheel, empty};
use crate::{root, say};

/// What building and testing need beside Python itself.
const NEEDS: &str = "maturin, numpy, pytest, hypothesis";

/// Installs the package of this repository into a folder of its own, without asking any server,
/// and runs its tests; where the interpreter or something it needs is not there, says so and is
/// content.
pub(crate) fn test() -> Result<(), String> {
    let Some(python) = interpreter() else {
        say(&format!(
            "the Python package is not tested: there is no Python 3.11 or later with {NEEDS}"
        ));
        return Ok(());
    };
    let (wheels, folder) = (root().join("target/wheels"), root().join("target/python"));
    empty(&wheels)?;
    let wheel = wheels.join(build_wheel(&wheels)?);
    let mut install = Command::new(&python);
    install.args(["-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--upgrade"]);
    call(install.arg("--target").arg(&folder).arg(wheel))?;
    let folder = std::path::absolute(&folder).map_err(|error| format!("target/python: {error}"))?;
    let mut tests = Command::new(&python);
    tests.args(["-m", "pytest", "crates/tress-python/tests"]).env("PYTHONPATH", &folder);
    call(tests.current_dir(root()))
}

/// `PYTHON`, or `python3`, if it has what is needed.
fn interpreter() -> Option<OsString> {
    let python = env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let check = format!("import sys, {NEEDS}; sys.exit(sys.version_info < (3, 11))");
    let status = Command::new(&python)
        .args(["-c", &check])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    status.is_ok_and(|status| status.success()).then_some(python)
}

fn call(command: &mut Command) -> Result<(), String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let status = command.status().map_err(|error| format!("{name} does not start: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{name} failed: {command:?}")) }
}
