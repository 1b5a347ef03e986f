//! Alembic `ICurves`, from Ogawa archives (`.abc`).
//!
//! Reading goes through the ogawa-rs crate. Every curves object of the archive is read, at its
//! first sample, in the order of the hierarchy; where there are several, the strand column `group`
//! tells which object a strand is from. The transforms of the parents apply. Points come out *on*
//! the curves, as for [`usd`](crate::usd): linear curves keep their points exactly whatever basis
//! they carry (exporters leave `kCatmullromBasis` or `kBezierBasis` on linear curves), cubic
//! B-splines and Bezier curves are evaluated.
//!
//! | in the file | in the groom |
//! |---|---|
//! | `P`, moved by the transforms of the parents | positions |
//! | `width`, or `groom_width` | `width` |
//! | `uv`, or `groom_root_uv` | `uv` |
//! | `groom_group_id`, `groom_color` | `group`, `color` |
//! | other `.arbGeomParams` of 32-bit integers (one) or floats (one to four) | a column of their name |
//!
//! Alembic has no unit and no up axis, so both are unknown. In practice Blender, Maya and most
//! other exporters write Y-up, Unreal wants centimetres, Blender writes metres.
//!
//! Not read are curves of variable order, with knots that are not evenly spaced, or with weights:
//! they are an error, for as anything else they would be other curves. The older HDF5 archives are
//! another format and an error that says so.
//!
//! # What ogawa-rs is not asked
//!
//! ogawa-rs 0.4 allocates by sizes from the file, so all of them are held against the file first
//! (see `alembic/chunks.rs`). Its `Schema` reads no transforms and prints to the standard output;
//! its `load_sample` takes the wrong chunk of animated arrays and cannot read booleans; the last of
//! the texts that objects share is lost. So objects and headers of properties come from it, samples
//! are read from the chunks it points to, and that text is put back.

mod chunks;
mod curves;
mod metadata;
mod parameters;
mod properties;
mod transform;
pub(crate) mod writer;

use std::io::{self, Cursor, Read, Seek, SeekFrom, Write};
use std::path::Path;

use glam::DMat4;
use ogawa_rs::{Archive, ArchiveReader, ObjectReader};
use tress_geometry::Groom;

use crate::basis_curves::join;
use crate::foreign::{no_panic, one_line};
use crate::{EncodeError, Frames, ParseError, Place, Problem};

/// What archives begin with, before a byte that says whether they are whole.
const MAGIC: &[u8] = b"Ogawa";
/// What that byte is then.
const WHOLE: u8 = 0xff;
/// What the older kind of archives begins with.
const HDF5: &[u8] = b"\x89HDF";
/// Objects within objects; scenes have some tens.
const DEEPEST: usize = 1000;

/// Reads the curves of an archive.
///
/// ```
/// let dir = tempfile::tempdir()?;
/// let path = dir.path().join("old.abc");
/// std::fs::write(&path, b"\x89HDF\r\n\x1a\n")?;
/// let error = tress_io::alembic::read(&path).unwrap_err();
/// assert!(error.to_string().contains("HDF5"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the file cannot be read, is not an Ogawa archive, or holds curves that are not read or whose
/// counts do not match. An archive without curves is a groom without strands.
pub fn read(path: &Path) -> Result<Groom, ParseError> {
    let bytes = std::fs::read(path)?;
    check_header(&bytes)?;
    chunks::check(&bytes)?;
    no_panic("the Alembic library", move || {
        let mut file = Bytes(Cursor::new(bytes));
        let mut archive = Archive::new(&mut file).map_err(|e| unreadable(Place::File, &e))?;
        metadata::restore_last(&mut archive, &mut file);
        let root = archive.load_root_object(&mut file).map_err(|e| unreadable(Place::File, &e))?;
        let mut parts = Vec::new();
        Hierarchy { archive, file }.visit(&root, DMat4::IDENTITY, 0, &mut parts)?;
        join(parts).map_err(|error| Problem::Unsupported(error.to_string()).at(Place::File))
    })
}

