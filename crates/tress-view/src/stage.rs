//! The light that pictures are taken in.
//!
//! As a photographer lights hair: a warm key from the upper left in front, which models the volume
//! and draws the highlights; a cool rim from the upper right behind, which parts the hair from the
//! ground; and a soft sky all around, brighter above, which no deep place sees much of. The lights
//! stand with the viewer, so that every view is as well lit as the front.

use glam::Vec3;

use crate::shade::{Light, Material};

/// Everything around the hair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stage {
    pub(crate) lights: [Light; 2],
    /// Light from all around where nothing is in its way.
    pub(crate) sky: Vec3,
    pub(crate) material: Material,
    /// What is seen where there is no hair, as linear light.
    pub(crate) background: Vec3,
}

const KEY: Vec3 = Vec3::new(-0.5, -0.7, -0.6);
const RIM: Vec3 = Vec3::new(0.6, -0.45, 0.65);

impl Stage {
    /// For natural hair.
    pub(crate) fn natural(background: Vec3) -> Self {
        let material =
            Material { roughness: 0.38, surface: 4.2, inside: 1.3, scattered: 1.0, depth: 0.45 };
        Self {
            lights: [
                Light { towards: KEY.normalize(), intensity: 2.5 * Vec3::new(1.0, 0.94, 0.85) },
                Light { towards: RIM.normalize(), intensity: 1.0 * Vec3::new(0.9, 0.95, 1.0) },
            ],
            sky: 1.25 * Vec3::new(0.97, 0.99, 1.0),
            material,
            background,
        }
    }

    /// For colours that stand for numbers: white light, weak highlights, and shadows that darken
    /// without hiding the hue.
    pub(crate) fn plain(background: Vec3) -> Self {
        let material =
            Material { roughness: 0.4, surface: 1.2, inside: 0.0, scattered: 0.6, depth: 0.35 };
        Self {
            lights: [
                Light { towards: KEY.normalize(), intensity: Vec3::splat(1.0) },
                Light { towards: RIM.normalize(), intensity: Vec3::splat(0.3) },
            ],
            sky: Vec3::splat(0.75),
            material,
            background,
        }
    }
}
