//! Two strands side by side: how near their centerlines are, and whether their coils are in phase.
//!
//! Coils of one wisp differ a little in radius and pitch, so that at equal arc lengths they are
//! soon not abreast. They are compared at places whose centerlines are: from a place of the shorter
//! strand the nearest place on the other's centerline is followed as both go on.

use glam::DVec3;
use tress_geometry::polyline::{arc_lengths, place};

/// Places at which two strands are compared.
const PLACES: u32 = 32;

/// A strand and its centerline.
pub(super) struct Way<'a> {
    points: &'a [DVec3],
    center: &'a [DVec3],
    /// Length of centerline at each point.
    along: Vec<f64>,
    /// How near another centerline must be to be in company: the coil radius.
    pub(super) near: f64,
}

/// What two strands are to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Abreast {
    /// 0 for strands far apart or in opposite phase, 1 for strands that lie in each other: the mean
    /// of `exp(-(d / R)^2) (1 + cos phi) / 2` over the shorter strand, with the distance `d` of the
    /// centerlines, the radius `R` of the narrower coil and the difference of phase `phi`.
    pub(super) affinity: f64,
    /// The share of each strand's length along which they are nearer than `R`, place by place.
    pub(super) locked: [f64; 2],
}

impl<'a> Way<'a> {
    /// Of a strand that is a curve, with a centerline for each of its points.
    pub(super) fn new(points: &'a [DVec3], center: &'a [DVec3], near: f64) -> Self {
        let mut along = Vec::with_capacity(center.len());
        arc_lengths(center, &mut along);
        Self { points, center, along, near }
    }

    /// Length of its centerline.
    pub(super) fn length(&self) -> f64 {
        self.along.last().copied().unwrap_or(0.0)
    }

    /// The centerline, and its direction, at a length along it.
    pub(super) fn center_at(&self, s: f64) -> (DVec3, DVec3) {
        let (i, f) = self.segment(s);
        let step = self.center[i + 1] - self.center[i];
        (self.center[i] + step * f, step.normalize_or_zero())
    }

    fn point_at(&self, s: f64) -> DVec3 {
        let (i, f) = self.segment(s);
        self.points[i].lerp(self.points[i + 1], f)
    }

    /// The segment at a length of centerline, and the place on it.
    fn segment(&self, s: f64) -> (usize, f64) {
        let (i, f) = place(&self.along, s);
        if i + 1 < self.along.len() { (i, f) } else { (i - 1, 1.0) }
    }
}

/// Compares two strands.
pub(super) fn abreast(a: &Way<'_>, b: &Way<'_>) -> Abreast {
    if b.length() < a.length() {
        let Abreast { affinity, locked: [of_b, of_a] } = abreast(b, a);
        return Abreast { affinity, locked: [of_a, of_b] };
    }
    let near = a.near.min(b.near);
    let step = a.length() / f64::from(PLACES);
    let (mut sum, mut locked, mut ahead) = (0.0, 0.0, 0.0);
    for k in 0..PLACES {
        let s = step * (f64::from(k) + 0.5);
        let (center, _) = a.center_at(s);
        let mut at = (s + ahead).clamp(0.0, b.length());
        let (mut other, mut direction) = b.center_at(at);
        // Steps of Newton's method towards the place abreast.
        for _ in 0..2 {
            let by = (center - other).dot(direction).clamp(-step, step);
            at = (at + by).clamp(0.0, b.length());
            (other, direction) = b.center_at(at);
        }
        ahead = at - s;
        let square = center.distance_squared(other) / (near * near);
        // Beyond three radii it is no company at all.
        if square < 9.0 {
            let (p, q) = (a.point_at(s), b.point_at(at));
            sum += (-square).exp() * 0.5 * (1.0 + cosine(p - center, q - other));
            if p.distance_squared(q) <= near * near {
                locked += 1.0;
            }
        }
    }
    let [affinity, locked] = [sum, locked].map(|sum| sum / f64::from(PLACES));
    let of_longer = if 0.0 < b.length() { a.length() / b.length() } else { 1.0 };
    Abreast { affinity, locked: [locked, locked * of_longer] }
}

/// The cosine of the angle between two offsets; 1 where a strand is its own centerline.
fn cosine(a: DVec3, b: DVec3) -> f64 {
    let lengths = (a.length_squared() * b.length_squared()).sqrt();
    if 0.0 < lengths { a.dot(b) / lengths } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// A coil of radius 0.5 about x, and its axis: so much pitch, so many turns, at a place.
    fn coil(pitch: f64, turns: u32, phase: f64, aside: f64) -> (Vec<DVec3>, Vec<DVec3>) {
        let at = |i: u32| {
            let turn = f64::from(i) / 12.0;
            let (sine, cosine) = (TAU * turn + phase).sin_cos();
            let axis = DVec3::new(pitch * turn, aside, 0.0);
            (axis + 0.5 * DVec3::new(0.0, cosine, sine), axis)
        };
        (0..=12 * turns).map(at).unzip()
    }

    fn compared(a: &(Vec<DVec3>, Vec<DVec3>), b: &(Vec<DVec3>, Vec<DVec3>)) -> Abreast {
        abreast(&Way::new(&a.0, &a.1, 0.5), &Way::new(&b.0, &b.1, 0.5))
    }

    #[test]
    fn affinity_falls_with_distance_and_phase() {
        let own = coil(0.5, 8, 0.0, 0.0);
        let same = compared(&own, &own);
        assert!((same.affinity - 1.0).abs() < 1e-12);
        assert!(same.locked.iter().all(|share| (share - 1.0).abs() < 1e-12));
        let aside = compared(&own, &coil(0.5, 8, 0.0, 0.5));
        assert!((aside.affinity - (-1.0_f64).exp()).abs() < 1e-12, "{aside:?}");
        let across = compared(&own, &coil(0.5, 8, TAU / 4.0, 0.0));
        assert!((across.affinity - 0.5).abs() < 1e-3 && across.locked[0] < 1e-12, "{across:?}");
        let opposite = compared(&own, &coil(0.5, 8, TAU / 2.0, 0.0));
        assert!(opposite.affinity < 1e-3, "{opposite:?}");
        assert!(compared(&own, &coil(0.5, 8, 0.0, 1.6)).affinity < 1e-12);
    }

    #[test]
    fn a_short_strand_is_compared_along_its_own_length() {
        let (long, short) = (coil(0.5, 16, 0.0, 0.1), coil(0.5, 8, 0.0, 0.0));
        let [of_long, of_short] = compared(&long, &short).locked;
        assert!((of_short - 1.0).abs() < 1e-12 && (of_long - 0.5).abs() < 1e-3, "{of_long}");
        let turned = compared(&short, &long);
        assert!((turned.locked[1] - of_long).abs() < 1e-12, "{turned:?}");
    }

    #[test]
    fn places_are_abreast_though_one_strand_runs_ahead() {
        // The same coil, its root three quarters of a turn later.
        let (own, later) = (coil(0.5, 8, 0.0, 0.0), coil(0.5, 8, 0.0, 0.0));
        let later = (later.0[9..].to_vec(), later.1[9..].to_vec());
        let compared = compared(&own, &later);
        assert!(0.9 < compared.affinity, "{compared:?}");
    }
}
