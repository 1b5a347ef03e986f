//! Other programs and the file system, with errors that say what was tried.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

/// The interpreter of Python that builds and tests: `PYTHON`, or `python3`.
pub(crate) fn python() -> OsString {
    env::var_os("PYTHON").unwrap_or_else(|| "python3".into())
}

/// Runs a program, which must succeed; `name` is what it is called in errors.
pub(crate) fn call(command: &mut Command, name: &str) -> Result<(), String> {
    let status = command.status().map_err(|error| format!("{name} does not start: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{name} failed")) }
}

/// Makes a folder with nothing in it.
pub(crate) fn empty(folder: &Path) -> Result<(), String> {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| broken(folder, &error))?;
    }
    fs::create_dir_all(folder).map_err(|error| broken(folder, &error))
}

/// The path from the root of the file system, which a program started elsewhere finds too.
pub(crate) fn absolute(path: &Path) -> Result<PathBuf, String> {
    std::path::absolute(path).map_err(|error| broken(path, &error))
}

/// An error of the file system.
pub(crate) fn broken(path: &Path, error: &io::Error) -> String {
    format!("{}: {error}", path.display())
}
