//! The body of a PLY file, row by row.

use super::header::{Element, Encoding, Header, Kind, Property};
use crate::binary::Bytes;
use crate::text::{Lines, number, printed, words};
use crate::{ParseError, Place, Problem};

/// Calls `each` with every row: which element it is of, and its numbers, 0 in place of lists.
pub(super) fn for_each_row(
    header: &Header,
    file: &[u8],
    mut each: impl FnMut(usize, &[f64]),
) -> Result<(), ParseError> {
    for_each_row_and_list(header, file, |element, row, _| each(element, row))
}

/// The same with the items of the row's lists as well, list after list.
pub(super) fn for_each_row_and_list(
    header: &Header,
    file: &[u8],
    each: impl FnMut(usize, &[f64], &[f64]),
) -> Result<(), ParseError> {
    check_room(header, file.len() - header.bytes)?;
    match header.encoding {
        Encoding::Ascii => ascii(header, &file[header.bytes..], each),
        _ => binary(header, file, each),
    }
}

/// An error unless the rows that the header counts fit into so many bytes.
fn check_room(header: &Header, left: usize) -> Result<(), ParseError> {
    let mut needed = 0_usize;
    for element in &header.elements {
        let row = element.row_bytes(header.encoding);
        if row == 0 && 0 < element.rows {
            let problem = Problem::unexpected("properties", "none");
            return Err(problem.at(Place::Part(format!("element {}", element.name))));
        }
        needed = needed.saturating_add(row.saturating_mul(element.rows));
    }
    // The last line of an ascii file may lack its end.
    let slack = usize::from(header.encoding == Encoding::Ascii);
    if needed <= left + slack {
        return Ok(());
    }
    let problem = Problem::Truncated { needed: needed as u64, left: left as u64 };
    Err(problem.at_byte(header.bytes))
}

fn ascii(
    header: &Header,
    body: &[u8],
    mut each: impl FnMut(usize, &[f64], &[f64]),
) -> Result<(), ParseError> {
    let mut lines = Lines::after(body, header.lines);
    let (mut row, mut items) = (Vec::new(), Vec::new());
    for (i, element) in header.elements.iter().enumerate() {
        for _ in 0..element.rows {
            let Some(line) = lines.next_written()? else {
                let expected = format!("a row of element {}", element.name);
                return Err(Problem::unexpected(expected, "the end of the file").at(lines.place()));
            };
            let read = ascii_row(element, line, &mut row, &mut items);
            read.map_err(|problem| problem.at(lines.place()))?;
            each(i, &row, &items);
        }
    }
    if lines.next_written()?.is_some() {
        return Err(Problem::unexpected("the end of the file", "another line").at(lines.place()));
    }
    Ok(())
}

fn ascii_row(
    element: &Element,
    line: &[u8],
    row: &mut Vec<f64>,
    items: &mut Vec<f64>,
) -> Result<(), Problem> {
    let mut words = words(line);
    let mut next = || match words.next() {
        Some(word) => number(word),
        None => {
            let expected = format!("{} numbers", element.properties.len());
            Err(Problem::unexpected(expected, "fewer"))
        }
    };
    row.clear();
    items.clear();
    for property in &element.properties {
        let value = next()?;
        if property.list.is_none() {
            row.push(value);
            continue;
        }
        for _ in 0..list_length(value)? {
            items.push(next()?);
        }
        row.push(0.0);
    }
    match words.next() {
        Some(_) => {
            Err(Problem::unexpected(format!("{} numbers", element.properties.len()), "more"))
        }
        None => Ok(()),
    }
}

/// The length of a list, which the items that follow must bear out one by one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked just before")]
fn list_length(value: f64) -> Result<u64, Problem> {
    if value.fract() == 0.0 && (0.0..=4294967295.0).contains(&value) {
        return Ok(value as u64);
    }
    Err(Problem::unexpected("the length of a list", printed(value)))
}

fn binary(
    header: &Header,
    file: &[u8],
    mut each: impl FnMut(usize, &[f64], &[f64]),
) -> Result<(), ParseError> {
    let mut bytes = Bytes::new(file);
    bytes.items::<1>(header.bytes)?;
    let (mut row, mut items) = (Vec::new(), Vec::new());
    for (i, element) in header.elements.iter().enumerate() {
        for _ in 0..element.rows {
            row.clear();
            items.clear();
            for property in &element.properties {
                row.push(binary_value(property, header.encoding, &mut bytes, &mut items)?);
            }
            each(i, &row, &items);
        }
    }
    bytes.finish()
}

fn binary_value(
    property: &Property,
    encoding: Encoding,
    bytes: &mut Bytes<'_>,
    items: &mut Vec<f64>,
) -> Result<f64, ParseError> {
    let Some(count) = property.list else { return scalar(property.kind, encoding, bytes) };
    let at = bytes.position();
    let length = list_length(scalar(count, encoding, bytes)?);
    let length = length.map_err(|problem| problem.at_byte(at))?;
    let length = usize::try_from(length).unwrap_or(usize::MAX);
    bytes.expect(length, property.kind.size())?;
    for _ in 0..length {
        items.push(scalar(property.kind, encoding, bytes)?);
    }
    Ok(0.0)
}

fn scalar(kind: Kind, encoding: Encoding, bytes: &mut Bytes<'_>) -> Result<f64, ParseError> {
    /// The next bytes, least significant first.
    fn item<const N: usize>(
        encoding: Encoding,
        bytes: &mut Bytes<'_>,
    ) -> Result<[u8; N], ParseError> {
        let mut item = bytes.item::<N>()?;
        if encoding == Encoding::BigEndian {
            item.reverse();
        }
        Ok(item)
    }
    Ok(match kind {
        Kind::I8 => i8::from_le_bytes(item(encoding, bytes)?).into(),
        Kind::U8 => u8::from_le_bytes(item(encoding, bytes)?).into(),
        Kind::I16 => i16::from_le_bytes(item(encoding, bytes)?).into(),
        Kind::U16 => u16::from_le_bytes(item(encoding, bytes)?).into(),
        Kind::I32 => i32::from_le_bytes(item(encoding, bytes)?).into(),
        Kind::U32 => u32::from_le_bytes(item(encoding, bytes)?).into(),
        Kind::F32 => f32::from_le_bytes(item(encoding, bytes)?).into(),
        Kind::F64 => f64::from_le_bytes(item(encoding, bytes)?),
    })
}
