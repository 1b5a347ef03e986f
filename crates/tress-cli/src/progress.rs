//! What is going on, on standard error, when someone watches.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::Everywhere;

/// The stages of a command, shown while they last and gone when it ends.
///
/// A stage that knows how much there is to do shows a bar and the time left, others that they go
/// on.
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// Silent when asked to be, or when nobody watches.
    pub(crate) fn new(everywhere: &Everywhere) -> Self {
        let bar = ProgressBar::no_length();
        if everywhere.quiet || !std::io::stderr().is_terminal() {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        bar.enable_steady_tick(Duration::from_millis(100));
        Self { bar }
    }

    /// The stage before is done; this one begins.
    pub(crate) fn stage(&self, message: impl Into<String>) {
        self.begin("{spinner} {msg} [{elapsed}]", message);
    }

    /// The stage before is done; this one begins, in which `total` things are to be done.
    pub(crate) fn stage_of(&self, message: impl Into<String>, total: usize) {
        self.begin("{spinner} {bar:24} {percent:>3} % {msg} [{elapsed}, {eta} to go]", message);
        self.bar.reset();
        self.bar.set_length(total as u64);
    }

    /// So many more of them are done.
    pub(crate) fn add(&self, more: usize) {
        self.bar.inc(more as u64);
    }

    /// What the stage is doing now.
    pub(crate) fn say(&self, message: impl Into<String>) {
        self.bar.set_message(message.into());
    }

    fn begin(&self, template: &str, message: impl Into<String>) {
        let style = ProgressStyle::with_template(template);
        self.bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        self.bar.set_message(message.into());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
