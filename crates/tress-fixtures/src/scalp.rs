//! The patch of scalp that [`coily_patch`](crate::coily_patch) grows on, as a mesh.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};
use tress_geometry::Mesh;

use crate::PatchOptions;

/// Rings of the mesh from the middle of the patch to its edge.
const RINGS: u32 = 48;

/// Corners of a ring.
const CORNERS: u32 = 96;

/// Turns the middle of the patch from +Z upwards.
pub(crate) fn tilt() -> DMat3 {
    DMat3::from_rotation_x(-0.5)
}

/// The patch of the head that these options describe: rings about its middle.
///
/// ```
/// use tress_fixtures::{PatchOptions, scalp};
///
/// let options = PatchOptions::default();
/// let mesh = scalp(&options);
/// let area: f64 = (0..mesh.triangles().len()).map(|i| mesh.area(i)).sum();
/// // A cap of a sphere.
/// let cap = std::f64::consts::TAU * 81.0 * (1.0 - options.patch_angle.cos());
/// assert!((area / cap - 1.0).abs() < 0.01);
/// ```
#[must_use]
pub fn scalp(options: &PatchOptions) -> Mesh {
    let mut positions = vec![tilt() * DVec3::Z * options.head_radius];
    let mut triangles = Vec::new();
    for ring in 1..=RINGS {
        let (r, z) = (options.patch_angle * f64::from(ring) / f64::from(RINGS)).sin_cos();
        for corner in 0..CORNERS {
            let (sine, cosine) = (TAU * f64::from(corner) / f64::from(CORNERS)).sin_cos();
            positions.push(tilt() * DVec3::new(r * cosine, r * sine, z) * options.head_radius);
        }
        for corner in 0..CORNERS {
            let next = (corner + 1) % CORNERS;
            let here = |corner| 1 + (ring - 1) * CORNERS + corner;
            if ring == 1 {
                triangles.push([0, here(corner), here(next)]);
                continue;
            }
            let inner = |corner| here(corner) - CORNERS;
            triangles.push([inner(corner), here(corner), here(next)]);
            triangles.push([inner(corner), here(next), inner(next)]);
        }
    }
    Mesh::new(positions, triangles).expect("corners of rings that are there")
}