/// Writes a groom as an archive of one curves object.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Groom, Strands, UpAxis};
///
/// let strands = Strands::from_counts([2], vec![DVec3::ZERO, DVec3::Z])?;
/// let groom = Groom::new(strands).in_space(Some(0.01), Some(UpAxis::Z));
/// let dir = tempfile::tempdir()?;
/// let path = dir.path().join("hair.abc");
/// tress_io::alembic::write(&groom, &mut std::fs::File::create(&path)?)?;
/// let back = tress_io::alembic::read(&path)?;
/// assert_eq!(back.strands().points()[1], DVec3::Y);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the stream takes no more, a strand has more points than Alembic can count (2^31), or a column
/// more than 255 numbers a row.
pub fn write(groom: &Groom, out: &mut (impl Write + Seek)) -> Result<(), EncodeError> {
    write_as(writer::Names::Own, groom, out)
}

/// Writes a groom as an archive of one sample.
pub(crate) fn write_as(
    names: writer::Names,
    groom: &Groom,
    out: &mut (impl Write + Seek),
) -> Result<(), EncodeError> {
    let still = Frames { start: 0.0, ..Frames::default() };
    let mut writer = writer::Writer::new(out, groom, still, names)?;
    writer.push(groom)?;
    writer.finish().map(drop)
}

fn check_header(bytes: &[u8]) -> Result<(), ParseError> {
    if bytes.starts_with(HDF5) {
        return Err(Problem::Unsupported(
            "an Alembic archive of the older HDF5 kind, which is not read: convert it with abcconvert \
             -toOgawa"
                .into(),
        )
        .at(Place::File));
    }
    if !bytes.starts_with(MAGIC) {
        let found = "something else";
        return Err(
            Problem::unexpected("an Alembic file, which begins with Ogawa", found).at(Place::File)
        );
    }
    match bytes.get(MAGIC.len()) {
        Some(&WHOLE) => Ok(()),
        Some(_) => Err(Problem::Unsupported(
            "the archive was not written to its end: its exporter stopped before closing it".into(),
        )
        .at(Place::File)),
        None => Err(Problem::Truncated { needed: 16, left: MAGIC.len() as u64 }.at(Place::File)),
    }
}

/// An open archive.
struct Hierarchy {
    archive: Archive,
    file: Bytes,
}

impl Hierarchy {
    /// Appends the curves of an object and of what lies below it to `parts`, in order.
    fn visit(
        &mut self,
        object: &ObjectReader,
        parent: DMat4,
        depth: usize,
        parts: &mut Vec<Groom>,
    ) -> Result<(), ParseError> {
        let place = || Place::Part(object.header.full_name.clone());
        if DEEPEST < depth {
            let problem = format!("objects lie more than {DEEPEST} deep in each other");
            return Err(Problem::Unsupported(problem).at(place()));
        }
        let schema = object.header.meta_data.tokens.get("schema").map(String::as_str);
        let world = match schema {
            Some("AbcGeom_Xform_v3") => transform::world(self, object, parent)?,
            _ => parent,
        };
        if schema == Some("AbcGeom_Curve_v2") {
            parts.push(curves::read(self, object, world)?);
        }
        for i in 0..object.children.len() {
            if object.group.children.len() <= i + 1 {
                let problem = Problem::unexpected("a child object", "the end of its parent");
                return Err(problem.at(place()));
            }
            let child = object
                .load_child(
                    i,
                    &mut self.file,
                    &self.archive.indexed_meta_data,
                    &self.archive.time_samplings,
                )
                .map_err(|e| unreadable(place(), &e))?;
            self.visit(&child, world, depth + 1, parts)?;
        }
        Ok(())
    }
}

/// A file in memory, as ogawa-rs wants it.
struct Bytes(Cursor<Vec<u8>>);

impl Read for Bytes {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

impl Seek for Bytes {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        self.0.seek(place)
    }
}

impl ArchiveReader for Bytes {
    fn size(&self) -> u64 {
        self.0.get_ref().len() as u64
    }
}

/// What ogawa-rs said, and what that was caused by.
fn unreadable(place: Place, error: &dyn std::error::Error) -> ParseError {
    let causes = std::iter::successors(Some(error), |error| error.source());
    let message = causes.map(ToString::to_string).collect::<Vec<_>>().join(": ");
    Problem::Unsupported(one_line(&message)).at(place)
}
