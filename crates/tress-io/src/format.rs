//! The formats, told apart by extension, and what each can carry.

use std::fmt;
use std::path::Path;

use tress_geometry::names;

use crate::UnknownExtension;

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront polylines.
    Obj,
    /// Cem Yuksel's cyHair.
    Hair,
    /// USC-HairSalon strands.
    Data,
    /// `CT2Hair` strands.
    Bin,
    /// Stanford PLY with strands.
    Ply,
    /// AMD `TressFX`.
    Tfx,
    /// One numpy array.
    Npy,
    /// Several numpy arrays.
    Npz,
    /// Super-helices, exactly as they are: the native format.
    Tress,
    /// USD text.
    Usda,
    /// USD binary.
    Usdc,
    /// USD, text or binary.
    Usd,
    /// Alembic.
    Abc,
}

/// The columns that a format has a place for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Columns {
    /// Any column.
    All,
    /// Those of these names and components.
    Only(&'static [(&'static str, usize)]),
}

impl Columns {
    /// Whether there is a place for a column of this name and number of components.
    #[must_use]
    pub fn hold(self, name: &str, components: usize) -> bool {
        match self {
            Self::All => true,
            Self::Only(columns) => columns.contains(&(name, components)),
        }
    }
}

/// What a format has a place for beside positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Carries {
    /// The unit of length.
    pub unit: bool,
    /// The up axis.
    pub up: bool,
    /// Columns with one row a point. A column of strands that only has a place here is written to
    /// every point of its strand.
    pub point_columns: Columns,
    /// Columns with one row a strand.
    pub strand_columns: Columns,
}

const POSITIONS_ONLY: Carries = Carries {
    unit: false,
    up: false,
    point_columns: Columns::Only(&[]),
    strand_columns: Columns::Only(&[]),
};

const EVERYTHING: Carries =
    Carries { unit: true, up: true, point_columns: Columns::All, strand_columns: Columns::All };

/// Name of the column that `CT2Hair` files hold a normal a point in.
pub(crate) const NORMAL: &str = "normal";
/// Name of the column that `CT2Hair` files hold a label a point in.
pub(crate) const LABEL: &str = "label";
/// Name of the column that `TressFX` files hold an inverse mass a point in.
pub(crate) const INVERSE_MASS: &str = "inverse_mass";
/// Name of the column that `TressFX` files hold texture coordinates a point in.
pub(crate) const VERTEX_UV: &str = "vertex_uv";

impl Format {
    /// Every format.
    pub const ALL: [Self; 13] = [
        Self::Obj,
        Self::Hair,
        Self::Data,
        Self::Bin,
        Self::Ply,
        Self::Tfx,
        Self::Npy,
        Self::Npz,
        Self::Tress,
        Self::Usda,
        Self::Usdc,
        Self::Usd,
        Self::Abc,
    ];

    /// The format that the extension names, in lower or upper case.
    ///
    /// ```
    /// # use tress_io::Format;
    /// assert_eq!(Format::from_path("Hair.OBJ"), Ok(Format::Obj));
    /// assert!(Format::from_path("hair.docx").is_err());
    /// ```
    ///
    /// # Errors
    ///
    /// If there is none, or it names no format; the message lists those that do.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, UnknownExtension> {
        let path = path.as_ref();
        let extension = path.extension().and_then(|extension| extension.to_str());
        let known = |extension: &str| {
            Self::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
        };
        extension.and_then(known).ok_or_else(|| UnknownExtension { path: path.into() })
    }

    /// The extension, without the dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Hair => "hair",
            Self::Data => "data",
            Self::Bin => "bin",
            Self::Ply => "ply",
            Self::Tfx => "tfx",
            Self::Npy => "npy",
            Self::Npz => "npz",
            Self::Tress => "tress",
            Self::Usda => "usda",
            Self::Usdc => "usdc",
            Self::Usd => "usd",
            Self::Abc => "abc",
        }
    }

    /// What it is, for help texts.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Self::Obj => "Wavefront polylines",
            Self::Hair => "cyHair",
            Self::Data => "USC-HairSalon strands",
            Self::Bin => "CT2Hair strands",
            Self::Ply => "PLY with strands (hairutil, NeuralHaircut)",
            Self::Tfx => "TressFX (1 to 4 read, 4 written)",
            Self::Npy => "numpy array, strands x points x 3",
            Self::Npz => "numpy arrays by name",
            Self::Tress => "super-helices, exactly as they are",
            Self::Usda => "USD BasisCurves, text",
            Self::Usdc => "USD BasisCurves, binary",
            Self::Usd => "USD BasisCurves, text or binary (written as binary)",
            Self::Abc => "Alembic curves",
        }
    }

    /// Whether the file is text.
    #[must_use]
    pub fn is_text(self) -> bool {
        matches!(self, Self::Obj | Self::Usda)
    }

    /// What it has a place for beside positions.
    #[must_use]
    pub fn carries(self) -> Carries {
        match self {
            Self::Obj | Self::Data | Self::Npy => POSITIONS_ONLY,
            Self::Hair => Carries {
                point_columns: Columns::Only(&[
                    (names::WIDTH, 1),
                    (names::OPACITY, 1),
                    (names::COLOR, 3),
                ]),
                ..POSITIONS_ONLY
            },
            Self::Bin => Carries {
                point_columns: Columns::Only(&[(NORMAL, 3), (LABEL, 1)]),
                ..POSITIONS_ONLY
            },
            Self::Ply => Carries {
                point_columns: Columns::Only(&[(names::COLOR, 3), (names::OPACITY, 1)]),
                ..POSITIONS_ONLY
            },
            Self::Tfx => Carries {
                point_columns: Columns::Only(&[
                    (INVERSE_MASS, 1),
                    (VERTEX_UV, 2),
                    (names::COLOR, 3),
                    (names::OPACITY, 1),
                ]),
                strand_columns: Columns::Only(&[(names::WIDTH, 1), (names::ROOT_UV, 2)]),
                ..POSITIONS_ONLY
            },
            Self::Npz | Self::Tress | Self::Usda | Self::Usdc | Self::Usd | Self::Abc => EVERYTHING,
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, ".{}", self.extension())
    }
}
