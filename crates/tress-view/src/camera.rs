//! Where a groom is seen from: an orthographic camera that can be kept for several pictures.
//!
//! A point `p` of the groom is seen at
//!
//! `(x, y, z) = (w/2, h/2, 0) + m A (p - c)`,
//!
//! where `c` is the centre of what is seen, `m` the pixels in a unit of length and the rows of the
//! rotation `A` point to the right, down and away from the viewer. `x` and `y` are pixels from the
//! upper left corner, `z` is depth in pixels too, so that lengths keep their proportions in all
//! three directions. There is no perspective: a millimetre is as long at the nape as at the brow,
//! and pictures can be measured.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};
use tress_geometry::UpAxis;

use crate::bounds::Bounds;

/// A side from which a groom is looked at.
///
/// Named for a head that faces the positive z axis where y is up, and the negative y axis where z
/// is up, which are the same head in the two conventions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum View {
    /// Into the face.
    #[default]
    Front,
    /// At the head's left ear: the face looks to the left of the picture.
    Side,
    /// At the back of the head.
    Back,
    /// From above, the face towards the lower edge of the picture.
    Top,
    /// From the front, walked 35 degrees to the head's left and 15 degrees up.
    ThreeQuarter,
}

impl View {
    /// Every view, in the order of the variants.
    pub const ALL: [Self; 5] = [Self::Front, Self::Side, Self::Back, Self::Top, Self::ThreeQuarter];

    /// Azimuth and elevation of the viewer in degrees; azimuth 0 is in front of the face.
    fn angles(self) -> (f64, f64) {
        match self {
            Self::Front => (0.0, 0.0),
            Self::Side => (90.0, 0.0),
            Self::Back => (180.0, 0.0),
            Self::Top => (0.0, 90.0),
            Self::ThreeQuarter => (35.0, 15.0),
        }
    }

    /// The rotation whose rows are right, down and away from the viewer.
    fn axes(self, up: UpAxis) -> DMat3 {
        let (azimuth, elevation) = self.angles();
        let (sin_a, cos_a) = azimuth.to_radians().sin_cos();
        let (sin_e, cos_e) = elevation.to_radians().sin_cos();
        let towards_viewer = DVec3::new(sin_a * cos_e, sin_e, cos_a * cos_e);
        let right = DVec3::new(cos_a, 0.0, -sin_a);
        let rows = [right, right.cross(towards_viewer), -towards_viewer];
        let turned = match up {
            UpAxis::Y => rows,
            UpAxis::Z => rows.map(|row| DVec3::new(row.x, -row.z, row.y)),
        };
        DMat3::from_cols_array_2d(&turned.map(|row| row.to_array())).transpose()
    }
}

/// Pixels of a picture, across and down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Size {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl Size {
    /// A size of `width` by `height` pixels.
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }
}

/// An orthographic camera; see the formula above this module.
///
/// Two grooms drawn by the same camera can be laid over each other.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::UpAxis;
/// use tress_view::{Camera, Size, View};
///
/// let points = [DVec3::ZERO, DVec3::splat(2.0)];
/// let camera = Camera::fit(points, UpAxis::Y, View::Front, Size::new(200, 100), 0.1);
/// // 80 of 100 pixels are left for the two units, and y points down in a picture.
/// assert_eq!(camera.pixels_per_unit(), 40.0);
/// let seen = camera.project(DVec3::new(1.0, 2.0, 1.0));
/// assert!(seen.distance(DVec3::new(100.0, 10.0, 0.0)) < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    // Invariant: `axes` is a rotation, `center` is finite, `scale` is positive and finite.
    axes: DMat3,
    center: DVec3,
    scale: f64,
    size: Size,
}

impl Camera {
    /// A camera that sees all points that are finite, from `view`, with `margin` (a share of the
    /// picture's shorter side, held to 0 to 0.45) left free on all sides.
    ///
    /// Points without extent are seen at one pixel a unit. For several grooms in one frame, chain
    /// their points.
    #[must_use]
    pub fn fit(
        points: impl IntoIterator<Item = DVec3>,
        up: UpAxis,
        view: View,
        size: Size,
        margin: f64,
    ) -> Self {
        let axes = view.axes(up);
        let seen = Bounds::around(points.into_iter().map(|point| axes * point));
        let reach = seen.half_extent();
        let (w, h) = (f64::from(size.width), f64::from(size.height));
        let margin = if margin.is_finite() { margin.clamp(0.0, 0.45) } else { 0.0 };
        let free = w.min(h) * margin;
        let fits = |pixels: f64, reach: f64| (0.5 * pixels - free) / reach;
        let scale = fits(w, reach.x).min(fits(h, reach.y));
        let scale = if scale.is_normal() && 0.0 < scale { scale } else { 1.0 };
        Self { axes, center: axes.transpose() * seen.center(), scale, size }
    }

