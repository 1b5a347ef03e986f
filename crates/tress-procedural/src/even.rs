//! Strands that all have the same number of points.

use glam::DVec3;
use rayon::prelude::*;
use tress_geometry::polyline::{arc_lengths, defect, place};
use tress_geometry::{Groom, Strands};

/// Strands of `points_each` points each, one after the other in one flat array.
///
/// A procedural groom blends strands point by point, so all of them have as many points.
#[derive(Clone, Debug, PartialEq)]
pub struct EvenStrands {
    // Invariant: `points.len()` is a multiple of `points_each`, which is at least 2.
    points_each: usize,
    points: Vec<DVec3>,
}

/// Why strands are not even ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EvenError {
    /// Fewer than two points a strand.
    ///
    /// ```
    /// # use tress_procedural::{EvenError, EvenStrands};
    /// assert_eq!(EvenStrands::new(1, vec![]), Err(EvenError::TooFew { points_each: 1 }));
    /// ```
    #[error("strands of {points_each} points, expected 2 or more")]
    TooFew {
        /// Points a strand asked for.
        points_each: usize,
    },
    /// More points than memory holds.
    ///
    /// ```
    /// # use glam::DVec3;
    /// # use tress_geometry::{Groom, Strands};
    /// # use tress_procedural::{EvenError, EvenStrands};
    /// let strands = Strands::from_counts([2], vec![DVec3::ZERO, DVec3::Y])?;
    /// let error = EvenStrands::resampled(&Groom::new(strands), usize::MAX);
    /// assert_eq!(error, Err(EvenError::NoMemory { strands: 1, points_each: usize::MAX }));
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[error("there is no memory for {strands} strands of {points_each} points")]
    NoMemory {
        /// Strands that were to be resampled.
        strands: usize,
        /// Points a strand asked for.
        points_each: usize,
    },
    /// The points do not divide into strands.
    ///
    /// ```
    /// # use glam::DVec3;
    /// # use tress_procedural::{EvenError, EvenStrands};
    /// let error = EvenStrands::new(2, vec![DVec3::ZERO; 5]);
    /// assert_eq!(error, Err(EvenError::Ragged { points: 5, points_each: 2 }));
    /// ```
    #[error("{points} points do not make strands of {points_each}")]
    Ragged {
        /// How many points there are.
        points: usize,
        /// Points a strand.
        points_each: usize,
    },
    /// A strand with another number of points than the first.
    ///
    /// ```
    /// # use glam::DVec3;
    /// # use tress_geometry::Strands;
    /// # use tress_procedural::{EvenError, EvenStrands};
    /// let strands = Strands::from_counts([2, 3], vec![DVec3::ZERO; 5])?;
    /// let error = EvenStrands::try_from(&strands).unwrap_err();
    /// assert_eq!(error, EvenError::Uneven { strand: 1, points: 3, expected: 2 });
    /// # Ok::<(), tress_geometry::OffsetsError>(())
    /// ```
    #[error("strand {strand} has {points} points, expected {expected} as strand 0 has")]
    Uneven {
        /// The strand.
        strand: usize,
        /// Its points.
        points: usize,
        /// Points of the first strand.
        expected: usize,
    },
}

impl EvenStrands {
    /// Cuts points into strands of `points_each`.
    ///
    /// # Errors
    ///
    /// If a strand would have fewer than two points or the points do not divide.
    pub fn new(points_each: usize, points: Vec<DVec3>) -> Result<Self, EvenError> {
        if points_each < 2 {
            return Err(EvenError::TooFew { points_each });
        }
        if !points.len().is_multiple_of(points_each) {
            return Err(EvenError::Ragged { points: points.len(), points_each });
        }
        Ok(Self { points_each, points })
    }

    /// As many strands of as many points, all at the origin.
    pub(crate) fn zeros(strands: usize, points_each: usize) -> Self {
        Self { points_each, points: vec![DVec3::ZERO; strands * points_each] }
    }

