//! Errors as exceptions: `TressError` for what tress refuses, Python's own for the rest.

use std::io;
use std::path::Path;

use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tress::io::{EncodeError, ReadError, WriteError};

create_exception!(
    tress,
    TressError,
    PyValueError,
    "What tress refuses: arrays that are no groom, options without a meaning, files that hold none.

The message is one line that says which file, strand or option, and what was expected."
);

/// The exception for an error of the library.
pub(crate) fn refused(error: impl std::error::Error) -> PyErr {
    TressError::new_err(error.to_string())
}

/// The exception for a file that is not read: `FileNotFoundError` and its like where the system
/// says no, `TressError` where the contents do.
pub(crate) fn not_read(error: ReadError) -> PyErr {
    let message = error.to_string();
    match error {
        ReadError::Open { path, source } => system(&source, &path, message),
        _ => TressError::new_err(message),
    }
}

/// The exception for a file that is not written.
pub(crate) fn not_written(error: WriteError) -> PyErr {
    let message = error.to_string();
    match error {
        WriteError::Encode { path, source: EncodeError::Io(source) } => {
            system(&source, &path, message)
        }
        _ => TressError::new_err(message),
    }
}

/// Python's own exception of a system's error: with its number and the file, where it has one.
fn system(error: &io::Error, path: &Path, message: String) -> PyErr {
    match error.raw_os_error() {
        Some(number) => {
            let words = error.to_string();
            let words = words.split(" (os error").next().unwrap_or_default().to_owned();
            pyo3::exceptions::PyOSError::new_err((number, words, path.to_path_buf()))
        }
        None => io::Error::new(error.kind(), message).into(),
    }
}
