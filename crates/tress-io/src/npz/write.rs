//! Writing an `.npz` archive.

use std::io::{self, Seek, Write};

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
    let mut archive = Archive(ZipWriter::new(out));
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
