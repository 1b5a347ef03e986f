//! A folder with a groom in it, and the program run there.

use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;
use tress::geometry::Groom;
use tress::io::{Model, WriteOptions};
use tress_fixtures::{PatchOptions, coily_patch};

/// A folder with a groom in it, gone when the test ends.
pub(crate) struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder for temporary files");
        let options = PatchOptions { wisps: 4, strands_per_wisp: 5, ..PatchOptions::default() };
        let bench = Self { folder };
        bench.write("groom.obj", &coily_patch(&options, 1));
        bench
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, groom: &Groom) {
        tress::io::write(self.path(name), groom, &WriteOptions::default()).expect("a good groom");
    }

    pub(crate) fn groom(&self, name: &str) -> Groom {
        match tress::io::read(self.path(name)).expect("a readable file") {
            Model::Polylines(groom) => groom,
            Model::Helices(_) => panic!("{name} holds super-helices"),
        }
    }

    /// Runs `tress` in the folder.
    pub(crate) fn run(&self, line: &str) -> Output {
        Command::new(env!("CARGO_BIN_EXE_tress"))
            .args(line.split_whitespace())
            .current_dir(self.folder.path())
            .output()
            .expect("the program starts")
    }

    /// Runs `tress`, which must succeed without a word on standard error.
    pub(crate) fn done(&self, line: &str) -> String {
        let output = self.run(line);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success() && errors.is_empty(), "tress {line}: {errors}");
        String::from_utf8(output.stdout).expect("reports are text")
    }

    /// The report for programs of a run that must succeed.
    pub(crate) fn json(&self, line: &str) -> Value {
        let text = self.done(&format!("{line} --json"));
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("tress {line}: {error}\n{text}"))
    }

    /// Runs `tress`, which must fail with this status and one line on standard error.
    pub(crate) fn fails(&self, line: &str, status: i32) -> String {
        let output = self.run(line);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(status), "tress {line}: {errors}");
        assert!(output.stdout.is_empty(), "tress {line} printed a report although it failed");
        assert!(!errors.contains("panicked"), "tress {line}: {errors}");
        if status == 1 {
            assert_eq!(errors.trim_end().lines().count(), 1, "tress {line}: {errors}");
        }
        errors
    }
}
