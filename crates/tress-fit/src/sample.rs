//! Super-helices to polylines.

use glam::DVec3;
use rayon::prelude::*;
use tress_geometry::polyline::place;
use tress_geometry::{Attributes, Column, Groom, HelixGroom, OffsetsError, Strands, SuperHelix};

use crate::columns::{joined, zeros_like};

/// How many points a strand is given; they are even in arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sampling<'a> {
    /// So many for every strand.
    Points(usize),
    /// So many for each strand: what gives an edited groom the counts it came with.
    Counts(&'a [usize]),
    /// As many as bring neighbours no farther apart than this along the strand.
    Spacing(f64),
    /// So many in one turn of each strand's coil, at least one an element, and no more than 10,000
    /// a strand: what turns more often is no hair.
    PerTurn(f64),
}

/// Why a groom is not sampled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SampleError {
    /// A polyline has two points or more.
    ///
    /// ```
    /// # use tress_fit::{SampleError, Sampling, sample};
    /// # use tress_geometry::{HelixGroom, Strands};
    /// let none = HelixGroom::new(vec![], Strands::default())?;
    /// let error = sample(&none, &Sampling::Points(1));
    /// assert_eq!(error, Err(SampleError::TooFewPoints { points: 1 }));
    /// # Ok::<(), tress_geometry::GroomError>(())
    /// ```
    #[error("{points} points do not make a polyline, which has at least 2")]
    TooFewPoints {
        /// Points asked for.
        points: usize,
    },
    /// Spacing and points per turn must be positive numbers.
    ///
    /// ```
    /// # use tress_fit::{SampleError, Sampling, sample};
    /// # use tress_geometry::{HelixGroom, Strands};
    /// let none = HelixGroom::new(vec![], Strands::default())?;
    /// let error = sample(&none, &Sampling::Spacing(-1.0));
    /// assert_eq!(error, Err(SampleError::NotPositive { value: -1.0 }));
    /// # Ok::<(), tress_geometry::GroomError>(())
    /// ```
    #[error("the spacing {value} is not a positive number")]
    NotPositive {
        /// The number given.
        value: f64,
    },
    /// Not one count a strand.
    ///
    /// ```
    /// # use tress_fit::{SampleError, Sampling, sample};
    /// # use tress_geometry::{HelixGroom, Strands};
    /// let none = HelixGroom::new(vec![], Strands::default())?;
    /// let error = sample(&none, &Sampling::Counts(&[3]));
    /// assert_eq!(error, Err(SampleError::Counts { counts: 1, strands: 0 }));
    /// # Ok::<(), tress_geometry::GroomError>(())
    /// ```
    #[error("{counts} point counts for {strands} strands")]
    Counts {
        /// Counts given.
        counts: usize,
        /// Strands there are.
        strands: usize,
    },
    /// More points than offsets can tell apart, as a tiny spacing asks for.
    ///
    /// ```
    /// # use glam::DVec3;
    /// # use tress_fit::{SampleError, Sampling, sample};
    /// # use tress_geometry::{Element, Frame, HelixGroom, Strands};
    /// let straight = vec![Element { curvature: DVec3::ZERO, length: 1.0 }];
    /// let elements = Strands::from_counts([1], straight)?;
    /// let one = HelixGroom::new(vec![Frame::IDENTITY], elements)?;
    /// let error = sample(&one, &Sampling::Spacing(1e-12));
    /// assert!(matches!(error, Err(SampleError::TooMany(_))));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[error(transparent)]
    TooMany(#[from] OffsetsError),
    /// More points than the memory holds.
    #[error("there is no memory for {points} points")]
    NoMemory {
        /// Points asked for.
        points: usize,
    },
}

/// Polylines along super-helices, points even in arc length, root and tip included.
///
/// Strands kept as polylines are given back as they are, whatever the sampling. Strand attributes
/// are carried over and attributes of joints interpolated to points; a column that the kept
/// strands' points have and the joints have not, or the other way round, is left out.
///
/// ```
/// use glam::DVec3;
/// use tress_fit::{Sampling, sample};
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
///
/// let straight = vec![Element { curvature: DVec3::ZERO, length: 1.0 }; 2];
/// let helices = HelixGroom::new(vec![Frame::IDENTITY], Strands::from_counts([2], straight)?)?;
/// let groom = sample(&helices, &Sampling::Points(5))?;
/// assert_eq!(groom.strands().points()[3], DVec3::new(1.5, 0.0, 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// See [`SampleError`].
pub fn sample(helices: &HelixGroom, how: &Sampling<'_>) -> Result<Groom, SampleError> {
    let counts = counts(helices, how)?;
    let total = counts.iter().fold(0_usize, |sum, &count| sum.saturating_add(count));
    if u32::try_from(total).is_err() {
        return Err(OffsetsError::TooMany { points: total }.into());
    }
    let mut points = Vec::new();
    points.try_reserve_exact(total).map_err(|_| SampleError::NoMemory { points: total })?;
    points.resize(total, DVec3::ZERO);
    let mut strands = Strands::from_counts(counts, points)?;
    let polylines: Vec<&mut [DVec3]> = strands.iter_mut().collect();
    polylines.into_par_iter().enumerate().with_min_len(16).for_each(|(i, polyline)| match helices
        .kept_polyline(i)
    {
        Some((_, kept)) => polyline.copy_from_slice(kept),
        None => helices.strand(i).sample_evenly(polyline),
    });
    let groom = with_point_attributes(helices, strands);
    Ok(groom.in_space(helices.unit, helices.up))
}

