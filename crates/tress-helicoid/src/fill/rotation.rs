//! The mean of rotations, as a rotation.

use glam::{DQuat, DVec3};

/// Steps of the iteration at most; rotations within a right angle of each other need three or four.
const STEPS: usize = 12;

/// The weighted mean of rotations: the one from which the weighted turns to them all cancel
/// (Karcher's mean; Moakher, "Means and averaging in the group of rotations", 2002).
///
/// Of two it is the spherical interpolation. Weights are positive and sum to 1; no rotation at all
/// has the mean 1. Rotations half a turn apart have no mean that is better than others; the one
/// found then leans to the first.
///
/// ```
/// use glam::DQuat;
/// use tress_helicoid::mean_rotation;
///
/// let (a, b) = (DQuat::IDENTITY, DQuat::from_rotation_z(1.0));
/// let mean = mean_rotation([(a, 0.7), (b, 0.3)].into_iter());
/// assert!(mean.angle_between(DQuat::from_rotation_z(0.3)) < 1e-7);
/// ```
#[must_use]
pub fn mean_rotation(rotations: impl Iterator<Item = (DQuat, f64)> + Clone) -> DQuat {
    let Some((first, _)) = rotations.clone().next() else { return DQuat::IDENTITY };
    let near = |q: DQuat, to: DQuat| if q.dot(to) < 0.0 { -q } else { q };
    let sum = rotations.clone().fold(first * 1e-9, |sum, (q, w)| sum + near(q, first) * w);
    let mut mean = sum.normalize();
    for _ in 0..STEPS {
        let back = mean.inverse();
        let turn: DVec3 = rotations
            .clone()
            .map(|(q, w)| near(back * q, DQuat::IDENTITY).to_scaled_axis() * w)
            .sum();
        mean = (mean * DQuat::from_scaled_axis(turn)).normalize();
        if turn.length_squared() < 1e-20 {
            break;
        }
    }
    mean
}
