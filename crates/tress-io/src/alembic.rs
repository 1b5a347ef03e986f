//! Alembic `ICurves`, from Ogawa archives (`.abc`).
//!
//! Every curves object of an archive is read, in the order of the hierarchy, instances as often as
//! they stand there; where there are several, the strand column `group` tells which object a strand
//! is from. The transforms of the parents apply. Points come out *on* the curves, as for
//! [`usd`](crate::usd): linear curves keep their points exactly whatever basis they carry
//! (exporters leave `kCatmullromBasis` or `kBezierBasis` on linear curves), cubic B-splines and
//! Bezier curves are evaluated. Of an animated archive [`read`] takes the first sample.
//!
//! | in the file | in the groom |
//! |---|---|
//! | `P`, moved by the transforms of the parents | positions |
//! | `width`, or `groom_width` | `width` |
//! | `uv` | `uv` |
//! | `.arbGeomParams` of Unreal's groom schema | `group`, `guide`, `id`, `uv`, `color` ... |
//! | other `.arbGeomParams` of numbers | a column of their name |
//!
//! Alembic has no unit and no up axis. Archives of this crate say them in `.userProperties` of the
//! transform above the curves (`metersPerUnit`, `upAxis`); of others both are unknown. In practice
//! Blender, Maya and most other exporters write Y-up, Unreal wants centimetres, Blender writes
//! metres.
//!
//! Not read are curves of variable order, with knots that are not evenly spaced, or with weights:
//! they are an error, for as anything else they would be other curves. The older HDF5 archives are
//! another format and an error that says so.
//!
//! # Writing
//!
//! A groom becomes one linear curves object, `/groom/strands`. Since all readers take Y for the
//! axis that is up, a groom whose axis is Z is turned. Positions and columns are narrowed to 32
//! bits. Widths are diameters; a groom without them gets a hair's, as for [`usd`](crate::usd),
//! since what tools assume differs wildly. A column becomes a geometry parameter of its name; a
//! column of strands steps aside as `NAME_strand` where one of points has its name.

mod curves;
mod parameters;
mod scene;
mod transform;
pub(crate) mod writer;

use std::io::{Seek, Write};
use std::path::Path;

use tress_alembic::Reader;
use tress_geometry::Groom;

use crate::{EncodeError, Frames, ParseError};
use scene::{Scene, broken};

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
    read_sample(&std::fs::read(path)?, 0)
}

/// Reads the curves of an archive at a sample.
pub(crate) fn read_sample(bytes: &[u8], sample: usize) -> Result<Groom, ParseError> {
    Scene::new(&Reader::new(bytes).map_err(broken)?, sample).groom()
}

/// The times, in seconds, of the samples of an archive's curves.
pub(crate) fn times(bytes: &[u8]) -> Result<Vec<f64>, ParseError> {
    Scene::new(&Reader::new(bytes).map_err(broken)?, 0).times()
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
/// assert_eq!((back.unit, back.up), (Some(0.01), Some(UpAxis::Y)));
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
