//! Wavefront polylines, `.obj`: `v x y z` lines, and `l i j k ...` lines that join them to strands.
//!
//! Indices count from 1, or back from the vertex read last when negative; `i/j` names a texture
//! coordinate as well, which is passed over, as are all names, groups and materials. A `p` line
//! makes a strand of a single point of each of its vertices.
//!
//! * Where every `l` line has two vertices, lines that share a vertex are one strand: that is how
//!   programs that know only edges write curves. See the section on chains below.
//! * Where there is nothing but vertices, each is a strand of a single point: a list of roots.
//! * Where there are faces and no strands, the file is a mesh and an error.
//! * Vertices that nothing names are not strands.
//!
//! Numbers are written in the fewest digits that read back as the same `f64`.
//!
//! # Chains
//!
//! A chain runs the way its first line in the file does, from end to end; strands are in the order
//! of their first lines. A vertex where three or more lines meet ends the chains that reach it. A
//! closed chain begins with its first line and ends where it began.

use std::io::{BufRead, Write};

use glam::DVec3;
use tress_geometry::{Groom, Strands};

use crate::chain::chains;
use crate::counts::{gather, too_many};
use crate::text::{Lines, integer, point, quoted, words, write_number};
use crate::{EncodeError, ParseError, Place, Problem};

/// Reads text, line by line.
///
/// ```
/// let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n";
/// let groom = tress_io::obj::read(text.as_bytes())?;
/// assert_eq!(groom.strands().offsets(), [0, 3]);
/// # Ok::<(), tress_io::ParseError>(())
/// ```
///
/// # Errors
///
/// If a line begins with a word that the format does not know, if something is not a number, if an
/// index names no vertex, or if the file holds a mesh and no strands.
pub fn read(text: impl BufRead) -> Result<Groom, ParseError> {
    let mut lines = Lines::new(text);
    let mut contents = Contents::default();
    while let Some((line, statement)) = lines.next_statement()? {
        contents.add(line, statement).map_err(|problem| problem.at(Place::Line(line)))?;
    }
    contents.into_groom()
}

/// Vertices, and the elements that name them.
#[derive(Default)]
struct Contents {
    vertices: Vec<DVec3>,
    /// The vertices, from 0, of each `l` line and of each entry of a `p` line.
    elements: Strands<u32>,
    /// The line of each element.
    lines: Vec<u64>,
    /// The line of the first face or surface.
    surface: Option<u64>,
    /// The indices of the line under way.
    indices: Vec<u32>,
}

impl Contents {
    fn add(&mut self, line: u64, statement: &[u8]) -> Result<(), Problem> {
        // A byte order mark may come first.
        let statement = match line {
            1 => statement.strip_prefix("\u{feff}".as_bytes()).unwrap_or(statement),
            _ => statement,
        };
        let mut words = words(statement);
        let Some(keyword) = words.next() else { return Ok(()) };
        match keyword {
            b"v" => self.vertices.push(point(&mut words)?),
            b"l" | b"p" => {
                self.read_indices(words)?;
                let size = if keyword == b"l" { self.indices.len() } else { 1 };
                for element in self.indices.chunks(size) {
                    let pushed = self.elements.push(element.iter().copied());
                    pushed.map_err(|error| Problem::Unsupported(error.to_string()))?;
                    self.lines.push(line);
                }
            }
            b"f" | b"fo" | b"surf" | b"curv" | b"curv2" => {
                self.surface.get_or_insert(line);
            }
            _ if keyword.starts_with(b"#") || PASSED_OVER.contains(&keyword) => {}
            _ => return Err(Problem::unexpected("a line of an .obj file", quoted(keyword))),
        }
        Ok(())
    }

    fn read_indices<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>) -> Result<(), Problem> {
        self.indices.clear();
        for word in words {
            let vertex = word.split(|&byte| byte == b'/').next().unwrap_or(word);
            let index: i64 = integer(vertex, "a vertex index")?;
            let behind = if index < 0 { self.vertices.len() as i64 } else { -1 };
            let from_zero = behind.checked_add(index).and_then(|i| u32::try_from(i).ok());
            self.indices.push(from_zero.ok_or_else(|| self.no_vertex(index))?);
        }
        if self.indices.is_empty() {
            return Err(Problem::unexpected("vertex indices", "none"));
        }
        Ok(())
    }

    fn no_vertex(&self, index: i64) -> Problem {
        let n = self.vertices.len();
        Problem::unexpected(format!("the index of one of {n} vertices"), index.to_string())
    }

    fn into_groom(self) -> Result<Groom, ParseError> {
        if self.elements.is_empty() {
            if let Some(line) = self.surface {
                let problem = Problem::unexpected("strands (lines that begin with l)", "a mesh");
                return Err(problem.at(Place::Line(line)));
            }
            let roots = std::iter::repeat_n(1, self.vertices.len());
            return Ok(Groom::new(Strands::from_counts(roots, self.vertices).map_err(too_many)?));
        }
        self.check_indices()?;
        let pairs =
            self.elements.counts().any(|n| n == 2) && self.elements.counts().all(|n| n <= 2);
        let elements = if pairs {
            let elements = (0..self.elements.len()).map(|i| self.elements.strand(i));
            chains(self.vertices.len(), elements).map_err(too_many)?
        } else {
            self.elements
        };
        Ok(Groom::new(gather(elements, self.vertices)?))
    }

    /// An index may name a vertex that comes later, so they are checked once all are there.
    fn check_indices(&self) -> Result<(), ParseError> {
        let n = self.vertices.len();
        for (strand, (indices, &line)) in self.elements.iter().zip(&self.lines).enumerate() {
            if let Some(&index) = indices.iter().find(|&&index| n <= index as usize) {
                let problem = self.no_vertex(i64::from(index) + 1);
                return Err(problem.at(Place::Line(line)).in_strand(strand));
            }
        }
        Ok(())
    }
}

/// First words of lines that say nothing of strands.
const PASSED_OVER: [&[u8]; 34] = [
    b"vt",
    b"vn",
    b"vp",
    b"o",
    b"g",
    b"s",
    b"mg",
    b"mtllib",
    b"usemtl",
    b"maplib",
    b"usemap",
    b"shadow_obj",
    b"trace_obj",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"ctech",
    b"stech",
    b"cstype",
    b"deg",
    b"bmat",
    b"step",
    b"parm",
    b"trim",
    b"hole",
    b"scrv",
    b"sp",
    b"end",
    b"con",
    b"call",
    b"csh",
    b"bzp",
    b"bsp",
];

/// Writes positions: for each strand its vertices, then its `l` line, or its `p` line if it has a
/// single point.
///
/// # Errors
///
/// If a strand has no points, or if the stream takes no more.
pub fn write(groom: &Groom, out: &mut impl Write) -> Result<(), EncodeError> {
    let strands = groom.strands();
    for (strand, points) in strands.iter().enumerate() {
        if points.is_empty() {
            let reason = "has no points, which an .obj file cannot say".into();
            return Err(EncodeError::Strand { strand, reason });
        }
        for point in points {
            out.write_all(b"v")?;
            for value in point.to_array() {
                out.write_all(b" ")?;
                write_number(out, value)?;
            }
            out.write_all(b"\n")?;
        }
        out.write_all(if points.len() == 1 { b"p" } else { b"l" })?;
        for point in strands.range(strand) {
            write!(out, " {}", point + 1)?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}
