//! Long work without the interpreter's lock, and someone told how far it is.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

/// How often progress is told: a person sees no finer steps, and a call costs nothing by then.
const TICK: Duration = Duration::from_millis(20);

/// Does the work with the interpreter's lock released. Where there is someone to tell, the work
/// runs on a thread of its own and counts what it has done of `total`; the calling thread, which
/// owns windows and signals, calls `progress` with the share between 0 and 1.
///
/// An exception from `progress`, or Ctrl-C, is raised once the work is over: strands in the middle
/// of being worked on cannot be left.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    total: usize,
    work: impl FnOnce(&AtomicUsize) -> T + Send,
) -> PyResult<T> {
    let done = AtomicUsize::new(0);
    let Some(progress) = progress else { return Ok(py.detach(|| work(&done))) };
    let tell = || {
        let share = done.load(Ordering::Relaxed) as f64 / total.max(1) as f64;
        progress.call1((share.min(1.0),))?;
        py.check_signals()
    };
    thread::scope(|scope| {
        let worker = scope.spawn(|| work(&done));
        let mut outcome = Ok(());
        while !worker.is_finished() {
            py.detach(|| thread::sleep(TICK));
            if outcome.is_ok() {
                outcome = tell();
            }
        }
        let result = worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        outcome?;
        progress.call1((1.0,))?;
        Ok(result)
    })
}
