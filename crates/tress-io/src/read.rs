//! Reading a file of any format.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;

use tress_geometry::{Groom, HelixGroom};

use crate::{
    Format, ParseError, ReadError, alembic, ct2hair, data, hair, native, npy, npz, obj, ply, tfx,
    usd,
};

/// What a file holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Model {
    /// Points: every format but `.tress`.
    Polylines(Groom),
    /// Super-helices: `.tress`.
    Helices(HelixGroom),
}

/// Reads a file; its extension names the format.
///
/// # Errors
///
/// If the extension is unknown, the file cannot be opened, or its contents are not a groom; see
/// [`ReadError`]. The message is one line that begins with the path.
pub fn read(path: impl AsRef<Path>) -> Result<Model, ReadError> {
    let path = path.as_ref();
    let cannot_open = |source| ReadError::Open { path: path.into(), source };
    let format = match Format::from_path(path) {
        // That it has no extension is not what is wrong with a folder.
        Err(_) if path.is_dir() => return Err(cannot_open(io::ErrorKind::IsADirectory.into())),
        format => format?,
    };
    let file = open(path).map_err(cannot_open)?;
    read_as(format, path, file).map_err(|source| ReadError::Parse { path: path.into(), source })
}

fn open(path: &Path) -> io::Result<File> {
    let file = File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    Ok(file)
}

fn read_as(format: Format, path: &Path, file: File) -> Result<Model, ParseError> {
    let groom = match format {
        Format::Obj => obj::read(BufReader::with_capacity(1 << 16, file)),
        Format::Hair => hair::read(&contents(file)?),
        Format::Data => data::read(&contents(file)?),
        Format::Bin => ct2hair::read(&contents(file)?),
        Format::Ply => ply::read(&contents(file)?),
        Format::Tfx => tfx::read(&contents(file)?),
        Format::Npy => npy::read(&contents(file)?),
        Format::Npz => npz::read(&contents(file)?),
        Format::Tress => return native::read(&contents(file)?).map(Model::Helices),
        Format::Usda | Format::Usdc | Format::Usd => usd::read(path),
        Format::Abc => alembic::read(path),
    };
    groom.map(Model::Polylines)
}

fn contents(mut file: File) -> Result<Vec<u8>, ParseError> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}
