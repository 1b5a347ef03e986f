//! The loosely guided region, [CC 3.3.3]: from the root into the wisp.

use glam::DVec3;
use tress_geometry::Frame;
use tress_geometry::curves::{hermite, hermite_derivative};

use crate::coils::Coil;
use crate::curve::smoothstep;
use crate::guide::Guide;

/// Chords by which arc length along the centerline is measured.
const CHORDS: usize = 16;

/// The centerline of a loose hair: a cubic from the root to the guide's centerline.
///
/// It leaves the root towards the middle of the guide's loose part and meets the guide's
/// centerline along its tangent, with derivatives as long as root and end are apart.
pub(crate) struct LooseLine {
    ends: [DVec3; 2],
    slopes: [DVec3; 2],
    /// Arc length at each sixteenth of the parameter.
    arc_lengths: [f64; CHORDS + 1],
}

impl LooseLine {
    /// Of a hair from `root` to the guide's point `joint`.
    pub(crate) fn new(guide: &Guide<'_>, joint: usize, root: DVec3) -> Self {
        let aside = guide.line_displacement(joint, root);
        let end = guide.line[joint].position + aside;
        let reach = end.distance(root);
        let half = 0.5 * guide.arc_lengths[joint];
        let middle = guide.arc_lengths.partition_point(|s| *s < half).min(joint);
        let towards = guide.line[middle].position + aside - root;
        let tangent = guide.line[joint].tangent();
        let slopes = [towards.try_normalize().unwrap_or(tangent) * reach, tangent * reach];
        let mut line = Self { ends: [root, end], slopes, arc_lengths: [0.0; CHORDS + 1] };
        let mut before = root;
        for i in 1..=CHORDS {
            let here = line.position(i as f64 / CHORDS as f64);
            line.arc_lengths[i] = line.arc_lengths[i - 1] + before.distance(here);
            before = here;
        }
        line
    }

    pub(crate) fn length(&self) -> f64 {
        self.arc_lengths[CHORDS]
    }

    /// Position and unit tangent at an arc length.
    fn at(&self, s: f64) -> (DVec3, DVec3) {
        let (i, beyond) = tress_geometry::polyline::place(&self.arc_lengths, s);
        let u = ((i as f64 + beyond) / CHORDS as f64).min(1.0);
        let tangent = hermite_derivative(self.ends, self.slopes, u).try_normalize();
        (self.position(u), tangent.unwrap_or_else(|| self.slopes[1].normalize_or(DVec3::X)))
    }

    fn position(&self, u: f64) -> DVec3 {
        hermite(self.ends, self.slopes, u)
    }
}

/// What a hair has drawn for its loose region.
pub(crate) struct Loose<'a> {
    pub(crate) joint: usize,
    pub(crate) root: DVec3,
    /// Its place in the wisp, `alpha` and `beta`.
    pub(crate) place: [f64; 2],
    /// Its coil, and how far that is turned about the line.
    pub(crate) coil: Option<Coil<'a>>,
    pub(crate) turn: f64,
    /// Turns over which the coil opens, and over which it locks.
    pub(crate) opening: f64,
    pub(crate) locking: f64,
}

impl Loose<'_> {
    /// How far the library's coil has to be turned about the line to be in phase with the guide's
    /// where they meet.
    pub(crate) fn phase(&self, guide: &Guide<'_>, length: f64) -> f64 {
        let to = guide.offset(self.joint, self.place);
        let from = self.coil.as_ref().map(|coil| coil.at(length)).unwrap_or_default();
        let angle = to.z.atan2(to.y) - from.y.atan2(from.x);
        if angle.is_finite() { angle } else { 0.0 }
    }

    /// Lays the hair along its centerline, from the root up to but not with the joint.
    ///
    /// Frames are carried back from the guide's at the joint, so that there is no jump; the coil
    /// opens at the root, and over the last points the guide's own offsets take its place, so that
    /// positions and tangents go on into the strictly guided region.
    pub(crate) fn lay(&self, guide: &Guide<'_>, line: &LooseLine, hair: &mut [DVec3]) {
        let m = hair.len();
        let step = line.length() / m as f64;
        let opening = (self.opening * guide.wavelength()).max(f64::MIN_POSITIVE);
        let locking = (self.locking * guide.points_per_turn()).clamp(1.0, m as f64);
        let (sine, cosine) = self.turn.sin_cos();
        let end = guide.line[self.joint];
        let mut frame = Frame { position: line.ends[1], axes: end.axes };
        for (j, place) in hair.iter_mut().enumerate().rev() {
            let s = step * j as f64;
            let (position, tangent) = line.at(s);
            frame = frame.reflected_to(position, tangent);
            let opened = smoothstep(s / opening);
            let own = self.coil.as_ref().map(|coil| opened * coil.at(s)).unwrap_or_default();
            let own = DVec3::new(0.0, cosine * own.x - sine * own.y, sine * own.x + cosine * own.y);
            let back = m - j;
            let locked = smoothstep(1.0 - back as f64 / locking);
            let offset = match self.joint.checked_sub(back) {
                Some(i) if locked > 0.0 => own.lerp(guide.offset(i, self.place), locked),
                _ => own,
            };
            *place = frame.position + frame.axes * offset;
        }
        if let Some(first) = hair.first_mut() {
            *first = self.root;
        }
    }
}
