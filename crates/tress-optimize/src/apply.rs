//! A pose turned into controls, which is all that a solver knows of it.

use glam::{DMat3, DVec3, EulerRot};
use rayon::prelude::*;
use tress_analysis::ClusterError;
use tress_geometry::{HelixGroom, OffsetsError, Strands};

use crate::armature::{clusters, points_at};
use crate::{Control, Fingerprint, Joint, Pose, Select};

/// Why a pose does not fit a groom. The pose has to be changed; nothing has been done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PoseError {
    /// The pose was made for a groom with other strands.
    #[error(
        "the pose is for a groom of {} strands with roots about {} and tips about {}, \
         not for one of {} strands about {} and {}",
        .pose.strands, .pose.roots, .pose.tips, .groom.strands, .groom.roots, .groom.tips
    )]
    AnotherGroom {
        /// What the pose was made for.
        pose: Box<Fingerprint>,
        /// What it is applied to.
        groom: Box<Fingerprint>,
    },
    /// The groom cannot be clustered.
    #[error(transparent)]
    Clusters(#[from] ClusterError),
    /// A group holds no strand: there is no such cluster, or no strand has the value.
    #[error("group {group} ({select}) names no strand")]
    NoStrand {
        /// The group's place in the pose.
        group: usize,
        /// What it selects.
        select: String,
    },
    /// The groom's strands have no such attribute.
    #[error("group {group}: strands have no attribute {name:?}")]
    NoAttribute {
        /// The group's place in the pose.
        group: usize,
        /// The attribute.
        name: String,
    },
    /// A joint lies outside the strands or not beyond the one before it: `at: 1.5`.
    #[error("group {group}: joint {joint} at {at} is not above the one before and at most 1")]
    Joint {
        /// The group's place in the pose.
        group: usize,
        /// The joint's place in the group.
        joint: usize,
        /// Where it is.
        at: f64,
    },
    /// A number of a joint is NaN or infinite.
    #[error("group {group}: joint {joint} is not finite")]
    NotFinite {
        /// The group's place in the pose.
        group: usize,
        /// The joint's place in the group.
        joint: usize,
    },
    /// An anchor names no strand, a place outside it, or a position that is not finite.
    #[error(
        "anchor {anchor}: strand {strand} at {at} is not there, or where it goes is not finite"
    )]
    Anchor {
        /// The anchor's place in the pose.
        anchor: usize,
        /// The strand.
        strand: usize,
        /// Where on the strand.
        at: f64,
    },
    /// The blend is negative or not finite.
    #[error("blend must be a number and at least 0, not {0}")]
    Blend(f64),
    /// More controls than can be told apart.
    #[error(transparent)]
    TooMany(#[from] OffsetsError),
}

/// A group's motion, ready to be applied.
struct Motion {
    /// How much each strand is moved by it.
    weights: Vec<f64>,
    /// By joint: where on strands, and the affine map `x -> matrix x + offset`.
    maps: Vec<(f64, DMat3, DVec3)>,
}

/// The controls that a pose puts on the strands of a groom; none on strands that it leaves alone.
///
/// # Errors
///
/// If the pose is for another groom, names strands, clusters or attributes that are not there, or
/// has numbers without a meaning.
pub fn apply_pose(groom: &HelixGroom, pose: &Pose) -> Result<Strands<Control>, PoseError> {
    check(groom, pose)?;
    let motions = motions(groom, pose)?;
    let mut direct = vec![Vec::new(); groom.len()];
    for anchor in &pose.anchors {
        direct[anchor.strand].push((anchor.at, anchor.position));
    }
    let controls: Vec<Vec<Control>> = (0..groom.len())
        .into_par_iter()
        .map(|i| strand_controls(groom, i, &motions, &direct[i]))
        .collect();
    let mut strands = Strands::default();
    for strand in controls {
        strands.push(strand)?;
    }
    Ok(strands)
}

/// Whether joints ascend within the strand and are finite.
pub(crate) fn check_joints(group: usize, joints: &[Joint]) -> Result<(), PoseError> {
    let mut before = 0.0;
    for (joint, j) in joints.iter().enumerate() {
        let Joint { at, center, axes, translate, rotate, scale } = *j;
        if !(before < at && at <= 1.0) {
            return Err(PoseError::Joint { group, joint, at });
        }
        before = at;
        let [a, b, c] = axes;
        if ![center, translate, rotate, scale, a, b, c].iter().all(|v| v.is_finite()) {
            return Err(PoseError::NotFinite { group, joint });
        }
    }
    Ok(())
}

fn check(groom: &HelixGroom, pose: &Pose) -> Result<(), PoseError> {
    if let Some(expected) = &pose.groom {
        let found = Fingerprint::of(groom);
        if !expected.matches(&found) {
            let (pose, groom) = (Box::new(*expected), Box::new(found));
            return Err(PoseError::AnotherGroom { pose, groom });
        }
    }
    let blend = pose.clusters.blend;
    if !(0.0 <= blend && blend.is_finite()) {
        return Err(PoseError::Blend(blend));
    }
    for (group, joints) in pose.groups.iter().map(|group| &group.joints).enumerate() {
        check_joints(group, joints)?;
    }
    for (anchor, a) in pose.anchors.iter().enumerate() {
        let there = a.strand < groom.len() && (0.0..=1.0).contains(&a.at);
        if !there || !a.position.is_finite() {
            return Err(PoseError::Anchor { anchor, strand: a.strand, at: a.at });
        }
    }
    Ok(())
}

