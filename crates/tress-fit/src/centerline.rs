//! The line that a strand coils about, and the strand as seen from it.
//!
//! [`centerline`] takes the coil out of a strand by a regression over windows of two turns (see
//! the sources of `harmonic`); [`fourier_centerline`] is the low-pass of [CC 3.2.1]. Both give a
//! [`Centerline`]: a point for each point of the strand, arc lengths along them, and frames that
//! do not turn about the line (double reflection, Wang et al. 2008). In those frames a strand is a
//! list of offsets ([`Centerline::offsets`]) which can be laid along another line by arc length
//! ([`Centerline::at`]): the coil without the way it takes, [CC 3.2.2].

mod fourier;
mod frames;
mod harmonic;
mod period;

use glam::DVec3;
use tress_geometry::Frame;
use tress_geometry::curves::{hermite, hermite_derivative};
use tress_geometry::polyline::{self, Defect, place};

pub use frames::{rotation_minimizing_frames, rotation_minimizing_frames_from};

/// The line that a strand coils about: a point for each point of the strand.
#[derive(Clone, Debug, PartialEq)]
pub struct Centerline {
    // Invariant: as many of each, one at least; arc lengths ascend from 0.
    frames: Vec<Frame>,
    arc_lengths: Vec<f64>,
    turns: f64,
}

/// The centerline of a strand by harmonic regression over windows of two turns.
///
/// On coils of 2 to 40 turns about straight and bent axes it stays within 0.1 of the coil's radius
/// of the axis, and within 0.3 over the last half turn at either end; on a straight axis it is
/// exact. Turns may be any number, also between whole ones. A strand in which no coil of 1.25
/// turns or more is found is its own centerline, and [`Centerline::turns`] is then 0.
///
/// ```
/// use glam::DVec3;
/// use tress_fit::centerline;
///
/// // 4.5 turns of radius 2 about the x axis, which climb 3 a turn.
/// let coil: Vec<_> = (0..=54)
///     .map(|i| f64::from(i) / 12.0)
///     .map(|turn| {
///         let (sine, cosine) = (turn * std::f64::consts::TAU).sin_cos();
///         DVec3::new(3.0 * turn, 2.0 * cosine, 2.0 * sine)
///     })
///     .collect();
/// let line = centerline(&coil)?;
/// assert!(line.points().all(|p| p.y.hypot(p.z) < 0.01));
/// assert!((line.length() - 13.5).abs() < 0.01 && (line.turns() - 4.5).abs() < 0.05);
///
/// // Seen from the line, every point is 2 away, across.
/// let across = |o: &DVec3| (o.length() - 2.0).abs() < 0.01 && o.x.abs() < 0.01;
/// assert!(line.offsets(&coil).iter().all(across));
/// # Ok::<(), tress_geometry::polyline::Defect>(())
/// ```
///
/// # Errors
///
/// If the points are no strand: fewer than two, all in one place, or not finite.
pub fn centerline(points: &[DVec3]) -> Result<Centerline, Defect> {
    if let Some(defect) = polyline::defect(points) {
        return Err(defect);
    }
    let turns =
        period::coil_period(points).map_or(0.0, |period| (points.len() - 1) as f64 / period);
    centerline_of_turns(points, turns)
}

/// The centerline of a strand whose number of turns is known: that of another frame of an
/// animation.
///
/// Turns that are not a positive number make the strand its own centerline.
///
/// # Errors
///
/// As [`centerline`].
pub fn centerline_of_turns(points: &[DVec3], turns: f64) -> Result<Centerline, Defect> {
    match polyline::defect(points) {
        Some(defect) => Err(defect),
        None if 0.0 < turns && turns.is_finite() => {
            // A turn takes a point at least: more would be windows without points.
            let turns = turns.min(points.len() as f64);
            Ok(Centerline::through(&harmonic::windowed(points, turns), turns))
        }
        None => Ok(Centerline::through(points, 0.0)),
    }
}

/// The centerline of [CC 3.2.1]: the strand's steps, without all but the three lowest coefficients
/// of their discrete Fourier transform, laid end to end and moved to fit the points [CC 1].
///
/// It is right for many turns and for whole ones. The transform takes the strand's steps as
/// periodic, so that what is left of a turn at the end bends the line: its greatest distance from
/// the axis is 0.01 of the coil's radius for 20 turns, and 0.92 for 20.37.
/// [`Centerline::turns`] is 0, as the transform does not count them.
///
/// # Errors
///
/// As [`centerline`].
pub fn fourier_centerline(points: &[DVec3]) -> Result<Centerline, Defect> {
    match polyline::defect(points) {
        Some(defect) => Err(defect),
        None => Ok(Centerline::through(&fourier::low_pass(points), 0.0)),
    }
}

impl Centerline {
    /// The line through `points`, one at least, with frames that do not turn about it.
    pub(crate) fn through(points: &[DVec3], turns: f64) -> Self {
        let mut arc_lengths = Vec::with_capacity(points.len());
        polyline::arc_lengths(points, &mut arc_lengths);
        Self { frames: rotation_minimizing_frames(points), arc_lengths, turns }
    }

    /// How many turns of the coil were found; 0 where there is no coil.
    #[must_use]
    pub fn turns(&self) -> f64 {
        self.turns
    }

    /// Its points, one for each of the strand's.
    pub fn points(&self) -> impl ExactSizeIterator<Item = DVec3> {
        self.frames.iter().map(|frame| frame.position)
    }

    /// Arc length along the line at each of its points.
    #[must_use]
    pub fn arc_lengths(&self) -> &[f64] {
        &self.arc_lengths
    }

    /// Its length.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.arc_lengths.last().copied().unwrap_or(0.0)
    }

    /// At each point a frame whose tangent is the line's; they do not turn about it.
    #[must_use]
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// The frame at an arc length, held within the line; between points it goes along the cubic
    /// that their tangents make.
    #[must_use]
    pub fn at(&self, s: f64) -> Frame {
        let (i, u) = place(&self.arc_lengths, s);
        let here = self.frames[i];
        let Some(&next) = self.frames.get(i + 1) else { return here };
        let span = self.arc_lengths[i + 1] - self.arc_lengths[i];
        let ends = [here.position, next.position];
        let slopes = [here, next].map(|frame| frame.tangent() * span);
        let along = hermite_derivative(ends, slopes, u).try_normalize();
        let turned = here.turned_to(along.unwrap_or(here.tangent()));
        Frame { position: hermite(ends, slopes, u), axes: turned.axes }
    }

    /// Where the strand's points stand in the frames: along the tangent, along `u`, along `v`.
    ///
    /// Points beyond the line's last are left out.
    #[must_use]
    pub fn offsets(&self, points: &[DVec3]) -> Vec<DVec3> {
        let seen =
            |(frame, point): (&Frame, &DVec3)| frame.axes.transpose() * (*point - frame.position);
        self.frames.iter().zip(points).map(seen).collect()
    }
}

#[cfg(test)]
mod tests;
