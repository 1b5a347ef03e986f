//! Writing the native file.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, Write};

use glam::DVec3;
use safetensors::Dtype;
use safetensors::tensor::{View, serialize};
use tress_geometry::{Attributes, Column, Element, Frame, HelixGroom};

use super::{
    CURVATURES, JOINT, KEPT_OFFSETS, KEPT_POINT, KEPT_POSITIONS, KEPT_STRANDS, LENGTHS, METADATA,
    Metadata, OFFSETS, ROOT_FRAMES, ROOT_POSITIONS, STRAND, VERSION,
};
use crate::EncodeError;

/// Writes a groom and all that belongs to it.
///
/// # Errors
///
/// If the stream takes no more.
pub fn write(groom: &HelixGroom, out: &mut impl Write) -> Result<(), EncodeError> {
    let (elements, roots, kept) = (groom.elements(), groom.roots(), groom.kept());
    let mut tensors = vec![
        Tensor::new(OFFSETS, &[], Data::Offsets(elements.offsets())),
        Tensor::new(CURVATURES, &[3], Data::Curvatures(elements.points())),
        Tensor::new(LENGTHS, &[], Data::Lengths(elements.points())),
        Tensor::new(ROOT_POSITIONS, &[3], Data::Positions(roots)),
        Tensor::new(ROOT_FRAMES, &[3, 3], Data::Frames(roots)),
    ];
    add_table(&mut tensors, STRAND, groom.strand_attributes());
    add_table(&mut tensors, JOINT, groom.joint_attributes());
    if !kept.strands.is_empty() {
        tensors.extend([
            Tensor::new(KEPT_STRANDS, &[], Data::Offsets(&kept.strands)),
            Tensor::new(KEPT_OFFSETS, &[], Data::Offsets(kept.polylines.offsets())),
            Tensor::new(KEPT_POSITIONS, &[3], Data::Points(kept.polylines.points())),
        ]);
        add_table(&mut tensors, KEPT_POINT, &kept.point_attributes);
    }
    let metadata = Metadata { version: VERSION, unit: groom.unit, up: groom.up };
    // A single entry: more would come in another order every time.
    let metadata = serde_json::to_string(&metadata).map_err(io::Error::from)?;
    let metadata = HashMap::from([(METADATA.to_owned(), metadata)]);
    let named = tensors.into_iter().map(|tensor| (tensor.name.clone(), tensor));
    let bytes = serialize(named, Some(metadata)).map_err(io::Error::other)?;
    out.write_all(&bytes)?;
    Ok(())
}

fn add_table<'a>(tensors: &mut Vec<Tensor<'a>>, prefix: &str, table: &'a Attributes) {
    tensors.extend(table.iter().map(|(name, column)| {
        let name = format!("{prefix}{name}");
        match column {
            Column::Int(values) => Tensor::new(name, &[], Data::Ints(values)),
            Column::Float { components: 1, values } => Tensor::new(name, &[], Data::Floats(values)),
            Column::Float { components, values } => {
                Tensor::new(name, &[*components], Data::Floats(values))
            }
        }
    }));
}

/// An array, turned to bytes only when it is its turn.
struct Tensor<'a> {
    name: String,
    shape: Vec<usize>,
    data: Data<'a>,
}

/// Where the numbers of an array come from.
enum Data<'a> {
    Offsets(&'a [u32]),
    Ints(&'a [i64]),
    Floats(&'a [f64]),
    Points(&'a [DVec3]),
    Curvatures(&'a [Element]),
    Lengths(&'a [Element]),
    Positions(&'a [Frame]),
    Frames(&'a [Frame]),
}

impl<'a> Tensor<'a> {
    /// An array whose rows are of this shape.
    fn new(name: impl Into<String>, row: &[usize], data: Data<'a>) -> Self {
        let numbers = data.numbers();
        let rows = numbers.checked_div(row.iter().product()).unwrap_or(0);
        let shape = std::iter::once(rows).chain(row.iter().copied()).collect();
        Self { name: name.into(), shape, data }
    }
}

impl Data<'_> {
    fn numbers(&self) -> usize {
        match self {
            Self::Offsets(values) => values.len(),
            Self::Ints(values) => values.len(),
            Self::Floats(values) => values.len(),
            Self::Points(points) => 3 * points.len(),
            Self::Curvatures(elements) => 3 * elements.len(),
            Self::Lengths(elements) => elements.len(),
            Self::Positions(frames) => 3 * frames.len(),
            Self::Frames(frames) => 9 * frames.len(),
        }
    }

    fn bytes(&self) -> Vec<u8> {
        fn floats<const N: usize>(rows: impl Iterator<Item = [f64; N]>) -> Vec<u8> {
            rows.flatten().flat_map(f64::to_le_bytes).collect()
        }
        match self {
            Self::Offsets(values) => values.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Self::Ints(values) => values.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Self::Floats(values) => floats(values.iter().map(|&value| [value])),
            Self::Points(points) => floats(points.iter().map(|point| point.to_array())),
            Self::Curvatures(elements) => floats(elements.iter().map(|e| e.curvature.to_array())),
            Self::Lengths(elements) => floats(elements.iter().map(|e| [e.length])),
            Self::Positions(frames) => floats(frames.iter().map(|f| f.position.to_array())),
            Self::Frames(frames) => floats(frames.iter().map(|f| f.axes.to_cols_array())),
        }
    }
}

impl View for Tensor<'_> {
    fn dtype(&self) -> Dtype {
        match self.data {
            Data::Offsets(_) => Dtype::U32,
            Data::Ints(_) => Dtype::I64,
            _ => Dtype::F64,
        }
    }

    fn shape(&self) -> &[usize] {
        &self.shape
    }

    fn data(&self) -> Cow<'_, [u8]> {
        Cow::Owned(self.data.bytes())
    }

    fn data_len(&self) -> usize {
        self.data.numbers() * if matches!(self.data, Data::Offsets(_)) { 4 } else { 8 }
    }
}