fn motions(groom: &HelixGroom, pose: &Pose) -> Result<Vec<Motion>, PoseError> {
    let needs_clusters = pose.groups.iter().any(|group| matches!(group.select, Select::Cluster(_)));
    let shares = if needs_clusters { cluster_weights(groom, pose)? } else { Vec::new() };
    let motion = |(index, group): (usize, &crate::Group)| {
        let none = |select: String| PoseError::NoStrand { group: index, select };
        let weights = match &group.select {
            Select::All => vec![1.0; groom.len()],
            Select::Cluster(cluster) => shares
                .get(*cluster)
                .filter(|weights| weights.iter().any(|&w| 0.0 < w))
                .cloned()
                .ok_or_else(|| none(format!("cluster {cluster}")))?,
            Select::Attribute { name, value } => {
                let column = groom
                    .strand_attributes()
                    .get(name)
                    .ok_or_else(|| PoseError::NoAttribute { group: index, name: name.clone() })?;
                let has = |x: f64| f64::from(u8::from((x - value).abs() < 1e-9));
                let weights: Vec<f64> = column.first_components().map(has).collect();
                if !weights.iter().any(|&w| 0.0 < w) {
                    return Err(none(format!("{name} = {value}")));
                }
                weights
            }
        };
        Ok(Motion { weights, maps: maps(&group.joints, pose.chained) })
    };
    pose.groups.iter().enumerate().map(motion).collect()
}

/// By cluster, how much it moves each strand; a strand's shares sum to 1.
fn cluster_weights(groom: &HelixGroom, pose: &Pose) -> Result<Vec<Vec<f64>>, PoseError> {
    let clusters = clusters(groom, &pose.clusters)?;
    let rows = tress_analysis::root_tip_features(groom);
    let square = |a: &[f64; 6], b: &[f64; 6]| -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
    };
    let own = |i: usize| square(&rows[i], &clusters.centers[clusters.assignment[i] as usize]);
    let mean = (0..rows.len()).map(own).sum::<f64>() / rows.len().max(1) as f64;
    let width = pose.clusters.blend * pose.clusters.blend * mean;
    let mut shares = vec![vec![0.0; rows.len()]; clusters.centers.len()];
    for (i, row) in rows.iter().enumerate() {
        let nearest = own(i);
        let share = |(cluster, center): (usize, &[f64; 6])| {
            if cluster == clusters.assignment[i] as usize {
                1.0
            } else if width == 0.0 {
                0.0
            } else {
                ((nearest - square(row, center)) / width).min(0.0).exp()
            }
        };
        let raw: Vec<f64> = clusters.centers.iter().enumerate().map(share).collect();
        let sum: f64 = raw.iter().sum();
        for (share, raw) in shares.iter_mut().zip(raw) {
            share[i] = raw / sum;
        }
    }
    Ok(shares)
}

/// The affine map of each joint, carried on to those beyond when chained.
fn maps(joints: &[Joint], chained: bool) -> Vec<(f64, DMat3, DVec3)> {
    let (mut matrix, mut offset) = (DMat3::IDENTITY, DVec3::ZERO);
    let map = |joint: &Joint| {
        let [x, y, z] = joint.rotate.to_array().map(f64::to_radians);
        let turn = DMat3::from_euler(EulerRot::ZYX, z, y, x);
        let axes = DMat3::from_cols_array_2d(&joint.axes.map(|axis| axis.to_array()));
        let own = turn * axes * DMat3::from_diagonal(joint.scale) * axes.transpose();
        let moved = joint.center + joint.translate - own * joint.center;
        if chained {
            // What lies beyond is moved by this joint first and by those nearer the root then.
            offset += matrix * moved;
            matrix *= own;
            (joint.at, matrix, offset)
        } else {
            (joint.at, own, moved)
        }
    };
    joints.iter().map(map).collect()
}

/// Controls of one strand: at every joint of the groups that move it, and where anchors are.
fn strand_controls(
    groom: &HelixGroom,
    strand: usize,
    motions: &[Motion],
    direct: &[(f64, DVec3)],
) -> Vec<Control> {
    let helix = groom.strand(strand);
    if helix.elements.is_empty() {
        return Vec::new();
    }
    let moving = || motions.iter().filter(|motion| 0.0 < motion.weights[strand]);
    let mut at: Vec<f64> = moving().flat_map(|m| m.maps.iter().map(|map| map.0)).collect();
    at.extend(direct.iter().map(|anchor| anchor.0));
    at.sort_by(f64::total_cmp);
    at.dedup();
    let length = helix.length();
    let mut moved = !direct.is_empty();
    let points = points_at(groom, strand, &at);
    let control = |(&at, point): (&f64, DVec3)| {
        let shift: DVec3 = moving()
            .map(|motion| motion.weights[strand] * displacement(&motion.maps, at, point))
            .sum();
        moved |= 1e-12 * length < shift.length();
        let put =
            direct.iter().find(|anchor| anchor.0.total_cmp(&at).is_eq()).map(|anchor| anchor.1);
        Control::new(at * length, put.unwrap_or(point + shift))
    };
    let controls: Vec<Control> = at.iter().zip(points).map(control).collect();
    if moved { controls } else { Vec::new() }
}

/// How far a chain of joints moves a point of a strand: linear between joints, nothing at the root.
fn displacement(maps: &[(f64, DMat3, DVec3)], at: f64, point: DVec3) -> DVec3 {
    let shift = |&(_, matrix, offset): &(f64, DMat3, DVec3)| matrix * point + offset - point;
    let beyond = maps.partition_point(|map| map.0 < at);
    let Some(next) = maps.get(beyond) else { return maps.last().map_or(DVec3::ZERO, shift) };
    let (from, before) = match beyond.checked_sub(1).map(|before| &maps[before]) {
        Some(map) => (map.0, shift(map)),
        None => (0.0, DVec3::ZERO),
    };
    before.lerp(shift(next), (at - from) / (next.0 - from))
}
