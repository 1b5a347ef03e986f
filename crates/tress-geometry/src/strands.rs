//! Many curves as one flat array and an offsets array.
//!
//! Offsets rather than lists of lists: half the memory traffic, strands next to each other in
//! cache, and any array library reads the two arrays as they are.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// Many polylines in one flat array, cut by ascending offsets.
///
/// Strand `i` owns `points[offsets[i]..offsets[i + 1]]`; the offsets hold one entry more than
/// there are strands, so the last strand needs no branch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    try_from = "Raw<T>",
    into = "Raw<T>",
    bound(serialize = "T: Serialize + Clone", deserialize = "T: Deserialize<'de>")
)]
pub struct Strands<T> {
    // Invariant: starts at 0, never falls, ends at `points.len()`.
    offsets: Vec<u32>,
    points: Vec<T>,
}

/// Why a pair of arrays is not a set of strands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OffsetsError {
    /// The first offset must be 0.
    #[error("offsets start at {0}, not at 0")]
    Start(u32),
    /// Offsets may not fall.
    ///
    /// ```
    /// # use tress_geometry::{OffsetsError, Strands};
    /// let bad = Strands::new(vec![0, 3, 2], vec![(); 2]);
    /// assert_eq!(bad, Err(OffsetsError::Falls { index: 2 }));
    /// ```
    #[error("offset {index} falls below the one before it")]
    Falls {
        /// The offending index.
        index: usize,
    },
    /// The last offset must be the number of points.
    #[error("offsets end at {end} but there are {points} points")]
    End {
        /// The last offset.
        end: usize,
        /// How many points there are.
        points: usize,
    },
    /// Offsets are 32 bits wide.
    ///
    /// ```
    /// # use tress_geometry::{OffsetsError, Strands};
    /// let huge = Strands::from_counts([1 << 31, 1 << 31], vec![(); 1 << 32]);
    /// assert_eq!(huge, Err(OffsetsError::TooMany { points: 1 << 32 }));
    /// ```
    #[error("{points} points are more than the 4,294,967,295 that offsets can tell apart")]
    TooMany {
        /// How many points there would be.
        points: usize,
    },
}

impl<T> Default for Strands<T> {
    fn default() -> Self {
        Self { offsets: vec![0], points: Vec::new() }
    }
}

impl<T> Strands<T> {
    /// Joins offsets and points, checking that they fit.
    ///
    /// # Errors
    ///
    /// If the offsets do not start at 0, fall, or do not end at the number of points.
    pub fn new(offsets: Vec<u32>, points: Vec<T>) -> Result<Self, OffsetsError> {
        let start = offsets.first().copied().unwrap_or(u32::MAX);
        if start != 0 {
            return Err(OffsetsError::Start(start));
        }
        if let Some(i) = offsets.windows(2).position(|w| w[1] < w[0]) {
            return Err(OffsetsError::Falls { index: i + 1 });
        }
        let end = offsets.last().map_or(0, |&offset| offset as usize);
        if end != points.len() {
            return Err(OffsetsError::End { end, points: points.len() });
        }
        Ok(Self { offsets, points })
    }

    /// Joins point counts and points.
    ///
    /// # Errors
    ///
    /// If the counts do not sum to the number of points, or to more than 32 bits hold.
    pub fn from_counts(
        counts: impl IntoIterator<Item = usize>,
        points: Vec<T>,
    ) -> Result<Self, OffsetsError> {
        let mut end = 0_usize;
        let mut offsets = vec![0];
        for count in counts {
            end = end.saturating_add(count);
            offsets.push(u32::try_from(end).map_err(|_| OffsetsError::TooMany { points: end })?);
        }
        Self::new(offsets, points)
    }

    /// Appends a strand.
    ///
    /// # Errors
    ///
    /// If 32 bits no longer tell the points apart; the strands are then as they were.
    pub fn push(&mut self, strand: impl IntoIterator<Item = T>) -> Result<(), OffsetsError> {
        let before = self.points.len();
        self.points.extend(strand);
        match u32::try_from(self.points.len()) {
            Ok(end) => self.offsets.push(end),
            Err(_) => {
                let points = self.points.len();
                self.points.truncate(before);
                return Err(OffsetsError::TooMany { points });
            }
        }
        Ok(())
    }

    /// Appends all strands of another set.
    ///
    /// # Errors
    ///
    /// If 32 bits no longer tell the points apart; the strands are then as they were.
    pub fn append(&mut self, other: &Self) -> Result<(), OffsetsError>
    where
        T: Clone,
    {
        let before = self.points.len();
        let points = before + other.points.len();
        if u32::try_from(points).is_err() {
            return Err(OffsetsError::TooMany { points });
        }
        let last = self.offsets[self.offsets.len() - 1];
        self.offsets.extend(other.offsets[1..].iter().map(|offset| last + offset));
        self.points.extend_from_slice(&other.points);
        Ok(())
    }

    /// How many strands there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Whether there are no strands.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Where strand `i` lies in the flat array.
    #[must_use]
    pub fn range(&self, i: usize) -> Range<usize> {
        self.offsets[i] as usize..self.offsets[i + 1] as usize
    }