    /// Where a point is seen: pixels right of and below the upper left corner, and depth in
    /// pixels behind the centre of what is seen.
    #[must_use]
    pub fn project(&self, point: DVec3) -> DVec3 {
        let seen = self.axes * (point - self.center) * self.scale;
        let middle = DVec3::new(f64::from(self.size.width), f64::from(self.size.height), 0.0);
        seen + 0.5 * middle
    }

    /// Pixels in one unit of the groom's length.
    #[must_use]
    pub fn pixels_per_unit(&self) -> f64 {
        self.scale
    }

    /// The picture's size.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point right of, above and before the centre of a head that faces z, y up.
    const P: DVec3 = DVec3::new(1.0, 2.0, 4.0);

    fn camera(view: View, up: UpAxis) -> Camera {
        Camera::fit([P, -P], up, view, Size::new(8, 8), 0.0)
    }

    /// Right, up and towards the viewer, in units.
    fn seen(view: View, up: UpAxis, p: DVec3) -> DVec3 {
        let camera = camera(view, up);
        let seen = (camera.project(p) - DVec3::new(4.0, 4.0, 0.0)) / camera.pixels_per_unit();
        DVec3::new(seen.x, -seen.y, -seen.z)
    }

    #[test]
    fn views_look_along_the_axis_they_name() {
        for (view, expected) in [
            (View::Front, DVec3::new(1.0, 2.0, 4.0)),
            (View::Side, DVec3::new(-4.0, 2.0, 1.0)),
            (View::Back, DVec3::new(-1.0, 2.0, -4.0)),
            (View::Top, DVec3::new(1.0, -4.0, 2.0)),
        ] {
            let got = seen(view, UpAxis::Y, P);
            assert!(got.distance(expected) < 1e-12, "{view:?}: {got}");
        }
        let quarter = seen(View::ThreeQuarter, UpAxis::Y, DVec3::X);
        assert!(0.5 < quarter.x && 0.5 < quarter.z, "the head's left comes nearer: {quarter}");
    }

    #[test]
    fn the_same_head_looks_the_same_whichever_axis_is_up() {
        let z_up = DVec3::new(P.x, -P.z, P.y);
        for view in View::ALL {
            let (a, b) = (seen(view, UpAxis::Y, P), seen(view, UpAxis::Z, z_up));
            assert!(a.distance(b) < 1e-12, "{view:?}: {a} and {b}");
        }
    }

    #[test]
    fn every_view_is_a_rotation() {
        for view in View::ALL {
            let a = view.axes(UpAxis::Y);
            assert!((a.determinant() - 1.0).abs() < 1e-12);
            assert!((a * a.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-12));
        }
    }

    #[test]
    fn all_points_are_seen_and_the_margin_is_free() {
        let points = [P, DVec3::new(-3.0, 1.0, 0.5), DVec3::NAN, DVec3::new(9.0, -2.0, 7.0)];
        for view in View::ALL {
            let camera = Camera::fit(points, UpAxis::Z, view, Size::new(300, 200), 0.05);
            let seen = Bounds::around(points.map(|point| camera.project(point)));
            let (left, top) = (seen.min.x, seen.min.y);
            assert!((left.min(top) - 10.0).abs() < 1e-9, "{view:?}: {left} {top}");
            let (right, bottom) = (300.0 - seen.max.x, 200.0 - seen.max.y);
            assert!((left - right).abs() < 1e-9 && (top - bottom).abs() < 1e-9);
        }
    }

    #[test]
    fn points_without_extent_and_points_as_far_as_numbers_reach_give_a_camera() {
        let cases: [&[DVec3]; 5] = [
            &[],
            &[DVec3::ONE],
            &[DVec3::NAN, DVec3::INFINITY],
            &[DVec3::MIN, DVec3::MAX],
            &[DVec3::ZERO, DVec3::splat(1e-320)],
        ];
        for points in cases {
            let points = points.iter().copied();
            let camera = Camera::fit(points, UpAxis::Y, View::Side, Size::new(10, 10), f64::NAN);
            assert!(camera.project(DVec3::ONE).is_finite());
            assert!(0.0 < camera.pixels_per_unit() && camera.pixels_per_unit().is_finite());
        }
    }
}
