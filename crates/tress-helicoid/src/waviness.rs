//! Waves and disorder on a traced hair [GH 3.2].

use glam::{DQuat, DVec3};
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};
use tress_geometry::Frame;

/// A helix about the hair: `p + a cos(b s) E_B + a sin(b s) E_N` [GH 4].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Waviness {
    /// Radius `a` of the helix.
    pub amplitude: f64,
    /// Radians `b` of the helix in a unit of arc length of the hair.
    pub frequency: f64,
    /// Arc length over which the waves grow to their amplitude, so that the root stays in place; 0
    /// as published. Default 0.
    pub fade_in: f64,
}

impl Waviness {
    /// Where the point at arc length `s` of a hair goes, whose frame there is `frame`.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tress_geometry::Frame;
    /// use tress_helicoid::Waviness;
    ///
    /// let waves = Waviness { amplitude: 0.1, frequency: 3.0, fade_in: 0.0 };
    /// assert_eq!(waves.offset(&Frame::IDENTITY, 0.0), DVec3::new(0.0, 0.0, 0.1));
    /// ```
    #[must_use]
    pub fn offset(&self, frame: &Frame, s: f64) -> DVec3 {
        let (sine, cosine) = (self.frequency * s).sin_cos();
        let grown = if s < self.fade_in { s / self.fade_in } else { 1.0 };
        let aside = frame.axes.z_axis * cosine + frame.axes.y_axis * sine;
        frame.position + aside * (self.amplitude * grown)
    }
}

/// Turns every segment of a polyline by a random angle that drifts along it: each segment keeps its
/// length and each point follows what lies before it.
///
/// `angle` is the standard deviation in radians of a segment's turn, `persistence` (0 to 1) how
/// much of its predecessor's turn a segment takes over.
///
/// ```
/// use glam::DVec3;
/// use rand::SeedableRng;
/// use tress_helicoid::perturb;
///
/// let mut line: Vec<_> = (0..10).map(|i| DVec3::new(f64::from(i), 0.0, 0.0)).collect();
/// perturb(&mut line, 0.1, 0.9, &mut rand_pcg::Pcg64Mcg::seed_from_u64(1));
/// assert!(line.windows(2).all(|ends| (ends[0].distance(ends[1]) - 1.0).abs() < 1e-12));
/// assert!(line[9].distance(DVec3::new(9.0, 0.0, 0.0)) > 0.01);
/// ```
pub fn perturb(points: &mut [DVec3], angle: f64, persistence: f64, rng: &mut impl Rng) {
    let kept = persistence.clamp(0.0, 1.0);
    let new = (1.0 - kept * kept).sqrt();
    let mut draw = || -> f64 { StandardNormal.sample(rng) };
    let mut turn = angle * DVec3::new(draw(), draw(), draw());
    let mut before = points.first().copied();
    for i in 1..points.len() {
        let here = points[i];
        let segment = before.map_or(DVec3::ZERO, |before| here - before);
        points[i] = points[i - 1] + DQuat::from_scaled_axis(turn) * segment;
        before = Some(here);
        turn = turn * kept + angle * new * DVec3::new(draw(), draw(), draw());
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64Mcg;

    use super::*;

    #[test]
    fn waves_stay_at_their_radius_and_fade_in() {
        let waves = Waviness { amplitude: 0.2, frequency: 7.0, fade_in: 1.0 };
        for (s, radius) in [(0.0, 0.0), (0.5, 0.1), (1.0, 0.2), (9.0, 0.2)] {
            let offset = waves.offset(&Frame::IDENTITY, s);
            assert!((offset.length() - radius).abs() < 1e-15 && offset.x == 0.0);
        }
    }

    #[test]
    fn no_angle_changes_nothing_and_one_point_stays() {
        let rng = &mut Pcg64Mcg::seed_from_u64(3);
        let mut line = [DVec3::ZERO, DVec3::X, DVec3::ONE];
        perturb(&mut line, 0.0, 0.5, rng);
        assert_eq!(line, [DVec3::ZERO, DVec3::X, DVec3::ONE]);
        let mut point = [DVec3::ONE];
        perturb(&mut point, 1.0, 0.5, rng);
        perturb(&mut [], 1.0, 0.5, rng);
        assert_eq!(point, [DVec3::ONE]);
    }
}
