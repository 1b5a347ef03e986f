//! A groom as p-helicoids, and the RON it is kept in.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::{
    Attributes, Column, ColumnError, Frame, Groom, GroomError, OffsetsError, Strands, UpAxis,
};

use crate::{PHelicoid, Piece, TraceError, Tracing};

/// Hairs as p-helicoids, with attributes.
///
/// A strand that no helicoid can describe (a single point, say) has no pieces; its polyline is
/// [kept](Self::kept) so that it is not lost.
///
/// ```
/// use tress_geometry::{Frame, Strands};
/// use tress_helicoid::{Helicoid, HelicoidGroom, Piece};
///
/// let pieces = vec![Piece { k: Helicoid::new(1.0, 0.0, 0.2, 0.5), length: 2.0 }; 3];
/// let pieces = Strands::from_counts([1, 2], pieces)?;
/// let groom = HelicoidGroom::new(vec![Frame::IDENTITY; 2], pieces)?;
/// let text = ron::to_string(&groom)?;
/// assert_eq!(ron::from_str::<HelicoidGroom>(&text)?, groom);
/// assert_eq!(groom.hair(1).length(), 4.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Raw", into = "Raw")]
pub struct HelicoidGroom {
    /// Metres in one unit of length, where it is known.
    pub unit: Option<f64>,
    /// The axis that is up, where it is known.
    pub up: Option<UpAxis>,
    // Invariant: one root a strand, a row of attributes each, kept strands are there.
    roots: Vec<Frame>,
    pieces: Strands<Piece>,
    strand_attributes: Attributes,
    kept: BTreeMap<u32, Vec<DVec3>>,
}

/// What a RON file of p-helicoids holds that is not a groom of them.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HelicoidGroomError {
    /// Not one root a strand, or a kept polyline of no strand.
    #[error(transparent)]
    Parts(#[from] GroomError),
    /// An attribute without a row a strand.
    #[error(transparent)]
    Column(#[from] ColumnError),
    /// A root that is not an orthonormal right-handed frame, or a piece with a number that is not
    /// finite or a negative length.
    ///
    /// ```
    /// use tress_helicoid::HelicoidGroom;
    ///
    /// let text = "(roots: [(position: (0, 0, 0), axes: (1, 0, 0, 0, 1, 0, 0, 0, -1))],
    ///     pieces: (offsets: [0, 1], points: [(k: (kt: 1.0), length: 1.0)]))";
    /// let error = ron::from_str::<HelicoidGroom>(text).unwrap_err();
    /// assert!(error.to_string().contains("strand 0"));
    /// ```
    #[error("strand {strand} has a root or a piece that is not one")]
    Strand {
        /// The strand.
        strand: usize,
    },
}

impl HelicoidGroom {
    /// Roots and pieces without attributes, unit and up axis unknown.
    ///
    /// # Errors
    ///
    /// If there is not one root a strand, or a root or piece is not one.
    pub fn new(roots: Vec<Frame>, pieces: Strands<Piece>) -> Result<Self, HelicoidGroomError> {
        let attributes = Attributes::new(pieces.len());
        Self::with_attributes(roots, pieces, attributes, BTreeMap::new())
    }

    /// All parts of a groom of p-helicoids: `kept` holds the polylines of strands without pieces.
    ///
    /// # Errors
    ///
    /// See [`HelicoidGroomError`].
    pub fn with_attributes(
        roots: Vec<Frame>,
        pieces: Strands<Piece>,
        strand_attributes: Attributes,
        kept: BTreeMap<u32, Vec<DVec3>>,
    ) -> Result<Self, HelicoidGroomError> {
        let (strands, rows) = (pieces.len(), strand_attributes.rows());
        if roots.len() != strands {
            return Err(GroomError::Roots { roots: roots.len(), strands }.into());
        }
        if rows != strands {
            return Err(GroomError::Rows { of: "strands", rows, expected: strands }.into());
        }
        let stray = kept.keys().position(|&strand| strands <= strand as usize);
        if let Some((entry, (&strand, _))) = stray.and_then(|i| kept.iter().enumerate().nth(i)) {
            return Err(GroomError::Kept { entry, strand }.into());
        }
        let good =
            |piece: &Piece| piece.k.is_finite() && piece.length.is_finite() && 0.0 <= piece.length;
        let whole = |i: &usize| roots[*i].is_valid() && pieces.strand(*i).iter().all(good);
        if let Some(strand) = (0..strands).find(|i| !whole(i)) {
            return Err(HelicoidGroomError::Strand { strand });
        }
        Ok(Self { unit: None, up: None, roots, pieces, strand_attributes, kept })
    }

    /// The same groom, said to be in this unit and with this axis up.
    #[must_use]
    pub fn in_space(mut self, unit: Option<f64>, up: Option<UpAxis>) -> Self {
        self.unit = unit;
        self.up = up;
        self
    }

    /// How many strands there are, kept ones included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.roots.len()
    }

    /// Whether there are no strands.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// Hair `i`; one without pieces where it is kept as a polyline.
    #[must_use]
    pub fn hair(&self, i: usize) -> PHelicoid<'_> {
        PHelicoid { root: self.roots[i], pieces: self.pieces.strand(i) }
    }

    /// All hairs in turn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = PHelicoid<'_>> {
        (0..self.len()).map(|i| self.hair(i))
    }

    /// The root frames.
    #[must_use]
    pub fn roots(&self) -> &[Frame] {
        &self.roots
    }

    /// The pieces.
    #[must_use]
    pub fn pieces(&self) -> &Strands<Piece> {
        &self.pieces
    }

    /// Columns with one row a strand.
    #[must_use]
    pub fn strand_attributes(&self) -> &Attributes {
        &self.strand_attributes
    }

    /// The polylines of strands that are no helicoids, by strand.
    #[must_use]
    pub fn kept(&self) -> &BTreeMap<u32, Vec<DVec3>> {
        &self.kept
    }

    /// The strands named, in that order, with their attributes.
    ///
    /// # Panics
    ///
    /// If a strand is not there.
    #[must_use]
    pub fn select(&self, strands: &[usize]) -> Self {
        let kept_as = |&i: &usize| self.kept.get(&u32::try_from(i).ok()?);
        let kept = (0..).zip(strands).filter_map(|(to, from)| Some((to, kept_as(from)?.clone())));
        let rows = |column: &Column| column.select(strands.iter().copied());
        Self {
            unit: self.unit,
            up: self.up,
            roots: strands.iter().map(|&i| self.roots[i]).collect(),
            pieces: self.pieces.select(strands.iter().copied()),
            strand_attributes: self.strand_attributes.map(strands.len(), rows),
            kept: kept.collect(),
        }
    }
}

