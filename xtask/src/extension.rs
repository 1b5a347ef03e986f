//! The Blender extension: the add-on's modules and the wheel of the Python package in one archive.

use std::ffi::{OsStr, OsString};
use std::path::Path;
use std::process::{Command, Stdio};
use std::{env, fs};

use crate::python::build_wheel;
use crate::tools::{absolute, broken, call, empty, python};
use crate::{root, say};

/// Builds `target/extension/tress-VERSION-PLATFORM.zip`, and has Blender validate and test it where
/// there is one: `blender` on the path validates; the interpreters that `BLENDER_PYTHON` names,
/// separated as in `PATH`, which have `bpy`, validate and, if they have pytest, test.
pub(crate) fn run() -> Result<(), String> {
    let folder = root().join("target/extension");
    let stage = folder.join("tress");
    let wheels = stage.join("wheels");
    empty(&stage)?;
    let wheel = build_wheel(&wheels)?;
    copy_modules(&root().join("blender/addon"), &stage)?;
    copy(&root().join("LICENSE"), &stage.join("LICENSE"))?;
    let (platform, tag) = platform(&wheel)?;
    let version = write_manifest(&stage, &wheel, platform)?;
    let archive = folder.join(format!("tress-{version}-{tag}.zip"));
    zip(&stage, &archive)?;
    say(&format!("{}", archive.display()));
    validate(&archive)
}

/// Copies the Python modules of the add-on.
fn copy_modules(from: &Path, to: &Path) -> Result<(), String> {
    for entry in fs::read_dir(from).map_err(|error| broken(from, &error))? {
        let path = entry.map_err(|error| broken(from, &error))?.path();
        if path.extension() == Some(OsStr::new("py")) {
            copy(&path, &to.join(path.file_name().unwrap_or_default()))?;
        }
    }
    Ok(())
}

/// Blender's name of the platform that a wheel is for, and the same for file names.
fn platform(wheel: &str) -> Result<(&'static str, &'static str), String> {
    let known = [
        ("linux", "x86_64", "linux-x64", "linux_x64"),
        ("linux", "aarch64", "linux-arm64", "linux_arm64"),
        ("macosx", "arm64", "macos-arm64", "macos_arm64"),
        ("macosx", "x86_64", "macos-x64", "macos_x64"),
        ("win", "amd64", "windows-x64", "windows_x64"),
        ("win", "arm64", "windows-arm64", "windows_arm64"),
    ];
    let stem = wheel.trim_end_matches(".whl");
    let of_wheel = |(system, machine, ..): &&(&str, &str, &str, &str)| {
        let tag = stem.rsplit('-').next().unwrap_or_default();
        (tag.starts_with(system) || tag.starts_with(&format!("many{system}")))
            && tag.ends_with(machine)
    };
    let found = known.iter().find(of_wheel).map(|&(_, _, name, tag)| (name, tag));
    found.ok_or_else(|| format!("{wheel}: Blender knows no such platform"))
}

/// The manifest, with the wheel and its platform; gives the extension's version.
fn write_manifest(stage: &Path, wheel: &str, platform: &str) -> Result<String, String> {
    let source = root().join("blender/addon/blender_manifest.toml");
    let text = fs::read_to_string(&source).map_err(|error| broken(&source, &error))?;
    let version = text.lines().find_map(|line| line.strip_prefix("version = "));
    let version = version.ok_or("blender_manifest.toml names no version")?.trim_matches('"');
    let (head, tables) = text.split_once("\n[").ok_or("blender_manifest.toml has no table")?;
    let lines = format!("platforms = [\"{platform}\"]\nwheels = [\"./wheels/{wheel}\"]\n");
    let target = stage.join("blender_manifest.toml");
    fs::write(&target, format!("{head}\n{lines}\n[{tables}"))
        .map_err(|error| broken(&target, &error))?;
    Ok(version.to_owned())
}

/// Packs everything in a folder into an archive.
fn zip(stage: &Path, archive: &Path) -> Result<(), String> {
    let mut names = Vec::new();
    for entry in fs::read_dir(stage).map_err(|error| broken(stage, &error))? {
        names.push(entry.map_err(|error| broken(stage, &error))?.file_name());
    }
    names.sort();
    let archive = absolute(archive)?;
    let mut command = Command::new(python());
    command.args(["-m", "zipfile", "-c"]).arg(archive).args(names);
    call(command.current_dir(stage), "python3 -m zipfile")
}

/// Blender's own opinion of the archive, where there is a Blender to ask.
fn validate(archive: &Path) -> Result<(), String> {
    let archive = absolute(archive)?;
    if let Some(interpreters) = env::var_os("BLENDER_PYTHON") {
        for python in env::split_paths(&interpreters).map(OsString::from) {
            let mut command = Command::new(&python);
            command.args(["-c", VALIDATE]).arg(&archive);
            call(&mut command, "Blender's extension command")?;
            test(&python, &archive)?;
        }
        return Ok(());
    }
    let mut command = Command::new("blender");
    command.args(["--command", "extension", "validate"]).arg(archive);
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err("Blender does not accept the extension".into()),
        Err(_) => {
            say("not validated: there is no `blender`, and BLENDER_PYTHON names no interpreter");
            Ok(())
        }
    }
}

/// Runs every operator of the archive in an interpreter that has `bpy`.
fn test(python: &OsStr, archive: &Path) -> Result<(), String> {
    let mut check = Command::new(python);
    check.args(["-c", "import pytest"]).stderr(Stdio::null());
    if !check.status().is_ok_and(|status| status.success()) {
        say(&format!("not tested: {} has no pytest", python.display()));
        return Ok(());
    }
    let mut tests = Command::new(python);
    tests.args(["-m", "pytest", "blender/tests"]).env("TRESS_EXTENSION", archive);
    call(tests.current_dir(root()), "pytest blender/tests")
}

/// What `blender --command extension validate` runs, in an interpreter that has `bpy`.
const VALIDATE: &str = "
import pathlib, subprocess, sys
import bpy
scripts = pathlib.Path(bpy.utils.system_resource('SCRIPTS'))
command = scripts / 'addons_core' / 'bl_pkg' / 'cli' / 'blender_ext.py'
sys.exit(subprocess.run([sys.executable, str(command), 'validate', sys.argv[1]]).returncode)
";

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    fs::copy(from, to).map(drop).map_err(|error| broken(from, &error))
}

#[cfg(test)]
mod tests {
    use super::platform;

    #[test]
    fn platforms_are_read_off_wheels() {
        let wheel = "tress-0.1.0-cp311-abi3-manylinux_2_34_x86_64.whl";
        assert_eq!(platform(wheel), Ok(("linux-x64", "linux_x64")));
        let mac = "tress-0.1.0-cp311-abi3-macosx_11_0_arm64.whl";
        assert_eq!(platform(mac), Ok(("macos-arm64", "macos_arm64")));
        assert!(platform("tress-0.1.0-py3-none-any.whl").is_err());
    }
}
