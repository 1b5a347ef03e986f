//! Strands whose operator guide lies across a parting, given to another [IPG 5.2].
//!
//! A strand that is drawn to an operator guide on the other side of the head passes through it. It
//! is given instead to the nearest operator guide by root for which the middle of the way from
//! strand to guide, point for point, stays out of the head. What is in the head is decided by the
//! plane of the triangle whose middle is nearest, so triangles should be small against the head.

use glam::DVec3;
use kiddo::SquaredEuclidean;
use kiddo::immutable::float::kdtree::ImmutableKdTree;
use rayon::prelude::*;
use tress_geometry::Mesh;

use crate::instancing::nearest;
use crate::{BuildError, ProceduralGroom};

/// Operator guides that a strand may be given to.
const CANDIDATES: usize = 16;
/// Points of a strand that are looked at.
const SAMPLES: usize = 8;
/// How deep in the head counts, as a part of the head's size. Where neighbours stand on a rounded
/// scalp the way between them dips below it by far less.
const DEPTH: f64 = 0.02;

/// Gives strands that would be drawn through the head to other operator guides; gives how many.
///
/// The head's triangles go around their outer side one way or the other, all alike. A strand that
/// no operator guide near it suits keeps the one it has.
///
/// # Errors
///
/// If the groom cannot be built.
pub fn avoid_head(groom: &mut ProceduralGroom, head: &Mesh) -> Result<usize, BuildError> {
    groom.check()?;
    if head.triangles().is_empty() {
        return Ok(0);
    }
    let head = Head::new(head);
    let strands = groom.instances()?.instance(&groom.guides, &groom.roots.positions);
    let guides = groom.operator_guide_points();
    let operators: Vec<usize> = groom.operator_guides.iter().map(|&g| g as usize).collect();
    let guide_roots = groom.guide_roots().select(&operators);
    let near =
        nearest(&guide_roots.places(&groom.roots), &groom.roots.places(&guide_roots), CANDIDATES);
    let passes =
        |i: usize, guide: u32| head.is_passed(strands.strand(i), guides.strand(guide as usize));
    let suited: Vec<u32> = groom
        .operator_of
        .par_iter()
        .enumerate()
        .map(|(i, &now)| {
            if !passes(i, now) {
                return now;
            }
            let mut others = near[i].iter().map(|&(_, guide)| guide);
            others.find(|&guide| guide != now && !passes(i, guide)).unwrap_or(now)
        })
        .collect();
    let moved = suited.iter().zip(&groom.operator_of).filter(|(a, b)| a != b).count();
    groom.operator_of = suited;
    Ok(moved)
}

/// Triangles by their middles and outward normals.
struct Head {
    middles: Vec<DVec3>,
    tree: ImmutableKdTree<f64, u32, 3, 32>,
    normals: Vec<DVec3>,
    low: DVec3,
    high: DVec3,
}

impl Head {
    fn new(mesh: &Mesh) -> Self {
        let corners = || (0..mesh.triangles().len()).map(|i| mesh.corners(i));
        let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        // The volume is positive where triangles go around counterclockwise, seen from outside.
        let volume: f64 = corners().map(|[a, b, c]| a.dot(b.cross(c))).sum();
        let outward = if volume < 0.0 { -1.0 } else { 1.0 };
        let positions = mesh.positions().iter().copied();
        let middles: Vec<DVec3> = corners().map(|[a, b, c]| (a + b + c) / 3.0).collect();
        let items: Vec<[f64; 3]> = middles.iter().map(DVec3::to_array).collect();
        Self {
            middles,
            tree: ImmutableKdTree::new_from_slice(&items),
            normals: corners().map(|t| outward * normal(t).normalize_or_zero()).collect(),
            low: positions.clone().fold(DVec3::INFINITY, DVec3::min),
            high: positions.fold(DVec3::NEG_INFINITY, DVec3::max),
        }
    }

    /// How deep a point is in the head; negative outside.
    fn depth(&self, x: DVec3) -> f64 {
        if x.cmplt(self.low).any() || x.cmpgt(self.high).any() {
            return f64::NEG_INFINITY;
        }
        let nearest = self.tree.nearest_one::<SquaredEuclidean>(&x.to_array());
        let k = nearest.item as usize;
        (self.middles[k] - x).dot(self.normals[k])
    }

