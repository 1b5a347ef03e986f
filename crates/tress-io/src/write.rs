//! Writing a file of any format, whole or not at all.
//!
//! Everything goes to a new file beside the target, which takes the target's name only once it is
//! complete and on the disk. A strand that cannot be written, a full disk or a crash leaves the
//! target as it was.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use tempfile::NamedTempFile;
use tress_geometry::{Groom, HelixGroom};

use crate::{
    EncodeError, Format, Loss, WriteError, alembic, ct2hair, data, hair, losses, native, npy, npz,
    obj, ply, tfx, usd,
};

/// Choices that some formats leave open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WriteOptions {
    /// How `.usda` says what lies between points.
    pub usd_curves: UsdCurves,
}

/// What lies between the points of a strand in a USD file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum UsdCurves {
    /// Straight segments, drawn alike by every tool.
    #[default]
    Linear,
    /// A Catmull-Rom spline through the points, pinned at both ends.
    CatmullRom,
}

/// Writes polylines; the extension names the format. Returns what it has no place for.
///
/// # Errors
///
/// If the extension is unknown or names a format that is only read (`.tress`, which holds
/// super-helices, is written by [`write_helices`]), if a strand cannot be expressed, or if the
/// disk does not take the file; what was there before is then as it was. See [`WriteError`].
pub fn write(
    path: impl AsRef<Path>,
    groom: &Groom,
    options: &WriteOptions,
) -> Result<Vec<Loss>, WriteError> {
    let path = path.as_ref();
    let format = Format::from_path(path)?;
    whole(path, |out| match format {
        Format::Obj => obj::write(groom, out),
        Format::Hair => hair::write(groom, out),
        Format::Data => data::write(groom, out),
        Format::Bin => ct2hair::write(groom, out),
        Format::Ply => ply::write(groom, out),
        Format::Tfx => tfx::write(groom, out),
        Format::Npy => npy::write(groom, out),
        Format::Npz => npz::write(groom, out),
        Format::Usda => usd::write(groom, options, out),
        Format::Abc => alembic::write(groom, out),
        Format::Tress => Err(EncodeError::Groom(
            "a .tress file holds super-helices, not polylines: fit them first".into(),
        )),
        Format::Usdc | Format::Usd => usd::write_binary(groom, options, out),
    })?;
    Ok(losses(groom, format))
}

/// Writes super-helices to a `.tress` file, with nothing lost.
///
/// # Errors
///
/// If the extension is not `.tress`, or if the disk does not take the file; what was there before
/// is then as it was.
pub fn write_helices(path: impl AsRef<Path>, groom: &HelixGroom) -> Result<(), WriteError> {
    let path = path.as_ref();
    let format = Format::from_path(path)?;
    whole(path, |out| match format {
        Format::Tress => native::write(groom, out),
        _ => Err(EncodeError::Groom(format!(
            "{format} files hold polylines, not super-helices: sample them first"
        ))),
    })
}

/// Writes bytes that are no groom, a picture or a report, whole or not at all.
///
/// # Errors
///
/// If the disk does not take the file; what was there before is then as it was.
pub fn write_bytes(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), WriteError> {
    whole(path.as_ref(), |out| Ok(out.write_all(bytes)?))
}

/// The stream that writers of files write to.
pub(crate) type Out = BufWriter<NamedTempFile>;

/// Lets `encode` fill a file that takes the name `path` once it is whole.
pub(crate) fn whole(
    path: &Path,
    encode: impl FnOnce(&mut Out) -> Result<(), EncodeError>,
) -> Result<(), WriteError> {
    replace(path, encode).map_err(|source| WriteError::Encode { path: path.into(), source })
}

fn replace(
    path: &Path,
    encode: impl FnOnce(&mut Out) -> Result<(), EncodeError>,
) -> Result<(), EncodeError> {
    // A link keeps pointing where it did; what it points to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if target.is_dir() {
        return Err(io::Error::from(io::ErrorKind::IsADirectory).into());
    }
    let mut out = BufWriter::with_capacity(1 << 16, beside(&target)?);
    encode(&mut out)?;
    out.flush()?;
    let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.as_file().sync_all()?;
    file.persist(&target).map_err(|error| error.error)?;
    Ok(())
}

/// A new file in the folder of `target`, with the permissions of the file it is to replace, or
/// those that any new file gets.
fn beside(target: &Path) -> io::Result<NamedTempFile> {
    let folder = match target.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tress-");
    // The system takes the user's mask off these.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder)?;
    if let Ok(old) = fs::metadata(target) {
        file.as_file().set_permissions(old.permissions())?;
    }
    Ok(file)
}
