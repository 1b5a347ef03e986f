//! The program `tress`: parse the command line, call the layers, report.
//!
//! Exit status: 0 done, 2 wrong usage, 1 anything else, with one line on standard error. Standard
//! output holds the report and nothing else; progress goes to standard error when that is a
//! terminal.

mod animation;
mod args;
mod commands;
mod failure;
mod options;
mod progress;
mod report;
mod sequence;
mod source;
mod target;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

use crate::args::Cli;
use crate::failure::Failure;
use crate::sequence::Sequence;

fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args_os().collect();
    match failure::caught(|| run(arguments)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.print();
            failure.exit_code()
        }
    }
}

fn run(arguments: Vec<OsString>) -> Result<(), Failure> {
    let sequence = Sequence::of(arguments.clone());
    let cli = sequence.as_ref().map_or_else(Cli::parse, Sequence::parse);
    if let Some(threads) = cli.everywhere.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|error| Failure::Failed(format!("no {threads} threads: {error}")))?;
    }
    let started = std::time::Instant::now();
    let mut report = match sequence {
        _ if cli.everywhere.animated => animation::run(arguments, &cli)?,
        Some(sequence) => sequence.run(&cli)?,
        None => commands::run(&cli.command, &cli.everywhere)?,
    };
    report.set("seconds", (started.elapsed().as_secs_f64() * 1e3).round() / 1e3);
    report.print(&cli.everywhere)
}
