//! Colours: what the screen shows, what light is, and the colour that melanin gives hair.
//!
//! Light adds up in linear intensities, files hold sRGB-encoded bytes; shading is done in the
//! former and only the finished picture is encoded.
//!
//! The colour of hair comes from eumelanin (brown to black) and pheomelanin (red). With the
//! amounts `e` and `p` the fibre absorbs
//!
//! `sigma = e (0.506, 0.841, 1.653) + p (0.343, 0.733, 1.924)`
//!
//! in red, green and blue, and a head of such fibres, through many scatterings, shows the colour
//!
//! `C = exp(-k sqrt(sigma))`, `k = 5.89`
//!
//! (Chiang, Bitterli, Tappan and Burley, "A Practical and Controllable Hair and Fur Model for
//! Production Path Tracing", Computer Graphics Forum 2016, with `k` for their roughness 0.3).

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::num::{byte, floor, index};

/// A colour as files and screens hold it: sRGB-encoded red, green and blue.
pub type Rgb = [u8; 3];

/// What absorbs in a fibre of pure eumelanin, in red, green and blue.
const EUMELANIN: Vec3 = Vec3::new(0.506, 0.841, 1.653);
/// What absorbs in a fibre of pure pheomelanin.
const PHEOMELANIN: Vec3 = Vec3::new(0.343, 0.733, 1.924);
/// From the square root of absorption to the colour of the whole head.
const MULTIPLE_SCATTERING: f32 = 5.89;

/// The colour of hair that is drawn for its looks.
///
/// ```
/// use tress_view::HairColor;
///
/// let preset: HairColor = ron::from_str("Melanin(amount: 0.2, redness: 0.1)")?;
/// let [r, g, b] = preset.rgb();
/// assert!(r > g && g > b, "blond is yellow");
/// # Ok::<(), ron::de::SpannedError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum HairColor {
    /// As grown.
    Melanin {
        /// 0 white, 0.2 blond, 0.5 dark brown, 1 black; held to that range.
        amount: f32,
        /// Share of pheomelanin: 0 brown, 1 red; held to that range.
        redness: f32,
    },
    /// As dyed.
    Dyed(Rgb),
}

impl Default for HairColor {
    /// Dark brown.
    fn default() -> Self {
        Self::Melanin { amount: 0.58, redness: 0.1 }
    }
}

impl HairColor {
    /// The colour that a head of this hair shows.
    #[must_use]
    pub fn rgb(self) -> Rgb {
        encode(self.linear())
    }

    /// The same as linear light.
    pub(crate) fn linear(self) -> Vec3 {
        match self {
            Self::Melanin { amount, redness } => {
                let amount = held(amount);
                let redness = held(redness);
                // As in the paper: an even step of `amount` is an even step to the eye.
                let melanin = -(1.0 - amount).max(1e-4).ln();
                let sigma = melanin * (EUMELANIN * (1.0 - redness) + PHEOMELANIN * redness);
                Vec3::from_array(sigma.to_array().map(|s| (-MULTIPLE_SCATTERING * s.sqrt()).exp()))
            }
            Self::Dyed(rgb) => decode(rgb),
        }
    }
}

/// A share held to 0 to 1; one that is not a number is 0.
fn held(share: f32) -> f32 {
    if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) }
}

/// Linear light of an sRGB colour.
pub(crate) fn decode(rgb: Rgb) -> Vec3 {
    Vec3::from_array(rgb.map(|byte| {
        let v = f32::from(byte) / 255.0;
        if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    }))
}

/// The sRGB colour of linear light, held to what the screen can show.
pub(crate) fn encode(light: Vec3) -> Rgb {
    light.to_array().map(|v| {
        let v = v.clamp(0.0, 1.0);
        let v = if v <= 0.0031308 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
        byte(255.0 * v)
    })
}

/// [`encode`] by looking it up: the powers of a picture's every pixel would take as long as its
/// hair.
pub(crate) struct Encoder(Vec<u8>);

impl Encoder {
    /// Steps from dark to bright: a twentieth of a byte where the encoding is steepest.
    const STEPS: u16 = u16::MAX;

    pub(crate) fn new() -> Self {
        let step = |i: u16| encode(Vec3::splat(f32::from(i) / f32::from(Self::STEPS)))[0];
        Self((0..=Self::STEPS).map(step).collect())
    }

    pub(crate) fn encode(&self, light: Vec3) -> Rgb {
        let last = self.0.len() - 1;
        light.to_array().map(|v| self.0[index(floor(v * f32::from(Self::STEPS) + 0.5)).min(last)])
    }
}

/// How light or dark a colour is to the eye, 0 to 1: the L* of CIELAB over 100.
pub(crate) fn lightness(rgb: Rgb) -> f32 {
    let y = luminance(decode(rgb));
    if y <= 0.008856 { 9.033 * y } else { 1.16 * y.cbrt() - 0.16 }
}

/// Relative luminance of linear light (ITU-R BT.709).
pub(crate) fn luminance(light: Vec3) -> f32 {
    light.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        let encoder = Encoder::new();
        for v in 0..=255 {
            assert_eq!(encode(decode([v, 0, 255])), [v, 0, 255]);
            assert_eq!(encoder.encode(decode([v, 0, 255])), [v, 0, 255]);
        }
    }

    #[test]
    fn more_melanin_is_darker_and_redness_is_red() {
        let dark = |amount| HairColor::Melanin { amount, redness: 0.0 };
        let shades: Vec<_> = [0.0, 0.2, 0.5, 0.8, 1.0].map(|a| lightness(dark(a).rgb())).into();
        assert!(shades.windows(2).all(|w| w[1] < w[0]), "{shades:?}");
        let ratio = |redness| {
            let c = HairColor::Melanin { amount: 0.4, redness }.linear();
            c.x / c.z
        };
        assert!(ratio(0.0) < ratio(1.0));
        let nonsense = HairColor::Melanin { amount: f32::NAN, redness: f32::INFINITY };
        assert_eq!(nonsense.rgb(), [255; 3]);
    }

    #[test]
    fn lightness_of_black_grey_and_white() {
        assert!(lightness([0; 3]).abs() < 1e-6);
        assert!((lightness([119; 3]) - 0.5).abs() < 0.01, "sRGB 119 is the middle grey");
        assert!((lightness([255; 3]) - 1.0).abs() < 1e-3);
    }
}
