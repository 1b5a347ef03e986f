//! The native file, `.tress`: super-helices as they are, bit for bit.
//!
//! A [safetensors](https://huggingface.co/docs/safetensors) file, which any array library opens;
//! `f64` throughout, `f32` is read as well.
//!
//! | array | shape | |
//! |---|---|---|
//! | `offsets` | strands + 1 | where the elements of strands begin |
//! | `curvatures` | elements x 3 | twist and curvatures `k0`, `k1`, `k2` |
//! | `lengths` | elements | arc lengths |
//! | `root_positions` | strands x 3 | |
//! | `root_frames` | strands x 3 x 3 | one row each for `t`, `u` and `v` |
//! | `strand/NAME` | strands, or strands x components | an attribute of strands |
//! | `joint/NAME` | joints, or joints x components | of joints, one more than elements a strand |
//! | `kept/strands` | kept | which strands are kept as polylines |
//! | `kept/offsets` | kept + 1 | where their points begin |
//! | `kept/positions` | kept points x 3 | |
//! | `kept/point/NAME` | kept points, or kept points x components | an attribute of kept points |
//!
//! The metadata entry `tress` is a JSON object: `version` (1), `unit` (metres), `up` ("Y", "Z").
//! Reading makes sure that the frames of strands are orthonormal and right-handed, curvatures
//! finite, and lengths finite and not below 0; a kept strand's root and points may be anything.

mod write;

use glam::{DMat3, DVec3};
use safetensors::tensor::TensorView;
use safetensors::{Dtype, SafeTensors};
use serde::{Deserialize, Serialize};
use tress_geometry::{Attributes, Column, Element, Frame, HelixGroom, Kept, Strands, UpAxis};

use crate::binary::widen;
use crate::text::printed;
use crate::{ParseError, Place, Problem};

pub use write::write;

const VERSION: u32 = 1;
const METADATA: &str = "tress";
const OFFSETS: &str = "offsets";
const CURVATURES: &str = "curvatures";
const LENGTHS: &str = "lengths";
const ROOT_POSITIONS: &str = "root_positions";
const ROOT_FRAMES: &str = "root_frames";
const STRAND: &str = "strand/";
const JOINT: &str = "joint/";
const KEPT_STRANDS: &str = "kept/strands";
const KEPT_OFFSETS: &str = "kept/offsets";
const KEPT_POSITIONS: &str = "kept/positions";
const KEPT_POINT: &str = "kept/point/";

/// What the file says beside arrays.
#[derive(Serialize, Deserialize)]
struct Metadata {
    version: u32,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    up: Option<UpAxis>,
}

/// Reads the bytes of a file.
///
/// # Errors
///
/// If the bytes are no safetensors file or not a whole one, if an array is missing, of another
/// shape than it should be, or of another type, or if a strand is no super-helix.
pub fn read(bytes: &[u8]) -> Result<HelixGroom, ParseError> {
    let metadata = metadata(bytes)?;
    let tensors = SafeTensors::deserialize(bytes).map_err(|error| broken(error.to_string()))?;
    let arrays = Arrays(tensors);
    let offsets = arrays.offsets(OFFSETS)?;
    let strands = offsets.len().saturating_sub(1);
    let elements = elements(&arrays, offsets)?;
    let roots = roots(&arrays, strands)?;
    let joints = elements.points().len() + strands;
    let kept = kept(&arrays)?;
    let strand_attributes = arrays.table(STRAND, strands)?;
    let joint_attributes = arrays.table(JOINT, joints)?;
    let groom =
        HelixGroom::with_attributes(roots, elements, strand_attributes, joint_attributes, kept);
    let groom = groom.map_err(|error| Problem::Unsupported(error.to_string()).at(Place::File))?;
    check(&groom)?;
    Ok(groom.in_space(metadata.unit, metadata.up))
}

fn broken(found: String) -> ParseError {
    Problem::unexpected("a whole safetensors file", found).at(Place::File)
}

