//! Strands as smooth curves on the screen, cut into pieces that are straight to the eye.
//!
//! Real grooms hold five points a turn; joined by straight lines, a coil becomes a pentagon. Each
//! segment is drawn as a cubic Hermite curve instead. The tangents at its ends are those of the
//! circles through three neighbouring points (the chordal Catmull-Rom derivative), and their length
//! is the one that makes the cubic follow a circular arc: for a chord `c` between tangents that
//! turn by `theta`,
//!
//! `|m| = c / cos^2(theta / 4)`
//!
//! (the cubic then meets the arc at its middle too; at five points a turn it strays from the circle
//! by less than 0.001 of the radius, where a uniform Catmull-Rom curve strays by 0.05).
//!
//! A piece of a curve that bends by `d`, the second difference of its ends and their tangents, is
//! at most `d / 8` away from its chord, and `n` pieces bring that down by `n^2`. So the pieces
//! follow from a tolerance in pixels: straight hair costs what its points cost.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use tress_geometry::curves::catmull_rom_derivative;
use tress_geometry::{OffsetsError, Strands};

use crate::Camera;
use crate::num::{ceil_to_count, narrow};

/// A point of a flattened curve, in pixels: see [`Camera`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    /// Right, down and away; not finite where there is a gap.
    pub(crate) position: Vec3,
    /// Half of the hair's width.
    pub(crate) radius: f32,
    /// What the hair is coloured by.
    pub(crate) value: f32,
}

impl Vertex {
    /// What lies between two strands, or two parts of a broken one.
    const GAP: Self = Self { position: Vec3::NAN, radius: 0.0, value: 0.0 };
}

/// What a groom's points carry into the picture.
#[derive(Clone, Debug)]
pub(crate) struct Dress {
    /// Half of the hair's width in pixels, a point.
    pub(crate) radii: Vec<f32>,
    /// What the hair is coloured by, a point.
    pub(crate) values: Vec<f32>,
}

/// How far a chord may be from its curve, in pixels. Larger shows corners on bright coils, smaller
/// costs time with the inverse square root.
const TOLERANCE: f64 = 0.2;

/// Pieces of one segment, at most: enough for a half turn across a big picture.
const MAX_PIECES: u32 = 64;

/// A piece longer than this has too long a way from front to back for one place in the order of
/// depth.
const MAX_LENGTH: f64 = 24.0;

/// Points farther than this from the picture's corner, in pixels, are not drawn: 32-bit floats
/// keep an eighth of a pixel up to here.
const FAR: f64 = 1e6;

/// All strands, smooth, as the camera sees them; each ends with a gap, so that the vertices can be
/// walked in one go.
pub(crate) fn flatten(
    strands: &Strands<DVec3>,
    dress: &Dress,
    camera: &Camera,
) -> Result<Strands<Vertex>, OffsetsError> {
    let counts: Vec<usize> = (0..strands.len())
        .into_par_iter()
        .map_init(Curve::default, |curve, i| curve.see(strands.strand(i), camera).vertices())
        .collect();
    let total = counts.iter().sum();
    let mut flat = Strands::from_counts(counts, vec![Vertex::GAP; total])?;
    let rooms: Vec<_> = flat.iter_mut().enumerate().collect();
    rooms.into_par_iter().for_each_init(Curve::default, |curve, (i, room)| {
        let range = strands.range(i);
        let (radii, values) = (&dress.radii[range.clone()], &dress.values[range]);
        curve.see(strands.strand(i), camera).write(room, radii, values);
    });
    Ok(flat)
}

/// One strand as Hermite segments, in pixels; kept as scratch space from strand to strand.
#[derive(Default)]
struct Curve {
    points: Vec<DVec3>,
    tangents: Vec<DVec3>,
    /// Pieces of the segment behind each point but the last; 0 where there is nothing to draw.
    pieces: Vec<u32>,
}

