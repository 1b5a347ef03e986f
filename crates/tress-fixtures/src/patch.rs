//! Wisps of coily hair on a patch of scalp.
//!
//! A strand is a helix wound about a centerline that leaves the scalp along its normal and sags:
//! `r(s) = c(s) + R(s) (cos phi(s) u(s) + sin phi(s) v(s))`, where `[t u v]` is carried along the
//! centerline by the least rotation, `phi' = +-2 pi / pitch(s)`, and `R` grows from 0 at the root,
//! so that the root lies on the scalp. Strands of a wisp share the centerline's shape, phase, hand,
//! radius and pitch, and stray from them a little, the more the farther from the root.

use std::f64::consts::TAU;

use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use tress_geometry::{Column, Frame, Groom, Strands, UpAxis, names};

use crate::noise::{Wander, WanderVector};

/// What [`coily_patch`] grows. Lengths in centimetres.
///
/// The defaults are taken from simulated coily guides: coil radius about 0.57, pitch about 0.5, 23
/// turns over a centerline of 11.5, 5 to 6 points a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchOptions {
    /// Wisps on the patch.
    pub wisps: usize,
    /// Strands in a wisp.
    pub strands_per_wisp: usize,
    /// Mean coil radius; wisps vary by a fifth about it.
    pub radius: f64,
    /// Mean pitch; wisps vary by a fifth about it.
    pub pitch: f64,
    /// Mean length of the centerline; wisps vary by an eighth about it, strands by a twelfth.
    pub length: f64,
    /// Points a turn.
    pub points_per_turn: f64,
    /// Radius of the head.
    pub head_radius: f64,
    /// How far the patch reaches from its middle, as an angle seen from the middle of the head.
    pub patch_angle: f64,
    /// Hair diameter. The default is three times that of hair: a strand stands for a few.
    pub width: f64,
}

impl Default for PatchOptions {
    fn default() -> Self {
        Self {
            wisps: 30,
            strands_per_wisp: 22,
            radius: 0.55,
            pitch: 0.52,
            length: 11.0,
            points_per_turn: 5.6,
            head_radius: 9.0,
            patch_angle: 0.62,
            width: 0.03,
        }
    }
}

/// Grows wisps on a patch: a groom in centimetres, Y up, facing +Z, with the attributes
/// [`names::GROUP`] (the wisp) and [`names::WIDTH`] of strands.
///
/// ```
/// use tress_fixtures::{PatchOptions, coily_patch};
///
/// let options = PatchOptions { wisps: 2, strands_per_wisp: 3, ..PatchOptions::default() };
/// let groom = coily_patch(&options, 1);
/// assert_eq!(groom.strands().len(), 6);
/// let root = groom.strands().strand(0)[0];
/// assert!((root.length() - 9.0).abs() < 1e-9, "roots lie on the head");
/// ```
#[must_use]
pub fn coily_patch(options: &PatchOptions, seed: u64) -> Groom {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut strands = Strands::default();
    let mut groups = Vec::new();
    for (group, normal) in (0..).zip(spread_on_cap(options)) {
        let wisp = Wisp::new(options, normal, &mut rng);
        for _ in 0..options.strands_per_wisp {
            let strand = wisp.strand(options, &mut rng);
            strands.push(strand).expect("a fixture has fewer points than 32 bits tell apart");
            groups.push(group);
        }
    }
    let widths = vec![options.width; strands.len()];
    let mut groom = Groom::new(strands).in_space(Some(0.01), Some(UpAxis::Y));
    let one_row_each = "one row was made for each strand";
    groom.insert_strand_attribute(names::GROUP, Column::Int(groups)).expect(one_row_each);
    groom.insert_strand_attribute(names::WIDTH, Column::scalar(widths)).expect(one_row_each);
    groom
}

/// Directions spread evenly over a cap about +Z, tilted upwards (a sunflower's spiral).
fn spread_on_cap(options: &PatchOptions) -> impl Iterator<Item = DVec3> {
    let (n, least) = (options.wisps as f64, options.patch_angle.cos());
    let golden = TAU * (1.0 - 1.0 / ((1.0 + 5_f64.sqrt()) / 2.0));
    let tilt = crate::scalp::tilt();
    (0..options.wisps).map(move |i| {
        let z = 1.0 - (i as f64 + 0.5) / n * (1.0 - least);
        let (sine, cosine) = (golden * i as f64).sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        tilt * DVec3::new(r * cosine, r * sine, z)
    })
}

/// What the strands of a wisp share.
struct Wisp {
    normal: DVec3,
    hand: f64,
    phase: f64,
    radius: f64,
    pitch: f64,
    length: f64,
    /// How the centerline sways, how the radius varies, and how the pitch does.
    sway: WanderVector,
    swell: Wander,
    stretch: Wander,
}

