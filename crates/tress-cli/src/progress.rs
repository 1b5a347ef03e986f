//! What is going on, on standard error, when someone watches.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::Everywhere;

/// The stages of a command, shown while they last and gone when it ends.
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// For a command of so many stages; silent when asked to be, or when nobody watches.
    pub(crate) fn new(stages: u64, everywhere: &Everywhere) -> Self {
        let bar = ProgressBar::new(stages);
        if everywhere.quiet || !std::io::stderr().is_terminal() {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        let style = ProgressStyle::with_template("{spinner} {bar:24} {msg} [{elapsed}]")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style);
        bar.enable_steady_tick(Duration::from_millis(100));
        Self(bar)
    }

    /// The stage before is done; this one begins.
    pub(crate) fn stage(&self, message: impl Into<String>) {
        if !self.0.message().is_empty() {
            self.0.inc(1);
        }
        self.0.set_message(message.into());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
