//! Ogawa: a file as a tree of groups and data.
//!
//! After a header of 16 bytes (magic, a byte that says whether the file is whole, version, address
//! of the root group) follow chunks in any order, each addressed by its first byte. Data is a `u64`
//! size and the bytes; a group is a `u64` count and the addresses of its children, those of data
//! with the highest bit set. Address 0 stands for what is empty. All numbers are little-endian.

use std::io::{self, Seek, SeekFrom, Write};

/// Magic, not whole yet, version 1, no root yet.
const HEADER: [u8; 16] = *b"Ogawa\x00\x00\x01\0\0\0\0\0\0\0\0";
/// Where the byte stands that says whether the file is whole, and what it says then.
const WHOLE: (u64, u8) = (5, 0xff);
/// Where the address of the root group stands.
const ROOT: u64 = 8;
/// Set in the address of data.
const DATA: u64 = 1 << 63;

/// Where a chunk is, as groups refer to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Address(u64);

impl Address {
    /// Data of no bytes.
    pub(crate) const NO_DATA: Self = Self(DATA);
    /// A group without children.
    pub(crate) const NO_GROUP: Self = Self(0);
}

/// A file under construction.
#[derive(Debug)]
pub(crate) struct Chunks<W> {
    out: W,
    /// Bytes written so far.
    end: u64,
}

impl<W: Write + Seek> Chunks<W> {
    /// Begins a file at the stream's beginning.
    pub(crate) fn new(mut out: W) -> io::Result<Self> {
        out.seek(SeekFrom::Start(0))?;
        out.write_all(&HEADER)?;
        Ok(Self { out, end: HEADER.len() as u64 })
    }

    /// Writes data: a head and the bytes behind it.
    pub(crate) fn data(&mut self, head: &[u8], bytes: &[u8]) -> io::Result<Address> {
        let size = (head.len() + bytes.len()) as u64;
        if size == 0 {
            return Ok(Address::NO_DATA);
        }
        let address = self.end | DATA;
        self.out.write_all(&size.to_le_bytes())?;
        self.out.write_all(head)?;
        self.out.write_all(bytes)?;
        self.end += 8 + size;
        Ok(Address(address))
    }

    /// Writes a group of chunks that are written already.
    pub(crate) fn group(&mut self, children: &[Address]) -> io::Result<Address> {
        if children.is_empty() {
            return Ok(Address::NO_GROUP);
        }
        let address = self.end;
        let mut bytes = (children.len() as u64).to_le_bytes().to_vec();
        bytes.extend(children.iter().flat_map(|child| child.0.to_le_bytes()));
        self.out.write_all(&bytes)?;
        self.end += bytes.len() as u64;
        Ok(Address(address))
    }

    /// Names the root group and says that the file is whole.
    pub(crate) fn finish(mut self, root: Address) -> io::Result<W> {
        self.out.seek(SeekFrom::Start(ROOT))?;
        self.out.write_all(&root.0.to_le_bytes())?;
        // Only once everything else is where it belongs.
        self.out.flush()?;
        self.out.seek(SeekFrom::Start(WHOLE.0))?;
        self.out.write_all(&[WHOLE.1])?;
        self.out.seek(SeekFrom::Start(self.end))?;
        self.out.flush()?;
        Ok(self.out)
    }
}