fn metadata(bytes: &[u8]) -> Result<Metadata, ParseError> {
    let header = SafeTensors::read_metadata(bytes).map_err(|error| broken(error.to_string()))?.1;
    let place = || Place::Part(format!("metadata {METADATA}"));
    let text = header.metadata().as_ref().and_then(|entries| entries.get(METADATA));
    let missing = || Problem::unexpected("an entry that says this is a .tress file", "none");
    let text = text.ok_or_else(|| missing().at(place()))?;
    let metadata: Metadata = serde_json::from_str(text).map_err(|error| {
        Problem::unexpected("version, unit and up", error.to_string()).at(place())
    })?;
    if metadata.version != VERSION {
        let problem = Problem::unexpected(
            format!("version {VERSION}"),
            format!("version {}", metadata.version),
        );
        return Err(problem.at(place()));
    }
    Ok(metadata)
}

fn elements(arrays: &Arrays<'_>, offsets: Vec<u32>) -> Result<Strands<Element>, ParseError> {
    let curvatures = arrays.floats(CURVATURES, &[3])?;
    let lengths = arrays.floats(LENGTHS, &[])?;
    if curvatures.len() != 3 * lengths.len() {
        let expected = format!("{} rows, as in {CURVATURES}", curvatures.len() / 3);
        let problem = Problem::unexpected(expected, lengths.len().to_string());
        return Err(problem.at(Place::Part(LENGTHS.into())));
    }
    let curvatures = curvatures.as_chunks().0.iter().copied().map(DVec3::from_array);
    let elements = curvatures.zip(lengths).map(|(curvature, length)| Element { curvature, length });
    cut(OFFSETS, offsets, elements.collect())
}

fn roots(arrays: &Arrays<'_>, strands: usize) -> Result<Vec<Frame>, ParseError> {
    let positions = arrays.floats(ROOT_POSITIONS, &[3])?;
    let frames = arrays.floats(ROOT_FRAMES, &[3, 3])?;
    for (name, rows) in [(ROOT_POSITIONS, positions.len() / 3), (ROOT_FRAMES, frames.len() / 9)] {
        if rows != strands {
            let problem = Problem::unexpected(format!("{strands} rows"), rows.to_string());
            return Err(problem.at(Place::Part(name.into())));
        }
    }
    let positions = positions.as_chunks().0.iter().copied().map(DVec3::from_array);
    let frames = frames.as_chunks().0.iter().map(DMat3::from_cols_array);
    Ok(positions.zip(frames).map(|(position, axes)| Frame { position, axes }).collect())
}

fn kept(arrays: &Arrays<'_>) -> Result<Kept, ParseError> {
    if !arrays.has(KEPT_STRANDS) {
        return Ok(Kept::default());
    }
    let strands = arrays.offsets(KEPT_STRANDS)?;
    let positions = arrays.floats(KEPT_POSITIONS, &[3])?;
    let positions = positions.as_chunks().0.iter().copied().map(DVec3::from_array).collect();
    let polylines = cut(KEPT_OFFSETS, arrays.offsets(KEPT_OFFSETS)?, positions)?;
    let point_attributes = arrays.table(KEPT_POINT, polylines.points().len())?;
    Ok(Kept { strands, polylines, point_attributes })
}

fn cut<T>(name: &str, offsets: Vec<u32>, points: Vec<T>) -> Result<Strands<T>, ParseError> {
    Strands::new(offsets, points)
        .map_err(|error| Problem::Unsupported(error.to_string()).at(Place::Part(name.into())))
}

