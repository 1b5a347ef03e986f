//! Holding the lines that strands wind about while their coils change.
//!
//! The centerline of a strand is taken as the mean of its positions over the turn about each place:
//! the coil cancels, the line stays. A strand whose coils were changed element by element keeps how
//! far each element advances, but where its axis bends the advances point elsewhere. It is brought
//! back by sculpting: points a turn or more apart are drawn to where they are now, moved by what
//! their centerline is off.

use glam::DVec3;
use rayon::prelude::*;
use tress_analysis::smoothed;
use tress_geometry::{HelixGroom, Strands, SuperHelix};

use crate::{Control, SculptError, SculptOptions, sculpt};

/// Control points of a strand at most: more cost the cube of their number.
const MOST_CONTROLS: usize = 10;

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
    let lines: Vec<Vec<DVec3>> =
        (0..groom.len())
            .into_par_iter()
            .map(|i| {
                if groom.kept_polyline(i).is_some() { vec![] } else { centerline(&groom.strand(i)) }
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
fn controls(strand: &SuperHelix<'_>, line: &[DVec3]) -> Vec<Control> {
    let now = centerline(strand);
    if now.len() != line.len() || now.is_empty() {
        return vec![];
    }
    let turns: f64 = smoothed(strand.elements).iter().map(|element| element.turns()).sum();
    #[expect(clippy::cast_possible_truncation, reason = "held below ten")]
    #[expect(clippy::cast_sign_loss, reason = "turns are not negative")]
    let n = (turns as usize).min(MOST_CONTROLS);
    if turns < 3.0 {
        return vec![];
    }
    let mut ends = vec![0.0];
    for element in strand.elements {
        ends.push(ends[ends.len() - 1] + element.length);
    }
    let joints: Vec<DVec3> = strand.joints().map(|frame| frame.position).collect();
    (1..=n)
        .map(|k| k * strand.elements.len() / n)
        .filter(|&joint| 0 < joint)
        .map(|joint| Control::new(ends[joint], joints[joint] + (line[joint] - now[joint])))
        .collect()
}

/// The centerline at each joint: the mean of positions from half a turn before it to half a turn
/// behind it; within half a turn of an end, over as much as lies on both sides.
///
/// Empty for a strand that does not turn.
fn centerline(strand: &SuperHelix<'_>) -> Vec<DVec3> {
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
        return vec![];
    }
    let mean = |at: f64| {
        let half = std::f64::consts::PI.min(at).min(angle - at);
        let first = angles.partition_point(|&a| a < at - half);
        let end = angles.partition_point(|&a| a <= at + half).max(first + 1).min(angles.len());
        let first = first.min(end - 1);
        (sums[end] - sums[first]) / (weights[end] - weights[first])
    };
    let mut joint_angle = 0.0;
    let mut line = vec![mean(0.0)];
    for (element, smooth) in strand.elements.iter().zip(&smooth) {
        joint_angle += smooth.curvature.length() * element.length;
        line.push(mean(joint_angle.min(angle)));
    }
    line
}

#[cfg(test)]
mod tests;
