//! Frames along a polyline that do not turn about it.
//!
//! Frames are carried from point to point by double reflection ([`Frame::reflected_to`]).

use glam::DVec3;
use tress_geometry::Frame;

/// A frame at each point, tangents along the polyline, moved on with no turn about it.
///
/// Tangents are central differences; where neighbours stand in one place, the tangent before is
/// kept. A polyline that goes nowhere has its frames along x.
///
/// ```
/// use glam::DVec3;
/// use tress_fit::rotation_minimizing_frames;
///
/// // In a plane, what stands across it goes on standing across it.
/// let arc = [0.0, 0.5, 1.0, 1.5].map(|a: f64| DVec3::new(a.cos(), a.sin(), 0.0));
/// let frames = rotation_minimizing_frames(&arc);
/// let first = frames[0].axes.transpose() * DVec3::Z;
/// assert!(frames.iter().all(|f| (f.axes * first).distance(DVec3::Z) < 1e-12));
/// ```
#[must_use]
pub fn rotation_minimizing_frames(points: &[DVec3]) -> Vec<Frame> {
    let first = (0..points.len()).find_map(|i| tangent(points, i)).unwrap_or(DVec3::X);
    let first = Frame::along(DVec3::ZERO, first).unwrap_or(Frame::IDENTITY);
    rotation_minimizing_frames_from(points, &first)
}

/// [`rotation_minimizing_frames`] of which the first is `first`, turned to the polyline's own first
/// tangent by the least rotation: frames that a polyline keeps while it moves.
///
/// ```
/// use glam::DVec3;
/// use tress_fit::rotation_minimizing_frames_from;
/// use tress_geometry::Frame;
///
/// let frames = rotation_minimizing_frames_from(&[DVec3::ZERO, DVec3::Y], &Frame::IDENTITY);
/// assert_eq!(frames[1].tangent(), DVec3::Y);
/// assert_eq!(frames[1].axes.z_axis, DVec3::Z);
/// ```
#[must_use]
pub fn rotation_minimizing_frames_from(points: &[DVec3], first: &Frame) -> Vec<Frame> {
    let mut frames: Vec<Frame> = Vec::with_capacity(points.len());
    let start = (0..points.len()).find_map(|i| tangent(points, i)).unwrap_or(first.tangent());
    for (i, &position) in points.iter().enumerate() {
        let next = match frames.last() {
            None => Frame { position, ..first.turned_to(start) },
            Some(before) => {
                let t = tangent(points, i).unwrap_or(before.tangent());
                before.reflected_to(position, t)
            }
        };
        frames.push(next);
    }
    frames
}

/// The unit tangent at point `i` of a polyline, if its neighbours stand apart.
fn tangent(points: &[DVec3], i: usize) -> Option<DVec3> {
    let last = points.len() - 1;
    let slope = match i {
        _ if last < 2 => points[last] - points[0],
        // The parabola through the three points at the end.
        0 => 4.0 * points[1] - 3.0 * points[0] - points[2],
        i if i == last => 3.0 * points[i] - 4.0 * points[i - 1] + points[i - 2],
        i => points[i + 1] - points[i - 1],
    };
    slope.try_normalize()
}
