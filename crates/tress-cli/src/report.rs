//! What a command did: lines for people, or one JSON object.

use std::fmt::Display;
use std::io::{self, Write};

use serde::Serialize;
use serde_json::{Map, Value};
use tress::analysis::Quantiles;

use crate::args::Everywhere;
use crate::failure::Failure;

/// Values by name for programs, and lines for people.
#[derive(Default)]
pub(crate) struct Report {
    json: Map<String, Value>,
    lines: Vec<String>,
}

impl Report {
    /// Sets a value that programs see.
    pub(crate) fn set(&mut self, name: &str, value: impl Serialize) {
        let value = serde_json::to_value(value).unwrap_or(Value::Null);
        self.json.insert(name.into(), value);
    }

    /// All values that programs see.
    pub(crate) fn json(&self) -> &Map<String, Value> {
        &self.json
    }

    /// Has programs see this value alone.
    pub(crate) fn replace_json(&mut self, name: &str, value: impl Serialize) {
        self.json.clear();
        self.set(name, value);
    }

    /// Adds a line that people see.
    pub(crate) fn line(&mut self, line: impl Into<String>) {
        self.lines.push(line.into());
    }

    /// Adds a line of a name and what is to be said of it.
    pub(crate) fn say(&mut self, name: &str, what: impl Display) {
        self.lines.push(format!("{name:<13} {what}"));
    }

    /// Prints to standard output; a reader who has seen enough is no failure.
    pub(crate) fn print(&self, everywhere: &Everywhere) -> Result<(), Failure> {
        let text = if everywhere.json {
            serde_json::to_string_pretty(&self.json)? + "\n"
        } else if everywhere.quiet {
            return Ok(());
        } else {
            self.lines.iter().map(|line| format!("{line}\n")).collect()
        };
        match io::stdout().write_all(text.as_bytes()) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error.into()),
            _ => Ok(()),
        }
    }
}

/// Four significant digits, without an exponent where a person can do without.
pub(crate) fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    if !(1e-4..1e7).contains(&size) {
        return format!("{x:.3e}");
    }
    // A number below ten million has at most seven digits before the point.
    #[expect(clippy::cast_possible_truncation, reason = "between -4 and 7")]
    let digits = (3 - size.log10().floor() as i32).max(0);
    let text = format!("{x:.*}", digits.unsigned_abs() as usize);
    match text.split_once('.') {
        Some(_) => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => text,
    }
}

/// A whole number with its thousands parted.
pub(crate) fn count(n: usize) -> String {
    let digits = n.to_string();
    let mut parted = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if 0 < i && (digits.len() - i).is_multiple_of(3) {
            parted.push(',');
        }
        parted.push(digit);
    }
    parted
}

/// Least, median and greatest in words.
pub(crate) fn spread(quantiles: Option<Quantiles>, unit: &str) -> String {
    match quantiles {
        None => "none".into(),
        Some(q) if q.min.to_bits() == q.max.to_bits() => format!("{}{unit}", short(q.median)),
        Some(q) => format!("{}{unit} ({} to {})", short(q.median), short(q.min), short(q.max)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_not_cut() {
        let cases = [
            (0.0, "0"),
            (76.94321, "76.94"),
            (0.000123456, "0.0001235"),
            (1234567.0, "1234567"),
            (-0.5, "-0.5"),
            (100.0, "100"),
            (1e-9, "1.000e-9"),
            (9.9999, "10"),
            (f64::NAN, "NaN"),
        ];
        for (x, text) in cases {
            assert_eq!(short(x), text);
        }
        assert_eq!([0, 999, 1000, 1234567].map(count), ["0", "999", "1,000", "1,234,567"]);
    }
}
