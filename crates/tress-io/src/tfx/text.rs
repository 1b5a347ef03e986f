//! `TressFX` 1 and 2: text.

use glam::DVec3;
use tress_geometry::{Column, Groom, names};

use crate::columns::misfit;
use crate::counts::Builder;
use crate::text::{Lines, integer, number, point, quoted, words};
use crate::{ParseError, Problem};

pub(super) fn read(text: &[u8]) -> Result<Groom, ParseError> {
    let mut lines = Lines::new(text);
    let mut declared = None;
    let mut strands = Strands { builder: Builder::with_room(0, 0), read: 0, uv: Vec::new() };
    while let Some(line) = lines.next_written()? {
        if words(line).next() == Some(b"strand") {
            let start = strand_line(line).map_err(|problem| problem.at(lines.place()));
            let start = start.map_err(|error| error.in_strand(strands.read))?;
            strands.add(start, &mut lines)?;
        } else {
            let read = header_line(line, &mut declared);
            read.map_err(|problem| problem.at(lines.place()))?;
        }
    }
    let read = strands.read;
    match declared {
        Some(declared) if declared == read => strands.into_groom(),
        Some(declared) => {
            let problem = Problem::unexpected(format!("{declared} strands"), read.to_string());
            Err(problem.at(lines.place()))
        }
        None => Err(Problem::unexpected("\"numStrands\"", "none").at(lines.place())),
    }
}

/// Numbers between blanks or commas.
fn numbers(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let parts = line.split(|&byte| byte == b',' || byte.is_ascii_whitespace());
    parts.filter(|part| !part.is_empty())
}

/// Reads a line before the strands.
fn header_line(line: &[u8], strands: &mut Option<usize>) -> Result<(), Problem> {
    let mut values = numbers(line);
    let keyword = values.next().unwrap_or(b"");
    match keyword {
        b"numStrands" => {
            *strands = Some(integer(values.next().unwrap_or(b""), "a number of strands")?);
            Ok(())
        }
        b"scale" => unmoved(1.0, line, values),
        b"rotation" | b"translation" => unmoved(0.0, line, values),
        b"version"
        | b"bothEndsImmovable"
        | b"maxNumVerticesInStrand"
        | b"numFollowHairsPerGuideHair"
        | b"maxRadiusAroundGuideHair"
        | b"is" => Ok(()),
        _ => Err(Problem::unexpected("a line of a TressFX text", quoted(keyword))),
    }
}

/// An error unless all numbers of a line are `value`, which leaves the hair where it is.
fn unmoved<'a>(
    value: f64,
    line: &[u8],
    mut numbers: impl Iterator<Item = &'a [u8]>,
) -> Result<(), Problem> {
    if numbers.all(|word| number(word).ok() == Some(value)) {
        return Ok(());
    }
    Err(Problem::unexpected(format!("{value}, which leaves the hair as it is"), quoted(line)))
}

/// How many points a strand has, and its texture coordinates.
struct Start {
    points: usize,
    uv: [f64; 2],
}

/// Reads `strand I numVerts N texcoord U V`.
fn strand_line(line: &[u8]) -> Result<Start, Problem> {
    let mut values = numbers(line).skip(2);
    let expected = || Problem::unexpected("\"strand I numVerts N texcoord U V\"", quoted(line));
    if values.next() != Some(b"numVerts") {
        return Err(expected());
    }
    let points = integer(values.next().unwrap_or(b""), "a number of points")?;
    let uv = match values.next() {
        None => [0.0; 2],
        Some(b"texcoord") => {
            [number(values.next().unwrap_or(b""))?, number(values.next().unwrap_or(b""))?]
        }
        Some(_) => return Err(expected()),
    };
    Ok(Start { points, uv })
}

/// The strands read so far.
struct Strands {
    builder: Builder,
    read: usize,
    uv: Vec<f64>,
}

impl Strands {
    /// Reads the lines of the points of a strand.
    fn add(&mut self, start: Start, lines: &mut Lines<&[u8]>) -> Result<(), ParseError> {
        let mut points: Vec<DVec3> = Vec::new();
        for _ in 0..start.points {
            let Some(line) = lines.next_written()? else {
                let expected = format!("{} points", start.points);
                let problem = Problem::unexpected(expected, points.len().to_string());
                return Err(problem.at(lines.place()).in_strand(self.read));
            };
            let point = point(&mut numbers(line));
            let point = point.map_err(|problem| problem.at(lines.place()).in_strand(self.read))?;
            points.push(point);
        }
        self.builder.push(points.into_iter())?;
        self.read += 1;
        self.uv.extend(start.uv);
        Ok(())
    }

    fn into_groom(self) -> Result<Groom, ParseError> {
        let mut groom = Groom::new(self.builder.finish()?);
        if self.uv.iter().any(|&value| value != 0.0) {
            let column = Column::Float { components: 2, values: self.uv };
            groom.insert_strand_attribute(names::ROOT_UV, column).map_err(misfit)?;
        }
        Ok(groom)
    }
}
