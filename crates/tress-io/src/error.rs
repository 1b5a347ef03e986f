//! What can be wrong with a file, said in one line: which file, where in it, what was found and
//! what was expected.
//!
//! Readers of bytes know no path and return a [`ParseError`]; [`read`](crate::read) puts the path
//! before it. Writers to a stream return an [`EncodeError`]; [`write`](crate::write) does the same.
//! Strands are counted from 0, lines from 1, bytes from 0.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use crate::Format;

/// Where in a file something is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// At this byte, from 0.
    Byte(u64),
    /// On this line, from 1.
    Line(u64),
    /// In a named part: an array of an archive, a prim of a stage.
    Part(String),
}

/// What is wrong there.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file ends before its contents do. Every count is held against the bytes that are left
    /// before anything is allocated for it, so this is also what an absurd count gives.
    ///
    /// ```
    /// # use tress_io::{Problem, data};
    /// let error = data::read(&[200, 0, 0, 0]).unwrap_err();
    /// assert!(matches!(error.problem, Problem::Truncated { needed: 800, left: 0 }));
    /// ```
    #[error("the file is cut short: {needed} more bytes are needed, {left} are left")]
    Truncated {
        /// Bytes that the contents take from here on, at least.
        needed: u64,
        /// Bytes that are left.
        left: u64,
    },
    /// The contents end before the file does.
    ///
    /// ```
    /// # use tress_io::{Problem, data};
    /// let error = data::read(&[0, 0, 0, 0, 7]).unwrap_err();
    /// assert!(matches!(error.problem, Problem::Trailing { bytes: 1 }));
    /// ```
    #[error("the file is too long: {bytes} bytes follow the last strand")]
    Trailing {
        /// How many bytes are left over.
        bytes: u64,
    },
    /// Something else stands where something was expected.
    ///
    /// ```
    /// # use tress_io::{Problem, obj};
    /// let error = obj::read(&b"v 1 2 three\n"[..]).unwrap_err();
    /// assert_eq!(error.to_string(), "line 1: expected a number, found \"three\"");
    /// ```
    #[error("expected {expected}, found {found}")]
    Unexpected {
        /// What should be there.
        expected: String,
        /// What is there.
        found: String,
    },
    /// A file of this format, but of a kind that is not read.
    #[error("{0}")]
    Unsupported(String),
    /// The file could not be read to its end.
    #[error("{0}")]
    Io(#[from] io::Error),
}

impl Problem {
    /// `found` stands where `expected` should.
    pub(crate) fn unexpected(expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self::Unexpected { expected: expected.into(), found: found.into() }
    }

    /// The problem with its place.
    pub(crate) fn at(self, place: Place) -> ParseError {
        ParseError { place, strand: None, problem: self }
    }

    /// The problem at a byte.
    pub(crate) fn at_byte(self, byte: usize) -> ParseError {
        self.at(Place::Byte(byte as u64))
    }
}

/// Why the contents of a file are not a groom.
#[derive(Debug)]
pub struct ParseError {
    /// Where.
    pub place: Place,
    /// In which strand, from 0, where it is in one.
    pub strand: Option<usize>,
    /// What.
    pub problem: Problem,
}

impl ParseError {
    /// The same error, said to be in strand `i`.
    pub(crate) fn in_strand(mut self, i: usize) -> Self {
        self.strand = Some(i);
        self
    }
}

impl From<io::Error> for ParseError {
    fn from(error: io::Error) -> Self {
        Problem::Io(error).at(Place::File)
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Place::File => {}
            Place::Byte(byte) => write!(f, "byte {byte}")?,
            Place::Line(line) => write!(f, "line {line}")?,
            Place::Part(name) => f.write_str(name)?,
        }
        if let Some(strand) = self.strand {
            let comma = if self.place == Place::File { "" } else { ", " };
            write!(f, "{comma}strand {strand}")?;
        }
        if self.place != Place::File || self.strand.is_some() {
            f.write_str(": ")?;
        }
        self.problem.fmt(f)
    }
}

