//! A triangle mesh: the scalp that roots stand on.

use glam::DVec3;

/// Positions, and triangles of three of them.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::Mesh;
///
/// let mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]])?;
/// assert_eq!(mesh.area(0), 0.5);
/// # Ok::<(), tress_geometry::MeshError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    positions: Vec<DVec3>,
    // Invariant: every entry is the index of a position.
    triangles: Vec<[u32; 3]>,
}

/// A triangle names a position that is not there.
///
/// ```
/// # use glam::DVec3;
/// # use tress_geometry::{Mesh, MeshError};
/// let error = Mesh::new(vec![DVec3::ZERO], vec![[0, 0, 1]]);
/// assert_eq!(error, Err(MeshError { triangle: 0, corner: 1, positions: 1 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("triangle {triangle} has a corner {corner}, but there are {positions} positions")]
pub struct MeshError {
    /// The triangle.
    pub triangle: usize,
    /// The position that it names.
    pub corner: u32,
    /// How many there are.
    pub positions: usize,
}

impl Mesh {
    /// Joins positions and triangles.
    ///
    /// # Errors
    ///
    /// If a triangle names a position that is not there.
    pub fn new(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&corner) = corners.iter().find(|c| positions.len() <= **c as usize) {
                return Err(MeshError { triangle, corner, positions: positions.len() });
            }
        }
        Ok(Self { positions, triangles })
    }

    /// The positions.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The triangles, as indices of positions.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of triangle `i`.
    #[must_use]
    pub fn corners(&self, i: usize) -> [DVec3; 3] {
        self.triangles[i].map(|corner| self.positions[corner as usize])
    }

    /// The area of triangle `i`.
    #[must_use]
    pub fn area(&self, i: usize) -> f64 {
        let [a, b, c] = self.corners(i);
        0.5 * (b - a).cross(c - a).length()
    }
}
