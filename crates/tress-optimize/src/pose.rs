//! A pose: where the joints of an armature are, and how far each has been moved [CSE 5.3].
//!
//! People write it, in RON. [`armature`](crate::armature()) gives the rest pose of a groom to start
//! from; a joint's `translate`, `rotate` and `scale` are then changed, and
//! [`apply_pose`](crate::apply_pose) turns the pose into controls.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_geometry::HelixGroom;

/// Chains of joints, anchors, and the groom they are for.
///
/// ```
/// use tress_optimize::Pose;
///
/// let pose: Pose = ron::from_str("(
///     groups: [(select: Attribute(name: \"group\", value: 3), joints: [
///         (at: 1.0, center: (0, 9, 0), translate: (0, -2, 0), rotate: (0, 45, 0)),
///     ])],
///     anchors: [(strand: 0, at: 0.5, position: (1, 2, 3))],
/// )")?;
/// assert_eq!(pose.groups[0].joints[0].scale, glam::DVec3::ONE);
/// let error = ron::from_str::<Pose>("(\n groups: [],\n joint: [])").unwrap_err();
/// assert_eq!((error.span.start.line, error.span.start.col), (3, 2));
/// # Ok::<(), ron::error::SpannedError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pose {
    /// The groom that the pose was made for; nothing is compared when absent.
    pub groom: Option<Fingerprint>,
    /// How strands are shared out among clusters.
    pub clusters: Clustering,
    /// Joints do not only move the hair at them but all joints farther from the root, as bones do.
    pub chained: bool,
    /// Strands and the joints that move them. A strand in several groups is moved by the sum.
    pub groups: Vec<Group>,
    /// Points put somewhere directly, whatever groups say.
    pub anchors: Vec<PoseAnchor>,
}

/// How strands are shared out among clusters: by k-means over root and tip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Clustering {
    /// How many clusters. Default 8, fewer when there are fewer strands.
    pub count: usize,
    /// Where k-means starts. Default 0.
    pub seed: u64,
    /// How far a strand is also moved by other clusters than its own: 0 not at all, 1 already when
    /// it is about as far from theirs as strands are from their own on average. Default 0.
    pub blend: f64,
}

impl Default for Clustering {
    fn default() -> Self {
        Self { count: 8, seed: 0, blend: 0.0 }
    }
}

/// Strands and the chain of joints that moves them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Which strands.
    pub select: Select,
    /// From root to tip.
    pub joints: Vec<Joint>,
}

/// Which strands a group holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Select {
    /// Those of a cluster, from 0 on.
    Cluster(usize),
    /// Those whose attribute (its first component) has a value.
    Attribute {
        /// The strand attribute.
        name: String,
        /// Its value.
        value: f64,
    },
    /// All strands.
    All,
}

/// An oriented frame that hair hangs on, and its move.
///
/// A point `x` goes to `center + translate + R A S A^T (x - center)`, with the rotation `R`, the
/// scale `S` and the axes `A`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Where on the strands it is, in parts of their length: above 0, at most 1, ascending.
    pub at: f64,
    /// Where it is in space; what rotation and scale are about.
    pub center: DVec3,
    /// Directions that the components of `scale` act along, orthonormal. Default x, y, z.
    #[serde(default = "world_axes")]
    pub axes: [DVec3; 3],
    /// By how much it is moved.
    #[serde(default)]
    pub translate: DVec3,
    /// Turns about the world's x, then y, then z; in degrees.
    #[serde(default)]
    pub rotate: DVec3,
    /// Stretches along its axes. Default 1.
    #[serde(default = "no_scale")]
    pub scale: DVec3,
}

fn world_axes() -> [DVec3; 3] {
    DVec3::AXES
}

fn no_scale() -> DVec3 {
    DVec3::ONE
}

/// A point of a strand put somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PoseAnchor {
    /// The strand, from 0 on.
    pub strand: usize,
    /// Where on the strand, in parts of its length, 0 to 1.
    pub at: f64,
    /// Where the point should go.
    pub position: DVec3,
}

/// What a groom is known by: enough to tell grooms apart, and the same after fitting it anew with
/// other elements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fingerprint {
    /// How many strands.
    pub strands: usize,
    /// Mean of the roots.
    pub roots: DVec3,
    /// Mean of the tips.
    pub tips: DVec3,
}

/// Means may differ by this part of the distance between them: a fit of the same polylines with
/// other elements moves tips by less, another groom's lie farther.
const SAME: f64 = 0.02;

impl Fingerprint {
    /// What this groom is known by.
    #[must_use]
    pub fn of(groom: &HelixGroom) -> Self {
        let finite = |p: DVec3| if p.is_finite() { p } else { DVec3::ZERO };
        let mut sums = (DVec3::ZERO, DVec3::ZERO);
        for strand in groom.iter() {
            sums.0 += finite(strand.root.position);
            sums.1 += finite(strand.tip().position);
        }
        let n = groom.len().max(1) as f64;
        Self { strands: groom.len(), roots: sums.0 / n, tips: sums.1 / n }
    }

    /// Whether the other is, to all appearances, of the same groom.
    #[must_use]
    pub fn matches(&self, other: &Self) -> bool {
        let near = SAME * self.roots.distance(self.tips);
        self.strands == other.strands
            && self.roots.distance(other.roots) <= near
            && self.tips.distance(other.tips) <= near
    }
}
