//! A procedural groom in files: a RON file that people edit, and a safetensors file beside it.
//!
//! The RON file holds the chain, the seed, how strands are instanced and the name of the file
//! beside it; that one holds guides, roots, assignments and the stored random numbers as arrays of
//! 64 bits, so that what is built again is the same to the last bit. Random numbers are named after
//! their operators (`bend.0`, `bend.1`): an operator that is added by hand draws new ones from the
//! seed, and one that is taken away leaves the others theirs.
//!
//! ```text
//! (
//!     data: "groom.safetensors",
//!     convention: Paper,
//!     seed: 1,
//!     instancing: Gaussian(neighbors: 8, sigma: 0.4),
//!     widths: [0.008, 0.008, 0.002],
//!     operators: [
//!         Clump(profile: 1.5),
//!         Curl(radius: 0.3, frequency: 0.5, random_frequency: 0.05, start: 0.2),
//!     ],
//! )
//! ```

mod data;

use std::path::{Path, PathBuf};

use ron::extensions::Extensions;
use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};

use crate::{BuildError, Chain, Convention, Instancing, Operator, ProceduralGroom};

pub use data::DataError;

/// What the RON file holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Description {
    data: String,
    #[serde(default)]
    convention: Convention,
    #[serde(default)]
    seed: u64,
    instancing: Instancing,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    widths: Vec<f64>,
    operators: Vec<Operator>,
}

/// Why a procedural groom cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The RON file does not say a groom: an unknown operator or field among others.
    #[error("{}: line {line}, column {column}: {message}", .path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// Where, from 1.
        line: usize,
        /// Where, from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// The description cannot be written as RON.
    #[error("{}: {message}", .path.display())]
    Ron {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        message: String,
    },
    /// A file cannot be read or written.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The arrays beside it are not those of a groom.
    #[error("{}: {source}", .path.display())]
    Data {
        /// The file.
        path: PathBuf,
        /// Why.
        source: DataError,
    },
    /// The parts do not fit together, or a parameter is out of range.
    #[error("{}: {source}", .path.display())]
    Groom {
        /// The file.
        path: PathBuf,
        /// Why.
        source: BuildError,
    },
}

fn options() -> ron::Options {
    ron::Options::default().with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

fn io(path: &Path) -> impl FnOnce(std::io::Error) -> FileError {
    move |source| FileError::Io { path: path.to_owned(), source }
}

/// Writes a file beside its target and renames it when it is whole.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let part = path.with_file_name(name);
    std::fs::write(&part, bytes).map_err(io(&part))?;
    std::fs::rename(&part, path).map_err(io(path))
}

impl ProceduralGroom {
    /// Writes the groom: `path` and, beside it, the same name with the extension `safetensors`.
    ///
    /// # Errors
    ///
    /// If a file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        let beside = path.with_extension("safetensors");
        let name = beside.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let description = Description {
            data: name,
            convention: self.chain.convention,
            seed: self.seed,
            instancing: self.instancing,
            widths: self.widths.clone(),
            operators: self.chain.operators.clone(),
        };
        let text = options()
            .to_string_pretty(&description, PrettyConfig::default().depth_limit(2))
            .map_err(|error| FileError::Ron {
                path: path.to_owned(),
                message: error.to_string(),
            })?;
        let bytes = data::encode(self)
            .map_err(|source| FileError::Data { path: beside.clone(), source })?;
        write_whole(&beside, &bytes)?;
        write_whole(path, format!("{text}\n").as_bytes())
    }

    /// Reads a groom that [`Self::write`] wrote, perhaps edited since; random numbers that are not
    /// stored are drawn.
    ///
    /// # Errors
    ///
    /// See [`FileError`]; what is wrong in the RON file is said with line and column.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let text = std::fs::read_to_string(path).map_err(io(path))?;
        let description: Description = options().from_str(&text).map_err(|error| {
            let start = error.span.start;
            FileError::Syntax {
                path: path.to_owned(),
                line: start.line,
                column: start.col,
                message: error.code.to_string(),
            }
        })?;
        let beside = path.with_file_name(&description.data);
        let bytes = std::fs::read(&beside).map_err(io(&beside))?;
        let Description { convention, seed, instancing, widths, operators, .. } = description;
        let chain = Chain { convention, operators };
        for (index, operator) in chain.operators.iter().enumerate() {
            operator.check(index).map_err(|error| FileError::Groom {
                path: path.to_owned(),
                source: BuildError::Chain(error.into()),
            })?;
        }
        let groom = data::decode(&bytes, chain, seed, instancing, widths)
            .map_err(|source| FileError::Data { path: beside.clone(), source })?;
        groom.check().map_err(|source| FileError::Groom { path: beside, source })?;
        Ok(groom)
    }
}

#[cfg(test)]
mod tests;