impl Wisp {
    fn new(options: &PatchOptions, normal: DVec3, rng: &mut Pcg64Mcg) -> Self {
        let mut vary = |mean: f64, by: f64| mean * (by * normal_number(rng)).clamp(-0.5, 0.5).exp();
        let (radius, pitch) = (vary(options.radius, 0.2), vary(options.pitch, 0.2));
        let length = vary(options.length, 0.12);
        Self {
            normal,
            hand: if rng.random_bool(0.5) { 1.0 } else { -1.0 },
            phase: rng.random_range(0.0..TAU),
            radius,
            pitch,
            length,
            sway: WanderVector::new(6.0, rng),
            swell: Wander::new(4.0, rng),
            stretch: Wander::new(4.0, rng),
        }
    }

    /// One strand, its points evenly spaced along it.
    fn strand(&self, options: &PatchOptions, rng: &mut Pcg64Mcg) -> Vec<DVec3> {
        let frame = Frame::along(DVec3::ZERO, self.normal).expect("normals have unit length");
        let aside = frame.axes * DVec3::new(0.0, normal_number(rng), normal_number(rng));
        let normal = (self.normal + aside * (0.22 / options.head_radius)).normalize();
        let stray = Stray {
            phase: 0.25 * normal_number(rng),
            radius: (0.08 * normal_number(rng)).exp(),
            pitch: (0.015 * normal_number(rng)).exp(),
            sway: WanderVector::new(5.0, rng),
            frizz: WanderVector::new(1.3 * self.pitch, rng),
        };
        let length = self.length * (0.08 * normal_number(rng)).clamp(-0.25, 0.25).exp();
        let fine = self.trace(normal * options.head_radius, normal, length, &stray);
        resample(&fine, (length / self.pitch * options.points_per_turn).max(8.0))
    }

    /// Walks along the centerline in steps of a fortieth of a turn.
    fn trace(&self, root: DVec3, normal: DVec3, length: f64, stray: &Stray) -> Vec<DVec3> {
        let step = self.pitch / 40.0;
        let mut frame = Frame::along(root, normal).expect("normals have unit length");
        let mut phase = self.phase + stray.phase;
        let mut points = Vec::new();
        let mut s = 0.0;
        while s < length {
            let open = 1.0 - (-s / (0.5 * self.radius)).exp();
            let swell = (0.12 * self.swell.at(s)).exp();
            let radius = self.radius * stray.radius * open * swell;
            let (sine, cosine) = phase.sin_cos();
            let frizz = stray.frizz.at(s) * (0.045 * self.radius * open);
            points
                .push(frame.position + frame.axes * DVec3::new(0.0, cosine, sine) * radius + frizz);

            let sag = DVec3::NEG_Y * (0.16 + 0.02 * s);
            let sway = self.sway.at(s) * 0.16 + stray.sway.at(s) * 0.05;
            let direction = (frame.tangent() + (sag + sway) * step).normalize();
            frame = frame.turned_to(direction);
            frame.position += direction * step;
            let pitch = self.pitch * stray.pitch * (0.12 * self.stretch.at(s)).exp();
            phase += self.hand * TAU * step / pitch;
            s += step;
        }
        points
    }
}

/// How one strand differs from its wisp.
struct Stray {
    phase: f64,
    radius: f64,
    pitch: f64,
    sway: WanderVector,
    frizz: WanderVector,
}

/// `n` points or one fewer, evenly spaced by length along a finely sampled curve, ends included.
fn resample(fine: &[DVec3], n: f64) -> Vec<DVec3> {
    let mut arc_lengths = Vec::with_capacity(fine.len());
    tress_geometry::polyline::arc_lengths(fine, &mut arc_lengths);
    let total = arc_lengths[arc_lengths.len() - 1];
    let steps = n.floor() - 1.0;
    let at = |s: f64| {
        let (i, f) = tress_geometry::polyline::place(&arc_lengths, s);
        fine[i].lerp(fine[(i + 1).min(fine.len() - 1)], f)
    };
    let mut points = Vec::new();
    let mut k = 0.0;
    while k <= steps {
        points.push(at(total * k / steps));
        k += 1.0;
    }
    points
}

fn normal_number(rng: &mut Pcg64Mcg) -> f64 {
    StandardNormal.sample(rng)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seed_decides_and_roots_lie_on_the_head() {
        let options = PatchOptions { wisps: 5, strands_per_wisp: 4, ..PatchOptions::default() };
        let groom = coily_patch(&options, 3);
        assert_eq!(groom, coily_patch(&options, 3));
        assert_ne!(groom, coily_patch(&options, 4));
        for strand in groom.strands().iter() {
            assert!((strand[0].length() - options.head_radius).abs() < 1e-12);
            assert!(60 < strand.len(), "{} points are too few for a coil", strand.len());
        }
    }

    #[test]
    fn strands_are_as_long_for_their_reach_as_real_coils() {
        let groom = coily_patch(&PatchOptions::default(), 0);
        let ratios = groom.strands().iter().map(|strand| {
            let reach = strand[0].distance(strand[strand.len() - 1]);
            tress_geometry::polyline::length(strand) / reach
        });
        let mean = ratios.sum::<f64>() / groom.strands().len() as f64;
        assert!((4.0..9.0).contains(&mean), "arc over chord is {mean}");
    }
}