    /// Whether the middle of the way from a strand to a guide is in the head, deeper than either.
    fn is_passed(&self, strand: &[DVec3], guide: &[DVec3]) -> bool {
        let allowed = DEPTH * (self.high - self.low).length();
        let n = strand.len() - 1;
        (1..=SAMPLES).map(|k| k * n / SAMPLES).any(|j| {
            let deep = self.depth(0.5 * (strand[j] + guide[j]));
            let ends = || self.depth(strand[j]).max(self.depth(guide[j])).max(0.0);
            allowed < deep && allowed + ends() < deep
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EvenStrands, Roots};

    /// A ball of radius 1 about the origin, its triangles going around one way or the other.
    fn ball(flipped: bool) -> Mesh {
        let (rings, around) = (24_u32, 48_u32);
        let point = |i: u32, j: u32| {
            let polar = std::f64::consts::PI * f64::from(i) / f64::from(rings);
            let angle = std::f64::consts::TAU * f64::from(j) / f64::from(around);
            let (sine, cosine) = polar.sin_cos();
            DVec3::new(sine * angle.cos(), cosine, -sine * angle.sin())
        };
        let positions = (0..=rings).flat_map(|i| (0..around).map(move |j| point(i, j))).collect();
        let at = |i: u32, j: u32| i * around + j % around;
        let triangles = (0..rings).flat_map(|i| {
            (0..around).flat_map(move |j| {
                let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                [[a, b, c], [a, c, d]].map(|[a, b, c]| if flipped { [a, c, b] } else { [a, b, c] })
            })
        });
        Mesh::new(positions, triangles.collect()).expect("corners that are there")
    }

    /// Hair that falls to the left and right of a parting along z, strand for strand.
    fn parted() -> ProceduralGroom {
        let strand = |x: f64, z: f64| {
            (0..20).map(move |j| {
                let angle = x.signum() * (0.1 + 0.12 * f64::from(j)) + 0.2 * x;
                1.05 * DVec3::new(angle.sin(), angle.cos(), 0.0) + DVec3::Z * z
            })
        };
        let guides = [(-0.2, 0.0), (0.3, 0.0)].into_iter().flat_map(|(x, z)| strand(x, z));
        let guides = EvenStrands::new(20, guides.collect()).expect("whole strands");
        let positions = [-0.2, 0.02, 0.3].map(|x| strand(x, 0.05).next().unwrap_or_default());
        let roots = Roots { positions: positions.to_vec(), uv: None };
        let mut groom = ProceduralGroom::new(guides, roots).expect("sound guides");
        // Strands fall to the right but for the first, and all belong to the left.
        let instances = crate::Instances { each: 1, guides: vec![0, 1, 1], weights: vec![1.0; 3] };
        groom.instances = Some(instances);
        groom.instancing = crate::Instancing::Stored;
        groom.operator_of = vec![0, 0, 0];
        groom
    }

    #[test]
    fn strands_across_a_parting_are_given_to_their_own_side() {
        for flipped in [false, true] {
            let mut groom = parted();
            let moved = avoid_head(&mut groom, &ball(flipped)).expect("a sound groom");
            assert_eq!((moved, groom.operator_of), (2, vec![0, 1, 1]));
        }
    }

    #[test]
    fn without_a_head_in_between_all_stay() {
        let mut groom = parted();
        assert_eq!(avoid_head(&mut groom, &Mesh::default()), Ok(0));
        let small: Vec<DVec3> = ball(false).positions().iter().map(|x| 0.1 * *x).collect();
        let small = Mesh::new(small, ball(false).triangles().to_vec()).expect("the same corners");
        assert_eq!(avoid_head(&mut groom, &small), Ok(0));
        assert_eq!(groom.operator_of, [0, 0, 0]);
    }

    #[test]
    fn depth_is_measured_from_the_surface() {
        let head = Head::new(&ball(false));
        assert!((head.depth(DVec3::new(0.0, 0.3, 0.4)) - 0.5).abs() < 0.01);
        assert!(head.depth(DVec3::new(0.69, 0.69, 0.69)) < -0.15);
    }
}
