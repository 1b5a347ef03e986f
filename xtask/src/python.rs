//! The Python package, built, installed into a folder of its own and tested.

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::tools::{absolute, broken, call, empty, python};
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
    let wheel = wheels.join(build_wheel(&wheels)?);
    empty(&folder)?;
    let mut install = Command::new(&python);
    install.args(["-m", "pip", "install", "--quiet", "--no-index", "--no-deps"]);
    call(install.arg("--target").arg(&folder).arg(wheel), "pip install")?;
    let mut tests = Command::new(&python);
    tests.args(["-m", "pytest", "crates/tress-python/tests"]);
    tests.env("PYTHONPATH", absolute(&folder)?).current_dir(root());
    call(&mut tests, "pytest crates/tress-python/tests")
}

/// Builds the wheel of the package with maturin into a folder, which is emptied; gives its file
/// name.
pub(crate) fn build_wheel(wheels: &Path) -> Result<String, String> {
    empty(wheels)?;
    let mut maturin = Command::new(python());
    maturin.args(["-m", "maturin", "build", "--release", "--out"]).arg(absolute(wheels)?);
    call(maturin.current_dir(root()), "maturin (pip install maturin)")?;
    let mut found = fs::read_dir(wheels).map_err(|error| broken(wheels, &error))?;
    let wheel = found.find_map(|entry| entry.ok()?.file_name().into_string().ok());
    wheel.ok_or_else(|| format!("maturin left no wheel in {}", wheels.display()))
}

/// The interpreter, if it has what is needed.
fn interpreter() -> Option<OsString> {
    let check = format!("import sys, {NEEDS}; sys.exit(sys.version_info < (3, 11))");
    let status = Command::new(python())
        .args(["-c", &check])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    status.is_ok_and(|status| status.success()).then(python)
}
