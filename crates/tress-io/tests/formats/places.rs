//! Where files are written to: odd names, folders that may not be written, disks that are full.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::DVec3;
use tempfile::{TempDir, tempdir};
use tress_geometry::{Groom, Strands};
use tress_io::{Format, Frames, WriteError, WriteOptions, unreal, write, write_animation};

/// Formats that a groom of any strands can be written in.
const FORMATS: [&str; 8] = ["obj", "data", "bin", "ply", "npz", "usda", "usdc", "abc"];

/// Says on standard error why a test has nothing to do.
fn skip(why: &str) {
    let _ = writeln!(std::io::stderr(), "skipped: {why}");
}

/// Strands of at most 100 points, of numbers that no format can squeeze.
fn groom(points: usize) -> Groom {
    let points: Vec<DVec3> = (0..points).map(|i| DVec3::splat((i as f64).sin())).collect();
    let counts: Vec<usize> = points.chunks(100).map(<[DVec3]>::len).collect();
    Groom::new(Strands::from_counts(counts, points).expect("their own counts"))
}

/// What is in a folder.
fn names(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").file_name().into()).collect()
}

/// Every way to write, each to a file of its own in a folder.
fn write_all(folder: &Path, groom: &Groom, mut check: impl FnMut(&Path, Result<(), WriteError>)) {
    let options = WriteOptions::default();
    for format in FORMATS {
        let path = folder.join(format!("groom.{format}"));
        let written = write(&path, groom, &options).map(drop);
        check(&path, written);
    }
    let path = folder.join("unreal.abc");
    check(&path, unreal::write(&path, groom, &unreal::UnrealOptions::default()).map(drop));
    for format in ["abc", "usdc"] {
        let path = folder.join(format!("wind.{format}"));
        let grooms = (0..3).map(|_| Ok(groom.clone()));
        let written = write_animation(&path, Frames::default(), &options, grooms).map(drop);
        check(&path, written);
    }
}

#[test]
fn names_in_any_script_with_spaces_and_quotes() {
    let folder = tempdir().expect("a folder");
    for name in
        ["\u{9aea}\u{578b} of hers", "a'b\"c", "\u{e9}t\u{e9}\u{301}", "%04 {x}", "-o", "a.b.c"]
    {
        let inner = folder.path().join(name);
        fs::create_dir(&inner).expect("a folder of that name");
        for format in FORMATS {
            let path = inner.join(format!("{name}.{format}"));
            write(&path, &groom(3), &WriteOptions::default()).expect("any name");
            assert_eq!(Format::from_path(&path).map(Format::extension), Ok(format));
            if !format.starts_with("usd") {
                tress_io::read(&path).expect("any name");
            }
        }
    }
}

#[test]
fn a_folder_that_may_not_be_written_says_so() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempdir().expect("a folder");
    let locked = folder.path().join("locked");
    fs::create_dir(&locked).expect("a folder");
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).expect("our own folder");
    if fs::write(locked.join("probe"), "").is_ok() {
        return skip("whoever runs this may write everywhere");
    }
    write_all(&locked, &groom(3), |path, written| {
        let message = written.expect_err("a locked folder").to_string();
        assert_eq!(message, format!("{}: permission denied", path.display()));
    });
}

/// A disk of 64 KiB, gone when the test ends.
///
/// There is one at a time: a program that is just being started holds the files open that another
/// test writes, whose space is then not free yet.
struct SmallDisk(TempDir, #[expect(dead_code, reason = "it is held")] MutexGuard<'static, ()>);

static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

impl SmallDisk {
    fn new() -> Option<Self> {
        let alone = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = tempdir().expect("a folder");
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", "size=64k", "tmpfs"]).arg(folder.path());
        let mounted = mount.output().is_ok_and(|output| output.status.success());
        mounted.then_some(Self(folder, alone))
    }
}

impl SmallDisk {
    /// Whether nothing can be written to it any more.
    fn lock(&self) -> bool {
        let mut mount = Command::new("mount");
        mount.args(["-o", "remount,ro"]).arg(self.0.path());
        mount.output().is_ok_and(|output| output.status.success())
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        // Where it fails the folder stays, which harms nobody.
        let _ = Command::new("umount").arg(self.0.path()).output();
    }
}

#[test]
fn a_full_disk_leaves_the_old_file_and_nothing_else() {
    let Some(disk) = SmallDisk::new() else {
        return skip("no small disk can be mounted here");
    };
    let folder = disk.0.path();
    write_all(folder, &groom(20_000), |path, written| {
        let message = written.expect_err("more than fits").to_string();
        assert_eq!(message, format!("{}: no space is left on the disk", path.display()));
        assert!(names(folder).is_empty(), "{:?}", names(folder));
    });
    write_all(folder, &groom(10), |path, written| {
        written.expect("small enough");
        let old = fs::read(path).expect("the file");
        let large = write(path, &groom(20_000), &WriteOptions::default());
        assert!(large.is_err() && fs::read(path).expect("the file") == old);
        assert_eq!(names(folder).len(), 1);
        fs::remove_file(path).expect("our own file");
    });
}

#[test]
fn a_disk_that_can_only_be_read_keeps_its_files() {
    let disk = SmallDisk::new().filter(|disk| {
        write_all(disk.0.path(), &groom(3), |_, written| written.expect("small enough"));
        disk.lock()
    });
    let Some(disk) = disk else {
        return skip("no small disk can be mounted here");
    };
    let folder = disk.0.path();
    let (before, read) = (names(folder).len(), |path: &Path| fs::read(path).expect("the file"));
    write_all(folder, &groom(4), |path, written| {
        let old = read(path);
        let message = written.expect_err("nothing can be written").to_string();
        assert_eq!(message, format!("{}: the disk can only be read", path.display()));
        assert_eq!(read(path), old);
    });
    assert_eq!(names(folder).len(), before);
}
