//! How a fibre scatters light.
//!
//! A hair is a transparent cylinder with tilted scales. Marschner et al. ("Light Scattering from
//! Human Hair Fibers", SIGGRAPH 2003) split the light it sends to the viewer by the way it took:
//! `R`, reflected at the surface, the white highlight; `TT`, through and out at the back, the
//! glowing rim against the light; `TRT`, reflected once inside, a second, coloured highlight. The
//! scales tilt the two highlights apart, `R` towards the root and `TRT` towards the tip, which is
//! what tells hair from wire. Each is a product of a Gaussian in the angles along the fibre and a
//! term in the angle around it, here in the closed forms of Karis ("Physically Based Hair Shading
//! in Unreal", SIGGRAPH course 2016).
//!
//! What is scattered from hair to hair has lost its direction: it is the fibre's colour under a
//! diffuse light that reaches a third as deep again as the unscattered beam.

use glam::Vec3;

/// Towards the viewer, in pixel space.
const TO_VIEWER: Vec3 = Vec3::NEG_Z;

/// Tilt of the scales, in radians: two degrees.
const TILT: f32 = 0.035;

/// Around the fibre (the cosine of the angle between light and viewer), `TT` is below a hundredth
/// of its peak above this, and `TRT` below this.
const TT_BELOW: f32 = 0.2;
const TRT_ABOVE: f32 = 0.7;

/// A beam with less than this left is not asked which way it goes: no step of an 8-bit colour.
const SPENT: f32 = 1.0 / 512.0;

/// A light far away.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light {
    /// Unit vector towards the light, in pixel space: right, down, away.
    pub(crate) towards: Vec3,
    /// How bright it is, red, green and blue.
    pub(crate) intensity: Vec3,
}

/// How strongly hair of one kind shows each way of light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Material {
    /// Width of the highlights along the fibre, 0.1 sharp to 0.5 dull.
    pub(crate) roughness: f32,
    /// Of `R`.
    pub(crate) surface: f32,
    /// Of `TT` and `TRT`.
    pub(crate) inside: f32,
    /// Of light scattered from hair to hair.
    pub(crate) scattered: f32,
    /// Optical depth seen by scattered light, as a share of that seen by the beam.
    pub(crate) depth: f32,
}

/// A hair at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fibre {
    /// Unit vector from root to tip.
    pub(crate) tangent: Vec3,
    /// What the hair shows when light has gone through many of its kind.
    pub(crate) color: Vec3,
    /// How far its scales are tilted beyond the usual, in radians.
    pub(crate) tilt: f32,
}

/// Light from a fibre towards the viewer, under a light that has come through an optical depth of
/// `tau`.
pub(crate) fn scatter(material: &Material, fibre: &Fibre, light: &Light, tau: f32) -> Vec3 {
    let (t, l, color) = (fibre.tangent, light.towards, fibre.color);
    let (sin_i, sin_o) = (t.dot(l), t.dot(TO_VIEWER));
    let beam = (-tau).exp();
    let diffuse = (1.0 - sin_i * sin_i).max(0.0).sqrt() * (-material.depth * tau).exp();
    let scattered = color * (material.scattered * diffuse);
    if beam < SPENT {
        return scattered * light.intensity;
    }
    let mut angles = Angles::new(t, l, sin_i, sin_o);
    angles.sines += fibre.tilt;
    (scattered + angles.ways(material, color) * beam) * light.intensity
}

/// Angles between fibre, light and viewer.
struct Angles {
    /// Sum of the sines of the inclinations of light and viewer: 0 in the mirror direction.
    sines: f32,
    /// Cosine of half the difference of the inclinations.
    cos_d: f32,
    /// Cosine of the angle around the fibre between light and viewer, and of its half.
    cos_phi: f32,
    cos_half_phi: f32,
    /// Cosine of the angle between light and viewer.
    cos_lv: f32,
}

impl Angles {
    fn new(t: Vec3, l: Vec3, sin_i: f32, sin_o: f32) -> Self {
        let cosine = |sine: f32| (1.0 - sine * sine).max(0.0).sqrt();
        // cos((a - b) / 2) from sines and cosines of a and b.
        let cos_difference = cosine(sin_i) * cosine(sin_o) + sin_i * sin_o;
        let cos_d = (0.5 + 0.5 * cos_difference).max(0.0).sqrt();
        let (across_l, across_v) = (l - sin_i * t, TO_VIEWER - sin_o * t);
        let lengths = (across_l.length_squared() * across_v.length_squared()).sqrt();
        let cos_phi = (across_l.dot(across_v) / lengths.max(1e-6)).clamp(-1.0, 1.0);
        let cos_half_phi = (0.5 + 0.5 * cos_phi).sqrt();
        Self { sines: sin_i + sin_o, cos_d, cos_phi, cos_half_phi, cos_lv: l.dot(TO_VIEWER) }
    }

    fn ways(&self, material: &Material, color: Vec3) -> Vec3 {
        let beta = material.roughness * material.roughness;
        let r = {
            let width = beta * std::f32::consts::SQRT_2 * self.cos_half_phi.max(0.2);
            let around = 0.25 * self.cos_half_phi;
            let mirrored = fresnel((0.5 + 0.5 * self.cos_lv).max(0.0).sqrt());
            gaussian(width, self.sines + 2.0 * TILT) * around * mirrored
        };
        let mut inside = Vec3::ZERO;
        if 0.0 < material.inside && self.cos_phi < TT_BELOW {
            let bend = 1.0 / (1.19 / self.cos_d + 0.36 * self.cos_d);
            let h = self.cos_half_phi * (1.0 + bend * (0.6 - 0.8 * self.cos_phi));
            let let_in = 1.0 - fresnel(self.cos_d * (1.0 - h * h).max(0.0).sqrt());
            let way = 0.5 * (1.0 - (h * bend) * (h * bend)).max(0.0).sqrt() / self.cos_d;
            let around = (-3.65 * self.cos_phi - 3.98).exp();
            let along = gaussian(0.5 * beta, self.sines - TILT);
            inside = power(color, way) * (along * around * let_in * let_in);
        } else if 0.0 < material.inside && TRT_ABOVE < self.cos_phi {
            let mirrored = fresnel(0.5 * self.cos_d);
            let let_in = 1.0 - mirrored;
            let around = (17.0 * self.cos_phi - 16.78).exp();
            let along = gaussian(2.0 * beta, self.sines - 4.0 * TILT);
            inside = power(color, 0.8 / self.cos_d) * (along * around * let_in * let_in * mirrored);
        }
        Vec3::splat(material.surface * r) + inside * material.inside
    }
}

/// Normal distribution of standard deviation `b`.
fn gaussian(b: f32, x: f32) -> f32 {
    (-0.5 * (x / b) * (x / b)).exp() / (b * 2.506_628)
}

/// Schlick's approximation for keratin, of refractive index 1.55.
fn fresnel(cosine: f32) -> f32 {
    const F0: f32 = 0.0465;
    F0 + (1.0 - F0) * (1.0 - cosine).max(0.0).powi(5)
}

/// What is left of white light after `way` times the path that leaves `color`.
fn power(color: Vec3, way: f32) -> Vec3 {
    color.max(Vec3::splat(1e-4)).powf(way)
}
