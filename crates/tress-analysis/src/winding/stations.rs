//! A strand at stations evenly spaced by arc length, however it came.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use tress_fit::{FitOptions, Spline, TangentRule, fit_strand};
use tress_geometry::SuperHelix;

/// A strand at even stations, from root to tip.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stations {
    pub(crate) positions: Vec<DVec3>,
    /// Arc length from one station to the next.
    pub(crate) spacing: f64,
    /// How far the tangent turns in all, in radians.
    pub(crate) bending: f64,
}

/// Stations a turn, at least, where the turns are those that the bending amounts to.
const PER_TURN: f64 = 32.0;

/// Least and most stations. Fewer blur waves that bend little; more than 128 turns are beyond hair.
const COUNT: [usize; 2] = [256, 4096];

/// Counts are multiples of this, for the sake of the transform: few lengths, of small factors.
const MULTIPLE: usize = 64;

/// Arcs that bend so many times as far as the segments do have looped somewhere.
const MOST_BENDING: f64 = 1.5;

impl Stations {
    /// Of a super-helix; `None` for one without length or with numbers that are not finite.
    pub(crate) fn of(strand: &SuperHelix<'_>) -> Option<Self> {
        let bending = strand.elements.iter().map(|e| e.bending() * e.length).sum();
        let n = count(bending)?;
        let mut positions = vec![DVec3::ZERO; n + 1];
        strand.sample_evenly(&mut positions);
        Self::checked(positions, strand.length(), bending)
    }

    /// Of the helix arcs through the points of a polyline, with the arc length of each point;
    /// `None` for one with a [`defect`](tress_geometry::polyline::defect).
    pub(crate) fn through(points: &[DVec3]) -> Option<(Self, Vec<f64>)> {
        let options = FitOptions { refine: None, measure: false, ..FitOptions::default() };
        let fit = fit_strand(points, &options).ok()?;
        let stations = Self::of(&fit.super_helix())?;
        if stations.bending <= MOST_BENDING * bending(points) + PI {
            return Some((stations, fit.arc_lengths));
        }
        Self::along_spline(points)
    }

    /// Of the cubic curve through the points, which cannot loop where arcs can.
    fn along_spline(points: &[DVec3]) -> Option<(Self, Vec<f64>)> {
        let mut distinct = points.to_vec();
        distinct.dedup();
        let spline = Spline::through(&distinct, TangentRule::Helix);
        let bending = spline.turning();
        let n = count(bending)?;
        let at = |i: usize| spline.at(spline.length() * (i as f64 / n as f64)).0;
        let stations = Self::checked((0..=n).map(at).collect(), spline.length(), bending)?;
        let mut place = 0;
        let mut before = points[0];
        let arc_lengths = points.iter().map(|&point| {
            place += usize::from(point != before);
            before = point;
            spline.arc_lengths()[place]
        });
        Some((stations, arc_lengths.collect()))
    }

    fn checked(positions: Vec<DVec3>, length: f64, bending: f64) -> Option<Self> {
        let spacing = length / (positions.len() - 1) as f64;
        let sound = 0.0 < spacing && spacing.is_finite() && positions.iter().all(|p| p.is_finite());
        sound.then_some(Self { positions, spacing, bending })
    }

    /// Arc length of the strand.
    pub(crate) fn length(&self) -> f64 {
        self.spacing * (self.positions.len() - 1) as f64
    }
}

/// How far the segments of a polyline turn in all, in radians.
fn bending(points: &[DVec3]) -> f64 {
    let mut before: Option<DVec3> = None;
    let mut sum = 0.0;
    for ends in points.windows(2) {
        let Some(direction) = (ends[1] - ends[0]).try_normalize() else { continue };
        sum += before.map_or(0.0, |before| before.angle_between(direction));
        before = Some(direction);
    }
    sum
}

/// How many stations a strand gets that bends so far, in radians.
fn count(bending: f64) -> Option<usize> {
    if !bending.is_finite() {
        return None;
    }
    let wanted = (PER_TURN * bending / TAU).clamp(COUNT[0] as f64, COUNT[1] as f64);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held above")]
    let wanted = wanted as usize;
    Some(wanted.next_multiple_of(MULTIPLE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strand_whose_arcs_loop_is_taken_along_a_spline() {
        // Points a hundredth of the others' distance apart at a corner, one of them twice.
        let points = [
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(2.0, 0.0, 0.0),
            DVec3::new(2.01, 0.0, 0.0),
            DVec3::new(2.01, 0.0, 0.0),
            DVec3::new(2.01, 0.01, 0.0),
            DVec3::new(2.0, 1.0, 0.5),
            DVec3::new(0.0, 1.0, 0.5),
        ];
        let options = FitOptions { refine: None, measure: false, ..FitOptions::default() };
        let arcs = fit_strand(&points, &options).expect("a curve");
        let looped = Stations::of(&arcs.super_helix()).expect("a length").bending;
        assert!(2.0 * bending(&points) < looped, "{looped} of {}", bending(&points));

        let (stations, arc_lengths) = Stations::through(&points).expect("a curve");
        assert!(stations.bending < 1.2 * bending(&points), "{}", stations.bending);
        assert!(arc_lengths.is_sorted() && arc_lengths.len() == points.len());
        for (point, s) in points.iter().zip(arc_lengths) {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a station"
            )]
            let nearest = stations.positions[(s / stations.spacing).round() as usize];
            assert!(nearest.distance(*point) < stations.spacing, "{point} is not at {s}");
        }
    }
}
