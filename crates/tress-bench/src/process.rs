//! Whole processes: how long they take and how much memory they touch.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::Outcome;

/// What a process took.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taken {
    pub(crate) seconds: f64,
    /// Greatest resident memory, in bytes, where the system tells.
    pub(crate) peak: Option<f64>,
}

/// The program, which is built first.
pub(crate) fn program() -> Outcome<PathBuf> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let build = ["build", "--release", "--quiet", "--package", "tress-cli"];
    let status = Command::new(cargo).args(build).current_dir(crate::grooms::root()).status()?;
    if !status.success() {
        return Err("the program does not build".into());
    }
    let here = std::env::current_exe()?;
    let folder = here.parent().ok_or("this program lies in no folder")?;
    Ok(folder.join(format!("tress{}", std::env::consts::EXE_SUFFIX)))
}

/// Runs the program quietly, `times` over, and gives the run that was fastest.
pub(crate) fn best(program: &Path, args: &[&str], times: usize) -> Outcome<Taken> {
    let mut best: Option<Taken> = None;
    for _ in 0..times.max(1) {
        let taken = once(program, args)?;
        if best.is_none_or(|best| taken.seconds < best.seconds) {
            best = Some(taken);
        }
    }
    best.ok_or_else(|| "not run".into())
}

fn once(program: &Path, args: &[&str]) -> Outcome<Taken> {
    let started = Instant::now();
    let mut child = Command::new(program).args(args).arg("--quiet").stdin(Stdio::null()).spawn()?;
    let status_file = format!("/proc/{}/status", child.id());
    let mut peak = None;
    let status = loop {
        peak = high_water_mark(&status_file).or(peak);
        match child.try_wait()? {
            Some(status) => break status,
            None => std::thread::sleep(Duration::from_millis(1)),
        }
    };
    let seconds = started.elapsed().as_secs_f64();
    if !status.success() {
        return Err(format!("tress {} failed", args.join(" ")).into());
    }
    Ok(Taken { seconds, peak })
}

/// What `work` gives, and the bytes that this process held at most meanwhile beyond those that it
/// held before; none where the system does not tell.
pub(crate) fn held<T>(work: impl FnOnce() -> Outcome<T>) -> Outcome<(T, Option<f64>)> {
    const STATUS: &str = "/proc/self/status";
    // Linux sets the high-water mark back to what is held now.
    let reset = std::fs::write("/proc/self/clear_refs", "5").is_ok();
    let before = high_water_mark(STATUS).filter(|_| reset);
    let done = work()?;
    Ok((done, before.and_then(|before| Some(high_water_mark(STATUS)? - before))))
}

/// `VmHWM` of a process on Linux, in bytes.
fn high_water_mark(status_file: &str) -> Option<f64> {
    let status = std::fs::read_to_string(status_file).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024.0)
}
