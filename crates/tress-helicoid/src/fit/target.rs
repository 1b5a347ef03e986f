//! What is fitted: a polyline in normal form, with what its smooth curve says.

use glam::{DMat3, DVec3};
use tress_fit::{Spline, TangentRule};
use tress_geometry::Frame;
use tress_geometry::polyline::{Defect, defect, place};

use super::options::Roll;

/// A polyline with its root at the origin and its smooth curve of length 1.
#[derive(Clone, Debug)]
pub(super) struct Target {
    /// The polyline's points, repeated ones left out.
    pub(super) polyline: Vec<DVec3>,
    /// Arc length of the smooth curve at each, 0 to 1.
    pub(super) at_polyline: Vec<f64>,
    /// What the fit is to pass: the same points, or more of the smooth curve.
    pub(super) points: Vec<DVec3>,
    /// Arc length of the smooth curve at each, 0 to 1.
    pub(super) arc_lengths: Vec<f64>,
    /// Its direction at each.
    pub(super) tangents: Vec<DVec3>,
    /// Where the root was.
    pub(super) origin: DVec3,
    /// How long the smooth curve was.
    pub(super) length: f64,
}

/// Segments shorter than this part of the strand are rounding.
const SAME_PLACE: f64 = 1e-12;

/// The strand's first bend, up to this many radians, says where its plane is.
const FIRST_BEND: f64 = 0.5;

impl Target {
    /// `fewest` is how many segments there are to be at least to fit to: where the polyline has
    /// fewer, its smooth curve fills in.
    pub(super) fn new(polyline: &[DVec3], fewest: usize) -> Result<Self, Defect> {
        if let Some(defect) = defect(polyline) {
            return Err(defect);
        }
        let origin = polyline[0];
        let size = polyline.iter().fold(0.0, |most, p| f64::max(most, p.distance(origin)));
        let mut points = vec![DVec3::ZERO];
        for p in polyline {
            let p = (p - origin) / size;
            if p.is_finite() && SAME_PLACE < p.distance(points[points.len() - 1]) {
                points.push(p);
            }
        }
        if points.len() < 2 {
            return Err(Defect::ZeroLength);
        }
        let spline = Spline::through(&points, TangentRule::Helix);
        let length = spline.length();
        let polyline: Vec<DVec3> = points.iter().map(|p| p / length).collect();
        let at_polyline: Vec<f64> = spline.arc_lengths().iter().map(|s| s / length).collect();
        let mut target = Self {
            arc_lengths: at_polyline.clone(),
            tangents: spline.tangents().collect(),
            points: polyline.clone(),
            polyline,
            at_polyline,
            origin,
            length: length * size,
        };
        if target.last() < fewest {
            target.arc_lengths = (0..=fewest).map(|i| i as f64 / fewest as f64).collect();
            let at = |s: &f64| spline.at(s * length);
            let (points, tangents): (Vec<_>, Vec<_>) = target.arc_lengths.iter().map(at).unzip();
            target.points = points.into_iter().map(|p| p / length).collect();
            target.tangents = tangents;
        }
        Ok(target)
    }

    /// The last point's index.
    pub(super) fn last(&self) -> usize {
        self.points.len() - 1
    }

    /// The frame at the root.
    pub(super) fn root(&self, roll: Roll) -> Frame {
        match roll {
            Roll::Bend => self.bent_root(),
            Roll::Steady => {
                let upright = DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X);
                Frame { position: DVec3::ZERO, axes: upright }.turned_to(self.tangents[0])
            }
        }
    }

    /// The frame at the root as the strand's first bend has it: `E_N` points to where it bends.
    fn bent_root(&self) -> Frame {
        let t = self.tangents[0];
        let turned = |v: &&DVec3| t.angle_between(**v) < FIRST_BEND;
        let ahead = self.tangents[1..].iter().take_while(turned).count().max(1);
        let bend: DVec3 = self.tangents[1..=ahead].iter().map(|v| v - t * t.dot(*v)).sum();
        let n = bend.try_normalize().filter(|_| 1e-9 < bend.length());
        let n = n.unwrap_or_else(|| t.any_orthonormal_vector());
        let n = (n - t * t.dot(n)).normalize_or(t.any_orthonormal_vector());
        Frame { position: DVec3::ZERO, axes: DMat3::from_cols(t, n, t.cross(n)) }
    }

    /// The direction at an arc length, between those of the points beside it.
    pub(super) fn tangent_at(&self, s: f64) -> DVec3 {
        let (i, part) = place(&self.arc_lengths, s);
        let next = (i + 1).min(self.last());
        self.tangents[i].lerp(self.tangents[next], part).normalize_or(self.tangents[i])
    }

    /// Angle between neighbouring tangents over arc length, at each point.
    pub(super) fn curvatures(&self) -> Vec<f64> {
        curvature_profile(&self.tangents, &self.arc_lengths)
    }
}

/// Angle between neighbouring tangents over the arc length between; the last is repeated.
pub(super) fn curvature_profile(tangents: &[DVec3], arc_lengths: &[f64]) -> Vec<f64> {
    let steps = arc_lengths.windows(2).map(|s| s[1] - s[0]);
    let turns = tangents.windows(2).map(|t| t[0].angle_between(t[1]));
    let mut profile: Vec<f64> = turns.zip(steps).map(|(turn, step)| turn / step).collect();
    profile.push(profile.last().copied().unwrap_or(0.0));
    profile
}