/// Why p-helicoids cannot become polylines.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SampleError {
    /// A hair that cannot be traced.
    #[error("strand {strand}: {source}")]
    Trace {
        /// Which strand.
        strand: usize,
        /// Why.
        source: TraceError,
    },
    /// Fewer than two points a strand were asked for.
    #[error("{0} points a strand, expected at least 2")]
    Points(usize),
    /// More points than offsets can tell apart.
    #[error(transparent)]
    Offsets(#[from] OffsetsError),
}

/// Polylines of so many points a hair, at equal arc lengths; kept strands are as they were.
///
/// ```
/// use tress_geometry::{Frame, Strands};
/// use tress_helicoid::{Helicoid, HelicoidGroom, Piece, Tracing, sample};
///
/// let circle = Piece { k: Helicoid::new(1.0, 0.0, 0.0, 0.0), length: std::f64::consts::TAU };
/// let strands = Strands::from_counts([1], vec![circle])?;
/// let hairs = HelicoidGroom::new(vec![Frame::IDENTITY], strands)?;
/// let groom = sample(&hairs, 30, Tracing::default())?;
/// let points = groom.strands().strand(0);
/// assert!(points[0].distance(points[29]) < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// See [`SampleError`].
pub fn sample(
    hairs: &HelicoidGroom,
    points: usize,
    tracing: Tracing,
) -> Result<Groom, SampleError> {
    sample_counts(hairs, |_| points, tracing)
}

/// Like [`sample`], with a number of points for each strand.
///
/// # Errors
///
/// See [`SampleError`].
pub fn sample_counts(
    hairs: &HelicoidGroom,
    points: impl Fn(usize) -> usize,
    tracing: Tracing,
) -> Result<Groom, SampleError> {
    let kept = |i: usize| hairs.kept.get(&u32::try_from(i).unwrap_or(u32::MAX));
    let counts: Vec<usize> =
        (0..hairs.len()).map(|i| kept(i).map_or_else(|| points(i), Vec::len)).collect();
    if let Some(i) = (0..hairs.len()).find(|&i| kept(i).is_none() && counts[i] < 2) {
        return Err(SampleError::Points(counts[i]));
    }
    let total = counts.iter().fold(0_usize, |sum, &count| sum.saturating_add(count));
    if u32::try_from(total).is_err() {
        return Err(OffsetsError::TooMany { points: total }.into());
    }
    let mut strands = Strands::from_counts(counts, vec![DVec3::ZERO; total])?;
    let polylines: Vec<&mut [DVec3]> = strands.iter_mut().collect();
    let traced: Vec<Result<(), TraceError>> = polylines
        .into_par_iter()
        .enumerate()
        .with_min_len(16)
        .map(|(i, polyline)| match kept(i) {
            Some(points) => {
                polyline.copy_from_slice(points);
                Ok(())
            }
            None => hairs.hair(i).sample_evenly(tracing, polyline),
        })
        .collect();
    let failed = traced.into_iter().enumerate().find_map(|(i, done)| Some((i, done.err()?)));
    if let Some((strand, source)) = failed {
        return Err(SampleError::Trace { strand, source });
    }
    let points = Attributes::new(total);
    let groom = Groom::with_attributes(strands, points, hairs.strand_attributes.clone());
    Ok(groom.expect("a row a strand was checked").in_space(hairs.unit, hairs.up))
}

/// The groom as files hold it.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    #[serde(default)]
    unit: Option<f64>,
    #[serde(default)]
    up: Option<UpAxis>,
    roots: Vec<Frame>,
    pieces: Strands<Piece>,
    #[serde(default)]
    strand_attributes: BTreeMap<String, Column>,
    #[serde(default)]
    kept: BTreeMap<u32, Vec<DVec3>>,
}

impl TryFrom<Raw> for HelicoidGroom {
    type Error = HelicoidGroomError;
    fn try_from(raw: Raw) -> Result<Self, HelicoidGroomError> {
        let mut attributes = Attributes::new(raw.pieces.len());
        for (name, column) in raw.strand_attributes {
            attributes.insert(name, column)?;
        }
        let groom = Self::with_attributes(raw.roots, raw.pieces, attributes, raw.kept)?;
        Ok(groom.in_space(raw.unit, raw.up))
    }
}

impl From<HelicoidGroom> for Raw {
    fn from(groom: HelicoidGroom) -> Self {
        let columns = groom.strand_attributes.iter();
        Self {
            unit: groom.unit,
            up: groom.up,
            strand_attributes: columns.map(|(name, c)| (name.to_owned(), c.clone())).collect(),
            roots: groom.roots,
            pieces: groom.pieces,
            kept: groom.kept,
        }
    }
}

#[cfg(test)]
mod tests;
