//! Calls into openusd, which was not made for broken files.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::{ParseError, Place, Problem};

/// Runs `read`, and makes a panic in it an error.
///
/// openusd 0.6 indexes by numbers from the file, and panics where data is compressed in several
/// chunks. What can be checked before is checked before it is called; this holds what is left.
/// Nothing that `read` touches outlives it, so that no state is seen half changed.
pub(super) fn no_panic<T>(read: impl FnOnce() -> Result<T, ParseError>) -> Result<T, ParseError> {
    catch_unwind(AssertUnwindSafe(read)).unwrap_or_else(|panic| {
        let message = panic
            .downcast_ref::<String>()
            .map(String::as_str)
            .or_else(|| panic.downcast_ref::<&str>().copied())
            .unwrap_or("no reason given");
        let message = format!("the USD library cannot make sense of the file ({message})");
        Err(Problem::Unsupported(one_line(&message)).at(Place::File))
    })
}

/// Letters of a message that are passed on. openusd quotes what it does not understand, which may
/// be the whole file.
const LONGEST: usize = 200;

/// The message on one line, not too long.
pub(super) fn one_line(message: &str) -> String {
    let line = message.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} ...", &line[..end]),
        None => line,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error_of_one_line() {
        let error = no_panic::<()>(|| panic!("index {} of 3\nis odd", 7));
        let message = error.expect_err("the panic").to_string();
        assert_eq!(message, "the USD library cannot make sense of the file (index 7 of 3 is odd)");
        assert_eq!(no_panic(|| Ok(3)).expect("no panic"), 3);
        assert_eq!(one_line(&"\u{e9}".repeat(1000)).chars().count(), LONGEST + 4);
    }
}