/// Steps that a strand is cut into for its turns, at most.
const MOST_BY_TURNS: f64 = 1e4;

/// How many points each strand gets.
fn counts(helices: &HelixGroom, how: &Sampling<'_>) -> Result<Vec<usize>, SampleError> {
    match *how {
        Sampling::Points(points) if points < 2 => return Err(SampleError::TooFewPoints { points }),
        Sampling::Spacing(value) | Sampling::PerTurn(value)
            if !(0.0 < value && value.is_finite()) =>
        {
            return Err(SampleError::NotPositive { value });
        }
        Sampling::Counts(counts) if counts.len() != helices.len() => {
            return Err(SampleError::Counts { counts: counts.len(), strands: helices.len() });
        }
        _ => {}
    }
    let own = |(i, strand): (usize, SuperHelix<'_>)| match helices.kept_polyline(i) {
        Some((_, points)) => points.len(),
        None => match *how {
            Sampling::Points(points) => points,
            Sampling::Counts(counts) => counts[i],
            Sampling::Spacing(spacing) => steps(strand.length() / spacing) + 1,
            Sampling::PerTurn(n) => {
                steps((strand.turns() * n).min(MOST_BY_TURNS)).max(strand.elements.len()) + 1
            }
        },
    };
    Ok(helices.iter().enumerate().map(own).collect())
}

/// At least one step, and no more than 32 bits count.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held within u32")]
fn steps(ratio: f64) -> usize {
    // A ratio that rounding put just above a whole number is that number.
    (ratio * (1.0 - 1e-12)).ceil().clamp(1.0, f64::from(u32::MAX)) as usize
}

fn with_point_attributes(helices: &HelixGroom, strands: Strands<DVec3>) -> Groom {
    let (joints, kept) = (helices.joint_attributes(), &helices.kept().point_attributes);
    let mut points = Attributes::new(strands.points().len());
    if !(joints.is_empty() && kept.is_empty()) {
        let places = places(helices, &strands);
        let names = joints.iter().map(|(name, _)| name);
        let only_kept = kept.iter().map(|(name, _)| name).filter(|n| joints.get(n).is_none());
        for name in names.chain(only_kept) {
            let Some(rows) = stacked(helices, name) else { continue };
            let column = rows.interpolate(places.iter().copied());
            points.insert(name, column).expect("a place a point");
        }
    }
    Groom::with_attributes(strands, points, helices.strand_attributes().clone())
        .expect("a row a point and a row a strand")
}

/// The rows of all joints and behind them those of all kept points, where both have the column.
fn stacked(helices: &HelixGroom, name: &str) -> Option<Column> {
    let (joints, kept) = (helices.joint_attributes(), &helices.kept().point_attributes);
    let no_helix = helices.kept().strands.len() == helices.len();
    match (joints.get(name), kept.get(name)) {
        (Some(joints), Some(kept)) => joined(joints, kept),
        (Some(joints), None) if kept.rows() == 0 => Some(joints.clone()),
        (None, Some(kept)) if no_helix => joined(&zeros_like(kept, joints.rows()), kept),
        _ => None,
    }
}

/// For each point its row among the stacked rows, and how far to the next.
fn places(helices: &HelixGroom, strands: &Strands<DVec3>) -> Vec<(usize, f64)> {
    let mut places = Vec::with_capacity(strands.points().len());
    let mut kept_row = helices.joint_attributes().rows();
    let mut ends = Vec::new();
    for (i, strand) in helices.iter().enumerate() {
        let count = strands.range(i).len();
        if helices.kept_polyline(i).is_some() {
            places.extend((0..count).map(|k| (kept_row + k, 0.0)));
            kept_row += count;
            continue;
        }
        ends.clear();
        ends.push(0.0);
        ends.extend(strand.elements.iter().scan(0.0, |s, element| {
            *s += element.length;
            Some(*s)
        }));
        let (first_row, length) = (helices.joint_range(i).start, strand.length());
        places.extend((0..count).map(|k| {
            let (joint, beyond) = place(&ends, length * (k as f64 / (count - 1).max(1) as f64));
            (first_row + joint, beyond)
        }));
    }
    places
}

#[cfg(test)]
mod tests;
