//! What can be wrong with an archive.

/// Why bytes are not read as an archive. Places are bytes of the file, from 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file does not begin as archives do.
    ///
    /// ```
    /// # use tress_alembic::{ReadError, Reader};
    /// assert_eq!(Reader::new(b"PXR-USDC").err(), Some(ReadError::NoArchive));
    /// ```
    #[error("expected an Alembic file, which begins with Ogawa, found something else")]
    NoArchive,
    /// An archive of the older kind.
    ///
    /// ```
    /// # use tress_alembic::{ReadError, Reader};
    /// assert_eq!(Reader::new(b"\x89HDF\r\n\x1a\n").err(), Some(ReadError::Hdf5));
    /// ```
    #[error(
        "an Alembic archive of the older HDF5 kind, which is not read: convert it with abcconvert \
         -toOgawa"
    )]
    Hdf5,
    /// Its writer stopped before the end.
    ///
    /// ```
    /// # use tress_alembic::{ReadError, Reader};
    /// assert_eq!(Reader::new(b"Ogawa\x00\x00\x01").err(), Some(ReadError::NotWhole));
    /// ```
    #[error("the archive was not written to its end: its exporter stopped before closing it")]
    NotWhole,
    /// The file ends before what it says is in it.
    ///
    /// ```
    /// # use tress_alembic::{ReadError, Reader};
    /// assert!(matches!(Reader::new(b"Ogawa\xff"), Err(ReadError::Truncated { .. })));
    /// ```
    #[error("the file is cut short: {needed} more bytes are needed, {left} are left")]
    Truncated {
        /// From where on.
        at: u64,
        /// Bytes that are needed there.
        needed: u64,
        /// Bytes that are there.
        left: u64,
    },
    /// Something that makes no sense: here a root group that holds nothing.
    ///
    /// ```
    /// # use tress_alembic::{ReadError, Reader};
    /// let empty = b"Ogawa\xff\x00\x01\0\0\0\0\0\0\0\0";
    /// assert!(matches!(Reader::new(empty), Err(ReadError::Broken { .. })));
    /// ```
    #[error("{what} cannot be made sense of")]
    Broken {
        /// Where.
        at: u64,
        /// What.
        what: &'static str,
    },
    /// A property without the sample asked for, as that of curves that were never written.
    #[error("property {0:?} has no sample")]
    NoSample(String),
}