/// An error unless every strand that is not kept is a super-helix.
fn check(groom: &HelixGroom) -> Result<(), ParseError> {
    for (i, strand) in groom.iter().enumerate() {
        let at = |name: &str| Place::Part(name.into());
        if groom.kept_polyline(i).is_none() && !strand.root.is_valid() {
            let problem = Problem::unexpected(
                "a finite position and orthonormal, right-handed axes",
                "another frame",
            );
            return Err(problem.at(at(ROOT_FRAMES)).in_strand(i));
        }
        for element in strand.elements {
            if !element.curvature.is_finite() {
                let found = format!("{:?}", element.curvature.to_array());
                let problem = Problem::unexpected("finite curvatures", found);
                return Err(problem.at(at(CURVATURES)).in_strand(i));
            }
            if !(0.0..f64::INFINITY).contains(&element.length) {
                let found = printed(element.length);
                let problem = Problem::unexpected("a finite length of at least 0", found);
                return Err(problem.at(at(LENGTHS)).in_strand(i));
            }
        }
    }
    Ok(())
}

/// The arrays of a file, by name.
struct Arrays<'a>(SafeTensors<'a>);

impl<'a> Arrays<'a> {
    fn has(&self, name: &str) -> bool {
        self.0.tensor(name).is_ok()
    }

    fn get(&self, name: &str) -> Result<TensorView<'a>, ParseError> {
        self.0.tensor(name).map_err(|_| {
            Problem::unexpected(format!("an array named {name}"), "none").at(Place::File)
        })
    }

    /// Rows of floating-point numbers, each of this shape.
    fn floats(&self, name: &str, row: &[usize]) -> Result<Vec<f64>, ParseError> {
        let array = self.get(name)?;
        let place = || Place::Part(name.into());
        if array.shape().len() != row.len() + 1 || &array.shape()[1..] != row {
            let expected = format!("a shape of rows and {row:?}");
            return Err(Problem::unexpected(expected, format!("{:?}", array.shape())).at(place()));
        }
        floats(&array).map_err(|problem| problem.at(place()))
    }

    /// A row of `u32`.
    fn offsets(&self, name: &str) -> Result<Vec<u32>, ParseError> {
        let array = self.get(name)?;
        if array.dtype() != Dtype::U32 || array.shape().len() != 1 {
            let found = format!("{:?} of {:?}", array.dtype(), array.shape());
            let problem = Problem::unexpected("a row of U32", found);
            return Err(problem.at(Place::Part(name.into())));
        }
        Ok(array.data().as_chunks().0.iter().map(|&bytes| u32::from_le_bytes(bytes)).collect())
    }

    /// The columns whose names begin so.
    fn table(&self, prefix: &str, rows: usize) -> Result<Attributes, ParseError> {
        let mut table = Attributes::new(rows);
        let mut names = self.0.names();
        names.sort_unstable();
        for name in names {
            let Some(key) = name.strip_prefix(prefix) else { continue };
            let place = || Place::Part(name.into());
            let column = column(&self.get(name)?).map_err(|problem| problem.at(place()))?;
            let inserted = table.insert(key, column);
            inserted.map_err(|error| Problem::Unsupported(error.to_string()).at(place()))?;
        }
        Ok(table)
    }
}

fn floats(array: &TensorView<'_>) -> Result<Vec<f64>, Problem> {
    let data = array.data();
    match array.dtype() {
        Dtype::F64 => {
            Ok(data.as_chunks().0.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect())
        }
        Dtype::F32 => Ok(data.as_chunks().0.iter().map(|&bytes| widen(bytes)).collect()),
        other => Err(Problem::unexpected("F64 or F32", format!("{other:?}"))),
    }
}

fn column(array: &TensorView<'_>) -> Result<Column, Problem> {
    let components = match *array.shape() {
        [_] => 1,
        [_, components] => components,
        _ => {
            let found = format!("a shape of {:?}", array.shape());
            return Err(Problem::unexpected("one axis or two", found));
        }
    };
    if array.dtype() == Dtype::I64 && array.shape().len() == 1 {
        let values = array.data().as_chunks().0.iter();
        return Ok(Column::Int(values.map(|&bytes| i64::from_le_bytes(bytes)).collect()));
    }
    Ok(Column::Float { components, values: floats(array)? })
}
