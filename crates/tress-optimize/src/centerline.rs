//! Holding the lines that strands wind about while their coils change.
//!
//! The centerline of a strand is taken as the mean of its positions over the turn about each place:
//! the coil cancels, the line stays. A strand whose coils were changed element by element keeps how
//! far each element advances, but where its axis bends the advances point elsewhere. It is brought
//! back by sculpting: points a turn or more apart are drawn to where they are now, moved by what
//! their centerline is off.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use tress_analysis::smoothed;
use tress_geometry::{HelixGroom, Strands, SuperHelix};

use crate::{Control, SculptError, SculptOptions, sculpt};

/// Control points of a strand at most: more cost the cube of their number.
const MOST_CONTROLS: f64 = 10.0;

/// Rounds of drawing points: what a round leaves is a bend within a turn, and halves.
const ROUNDS: usize = 3;

/// Samples of a strand from which its centerline is taken, an element.
const SAMPLES: usize = 4;

/// Moves the strands of `changed` so that they wind about the same lines as those of `groom`, whose
/// elements they share one by one; gives the number of strands that were moved.
///
/// Strands of less than three turns have no centerline to speak of and stay.
///
/// # Errors
///
/// If the grooms do not have as many strands.
///
/// ```
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
/// use tress_optimize::hold_centerlines;
///
/// let coil = |radius| -> Result<HelixGroom, Box<dyn std::error::Error>> {
///     let element = Element { length: 0.4, ..Element::coil(radius, 0.6) };
///     Ok(HelixGroom::new(vec![Frame::IDENTITY], Strands::from_counts([80], vec![element; 80])?)?)
/// };
/// let (before, mut after) = (coil(0.5)?, coil(0.5)?);
/// assert_eq!(hold_centerlines(&before, &mut after)?, 1);
/// let tips = [&before, &after].map(|groom| groom.strand(0).tip().position);
/// assert!(tips[0].distance(tips[1]) < 1e-6, "nothing was off");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn hold_centerlines(
    groom: &HelixGroom,
    changed: &mut HelixGroom,
) -> Result<usize, SculptError> {
    if groom.len() != changed.len() {
        let (controls, strands) = (groom.len(), changed.len());
        return Err(SculptError::Strands { controls, strands });
    }
    let lines: Vec<Line> = (0..groom.len())
        .into_par_iter()
        .map(|i| match groom.kept_polyline(i) {
            Some(_) => Line::default(),
            None => centerline(&groom.strand(i)),
        })
        .collect();
    let mut moved = 0;
    for _ in 0..ROUNDS {
        let controls: Vec<Vec<Control>> = (0..changed.len())
            .into_par_iter()
            .map(|i| controls(&changed.strand(i), &lines[i]))
            .collect();
        moved = controls.iter().filter(|controls| !controls.is_empty()).count();
        let counts: Vec<usize> = controls.iter().map(Vec::len).collect();
        // Ten controls a strand at most: fewer than the elements that are numbered already.
        let Ok(controls) = Strands::from_counts(counts, controls.concat()) else { break };
        sculpt(changed, &controls, &SculptOptions::default())?;
    }
    Ok(moved)
}

/// Points of `strand` at joints a turn or more apart, drawn by what the centerline is off there.
fn controls(strand: &SuperHelix<'_>, line: &Line) -> Vec<Control> {
    let now = centerline(strand);
    if now.points.len() != line.points.len() || now.turns < 3.0 {
        return vec![];
    }
    let first = now.whole.start.max(line.whole.start);
    let Some(reach) = now.whole.end.min(line.whole.end).checked_sub(first + 1) else {
        return vec![];
    };
    #[expect(clippy::cast_possible_truncation, reason = "held to ten")]
    #[expect(clippy::cast_sign_loss, reason = "at least three")]
    let n = now.turns.min(MOST_CONTROLS) as usize;
    let mut ends = vec![0.0];
    for element in strand.elements {
        ends.push(ends[ends.len() - 1] + element.length);
    }
    let joints: Vec<DVec3> = strand.joints().map(|frame| frame.position).collect();
    let draw = |joint: usize| {
        let off = line.points[joint] - now.points[joint];
        Control::new(ends[joint], joints[joint] + off)
    };
    (1..=n).map(|k| first + k * reach / n).filter(|&joint| 0 < joint).map(draw).collect()
}

/// The line that a strand winds about.
#[derive(Clone, Debug, Default, PartialEq)]
struct Line {
    /// Its place at each joint of the strand; none for a strand that does not turn.
    points: Vec<DVec3>,
    /// The joints that have half a turn on either side.
    whole: Range<usize>,
    /// Turns of the strand about it.
    turns: f64,
}

/// The centerline at each joint: the mean of positions from half a turn before it to half a turn
/// behind it; within half a turn of an end, over as much as lies on both sides.
fn centerline(strand: &SuperHelix<'_>) -> Line {
    // Samples within elements, each with the turning up to it.
    let smooth = smoothed(strand.elements);
    let mut angles = Vec::new();
    let mut sums = vec![DVec3::ZERO];
    let mut weights = vec![0.0];
    let mut angle = 0.0;
    for ((element, smooth), base) in strand.elements.iter().zip(&smooth).zip(strand.joints()) {
        let step = element.length / SAMPLES as f64;
        let turning = smooth.curvature.length() * step;
        for k in 0..SAMPLES {
            let position = element.frame_at(&base, step * (k as f64 + 0.5)).position;
            angles.push(angle + 0.5 * turning);
            angle += turning;
            // Weighted by turning, a turn's mean is its middle even where its speed changes.
            sums.push(sums[sums.len() - 1] + position * turning);
            weights.push(weights[weights.len() - 1] + turning);
        }
    }
    if angle == 0.0 || !angle.is_finite() {
        return Line::default();
    }
    let mean = |at: f64| {
        let half = PI.min(at).min(angle - at);
        let first = angles.partition_point(|&a| a < at - half);
        let end = angles.partition_point(|&a| a <= at + half).max(first + 1).min(angles.len());
        let first = first.min(end - 1);
        (sums[end] - sums[first]) / (weights[end] - weights[first])
    };
    let mut joint_angles = vec![0.0];
    for (element, smooth) in strand.elements.iter().zip(&smooth) {
        let before = joint_angles[joint_angles.len() - 1];
        joint_angles.push(before + smooth.curvature.length() * element.length);
    }
    Line {
        whole: joint_angles.partition_point(|&a| a < PI)
            ..joint_angles.partition_point(|&a| a <= angle - PI),
        points: joint_angles.into_iter().map(|at| mean(at.min(angle))).collect(),
        turns: angle / TAU,
    }
}

#[cfg(test)]
mod tests;
