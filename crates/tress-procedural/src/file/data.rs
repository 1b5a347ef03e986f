//! The arrays of a procedural groom as a safetensors file.

use std::collections::HashMap;

use glam::DVec3;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};

use crate::groom::Space;
use crate::numbers::label;
use crate::{Chain, EvenError, EvenStrands, Instances, Instancing, ProceduralGroom, Roots};

const GUIDES: &str = "guides";
const GUIDE_UV: &str = "guide_uv";
const OPERATOR_GUIDES: &str = "operator_guides";
const ROOTS: &str = "roots";
const ROOT_UV: &str = "root_uv";
const OPERATOR_OF: &str = "operator_of";
const INSTANCE_GUIDES: &str = "instance_guides";
const INSTANCE_WEIGHTS: &str = "instance_weights";
const NUMBERS: &str = "numbers.";
const METADATA: &str = "tress_procedural";

/// Why a file's arrays are not those of a procedural groom.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DataError {
    /// Not a safetensors file.
    #[error("not a safetensors file: {0}")]
    Format(#[from] safetensors::SafeTensorError),
    /// An array that must be there is not.
    #[error("no array {0:?}")]
    Missing(&'static str),
    /// An array of another type or shape.
    #[error("array {name:?} has shape {shape:?}, expected {expected}")]
    Shape {
        /// The array.
        name: String,
        /// Its shape.
        shape: Vec<usize>,
        /// What it should be.
        expected: &'static str,
    },
    /// An array of another type.
    #[error("array {name:?} is not of type {expected}")]
    Type {
        /// The array.
        name: String,
        /// The type it should have.
        expected: &'static str,
    },
    /// Guides that are not even strands.
    #[error(transparent)]
    Even(#[from] EvenError),
    /// The unit or up axis cannot be read.
    #[error("metadata: {0}")]
    Metadata(#[from] serde_json::Error),
}

/// An array on its way out.
struct Array {
    name: String,
    dtype: Dtype,
    shape: Vec<usize>,
    bytes: Vec<u8>,
}

impl Array {
    fn floats(name: impl Into<String>, shape: &[usize], values: impl Iterator<Item = f64>) -> Self {
        let bytes = values.flat_map(f64::to_le_bytes).collect();
        Self { name: name.into(), dtype: Dtype::F64, shape: shape.to_vec(), bytes }
    }

    fn indices(name: &str, shape: &[usize], values: &[u32]) -> Self {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        Self { name: name.to_owned(), dtype: Dtype::U32, shape: shape.to_vec(), bytes }
    }
}

fn coordinates(points: &[DVec3]) -> impl Iterator<Item = f64> + '_ {
    points.iter().flat_map(|x| x.to_array())
}

/// The bytes of the file.
pub(super) fn encode(groom: &ProceduralGroom) -> Result<Vec<u8>, DataError> {
    let (guides, strands) = (groom.guides.len(), groom.roots.len());
    let points = groom.guides.points();
    let shape = [guides, groom.guides.points_each(), 3];
    let mut arrays = vec![
        Array::floats(GUIDES, &shape, coordinates(points)),
        Array::indices(OPERATOR_GUIDES, &[groom.operator_guides.len()], &groom.operator_guides),
        Array::floats(ROOTS, &[strands, 3], coordinates(&groom.roots.positions)),
        Array::indices(OPERATOR_OF, &[strands], &groom.operator_of),
    ];
    for (name, uv) in [(GUIDE_UV, &groom.guide_uv), (ROOT_UV, &groom.roots.uv)] {
        let Some(uv) = uv else { continue };
        arrays.push(Array::floats(name, &[uv.len(), 2], uv.iter().flatten().copied()));
    }
    if let Some(instances) = &groom.instances {
        let shape = [instances.len(), instances.each];
        arrays.push(Array::indices(INSTANCE_GUIDES, &shape, &instances.guides));
        let weights = instances.weights.iter().copied();
        arrays.push(Array::floats(INSTANCE_WEIGHTS, &shape, weights));
    }
    for (o, numbers) in groom.numbers.iter().enumerate().filter(|(_, n)| !n.is_empty()) {
        let name = format!("{NUMBERS}{}", label(&groom.chain.operators, o));
        arrays.push(Array::floats(name, &[numbers.len()], numbers.iter().copied()));
    }
    let views: Vec<(&str, TensorView<'_>)> = arrays
        .iter()
        .map(|a| Ok((a.name.as_str(), TensorView::new(a.dtype, a.shape.clone(), &a.bytes)?)))
        .collect::<Result<_, DataError>>()?;
    let space = Space { unit: groom.unit, up: groom.up };
    let metadata = HashMap::from([(METADATA.to_owned(), serde_json::to_string(&space)?)]);
    Ok(safetensors::serialize(views, Some(metadata))?)
}

/// The groom that the bytes and the description make.
pub(super) fn decode(
    bytes: &[u8],
    chain: Chain,
    seed: u64,
    instancing: Instancing,
    widths: Vec<f64>,
) -> Result<ProceduralGroom, DataError> {
    let arrays = SafeTensors::deserialize(bytes)?;
    let (_, header) = SafeTensors::read_metadata(bytes)?;
    let space = header.metadata().as_ref().and_then(|metadata| metadata.get(METADATA));
    let space = space.map_or(Ok(Space::default()), |text| serde_json::from_str(text))?;
    let (shape, points) = floats(&arrays, GUIDES)?.ok_or(DataError::Missing(GUIDES))?;
    let &[_, points_each, 3] = shape.as_slice() else {
        return Err(misshapen(GUIDES, shape, "[guides, points, 3]"));
    };
    let guides = EvenStrands::new(points_each, points_of(&points))?;
    let (shape, roots) = floats(&arrays, ROOTS)?.ok_or(DataError::Missing(ROOTS))?;
    if !matches!(shape.as_slice(), [_, 3]) {
        return Err(misshapen(ROOTS, shape, "[strands, 3]"));
    }
    let roots = Roots { positions: points_of(&roots), uv: uv(&arrays, ROOT_UV)? };
    let stored = |name: &'static str| indices(&arrays, name)?.ok_or(DataError::Missing(name));
    let mut groom = ProceduralGroom {
        seed,
        instancing,
        guides,
        guide_uv: uv(&arrays, GUIDE_UV)?,
        operator_guides: stored(OPERATOR_GUIDES)?.1,
        roots,
        operator_of: stored(OPERATOR_OF)?.1,
        instances: instances(&arrays)?,
        numbers: Vec::new(),
        widths,
        unit: space.unit,
        up: space.up,
        chain,
    };
    for o in 0..groom.chain.operators.len() {
        let name = format!("{NUMBERS}{}", label(&groom.chain.operators, o));
        groom.numbers.push(floats(&arrays, &name)?.map(|(_, values)| values).unwrap_or_default());
    }
    groom.draw_missing();
    Ok(groom)
}

fn misshapen(name: &str, shape: Vec<usize>, expected: &'static str) -> DataError {
    DataError::Shape { name: name.to_owned(), shape, expected }
}

fn points_of(values: &[f64]) -> Vec<DVec3> {
    values.chunks_exact(3).map(DVec3::from_slice).collect()
}

fn instances(arrays: &SafeTensors<'_>) -> Result<Option<Instances>, DataError> {
    let Some((shape, guides)) = indices(arrays, INSTANCE_GUIDES)? else { return Ok(None) };
    let (_, weights) =
        floats(arrays, INSTANCE_WEIGHTS)?.ok_or(DataError::Missing(INSTANCE_WEIGHTS))?;
    match shape.as_slice() {
        &[_, each] if each > 0 => Ok(Some(Instances { each, guides, weights })),
        _ => Err(misshapen(INSTANCE_GUIDES, shape, "[strands, neighbors]")),
    }
}

fn uv(arrays: &SafeTensors<'_>, name: &str) -> Result<Option<Vec<[f64; 2]>>, DataError> {
    let Some((shape, values)) = floats(arrays, name)? else { return Ok(None) };
    if !matches!(shape.as_slice(), [_, 2]) {
        return Err(misshapen(name, shape, "[roots, 2]"));
    }
    Ok(Some(values.chunks_exact(2).map(|uv| [uv[0], uv[1]]).collect()))
}

type Shaped<T> = Option<(Vec<usize>, Vec<T>)>;

fn floats(arrays: &SafeTensors<'_>, name: &str) -> Result<Shaped<f64>, DataError> {
    let Ok(view) = arrays.tensor(name) else { return Ok(None) };
    if view.dtype() != Dtype::F64 {
        return Err(DataError::Type { name: name.to_owned(), expected: "F64" });
    }
    let (chunks, _) = view.data().as_chunks::<8>();
    Ok(Some((view.shape().to_vec(), chunks.iter().map(|b| f64::from_le_bytes(*b)).collect())))
}

fn indices(arrays: &SafeTensors<'_>, name: &str) -> Result<Shaped<u32>, DataError> {
    let Ok(view) = arrays.tensor(name) else { return Ok(None) };
    if view.dtype() != Dtype::U32 {
        return Err(DataError::Type { name: name.to_owned(), expected: "U32" });
    }
    let (chunks, _) = view.data().as_chunks::<4>();
    Ok(Some((view.shape().to_vec(), chunks.iter().map(|b| u32::from_le_bytes(*b)).collect())))
}
