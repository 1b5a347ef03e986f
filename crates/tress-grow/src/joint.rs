//! How visible the joint of the two regions is.

use glam::DVec3;
use tress_geometry::Strands;

/// What happens to hairs where their loosely and strictly guided regions meet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointReport {
    /// Hairs that have both regions.
    pub joints: usize,
    /// The mean of the turning from segment to segment at both ends of the segment in which the
    /// regions meet.
    pub mean_turning: f64,
    /// The same at all other points of the same hairs.
    pub mean_turning_elsewhere: f64,
    /// The greatest turning at a joint, over the greatest elsewhere on its own hair.
    pub greatest_ratio: f64,
    /// The share of joints that turn more than any other point of their hair.
    pub sharpest_at_joint: f64,
}

/// Measures the angles between segments at joints, in radians, and elsewhere.
///
/// `joints` are the indices of the first points of strictly guided regions, as
/// [`Plan::joints`](crate::Plan::joints) says. Where a joint is no sharper than the rest of a
/// hair, it cannot be seen.
#[must_use]
pub fn joint_report(
    strands: &Strands<DVec3>,
    joints: impl IntoIterator<Item = usize>,
) -> JointReport {
    let mut report = JointReport::default();
    let (mut elsewhere, mut n_elsewhere, mut sharpest) = (0.0, 0_usize, 0_usize);
    for (points, joint) in strands.iter().zip(joints) {
        if joint == 0 || points.len() <= joint + 1 || points.len() < 4 {
            continue;
        }
        let turning =
            |i: usize| (points[i] - points[i - 1]).angle_between(points[i + 1] - points[i]);
        // The joint lies between the last loose point and the first strict one: either may turn.
        let pair = [turning(joint), if joint > 1 { turning(joint - 1) } else { turning(joint) }];
        let own = f64::max(pair[0], pair[1]);
        let others = (1..points.len() - 1).filter(|i| *i != joint && i + 1 != joint);
        let mut greatest = 0.0;
        for angle in others.map(turning).filter(|angle| angle.is_finite()) {
            elsewhere += angle;
            n_elsewhere += 1;
            greatest = f64::max(greatest, angle);
        }
        if !own.is_finite() || greatest <= 0.0 {
            continue;
        }
        report.joints += 1;
        report.mean_turning += 0.5 * (pair[0] + pair[1]);
        report.greatest_ratio = report.greatest_ratio.max(own / greatest);
        sharpest += usize::from(greatest < own);
    }
    let n = report.joints.max(1) as f64;
    report.mean_turning /= n;
    report.mean_turning_elsewhere = elsewhere / n_elsewhere.max(1) as f64;
    report.sharpest_at_joint = sharpest as f64 / n;
    report
}
