//! Why a command did not do what it was told, in one line.

use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::process::ExitCode;
use std::sync::Mutex;

use anstyle::{AnsiColor, Style};

/// What goes to standard error, and with which exit status.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command line asks for what cannot be: exit status 2.
    Usage(String),
    /// Anything else: exit status 1.
    Failed(String),
}

impl Failure {
    /// Prints the line, coloured on terminals.
    pub(crate) fn print(&self) {
        let (Self::Usage(message) | Self::Failed(message)) = self;
        print_error(message);
    }

    /// The same, said of a frame of a sequence.
    pub(crate) fn on_frame(self, frame: u32) -> Self {
        match self {
            Self::Usage(message) => Self::Usage(message),
            Self::Failed(message) => Self::Failed(format!("frame {frame}: {message}")),
        }
    }

    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::Usage(_) => ExitCode::from(2),
            Self::Failed(_) => ExitCode::FAILURE,
        }
    }
}

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Failed(error.to_string())
    }
}

/// Runs the program so that a bug in it ends in one line too.
///
/// Readers of files made by others are allowed to panic and are caught below; what they print is of
/// no use to anyone.
pub(crate) fn caught(run: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
    static LAST: Mutex<String> = Mutex::new(String::new());
    set_hook(Box::new(|info| {
        if let Ok(mut last) = LAST.lock() {
            *last = info.to_string().replace('\n', " ");
        }
    }));
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| {
        let last = LAST.lock().map(|last| last.clone()).unwrap_or_default();
        Err(Failure::Failed(format!("this is a bug in tress, please report it: {last}")))
    })
}

fn print_error(message: &str) {
    let red = Style::new().bold().fg_color(Some(AnsiColor::Red.into()));
    anstream::eprintln!("{red}error:{red:#} {message}");
}
