//! Frames along a polyline that do not turn about it.
//!
//! The double reflection method of Wang, Juettler, Zheng and Liu, "Computation of rotation
//! minimizing frames", ACM TOG 27(1), 2008: the frame at a point is reflected in the plane between
//! it and the next, and again so that its tangent becomes the next point's. The error of the
//! frame's turn about the line is of fourth order in the step.

use glam::{DMat3, DVec3};
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
    let mut frames: Vec<Frame> = Vec::with_capacity(points.len());
    let first = (0..points.len()).find_map(|i| tangent(points, i)).unwrap_or(DVec3::X);
    for (i, &position) in points.iter().enumerate() {
        let next = match frames.last() {
            None => Frame::along(position, first).unwrap_or(Frame { position, ..Frame::IDENTITY }),
            Some(before) => {
                let t = tangent(points, i).unwrap_or(before.tangent());
                reflected(before, position, t)
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

/// The frame carried to `position` and unit tangent `t` by two reflections.
fn reflected(before: &Frame, position: DVec3, t: DVec3) -> Frame {
    let mirror = |a: DVec3, n: DVec3| {
        let square = n.length_squared();
        if square > 0.0 { a - n * (2.0 * n.dot(a) / square) } else { a }
    };
    let across = position - before.position;
    let (u, along) = (mirror(before.axes.y_axis, across), mirror(before.tangent(), across));
    let u = mirror(u, t - along);
    let Some(u) = (u - t * t.dot(u)).try_normalize() else {
        let turned = before.turned_to(t);
        return Frame { position, axes: turned.axes };
    };
    Frame { position, axes: DMat3::from_cols(t, u, t.cross(u)) }
}