impl Curve {
    fn see(&mut self, strand: &[DVec3], camera: &Camera) -> &Self {
        self.points.clear();
        self.points.extend(strand.iter().map(|&point| {
            let seen = camera.project(point);
            if seen.abs().max_element() < FAR { seen } else { DVec3::NAN }
        }));
        self.tangents.clear();
        for run in self.points.chunk_by(|a, b| a.is_finite() && b.is_finite()) {
            tangents(run, &mut self.tangents);
        }
        self.pieces.clear();
        for i in 1..self.points.len() {
            let pieces = self.segment(i - 1).map_or(0, |segment| segment.pieces());
            self.pieces.push(pieces);
        }
        self
    }

    /// The segment behind point `i`, unless it has no length or an end that is not there.
    fn segment(&self, i: usize) -> Option<Segment> {
        let ends = [self.points[i], self.points[i + 1]];
        let chord = ends[0].distance(ends[1]);
        if chord.is_nan() || chord <= 0.0 {
            return None;
        }
        let [a, b] = [self.tangents[i], self.tangents[i + 1]];
        let half_turn = (0.5 + 0.5 * a.dot(b)).clamp(0.0, 1.0).sqrt();
        // cos^2(theta / 4), from cos(theta / 2).
        let speed = chord / (0.5 + 0.5 * half_turn);
        Some(Segment { ends, tangents: [a * speed, b * speed], chord })
    }

    fn vertices(&self) -> usize {
        let pieces: usize = self.pieces.iter().map(|&n| n.max(1) as usize).sum();
        // The first point and the gap.
        pieces + 2
    }

    fn write(&self, room: &mut [Vertex], radii: &[f32], values: &[f32]) {
        let mut room = room.iter_mut();
        let mut put = |position: DVec3, radius, value| {
            if let Some(vertex) = room.next() {
                *vertex = Vertex { position: position.as_vec3(), radius, value };
            }
        };
        for (i, &point) in self.points.iter().enumerate() {
            put(point, radii[i], values[i]);
            let pieces = self.pieces.get(i).copied().unwrap_or(0);
            let Some(segment) = (1 < pieces).then(|| self.segment(i)).flatten() else { continue };
            for piece in 1..pieces {
                let t = f64::from(piece) / f64::from(pieces);
                let mix = |v: &[f32]| v[i] + (v[i + 1] - v[i]) * narrow(t);
                put(segment.at(t), mix(radii), mix(values));
            }
        }
    }
}

/// Appends the unit tangents at points that are all finite, or at a single one.
fn tangents(run: &[DVec3], tangents: &mut Vec<DVec3>) {
    let first = tangents.len();
    let at = |i| catmull_rom_derivative(run, i, 1.0).normalize_or_zero();
    tangents.extend((0..run.len()).map(at));
    let Some(last) = run.len().checked_sub(2) else { return };
    // A circle's tangents at both ends of a chord mirror each other.
    let mirrored = |a: usize, b: usize, t: DVec3| {
        let chord = (run[b] - run[a]).normalize_or_zero();
        2.0 * t.dot(chord) * chord - t
    };
    if 0 < last {
        tangents[first] = mirrored(0, 1, tangents[first + 1]);
        tangents[first + last + 1] = mirrored(last, last + 1, tangents[first + last]);
    }
}

/// A cubic Hermite curve.
struct Segment {
    ends: [DVec3; 2],
    tangents: [DVec3; 2],
    chord: f64,
}

impl Segment {
    fn at(&self, t: f64) -> DVec3 {
        let [p, q] = self.ends;
        let [a, b] = self.tangents;
        let r = 1.0 - t;
        p * (r * r * (1.0 + 2.0 * t)) + q * (t * t * (1.0 + 2.0 * r)) + (a * r - b * t) * (r * t)
    }

    fn pieces(&self) -> u32 {
        // The curve strays from its chord `c` by less than
        // `|m0 - m1| / 8 + |m0 + m1 - 2 c| / 20`.
        let [a, b] = self.tangents;
        let c = self.ends[1] - self.ends[0];
        let away = (a - b).length() / 8.0 + (a + b - 2.0 * c).length() / 20.0;
        let by_bend = (away / TOLERANCE).sqrt();
        let by_length = self.chord / MAX_LENGTH;
        ceil_to_count(by_bend.max(by_length), MAX_PIECES).max(1)
    }
}

#[cfg(test)]
mod tests;
