//! Measurements of the project, and the files it makes for itself.
//!
//! Run as `cargo xtask bench`, `cargo xtask fixtures` and `cargo xtask pictures`.

mod fixtures;
mod grooms;
mod metric;
mod pictures;
mod process;
mod suites;

use std::process::ExitCode;

fn main() -> ExitCode {
    let mut args = std::env::args().skip(1);
    let task = args.next().unwrap_or_default();
    let rest: Vec<String> = args.collect();
    let outcome = match task.as_str() {
        "bench" => suites::run(&rest),
        "fixtures" => fixtures::make(),
        "pictures" => pictures::make(&rest),
        other => Err(format!("no task named {other:?}; see cargo xtask help").into()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            metric::say(&format!("error: {error}"));
            ExitCode::FAILURE
        }
    }
}

/// What a task ends with.
type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;
