//! USD `BasisCurves`: `.usda` (text), `.usdc` (binary), `.usd` (either; the contents tell).
//!
//! Reading goes through the openusd crate (feature `usd` of this crate, without which USD files are
//! an error that says so), which composes the stage: sublayers, references,
//! payloads, variants and instances count. Every `BasisCurves` prim that is active and defined is
//! read, in the order of traversal, invisible ones too; where there are several, the strand column
//! `group` tells which prim a strand is from. Points come out *on* the curves: those of
//! linear and pinned Catmull-Rom curves are kept exactly, B-spline and Bezier curves are
//! evaluated at 4 points a control point, which a Catmull-Rom curve through them follows to
//! 0.06 % of the radius of a coil of 5 control points a turn.
//!
//! | in the file | in the groom |
//! |---|---|
//! | `points`, moved by `xformOpOrder` of the prim and its ancestors | positions |
//! | `widths` | `width`, in the unit of the points as they stand in the file |
//! | `primvars:displayColor`, `primvars:displayOpacity` | `color`, `opacity` |
//! | `primvars:st` (else `primvars:uv`) | `uv` |
//! | other numeric primvars | a column of their name |
//! | `metersPerUnit`, `upAxis` | unit, up axis; unknown when they are not in the file |
//!
//! A primvar that is `constant` or `uniform` makes a column of strands, one that is `vertex` or
//! `varying` makes a column of points. Texts, matrices and quaternions have no column to go to.
//! Of animated attributes the default is read, or the first sample where there is none. Transforms
//! do not scale widths, as they do not in USD.
//!
//! # Writing
//!
//! `.usda` is written by this module rather than through openusd, which wants the whole file as
//! values in memory first; what is written is checked by reading it back with openusd and with
//! Pixar's library. A groom becomes one `BasisCurves` prim in an `Xform` that is the default prim:
//! linear, or cubic, Catmull-Rom and pinned, on request. Positions and columns are narrowed to 32
//! bits. `metersPerUnit` and `upAxis` are left out when they are unknown; normals always are, for
//! they would turn hair to ribbons.
//!
//! - Widths are diameters. A groom without them gets a constant one, since tools differ wildly in
//!   what they assume: 0.1 mm where the unit is known, else a four-thousandth of the groom's size.
//! - A column becomes a primvar of its name; characters that USD has no place for become `_`, and
//!   a column of strands steps aside as `NAME_strand` where one of points has its name. Columns of
//!   more than 4 components use `elementSize`.
//! - Strands of no or one point are written as they are. USD calls such curves invalid, Pixar's
//!   library reads them, and none is lost on the way back; some renderers leave the prim out.
//!
//! `.usdc` and `.usd` hold the same prims in binary, written by this module as well: what openusd
//! 0.6 writes, Pixar's library refuses.
//!
//! # Broken files
//!
//! openusd trusts the counts and offsets of binary files, so every layer is checked before it sees
//! it (see `usd/stage/crate_file.rs`), and text is held to a depth of nesting that its recursive
//! parser survives. What indexing errors are left in it end as an error, not as a panic of the
//! caller.

pub(crate) mod binary;
mod primvars;
#[cfg_attr(not(feature = "usd"), path = "usd/no_stage.rs")]
mod stage;
mod writer;

use std::io::{Seek, Write};
use std::path::Path;

use tress_geometry::Groom;

use crate::{EncodeError, ParseError, WriteOptions};

/// Reads the curves of a stage.
///
/// ```
/// # #[cfg(feature = "usd")] {
/// use glam::DVec3;
/// use tress_geometry::UpAxis;
///
/// let dir = tempfile::tempdir()?;
/// let path = dir.path().join("hair.usda");
/// std::fs::write(
///     &path,
///     r#"#usda 1.0
///     (
///         metersPerUnit = 0.01
///         upAxis = "Z"
///     )
///     def BasisCurves "hair"
///     {
///         int[] curveVertexCounts = [2]
///         point3f[] points = [(0, 0, 0), (0, 0, 1)]
///         uniform token type = "linear"
///         double3 xformOp:translate = (5, 0, 0)
///         uniform token[] xformOpOrder = ["xformOp:translate"]
///     }
///     "#,
/// )?;
/// let groom = tress_io::usd::read(&path)?;
/// assert_eq!((groom.unit, groom.up), (Some(0.01), Some(UpAxis::Z)));
/// assert_eq!(groom.strands().points()[1], DVec3::new(5.0, 0.0, 1.0));
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the file cannot be read, is not a USD layer, the feature `usd` is off, or holds curves whose
/// counts do not match. A stage without curves is a groom without strands.
pub fn read(path: &Path) -> Result<Groom, ParseError> {
    stage::read(path, None)
}

/// Reads the curves of a stage at a time code.
pub(crate) fn read_at(path: &Path, code: f64) -> Result<Groom, ParseError> {
    stage::read(path, Some(code))
}

/// The time codes at which the points of a stage's curves have samples, and how many a second has.
pub(crate) fn times(path: &Path) -> Result<(Vec<f64>, f64), ParseError> {
    stage::times(path)
}

/// Writes a groom as `.usda`.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Groom, Strands};
/// use tress_io::{WriteOptions, usd};
///
/// let strands = Strands::from_counts([2], vec![DVec3::ZERO, DVec3::X])?;
/// let mut text = Vec::new();
/// usd::write(&Groom::new(strands), &WriteOptions::default(), &mut text)?;
/// let text = String::from_utf8(text)?;
/// assert!(text.contains("point3f[] points = [\n(0, 0, 0), (1, 0, 0),\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the stream takes no more, or a strand has more points than USD can count (2^31).
pub fn write(
    groom: &Groom,
    options: &WriteOptions,
    out: &mut impl Write,
) -> Result<(), EncodeError> {
    writer::write(groom, options.usd_curves, out)
}

/// Writes a groom as `.usdc`.
///
/// ```
/// use glam::DVec3;
/// use std::io::Cursor;
/// use tress_geometry::{Groom, Strands};
/// use tress_io::{WriteOptions, usd};
///
/// let strands = Strands::from_counts([2], vec![DVec3::ZERO, DVec3::X])?;
/// let mut binary = Cursor::new(Vec::new());
/// usd::write_binary(&Groom::new(strands), &WriteOptions::default(), &mut binary)?;
/// assert!(binary.into_inner().starts_with(b"PXR-USDC"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the stream takes no more, or a strand has more points than USD can count (2^31).
pub fn write_binary(
    groom: &Groom,
    options: &WriteOptions,
    out: &mut (impl Write + Seek),
) -> Result<(), EncodeError> {
    let mut writer = binary::Writer::new(out, groom, options.usd_curves, None)?;
    writer.push(groom)?;
    writer.finish().map(drop)
}

fn check_counts(groom: &Groom) -> Result<(), EncodeError> {
    match groom.strands().counts().position(|count| i32::try_from(count).is_err()) {
        Some(strand) => Err(EncodeError::Strand {
            strand,
            reason: "has more points than USD can count (2,147,483,647)".into(),
        }),
        None => Ok(()),
    }
}