    /// Every strand of a groom resampled to `points_each` points even in arc length, and which
    /// strand of the groom each is. Strands that have as many points keep them; those with a
    /// [defect](tress_geometry::polyline::Defect) are left out.
    ///
    /// # Errors
    ///
    /// If fewer than two points are asked for, or more than there is memory for.
    pub fn resampled(groom: &Groom, points_each: usize) -> Result<(Self, Vec<usize>), EvenError> {
        if points_each < 2 {
            return Err(EvenError::TooFew { points_each });
        }
        let strands = groom.strands();
        let sound: Vec<usize> =
            (0..strands.len()).filter(|&i| defect(strands.strand(i)).is_none()).collect();
        let none = EvenError::NoMemory { strands: sound.len(), points_each };
        let total = sound.len().checked_mul(points_each).ok_or(none)?;
        let mut points = Vec::new();
        points.try_reserve_exact(total).map_err(|_| none)?;
        points.resize(total, DVec3::ZERO);
        let mut even = Self { points_each, points };
        even.points
            .par_chunks_mut(points_each)
            .zip(&sound)
            .for_each(|(out, &i)| resample(strands.strand(i), out));
        Ok((even, sound))
    }

    /// How many strands there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.points.len() / self.points_each
    }

    /// Whether there are no strands.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Points a strand.
    #[must_use]
    pub fn points_each(&self) -> usize {
        self.points_each
    }

    /// The points of strand `i`.
    #[must_use]
    pub fn strand(&self, i: usize) -> &[DVec3] {
        &self.points[i * self.points_each..(i + 1) * self.points_each]
    }

    /// The points of strand `i`, to be moved.
    pub fn strand_mut(&mut self, i: usize) -> &mut [DVec3] {
        &mut self.points[i * self.points_each..(i + 1) * self.points_each]
    }

    /// The points of every strand in turn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[DVec3]> {
        self.points.chunks_exact(self.points_each)
    }

    /// The first point of every strand.
    #[must_use]
    pub fn roots(&self) -> Vec<DVec3> {
        self.iter().map(|strand| strand[0]).collect()
    }

    /// All points, strand after strand.
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// All points, to be moved.
    pub fn points_mut(&mut self) -> &mut [DVec3] {
        &mut self.points
    }

    /// The strands named, in that order.
    ///
    /// # Panics
    ///
    /// If a strand is not there.
    #[must_use]
    pub fn select(&self, strands: &[usize]) -> Self {
        let points = strands.iter().flat_map(|&i| self.strand(i).iter().copied()).collect();
        Self { points_each: self.points_each, points }
    }

    /// The same strands, cut by offsets.
    ///
    /// # Errors
    ///
    /// If 32 bits do not tell the points apart.
    pub fn into_strands(self) -> Result<Strands<DVec3>, tress_geometry::OffsetsError> {
        let counts = std::iter::repeat_n(self.points_each, self.len());
        Strands::from_counts(counts, self.points)
    }
}

impl TryFrom<&Strands<DVec3>> for EvenStrands {
    type Error = EvenError;

    fn try_from(strands: &Strands<DVec3>) -> Result<Self, EvenError> {
        let expected = strands.counts().next().unwrap_or(2);
        if let Some((strand, points)) = strands.counts().enumerate().find(|&(_, n)| n != expected) {
            return Err(EvenError::Uneven { strand, points, expected });
        }
        Self::new(expected, strands.points().to_vec())
    }
}

/// Points even in arc length along a polyline without a defect; its ends stay.
fn resample(polyline: &[DVec3], out: &mut [DVec3]) {
    if polyline.len() == out.len() {
        // Strands that have as many points keep them, bit for bit.
        out.copy_from_slice(polyline);
        return;
    }
    let mut s = Vec::with_capacity(polyline.len());
    arc_lengths(polyline, &mut s);
    let last = out.len() - 1;
    let step = s[s.len() - 1] / last as f64;
    for (j, point) in out.iter_mut().enumerate() {
        let (i, f) = place(&s, step * j as f64);
        *point = polyline[i].lerp(polyline[(i + 1).min(polyline.len() - 1)], f);
    }
    out[last] = polyline[polyline.len() - 1];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resampling_keeps_ends_and_leaves_defects_out() {
        let points = vec![
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(1.0, 3.0, 0.0),
            DVec3::ONE,
            DVec3::NAN,
            DVec3::ONE,
        ];
        let groom = Groom::new(Strands::from_counts([3, 1, 2], points).expect("six points"));
        let (even, kept) = EvenStrands::resampled(&groom, 5).expect("five points are enough");
        assert_eq!(kept, [0]);
        assert_eq!(even.strand(0)[1], DVec3::X);
        assert_eq!(even.strand(0)[4], DVec3::new(1.0, 3.0, 0.0));
        assert_eq!(EvenStrands::resampled(&groom, 0), Err(EvenError::TooFew { points_each: 0 }));
    }
}
