//! Numpy arrays by name, `.npz`: a zip archive of `.npy` files.
//!
//! | array | shape | |
//! |---|---|---|
//! | `positions` | strands x points x 3, or all points x 3 | |
//! | `offsets` | strands + 1 | where strands begin; needed when `positions` has two axes |
//! | `unit` | one | metres in one unit of length |
//! | `up` | one | 1 if y is up, 2 if z is |
//! | `point/NAME` | all points, or all points x components | an attribute of points |
//! | `strand/NAME` | strands, or strands x components | an attribute of strands |
//!
//! An array of another name is an attribute too when its first axis is the number of strands, or of
//! all points, or its first two are strands and points; other arrays, which say nothing of strands,
//! are passed over. Whole numbers with one component stay whole. Written are `offsets` and
//! positions with two axes, uncompressed, so that nothing is lost.

mod write;

use std::io::{Cursor, Read};

use glam::DVec3;
use memchr::memmem;
use tress_geometry::{Attributes, Column, Groom, Strands, UpAxis};
use zip::ZipArchive;
use zip::result::ZipError;

use crate::columns::misfit;
use crate::counts::too_many;
use crate::npy::{Array, Numbers, uniform};
use crate::text::printed;
use crate::{ParseError, Place, Problem};

pub use write::write;

const POINT: &str = "point/";
const STRAND: &str = "strand/";
const POSITIONS: &str = "positions";
const OFFSETS: &str = "offsets";
const UNIT: &str = "unit";
const UP: &str = "up";

/// Reads the bytes of a file.
///
/// # Errors
///
/// If the bytes are no zip archive, if it holds no `positions`, or if an array that says something
/// of strands is broken or does not match the others.
pub fn read(bytes: &[u8]) -> Result<Groom, ParseError> {
    let mut archive = Archive::open(bytes)?;
    let (strands, each) = strands(&mut archive)?;
    let unit = archive.number(UNIT)?;
    let up = match archive.number(UP)? {
        None => None,
        Some(1.0) => Some(UpAxis::Y),
        Some(2.0) => Some(UpAxis::Z),
        Some(other) => {
            let problem = Problem::unexpected("1 (y) or 2 (z)", printed(other));
            return Err(problem.at(Place::Part(UP.into())));
        }
    };
    let mut points = Attributes::new(strands.points().len());
    let mut per_strand = Attributes::new(strands.len());
    for name in archive.attributes() {
        archive.attach(&name, each, &mut points, &mut per_strand)?;
    }
    let groom = Groom::with_attributes(strands, points, per_strand);
    let groom = groom.map_err(|error| Problem::Unsupported(error.to_string()).at(Place::File))?;
    Ok(groom.in_space(unit, up))
}

/// An array of an archive.
#[derive(Clone, Debug, PartialEq)]
pub struct FloatArray {
    /// Its name, without `.npy`.
    pub name: String,
    /// How long it is along each of its axes.
    pub shape: Vec<usize>,
    /// Its numbers in C order.
    pub values: Vec<f64>,
}

/// All arrays of floating-point numbers.
///
/// They are ordered by the number that ends their name, as in `arr_2` and `arr_10`, which is the
/// order in which numpy stored them, and by name.
///
/// # Errors
///
/// If the bytes are no zip archive, or if an array is broken.
pub fn float_arrays(bytes: &[u8]) -> Result<Vec<FloatArray>, ParseError> {
    let mut archive = Archive::open(bytes)?;
    let names = archive.0.file_names().filter_map(|name| name.strip_suffix(".npy"));
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    let number = |name: &str| -> Option<u64> {
        let digits = name.len() - name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        name[name.len() - digits..].parse().ok()
    };
    names.sort_by(|a, b| (number(a), a).cmp(&(number(b), b)));
    let mut arrays = Vec::new();
    for name in names {
        let Some(bytes) = archive.bytes(&name)? else { continue };
        let array = Array::read(&bytes).map_err(|error| in_part(&name, error))?;
        if let Numbers::Float(values) = array.numbers() {
            arrays.push(FloatArray { name, shape: array.shape, values });
        }
    }
    Ok(arrays)
}

/// The strands, and how many points each has where the file says so once for all.
fn strands(archive: &mut Archive<'_>) -> Result<(Strands<DVec3>, Option<usize>), ParseError> {
    let Some(bytes) = archive.bytes(POSITIONS)? else {
        return Err(Problem::unexpected("an array named positions", "none").at(Place::File));
    };
    let part = |error: ParseError| in_part(POSITIONS, error);
    let array = Array::read(&bytes).map_err(part)?;
    match *array.shape.as_slice() {
        [strands, each, 3] => {
            let points = array.points().map_err(part)?;
            let strands = uniform(strands, each, points);
            Ok((strands.map_err(|problem| problem.at(Place::Part(POSITIONS.into())))?, Some(each)))
        }
        [_, 3] => {
            let points = array.points().map_err(part)?;
            Ok((Strands::new(offsets(archive)?, points).map_err(too_many)?, None))
        }
        _ => {
            let expected = "strands x points x 3 or all points x 3";
            let problem = Problem::unexpected(expected, array.describe());
            Err(problem.at(Place::Part(POSITIONS.into())))
        }
    }
}

