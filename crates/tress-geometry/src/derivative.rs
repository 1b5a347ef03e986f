//! Derivatives of the chain by its curvatures, without tables.
//!
//! Let `L = V(q,l)` and `D = d(V e0)/dq` of an element (see its module). When `q_j` changes, the
//! frame behind element `j` turns by the world vector `F_j L_j dq_j` about the joint `p_{j+1}`, and
//! all that lies beyond goes with it, as with a robot's arm:
//!
//! - `dS(lambda)/dq_j = F_j D_j - [S(lambda) - p_{j+1}]x F_j L_j` where element `j` lies wholly
//!   before `lambda`,
//! - `dS(lambda)/dq_i = F_i D(q_i, s)` for the element `i` that holds `lambda`.
//!
//! That is `O(N M)` for `M` points on `N` elements, where [CSE 17-26] and Algorithms 1-2 fill
//! `O(N^2)` tables. The product `J^T r` needs no Jacobian at all: with `f` the sum of the `r_k`
//! beyond element `j` and `m` the sum of `S_k x r_k`, one sweep from the tip gives
//!
//! `g_j = D_j^T F_j^T f + L_j^T F_j^T (m - p_{j+1} x f)`, in `O(N + M)`.

use glam::{DMat3, DVec3};

use crate::{Frame, SuperHelix};

/// Memory that derivatives work in; keep one and hand it in again, and nothing is allocated.
#[derive(Clone, Debug, Default)]
pub struct ChainScratch {
    /// Frames at the joints, one more than elements.
    joints: Vec<Frame>,
    /// For each point: its element, the arc length on it, and its position.
    points: Vec<(usize, f64, DVec3)>,
}

impl ChainScratch {
    /// Positions of the points of the last call, in the order given.
    pub fn positions(&self) -> impl Iterator<Item = DVec3> {
        self.points.iter().map(|&(_, _, position)| position)
    }

    /// Walks the strand once; `arc_lengths` ascend and are held within the strand.
    fn locate(&mut self, strand: &SuperHelix<'_>, arc_lengths: impl Iterator<Item = f64>) {
        self.joints.clear();
        self.joints.extend(strand.joints());
        self.points.clear();
        let (mut index, mut begins) = (0, 0.0);
        for s in arc_lengths {
            while index + 1 < strand.elements.len() && begins + strand.elements[index].length < s {
                begins += strand.elements[index].length;
                index += 1;
            }
            let Some(element) = strand.elements.get(index) else {
                self.points.push((0, 0.0, strand.root.position));
                continue;
            };
            let local = (s - begins).min(element.length).max(0.0);
            let base = &self.joints[index];
            let position = base.position + base.axes * element.displacement(local);
            self.points.push((index, local, position));
        }
    }
}

/// `dS/dq` at ascending `arc_lengths`: fills `blocks[k * N + j]` with the 3 x 3 derivative of point
/// `k` by the curvatures of element `j`, and zeros where an element lies beyond the point.
///
/// # Panics
///
/// If `blocks` does not hold one block for each pair of a point and an element.
///
/// ```
/// use glam::{DMat3, DVec3};
/// use tress_geometry::{ChainScratch, Element, Frame, SuperHelix, jacobian};
///
/// // A straight element of length 2: bending about v moves the tip along u by s^2 / 2.
/// let elements = [Element { curvature: DVec3::ZERO, length: 2.0 }];
/// let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
/// let mut blocks = [DMat3::ZERO];
/// jacobian(&strand, &[2.0], &mut ChainScratch::default(), &mut blocks);
/// assert_eq!(blocks[0].z_axis, DVec3::new(0.0, 2.0, 0.0));
/// ```
pub fn jacobian(
    strand: &SuperHelix<'_>,
    arc_lengths: &[f64],
    scratch: &mut ChainScratch,
    blocks: &mut [DMat3],
) {
    let n_elements = strand.elements.len();
    assert_eq!(blocks.len(), n_elements * arc_lengths.len(), "one block a point and element");
    scratch.locate(strand, arc_lengths.iter().copied());
    blocks.fill(DMat3::ZERO);
    for (j, element) in strand.elements.iter().enumerate() {
        let base = &scratch.joints[j];
        let joint = scratch.joints[j + 1].position;
        let (turning, moving) = element.derivatives(element.length);
        let (turning, moving) = (base.axes * turning, base.axes * moving);
        for (k, &(index, local, position)) in scratch.points.iter().enumerate() {
            if j < index {
                blocks[k * n_elements + j] = moving - cross_columns(position - joint, &turning);
            } else if j == index {
                blocks[k * n_elements + j] = base.axes * element.derivatives(local).1;
            }
        }
    }
}

/// `J^T r`: the gradient by all curvatures of `sum_k r_k . S(lambda_k)`, in one sweep.
///
/// `loads` yields `lambda_k` ascending; `residual` is told each point's index and position and
/// answers with `r_k`. For `sum_k |S(lambda_k) - a_k|^2` answer `2 (S - a_k)`.
///
/// # Panics
///
/// If `gradient` does not hold one vector an element.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{ChainScratch, Element, Frame, SuperHelix, adjoint};
///
/// let elements = [Element { curvature: DVec3::ZERO, length: 2.0 }];
/// let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
/// let mut gradient = [DVec3::ZERO];
/// adjoint(&strand, &[2.0], |_, _| DVec3::Y, &mut ChainScratch::default(), &mut gradient);
/// assert_eq!(gradient[0], DVec3::new(0.0, 0.0, 2.0));
/// ```
pub fn adjoint(
    strand: &SuperHelix<'_>,
    arc_lengths: &[f64],
    mut residual: impl FnMut(usize, DVec3) -> DVec3,
    scratch: &mut ChainScratch,
    gradient: &mut [DVec3],
) {
    assert_eq!(gradient.len(), strand.elements.len(), "one gradient an element");
    scratch.locate(strand, arc_lengths.iter().copied());
    let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
    let mut left = scratch.points.len();
    for (j, element) in strand.elements.iter().enumerate().rev() {
        let base = &scratch.joints[j];
        let into_body = base.axes.transpose();
        let joint = scratch.joints[j + 1].position;
        let (turning, moving) = element.derivatives(element.length);
        let torque = into_body * (moment - joint.cross(force));
        let mut sum = moving.transpose() * (into_body * force) + turning.transpose() * torque;
        while 0 < left && scratch.points[left - 1].0 == j {
            left -= 1;
            let (_, local, position) = scratch.points[left];
            let r = residual(left, position);
            sum += element.derivatives(local).1.transpose() * (into_body * r);
            force += r;
            moment += position.cross(r);
        }
        gradient[j] = sum;
    }
}

/// `[a]x M`.
fn cross_columns(a: DVec3, m: &DMat3) -> DMat3 {
    DMat3::from_cols(a.cross(m.x_axis), a.cross(m.y_axis), a.cross(m.z_axis))
}

#[cfg(test)]
mod tests;
