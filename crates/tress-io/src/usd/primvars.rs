//! Columns as primvars.

use tress_geometry::{Column, Groom, names};

use crate::named::named;
use crate::widths::is_width;

/// What an array has a row for: USD's interpolation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rows {
    Constant,
    Uniform,
    Vertex,
}

impl Rows {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Uniform => "uniform",
            Self::Vertex => "vertex",
        }
    }
}

/// The type of an item of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Int,
    Int64,
    Float,
    Float2,
    Float3,
    Float4,
    TexCoord2,
    Color3,
}

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Int => "int",
            Self::Int64 => "int64",
            Self::Float => "float",
            Self::Float2 => "float2",
            Self::Float3 => "float3",
            Self::Float4 => "float4",
            Self::TexCoord2 => "texCoord2f",
            Self::Color3 => "color3f",
        }
    }
}

/// A column under the name and type that USD has for it.
pub(super) struct Primvar<'a> {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// How many items make a row.
    pub(super) size: usize,
    pub(super) column: &'a Column,
    pub(super) rows: Rows,
}

/// Every column but the widths.
pub(super) fn primvars(groom: &Groom) -> Vec<Primvar<'_>> {
    let columns = named(groom, is_width, spell).into_iter();
    columns
        .map(|named| {
            let (kind, size) = kind(&named.name, named.column);
            let rows = if named.of_points { Rows::Vertex } else { Rows::Uniform };
            Primvar { name: named.name, kind, size, column: named.column, rows }
        })
        .collect()
}

/// The name of a column as USD spells it: known names by USD's own, others with `_` for what may
/// not stand in an identifier.
fn spell(name: &str) -> String {
    let legal = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '_' };
    let mut spelled = match name {
        names::COLOR => "displayColor".to_owned(),
        names::OPACITY => "displayOpacity".to_owned(),
        names::ROOT_UV => "st".to_owned(),
        _ => name.chars().map(legal).collect(),
    };
    if !spelled.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
        spelled.insert(0, '_');
    }
    spelled
}

/// The type of one item, and how many items make a row.
fn kind(name: &str, column: &Column) -> (Kind, usize) {
    match column {
        Column::Int(values) if values.iter().all(|&i| i32::try_from(i).is_ok()) => (Kind::Int, 1),
        Column::Int(_) => (Kind::Int64, 1),
        Column::Float { components, .. } => match (components, name) {
            (1, _) => (Kind::Float, 1),
            (2, "st") => (Kind::TexCoord2, 1),
            (2, _) => (Kind::Float2, 1),
            (3, "displayColor") => (Kind::Color3, 1),
            (3, _) => (Kind::Float3, 1),
            (4, _) => (Kind::Float4, 1),
            (n, _) => (Kind::Float, *n),
        },
    }
}