fn offsets(archive: &mut Archive<'_>) -> Result<Vec<u32>, ParseError> {
    let place = || Place::Part(OFFSETS.into());
    let Some(bytes) = archive.bytes(OFFSETS)? else {
        let expected = "an array named offsets beside positions of two axes";
        return Err(Problem::unexpected(expected, "none").at(Place::File));
    };
    let array = Array::read(&bytes).map_err(|error| in_part(OFFSETS, error))?;
    let Numbers::Int(values) = array.numbers() else {
        return Err(Problem::unexpected("whole numbers", array.describe()).at(place()));
    };
    let narrow = |value: i64| {
        let problem = || Problem::unexpected("an offset", value.to_string()).at(place());
        u32::try_from(value).map_err(|_| problem())
    };
    values.into_iter().map(narrow).collect()
}

/// An error in an array, said to be in it.
fn in_part(name: &str, error: ParseError) -> ParseError {
    let place = match error.place {
        Place::Byte(byte) => format!("{name}, byte {byte}"),
        _ => name.to_owned(),
    };
    ParseError { place: Place::Part(place), ..error }
}

/// The archive, its arrays unpacked one at a time.
struct Archive<'a>(ZipArchive<Cursor<&'a [u8]>>);

impl<'a> Archive<'a> {
    fn open(bytes: &'a [u8]) -> Result<Self, ParseError> {
        let archive = ZipArchive::new(Cursor::new(bytes));
        let archive = archive.map_err(|error| broken(&error).at(Place::File))?;
        // The last record of an archive is 22 bytes and a comment; a file that goes on is accepted
        // by the reader above.
        let last = memmem::rfind(bytes, b"PK\x05\x06").unwrap_or(0);
        let end = last + 22 + archive.comment().len();
        match bytes.len().checked_sub(end) {
            None | Some(0) => Ok(Self(archive)),
            Some(more) => Err(Problem::Trailing { bytes: more as u64 }.at_byte(end)),
        }
    }

    /// The bytes of an array, if it is there.
    fn bytes(&mut self, name: &str) -> Result<Option<Vec<u8>>, ParseError> {
        let place = || Place::Part(name.to_owned());
        let mut entry = match self.0.by_name(&format!("{name}.npy")) {
            Ok(entry) => entry,
            Err(ZipError::FileNotFound) => return Ok(None),
            Err(error) => return Err(broken(&error).at(place())),
        };
        // Grown as it is unpacked: the size that the archive states is not relied on.
        let mut bytes = Vec::new();
        let read = entry.read_to_end(&mut bytes);
        read.map_err(|error| Problem::Unsupported(error.to_string()).at(place()))?;
        Ok(Some(bytes))
    }

    /// The only number of an array, if it is there.
    fn number(&mut self, name: &str) -> Result<Option<f64>, ParseError> {
        let Some(bytes) = self.bytes(name)? else { return Ok(None) };
        let array = Array::read(&bytes).map_err(|error| in_part(name, error))?;
        match array.numbers() {
            Numbers::Float(values) if values.len() == 1 => Ok(Some(values[0])),
            Numbers::Int(values) if values.len() == 1 => Ok(Some(values[0] as f64)),
            _ => {
                let problem = Problem::unexpected("one number", array.describe());
                Err(problem.at(Place::Part(name.to_owned())))
            }
        }
    }

    /// Names of arrays that may be attributes, in order.
    fn attributes(&self) -> Vec<String> {
        let names = self.0.file_names().filter_map(|name| name.strip_suffix(".npy"));
        let mut names: Vec<_> = names
            .filter(|name| ![POSITIONS, OFFSETS, UNIT, UP].contains(name))
            .map(str::to_owned)
            .collect();
        names.sort_unstable();
        names
    }

    /// Attaches an array as an attribute.
    fn attach(
        &mut self,
        name: &str,
        each: Option<usize>,
        points: &mut Attributes,
        strands: &mut Attributes,
    ) -> Result<(), ParseError> {
        let Some(bytes) = self.bytes(name)? else { return Ok(()) };
        let named = name.starts_with(POINT) || name.starts_with(STRAND);
        let array = match Array::read(&bytes) {
            Ok(array) => array,
            Err(error) if named => return Err(in_part(name, error)),
            // Of a kind that is no attribute, such as text.
            Err(_) => return Ok(()),
        };
        let (n, m) = (points.rows(), strands.rows());
        let (table, rows, key) = if let Some(key) = name.strip_prefix(POINT) {
            (points, n, key)
        } else if let Some(key) = name.strip_prefix(STRAND) {
            (strands, m, key)
        } else if array.shape.len() >= 2 && Some(array.shape[1]) == each && array.shape[0] == m {
            (points, n, name)
        } else if array.shape.first() == Some(&m) {
            (strands, m, name)
        } else if array.shape.first() == Some(&n) {
            (points, n, name)
        } else {
            return Ok(());
        };
        let column =
            column(&array, rows).map_err(|problem| problem.at(Place::Part(name.into())))?;
        table.insert(key, column).map(drop).map_err(misfit)
    }
}

/// The numbers of an array as so many rows.
fn column(array: &Array<'_>, rows: usize) -> Result<Column, Problem> {
    let count = |n: usize| match n.checked_div(rows) {
        Some(components) if components * rows == n && 0 < components => Ok(components),
        None if n == 0 => Ok(array.shape.get(1).copied().unwrap_or(1).max(1)),
        _ => Err(Problem::unexpected(format!("{rows} rows"), array.describe())),
    };
    Ok(match array.numbers() {
        Numbers::Float(values) => Column::Float { components: count(values.len())?, values },
        Numbers::Int(values) => match count(values.len())? {
            1 => Column::Int(values),
            components => {
                let values = values.into_iter().map(|value| value as f64).collect();
                Column::Float { components, values }
            }
        },
    })
}

/// What the archive's reader says.
fn broken(error: &ZipError) -> Problem {
    Problem::unexpected("a zip archive of arrays", error.to_string())
}
