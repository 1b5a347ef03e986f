//! What cannot be written, and why.

use std::io;

/// Why something does not go into an archive.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A name that is empty or has `/` or a control character in it.
    ///
    /// ```
    /// # use std::io::Cursor;
    /// # use tress_alembic::{Archive, Error};
    /// let mut archive = Archive::new(Cursor::new(Vec::new()), "")?;
    /// let error = archive.add_transform(archive.top(), "a/b", None).unwrap_err();
    /// assert!(matches!(error, Error::Name(name) if name == "a/b"));
    /// # Ok::<(), Error>(())
    /// ```
    #[error("{0:?} is no name: it is empty or has a slash or a control character in it")]
    Name(String),
    /// A name that a sibling or another property of the object has.
    ///
    /// ```
    /// # use std::io::Cursor;
    /// # use tress_alembic::{Archive, Error};
    /// let mut archive = Archive::new(Cursor::new(Vec::new()), "")?;
    /// archive.add_transform(archive.top(), "a", None)?;
    /// let error = archive.add_transform(archive.top(), "a", None).unwrap_err();
    /// assert!(matches!(error, Error::Taken(_)));
    /// # Ok::<(), Error>(())
    /// ```
    #[error("the name {0:?} is taken")]
    Taken(String),
    /// Counts that do not sum to the number of points, or one that is negative.
    ///
    /// ```
    /// # use std::io::Cursor;
    /// # use tress_alembic::{Archive, CurvesSample, Error, Kind};
    /// let mut archive = Archive::new(Cursor::new(Vec::new()), "")?;
    /// let time = archive.add_time(0.0, 1.0);
    /// let hair = archive.add_curves(archive.top(), "hair", Kind::Linear, time)?;
    /// let sample = CurvesSample { points: &[], counts: &[3], ..CurvesSample::default() };
    /// let error = archive.write_curves(hair, &sample).unwrap_err();
    /// assert!(matches!(error, Error::Counts { counted: 3, points: 0 }));
    /// # Ok::<(), Error>(())
    /// ```
    #[error("the curves' counts sum to {counted}, but there are {points} points")]
    Counts {
        /// What the counts sum to; a negative count counts as none.
        counted: usize,
        /// Points given.
        points: usize,
    },
    /// A parameter without the rows that its scope asks for.
    ///
    /// ```
    /// # use std::io::Cursor;
    /// # use tress_alembic::{Archive, CurvesSample, Error, Kind, Scope};
    /// let mut archive = Archive::new(Cursor::new(Vec::new()), "")?;
    /// let time = archive.add_time(0.0, 1.0);
    /// let hair = archive.add_curves(archive.top(), "hair", Kind::Linear, time)?;
    /// let widths: (Scope, &[f32]) = (Scope::Uniform, &[0.1, 0.2]);
    /// let sample = CurvesSample { widths: Some(widths), ..CurvesSample::default() };
    /// let error = archive.write_curves(hair, &sample).unwrap_err();
    /// assert!(matches!(error, Error::Rows { rows: 2, expected: 0, .. }));
    /// # Ok::<(), Error>(())
    /// ```
    #[error("parameter {name:?} has {rows} rows, expected {expected}")]
    Rows {
        /// The parameter.
        name: String,
        /// Rows it has.
        rows: usize,
        /// Rows that its scope asks for.
        expected: usize,
    },
    /// A parameter that is of another type than in the sample before, or that was not in the first.
    ///
    /// ```
    /// # use std::io::Cursor;
    /// # use tress_alembic::{Archive, CurvesSample, Error, Kind, Scope};
    /// let mut archive = Archive::new(Cursor::new(Vec::new()), "")?;
    /// let time = archive.add_time(0.0, 1.0);
    /// let hair = archive.add_curves(archive.top(), "hair", Kind::Linear, time)?;
    /// let first = CurvesSample::default();
    /// archive.write_curves(hair, &first)?;
    /// let second = CurvesSample { widths: Some((Scope::Constant, &[0.1])), ..first };
    /// let error = archive.write_curves(hair, &second).unwrap_err();
    /// assert!(matches!(error, Error::Changed(name) if name == "width"));
    /// # Ok::<(), Error>(())
    /// ```
    #[error("parameter {0:?} is not what it was in the first sample")]
    Changed(String),
    /// An instance of what it would lie in.
    ///
    /// ```
    /// # use std::io::Cursor;
    /// # use tress_alembic::{Archive, Error};
    /// let mut archive = Archive::new(Cursor::new(Vec::new()), "")?;
    /// let head = archive.add_transform(archive.top(), "head", None)?;
    /// let inner = archive.add_transform(head, "inner", None)?;
    /// let error = archive.add_instance(inner, "again", head).unwrap_err();
    /// assert!(matches!(error, Error::Circular(name) if name == "again"));
    /// # Ok::<(), Error>(())
    /// ```
    #[error("{0:?} would be an instance of what it lies in")]
    Circular(String),
    /// An object of another archive, samples of curves for one that is none, or anything in or of
    /// an instance.
    ///
    /// ```
    /// # use std::io::Cursor;
    /// # use tress_alembic::{Archive, CurvesSample, Error};
    /// let mut archive = Archive::new(Cursor::new(Vec::new()), "")?;
    /// let head = archive.add_transform(archive.top(), "head", None)?;
    /// let error = archive.write_curves(head, &CurvesSample::default()).unwrap_err();
    /// assert!(matches!(error, Error::NoObject));
    /// # Ok::<(), Error>(())
    /// ```
    #[error("the object is not in the archive, or does not hold such things")]
    NoObject,
    /// The stream takes no more.
    #[error(transparent)]
    Io(#[from] io::Error),
}
