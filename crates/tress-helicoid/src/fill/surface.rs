//! Normals of a surface where hairs stand on it.

use glam::DVec3;
use rayon::prelude::*;
use tress_geometry::Mesh;

/// The unit normals of the mesh next to points: of the triangle whose middle is nearest, tilted to
/// the normals of its corners as the point lies between them. Points beside a mesh without
/// triangles get z.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::Mesh;
/// use tress_helicoid::normals_at;
///
/// let floor = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]])?;
/// assert_eq!(normals_at(&floor, &[DVec3::new(0.2, 0.2, 0.0)]), [DVec3::Z]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn normals_at(mesh: &Mesh, points: &[DVec3]) -> Vec<DVec3> {
    let n = mesh.triangles().len();
    let middles: Vec<DVec3> =
        (0..n).map(|i| mesh.corners(i).into_iter().sum::<DVec3>() / 3.0).collect();
    let corners = corner_normals(mesh);
    let nearest = |point: DVec3| {
        let distance = |i: &usize| middles[*i].distance_squared(point);
        (0..n).min_by(|i, j| distance(i).total_cmp(&distance(j)))
    };
    let normal = |point: &DVec3| match nearest(*point) {
        Some(i) => {
            let near = mesh.triangles()[i].map(|vertex| corners[vertex as usize]);
            let at = mesh.corners(i);
            // Weights that fall with the distance from a corner, which no flat triangle upsets.
            let sum: DVec3 =
                (0..3).map(|j| near[j] / (at[j].distance(*point) + f64::MIN_POSITIVE)).sum();
            sum.try_normalize().unwrap_or(DVec3::Z)
        }
        None => DVec3::Z,
    };
    points.par_iter().map(normal).collect()
}

/// The unit normal of every vertex: the mean of its triangles', by their area.
fn corner_normals(mesh: &Mesh) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; mesh.positions().len()];
    for (i, triangle) in mesh.triangles().iter().enumerate() {
        let [a, b, c] = mesh.corners(i);
        let area = (b - a).cross(c - a);
        for &vertex in triangle {
            normals[vertex as usize] += area;
        }
    }
    normals.into_iter().map(|normal| normal.normalize_or_zero()).collect()
}
