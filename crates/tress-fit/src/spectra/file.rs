//! The library's file, `.tress-spectra`: a safetensors file that any array library opens.
//!
//! | tensor | type, shape | |
//! |---|---|---|
//! | `samples` | u32, spectra | samples each was taken from |
//! | `steps` | f64, spectra | arc length of the centerline from sample to sample, 0 if not known |
//! | `amplitudes`, `phases` | f32, harmonics x 2 | spectrum after spectrum, along `u` and `v` |
//!
//! A spectrum has `samples / 2 + 1` harmonics. The metadata holds `format`: `tress-spectra 1`.

use std::collections::HashMap;

use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use tress_geometry::Strands;

use super::{Harmonic, Spectra, SpectraError};

const FORMAT: &str = "format";
const VERSION: &str = "tress-spectra 1";

/// Why bytes are not a library of spectra.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadSpectraError {
    /// Not a safetensors file, or one that is cut short.
    ///
    /// ```
    /// # use tress_fit::{ReadSpectraError, Spectra};
    /// let error = Spectra::from_bytes(b"not a library");
    /// assert!(matches!(error, Err(ReadSpectraError::Container(_))));
    /// ```
    #[error("no safetensors file: {0}")]
    Container(#[from] safetensors::SafeTensorError),
    /// A safetensors file of another kind.
    #[error("a library of spectra says {VERSION:?} in its metadata, this file {0:?}")]
    Format(String),
    /// A tensor of another type or shape.
    #[error("the tensor {0} is not of the type and shape it should be")]
    Tensor(&'static str),
    /// Numbers that are no spectra.
    #[error(transparent)]
    Spectra(#[from] SpectraError),
}

/// Why a library cannot be written: the container does not take it.
#[derive(Debug, thiserror::Error)]
#[error("the library cannot be written: {0}")]
pub struct WriteSpectraError(#[from] safetensors::SafeTensorError);

impl Spectra {
    /// The library as a `.tress-spectra` file.
    ///
    /// # Errors
    ///
    /// If the container does not take it.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WriteSpectraError> {
        let all = self.harmonics.points();
        let flat = |of: fn(&Harmonic) -> [f32; 2]| -> Vec<u8> {
            all.iter().flat_map(of).flat_map(f32::to_le_bytes).collect()
        };
        let samples: Vec<u8> = self.samples.iter().flat_map(|n| n.to_le_bytes()).collect();
        let steps: Vec<u8> = self.steps.iter().flat_map(|s| s.to_le_bytes()).collect();
        let (amplitudes, phases) = (flat(|h| h.amplitude), flat(|h| h.phase));
        let (n, m) = (self.len(), all.len());
        let tensors = [
            ("samples", TensorView::new(Dtype::U32, vec![n], &samples)?),
            ("steps", TensorView::new(Dtype::F64, vec![n], &steps)?),
            ("amplitudes", TensorView::new(Dtype::F32, vec![m, 2], &amplitudes)?),
            ("phases", TensorView::new(Dtype::F32, vec![m, 2], &phases)?),
        ];
        let about = HashMap::from([(FORMAT.to_owned(), VERSION.to_owned())]);
        Ok(safetensors::serialize(tensors, Some(about))?)
    }

    /// Reads a `.tress-spectra` file.
    ///
    /// # Errors
    ///
    /// See [`ReadSpectraError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ReadSpectraError> {
        let (_, header) = SafeTensors::read_metadata(bytes)?;
        let format = header.metadata().as_ref().and_then(|about| about.get(FORMAT));
        if format.is_none_or(|format| format != VERSION) {
            return Err(ReadSpectraError::Format(format.cloned().unwrap_or_default()));
        }
        let file = SafeTensors::deserialize(bytes)?;
        let samples: Vec<u32> = numbers(&file, "samples", Dtype::U32, &[], u32::from_le_bytes)?;
        let steps = numbers(&file, "steps", Dtype::F64, &[], f64::from_le_bytes)?;
        let amplitudes = numbers(&file, "amplitudes", Dtype::F32, &[2], f32::from_le_bytes)?;
        let phases = numbers(&file, "phases", Dtype::F32, &[2], f32::from_le_bytes)?;
        if phases.len() != amplitudes.len() {
            return Err(ReadSpectraError::Tensor("phases"));
        }
        let pairs = amplitudes.chunks_exact(2).zip(phases.chunks_exact(2));
        let harmonic =
            |(a, p): (&[f32], &[f32])| Harmonic { amplitude: [a[0], a[1]], phase: [p[0], p[1]] };
        let counts = samples.iter().map(|n| *n as usize / 2 + 1);
        let harmonics = Strands::from_counts(counts, pairs.map(harmonic).collect());
        let harmonics = harmonics.map_err(|_| ReadSpectraError::Tensor("amplitudes"))?;
        Ok(Self::new(harmonics, samples, steps)?)
    }
}

/// The numbers of a tensor of this type whose shape ends so, behind one axis.
fn numbers<T, const N: usize>(
    file: &SafeTensors<'_>,
    name: &'static str,
    dtype: Dtype,
    behind: &[usize],
    from: fn([u8; N]) -> T,
) -> Result<Vec<T>, ReadSpectraError> {
    let tensor = file.tensor(name)?;
    if tensor.dtype() != dtype || tensor.shape().get(1..) != Some(behind) {
        return Err(ReadSpectraError::Tensor(name));
    }
    let (chunks, _) = tensor.data().as_chunks::<N>();
    Ok(chunks.iter().copied().map(from).collect())
}
