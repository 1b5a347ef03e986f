//! Writing an `.npz` archive.

use std::io::{self, Seek, SeekFrom, Write};

use tress_geometry::{Attributes, Column, Groom, UpAxis};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::{OFFSETS, POINT, POSITIONS, STRAND, UNIT, UP};
use crate::EncodeError;
use crate::npy::write_header;

/// Writes positions, offsets, unit, up axis and all attributes.
///
/// # Errors
///
/// If the stream takes no more.
pub fn write(groom: &Groom, out: &mut (impl Write + Seek)) -> Result<(), EncodeError> {
    let mut archive = Archive(ZipWriter::new(UntilError::new(out)));
    let strands = groom.strands();
    let points = strands.points();
    archive.floats(POSITIONS, &[points.len(), 3], points.iter().flat_map(|p| p.to_array()))?;
    archive.ints(OFFSETS, strands.offsets().iter().copied().map(i64::from))?;
    if let Some(unit) = groom.unit {
        archive.floats(UNIT, &[], [unit])?;
    }
    if let Some(up) = groom.up {
        let axis = match up {
            UpAxis::Y => 1,
            UpAxis::Z => 2,
        };
        archive.ints(UP, std::iter::once(axis))?;
    }
    archive.table(POINT, groom.point_attributes())?;
    archive.table(STRAND, groom.strand_attributes())?;
    archive.0.finish().map_err(io::Error::from)?;
    Ok(())
}

/// A stream that takes everything once an error is told, and does nothing with it.
///
/// An archive that is dropped tries to finish itself, and writes to standard error that it cannot.
struct UntilError<W> {
    out: W,
    failed: bool,
    /// Where it is, or would be.
    at: u64,
}

impl<W> UntilError<W> {
    fn new(out: W) -> Self {
        Self { out, failed: false, at: 0 }
    }

    /// What comes of the stream, or `pretended` after an error.
    fn unless_failed<T>(
        &mut self,
        pretended: T,
        act: impl FnOnce(&mut W) -> io::Result<T>,
    ) -> io::Result<T> {
        if self.failed {
            return Ok(pretended);
        }
        let outcome = act(&mut self.out);
        let is_lasting = |error: &io::Error| error.kind() != io::ErrorKind::Interrupted;
        self.failed = outcome.as_ref().is_err_and(is_lasting);
        outcome
    }
}

impl<W: Write> Write for UntilError<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.unless_failed(bytes.len(), |out| out.write(bytes))?;
        self.at += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.unless_failed((), W::flush)
    }
}

impl<W: Seek> Seek for UntilError<W> {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        let pretended = match place {
            SeekFrom::Start(at) => at,
            SeekFrom::Current(by) => self.at.saturating_add_signed(by),
            SeekFrom::End(_) => self.at,
        };
        self.at = self.unless_failed(pretended, |out| out.seek(place))?;
        Ok(self.at)
    }
}

struct Archive<W: Write + Seek>(ZipWriter<W>);

impl<W: Write + Seek> Archive<W> {
    /// Begins an array of so many bytes of numbers.
    fn begin(&mut self, name: &str, bytes: usize) -> io::Result<()> {
        // Above this, sizes are written with 64 bits; the header of an array is far below the rest.
        const LARGE: usize = (1 << 32) - (1 << 16);
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(LARGE <= bytes);
        self.0.start_file(format!("{name}.npy"), options).map_err(io::Error::from)
    }

    fn floats(
        &mut self,
        name: &str,
        shape: &[usize],
        values: impl IntoIterator<Item = f64>,
    ) -> io::Result<()> {
        self.begin(name, 8 * shape.iter().product::<usize>())?;
        let mut out = io::BufWriter::new(&mut self.0);
        write_header(&mut out, "<f8", shape)?;
        for value in values {
            out.write_all(&value.to_le_bytes())?;
        }
        out.flush()
    }

    fn ints(&mut self, name: &str, values: impl ExactSizeIterator<Item = i64>) -> io::Result<()> {
        self.begin(name, 8 * values.len())?;
        let mut out = io::BufWriter::new(&mut self.0);
        write_header(&mut out, "<i8", &[values.len()])?;
        for value in values {
            out.write_all(&value.to_le_bytes())?;
        }
        out.flush()
    }

    fn table(&mut self, prefix: &str, table: &Attributes) -> io::Result<()> {
        for (name, column) in table.iter() {
            let name = format!("{prefix}{name}");
            match column {
                Column::Int(values) => self.ints(&name, values.iter().copied())?,
                Column::Float { components: 1, values } => {
                    self.floats(&name, &[values.len()], values.iter().copied())?;
                }
                Column::Float { components, values } => {
                    let shape = [table.rows(), *components];
                    self.floats(&name, &shape, values.iter().copied())?;
                }
            }
        }
        Ok(())
    }
}
