//! Where on a chain a point is nearest.

use glam::DVec3;
use tress_geometry::{Element, Frame};

/// The nearest place to a point on a chain, not before `floor`, and the square of its distance.
pub(super) fn slide(
    joints: &[Frame],
    elements: &[Element],
    point: DVec3,
    start: (usize, f64),
    floor: (usize, f64),
) -> ((usize, f64), f64) {
    let (mut i, mut s) = start;
    let mut square = f64::INFINITY;
    for _ in 0..SLIDES {
        while elements[i].length < s && i + 1 < elements.len() {
            s -= elements[i].length;
            i += 1;
        }
        while s < 0.0 && 0 < i {
            i -= 1;
            s += elements[i].length;
        }
        if (i, s) < floor {
            (i, s) = floor;
        }
        s = s.max(0.0).min(elements[i].length);
        let frame = elements[i].frame_at(&joints[i], s);
        let q = elements[i].curvature;
        let off = frame.axes.transpose() * (frame.position - point);
        // (r - p) . t = 0, with t' = F (q x e0).
        let step = off.x / (1.0 + off.y * q.z - off.z * q.y).max(0.3);
        square = off.y * off.y + off.z * off.z;
        s -= step;
        if step.abs() <= SLID * elements[i].length {
            break;
        }
    }
    ((i, s.max(0.0).min(elements[i].length)), square)
}

/// Newton steps a point slides at most; the next step of the refinement goes on from there.
const SLIDES: usize = 4;

/// A point has slid when it is this part of its element's length from its place.
const SLID: f64 = 1e-2;
