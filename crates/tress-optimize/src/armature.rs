//! The armature of a groom at rest: for each cluster a chain of oriented frames [CSE 5.3].
//!
//! A frame sits at the mean of its cluster's control points, the points at one relative length of
//! all strands of the cluster, and lies along their principal directions.

use glam::{DMat3, DVec3};
use nalgebra::{Matrix3, SymmetricEigen};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_analysis::{Clusters, k_means, root_tip_features};
use tress_geometry::HelixGroom;

use crate::{Clustering, Fingerprint, Group, Joint, Pose, PoseError, Select};

/// What an armature is made like.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ArmatureOptions {
    /// How strands are shared out.
    pub clusters: Clustering,
    /// Where joints are, in parts of the strands' lengths: above 0, at most 1, ascending. Default
    /// a third, two thirds and the tip.
    pub lengths: Vec<f64>,
}

impl Default for ArmatureOptions {
    fn default() -> Self {
        Self { clusters: Clustering::default(), lengths: vec![1.0 / 3.0, 2.0 / 3.0, 1.0] }
    }
}

/// The rest pose of a groom: every joint where its hair is, nothing moved.
///
/// # Errors
///
/// If the groom cannot be clustered or a length has no meaning.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
/// use tress_optimize::{ArmatureOptions, Clustering, apply_pose, armature};
///
/// // Two straight strands that hang side by side.
/// let down = |x| Frame::along(DVec3::new(x, 0.0, 0.0), DVec3::NEG_Y).expect("a direction");
/// let straight = Element { length: 3.0, ..Element::default() };
/// let elements = Strands::from_counts([1, 1], vec![straight; 2])?;
/// let groom = HelixGroom::new(vec![down(-1.0), down(1.0)], elements)?;
///
/// let one = Clustering { count: 1, ..Clustering::default() };
/// let mut pose = armature(&groom, &ArmatureOptions { clusters: one, ..Default::default() })?;
/// let tip = &mut pose.groups[0].joints[2];
/// assert_eq!(tip.center, DVec3::new(0.0, -3.0, 0.0));
/// tip.translate = DVec3::new(0.0, 0.0, 1.0);
/// let controls = apply_pose(&groom, &pose)?;
/// assert_eq!(controls.strand(1)[2].anchor, DVec3::new(1.0, -3.0, 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn armature(groom: &HelixGroom, options: &ArmatureOptions) -> Result<Pose, PoseError> {
    let clusters = clusters(groom, &options.clusters)?;
    let mut groups = Vec::new();
    for (cluster, members) in clusters.members().into_iter().enumerate() {
        let members: Vec<usize> =
            members.into_iter().filter(|&i| !groom.strand(i).elements.is_empty()).collect();
        if members.is_empty() {
            continue;
        }
        let points: Vec<Vec<DVec3>> =
            members.par_iter().map(|&i| points_at(groom, i, &options.lengths)).collect();
        let joints = options.lengths.iter().enumerate().map(|(k, &at)| {
            let (center, axes) = principal_frame(points.iter().map(|strand| strand[k]));
            let (translate, rotate, scale) = (DVec3::ZERO, DVec3::ZERO, DVec3::ONE);
            Joint { at, center, axes, translate, rotate, scale }
        });
        let joints: Vec<Joint> = joints.collect();
        crate::apply::check_joints(groups.len(), &joints)?;
        groups.push(Group { select: Select::Cluster(cluster), joints });
    }
    let groom = Some(Fingerprint::of(groom));
    Ok(Pose { groom, clusters: options.clusters, chained: true, groups, anchors: Vec::new() })
}

/// Strands shared out among clusters; no more clusters than strands.
pub(crate) fn clusters(
    groom: &HelixGroom,
    clustering: &Clustering,
) -> Result<Clusters<6>, PoseError> {
    if groom.is_empty() {
        return Ok(Clusters { centers: Vec::new(), assignment: Vec::new() });
    }
    let count = clustering.count.min(groom.len());
    Ok(k_means(&root_tip_features(groom), count, clustering.seed)?)
}

/// The points of a strand at parts of its length.
pub(crate) fn points_at(groom: &HelixGroom, strand: usize, at: &[f64]) -> Vec<DVec3> {
    let strand = groom.strand(strand);
    let length = strand.length();
    strand.frames_at(at.iter().map(|at| at * length)).map(|frame| frame.position).collect()
}

/// Mean and principal directions of points, those of greatest spread first; right-handed.
///
/// Each of the first two is taken with its greatest component positive, so that the same points
/// always have the same frame.
fn principal_frame(points: impl Iterator<Item = DVec3> + Clone) -> (DVec3, [DVec3; 3]) {
    let points = points.filter(|point| point.is_finite());
    let n = points.clone().count().max(1) as f64;
    let mean = points.clone().sum::<DVec3>() / n;
    let mut spread = DMat3::ZERO;
    for point in points {
        let d = point - mean;
        spread += DMat3::from_cols(d * d.x, d * d.y, d * d.z);
    }
    let eigen = SymmetricEigen::new(Matrix3::from_column_slice(&spread.to_cols_array()));
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let axis = |i: usize| {
        let axis = DVec3::from_array(eigen.eigenvectors.column(order[i]).into_owned().into());
        axis * axis[axis.abs().max_position()].signum()
    };
    let (first, second) = (axis(0), axis(1));
    (mean, [first, second, first.cross(second)])
}
