//! Lines, words and numbers of text files, as bytes: no line is copied and none need be UTF-8.

use std::io::{self, BufRead};

use crate::{ParseError, Place, Problem};

/// Lines of a stream, read one by one into the same buffer.
pub(crate) struct Lines<R> {
    stream: R,
    line: Vec<u8>,
    number: u64,
}

impl<R: BufRead> Lines<R> {
    pub(crate) fn new(stream: R) -> Self {
        Self { stream, line: Vec::new(), number: 0 }
    }

    /// The lines that follow so many others.
    pub(crate) fn after(stream: R, lines: u64) -> Self {
        Self { number: lines, ..Self::new(stream) }
    }

    /// The next line that is not blank; `None` at the end of the stream.
    pub(crate) fn next_written(&mut self) -> Result<Option<&[u8]>, ParseError> {
        loop {
            // Borrowed again below: a line returned from a loop would stay borrowed in it.
            match self.next()? {
                None => return Ok(None),
                Some([]) => {}
                Some(_) => return Ok(Some(trimmed(&self.line))),
            }
        }
    }

    /// The next line without its end, LF or CR LF; `None` at the end of the stream.
    fn next(&mut self) -> Result<Option<&[u8]>, ParseError> {
        self.line.clear();
        self.append().map_err(|error| Problem::Io(error).at(Place::Line(self.number + 1)))?;
        if self.line.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        Ok(Some(trimmed(&self.line)))
    }

    fn append(&mut self) -> io::Result<usize> {
        self.stream.read_until(b'\n', &mut self.line)
    }

    /// The next statement: as [`next`](Self::next), but a backslash at the end of a line joins the
    /// line after it. The number is the first line's, from 1.
    pub(crate) fn next_statement(&mut self) -> Result<Option<(u64, &[u8])>, ParseError> {
        self.line.clear();
        let first = self.number + 1;
        loop {
            let before = self.line.len();
            let read = self.append();
            let read = read.map_err(|error| Problem::Io(error).at(Place::Line(self.number + 1)))?;
            if read == 0 {
                break;
            }
            self.number += 1;
            let end = trimmed(&self.line[before..]).len() + before;
            if !self.line[before..end].ends_with(b"\\") {
                break;
            }
            self.line.truncate(end - 1);
            self.line.push(b' ');
        }
        let ended = self.line.is_empty();
        Ok((!ended).then(|| (first, trimmed(&self.line))))
    }

    /// The line read last, from 1.
    pub(crate) fn place(&self) -> Place {
        Place::Line(self.number)
    }
}

fn trimmed(line: &[u8]) -> &[u8] {
    line.trim_ascii_end()
}

/// The words of a line.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A number, in any of the spellings that programs print; not-a-number and infinity are numbers.
pub(crate) fn number(word: &[u8]) -> Result<f64, Problem> {
    let text = std::str::from_utf8(word).ok();
    text.and_then(|text| text.parse().ok())
        .or_else(|| not_finite(word))
        .ok_or_else(|| Problem::unexpected("a number", quoted(word)))
}

/// Infinity and not-a-number as C libraries print them: `-1.#INF`, `1.#QNAN`, `-nan(ind)`.
fn not_finite(word: &[u8]) -> Option<f64> {
    let negative = word.starts_with(b"-");
    let bare = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
    let is = |prefix: &[u8]| {
        bare.get(..prefix.len()).is_some_and(|start| start.eq_ignore_ascii_case(prefix))
    };
    if is(b"1.#INF") {
        return Some(if negative { f64::NEG_INFINITY } else { f64::INFINITY });
    }
    let spelled = [&b"1.#QNAN"[..], b"1.#SNAN", b"1.#IND", b"nan("];
    spelled.into_iter().any(is).then_some(f64::NAN)
}

/// A whole number.
pub(crate) fn integer<T: std::str::FromStr>(word: &[u8], what: &str) -> Result<T, Problem> {
    let text = std::str::from_utf8(word).ok();
    text.and_then(|text| text.parse().ok()).ok_or_else(|| Problem::unexpected(what, quoted(word)))
}

/// The next three words as numbers.
pub(crate) fn point<'a>(
    words: &mut impl Iterator<Item = &'a [u8]>,
) -> Result<glam::DVec3, Problem> {
    let mut coordinate = || match words.next() {
        Some(word) => number(word),
        None => Err(Problem::unexpected("three coordinates", "fewer")),
    };
    Ok(glam::DVec3::new(coordinate()?, coordinate()?, coordinate()?))
}

/// A word in quotes, cut where it is too long to print.
pub(crate) fn quoted(word: &[u8]) -> String {
    let (shown, more) = if word.len() <= 40 { (word, "") } else { (&word[..40], "...") };
    format!("\"{}{more}\"", shown.escape_ascii())
}

/// A number in the fewest digits that read back as the same number.
pub(crate) fn write_number(out: &mut impl io::Write, value: f64) -> io::Result<()> {
    let size = value.abs();
    // Beyond these, zeros outnumber digits.
    if value == 0.0 || !value.is_finite() || (1e-5..1e16).contains(&size) {
        write!(out, "{value}")
    } else {
        write!(out, "{value:e}")
    }
}

/// The same number for a message.
pub(crate) fn printed(value: f64) -> String {
    let mut text = Vec::new();
    // Memory takes all that is written to it.
    let _ = write_number(&mut text, value);
    String::from_utf8_lossy(&text).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_every_spelling() {
        for (word, value) in [
            ("1", 1.0),
            ("-2.5e-3", -0.0025),
            ("+.5", 0.5),
            ("inf", f64::INFINITY),
            ("-Infinity", f64::NEG_INFINITY),
            ("-1.#INF", f64::NEG_INFINITY),
            ("1.#INF00", f64::INFINITY),
        ] {
            assert_eq!(number(word.as_bytes()).ok(), Some(value), "{word}");
        }
        for word in ["nan", "NaN", "-nan", "-nan(ind)", "1.#QNAN", "-1.#IND00", "1.#SNAN"] {
            assert!(number(word.as_bytes()).is_ok_and(f64::is_nan), "{word}");
        }
        for word in ["", "1,5", "0x10", "1.0f", "--1", "1.#", "\u{ff11}"] {
            assert!(number(word.as_bytes()).is_err(), "{word}");
        }
    }

    #[test]
    fn statements_span_lines_and_know_where_they_began() {
        let text = b"a b\r\n\nl 1 \\\r\n2\\\n 3\nlast" as &[u8];
        let mut lines = Lines::new(text);
        let mut statements = Vec::new();
        while let Some((line, statement)) = lines.next_statement().unwrap() {
            statements.push((line, words(statement).map(quoted).collect::<String>()));
        }
        let expected = [(1, "\"a\"\"b\""), (2, ""), (3, "\"l\"\"1\"\"2\"\"3\""), (6, "\"last\"")];
        assert_eq!(statements, expected.map(|(line, text)| (line, text.to_owned())));
    }

    #[test]
    fn written_numbers_read_back_bit_for_bit() {
        for value in [0.0, -0.0, 0.1, 1e300, -1e-300, 5e-324, f64::MAX, 123456.789, 1e16] {
            let mut text = Vec::new();
            write_number(&mut text, value).unwrap();
            assert!(text.len() < 25, "{value}");
            assert_eq!(number(&text).map(f64::to_bits).ok(), Some(value.to_bits()));
        }
    }
}