impl std::error::Error for ParseError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        // The problem is part of the message already; its cause comes next.
        self.problem.source()
    }
}

/// Why a path is not read as, or written in, any format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}: {}, expected one of {}", path.display(), describe_extension(path), known_extensions())]
pub struct UnknownExtension {
    /// The path.
    pub path: PathBuf,
}

fn describe_extension(path: &Path) -> String {
    match path.extension() {
        Some(extension) => format!("unknown extension .{}", extension.to_string_lossy()),
        None => "no extension".into(),
    }
}

fn known_extensions() -> String {
    Format::ALL.map(|format| format!(".{}", format.extension())).join(" ")
}

/// Why a file is not read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The extension names no format.
    ///
    /// ```
    /// let error = tress_io::read("hair.docx").unwrap_err();
    /// assert!(error.to_string().starts_with("hair.docx: unknown extension .docx, expected"));
    /// ```
    #[error(transparent)]
    Format(#[from] UnknownExtension),
    /// The extension is not one of a mesh's.
    ///
    /// ```
    /// let error = tress_io::mesh::read("scalp.hair").unwrap_err();
    /// assert_eq!(error.to_string(), "scalp.hair: meshes are read from .obj and .ply files");
    /// ```
    #[error("{}: meshes are read from .obj and .ply files", path.display())]
    NotAMesh {
        /// The path.
        path: PathBuf,
    },
    /// The file cannot be opened.
    ///
    /// ```
    /// let error = tress_io::read("nowhere/hair.obj").unwrap_err();
    /// assert_eq!(error.to_string(), "nowhere/hair.obj: no such file");
    /// ```
    #[error("{}: {}", path.display(), describe_io(source))]
    Open {
        /// The path.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The contents are not a groom.
    #[error("{}: {source}", path.display())]
    Parse {
        /// The path.
        path: PathBuf,
        /// Where and why.
        source: ParseError,
    },
}

/// Why a groom cannot be written in a format.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EncodeError {
    /// A strand that the format has no way to hold.
    ///
    /// ```
    /// # use tress_geometry::{Groom, Strands};
    /// # use tress_io::{EncodeError, hair};
    /// let empty = Groom::new(Strands::from_counts([0], vec![])?);
    /// let error = hair::write(&empty, &mut Vec::new()).unwrap_err();
    /// assert!(matches!(error, EncodeError::Strand { strand: 0, .. }));
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[error("strand {strand} {reason}")]
    Strand {
        /// Which, from 0.
        strand: usize,
        /// What it has that the format cannot hold, as words that follow "strand 5".
        reason: String,
    },
    /// A groom that the format has no way to hold.
    #[error("{0}")]
    Groom(String),
    /// The stream took no more.
    #[error("{}", describe_write(.0))]
    Io(#[from] io::Error),
}

/// Why a file is not written; what was there before is as it was.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The extension names no format.
    #[error(transparent)]
    Format(#[from] UnknownExtension),
    /// The groom does not fit the format, or the disk does not take it.
    #[error("{}: {source}", path.display())]
    Encode {
        /// The path.
        path: PathBuf,
        /// Which strand and why, or what the system said.
        source: EncodeError,
    },
}

/// The same of a file that is written, which need not be there.
fn describe_write(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such folder".into(),
        _ => describe_io(error),
    }
}

/// What the system said, in words that need no system to understand.
fn describe_io(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".into(),
        io::ErrorKind::PermissionDenied => "permission denied".into(),
        io::ErrorKind::IsADirectory => "is a directory, expected a file".into(),
        io::ErrorKind::NotADirectory => "a part of the path is a file, not a directory".into(),
        io::ErrorKind::StorageFull => "no space is left on the disk".into(),
        io::ErrorKind::ReadOnlyFilesystem => "the disk can only be read".into(),
        _ => error.to_string(),
    }
}