    /// The points of strand `i`.
    #[must_use]
    pub fn strand(&self, i: usize) -> &[T] {
        &self.points[self.range(i)]
    }

    /// The points of strand `i`, to be changed.
    pub fn strand_mut(&mut self, i: usize) -> &mut [T] {
        let range = self.range(i);
        &mut self.points[range]
    }

    /// The points of every strand in turn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[T]> {
        (0..self.len()).map(|i| self.strand(i))
    }

    /// The points of every strand in turn, to be changed; collect it to share strands out.
    pub fn iter_mut(&mut self) -> impl ExactSizeIterator<Item = &mut [T]> {
        let mut rest = self.points.as_mut_slice();
        self.offsets.windows(2).map(move |ends| {
            let (strand, behind) =
                std::mem::take(&mut rest).split_at_mut((ends[1] - ends[0]) as usize);
            rest = behind;
            strand
        })
    }

    /// How many points each strand has.
    pub fn counts(&self) -> impl ExactSizeIterator<Item = usize> {
        self.offsets.windows(2).map(|ends| (ends[1] - ends[0]) as usize)
    }

    /// Where strands begin in the flat array, and its length.
    #[must_use]
    pub fn offsets(&self) -> &[u32] {
        &self.offsets
    }

    /// All points, strand after strand.
    #[must_use]
    pub fn points(&self) -> &[T] {
        &self.points
    }

    /// All points, to be changed.
    pub fn points_mut(&mut self) -> &mut [T] {
        &mut self.points
    }

    /// The same cut with other points: `points[i]` takes the place of this one's.
    ///
    /// # Errors
    ///
    /// If there are not as many.
    pub fn with_points<U>(&self, points: Vec<U>) -> Result<Strands<U>, OffsetsError> {
        Strands::new(self.offsets.clone(), points)
    }

    /// The offsets and the points.
    #[must_use]
    pub fn into_parts(self) -> (Vec<u32>, Vec<T>) {
        (self.offsets, self.points)
    }

    /// The strands named by `strands`, in that order; a strand may be named twice.
    ///
    /// # Panics
    ///
    /// If a strand is not there, or if 32 bits no longer tell the points apart.
    #[must_use]
    pub fn select(&self, strands: impl IntoIterator<Item = usize>) -> Self
    where
        T: Clone,
    {
        let mut selected = Self::default();
        for i in strands {
            let points = self.strand(i).iter().cloned();
            selected.push(points).expect("a selection of strands fits where the strands did");
        }
        selected
    }
}

#[derive(Clone, Serialize, Deserialize)]
struct Raw<T> {
    offsets: Vec<u32>,
    points: Vec<T>,
}

impl<T> TryFrom<Raw<T>> for Strands<T> {
    type Error = OffsetsError;
    fn try_from(raw: Raw<T>) -> Result<Self, OffsetsError> {
        Self::new(raw.offsets, raw.points)
    }
}

impl<T> From<Strands<T>> for Raw<T> {
    fn from(s: Strands<T>) -> Self {
        Self { offsets: s.offsets, points: s.points }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_broken_cut_is_refused() {
        assert_eq!(Strands::<u8>::new(vec![], vec![]), Err(OffsetsError::Start(u32::MAX)));
        assert_eq!(Strands::new(vec![1, 1], vec![0]), Err(OffsetsError::Start(1)));
        let end = OffsetsError::End { end: 2, points: 3 };
        assert_eq!(Strands::new(vec![0, 2], vec![0; 3]), Err(end));
        assert_eq!(Strands::from_counts([1, 1], vec![0; 3]), Err(end));
    }

    #[test]
    fn changing_strands_one_by_one_reaches_every_point_once() {
        let mut strands = Strands::from_counts([2, 0, 3], vec![0; 5]).expect("counts sum to 5");
        for (i, strand) in strands.iter_mut().enumerate() {
            strand.iter_mut().for_each(|point| *point += i + 1);
        }
        assert_eq!(strands.points(), [1, 1, 3, 3, 3]);
        assert_eq!(strands.counts().collect::<Vec<_>>(), [2, 0, 3]);
        let picked = strands.select([2, 1, 2]);
        assert_eq!((picked.offsets(), picked.points().len()), (&[0, 3, 3, 6][..], 6));
    }

    #[test]
    fn parts_make_the_same_strands_again() {
        let strands = Strands::from_counts([2, 0, 3], vec![0, 1, 2, 3, 4]).expect("5 points");
        let (offsets, points) = strands.clone().into_parts();
        assert_eq!(Strands::new(offsets, points), Ok(strands));
    }

    #[test]
    fn serialized_strands_are_checked_when_read() {
        let strands = Strands::from_counts([1, 2], vec![7, 8, 9]).expect("counts sum to 3");
        let text = ron::to_string(&strands).expect("plain data");
        assert_eq!(ron::from_str::<Strands<i32>>(&text), Ok(strands));
        assert!(ron::from_str::<Strands<i32>>("(offsets: [0, 2], points: [1])").is_err());
    }
}
