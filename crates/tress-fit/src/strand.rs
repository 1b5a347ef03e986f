//! One strand: from points to a super-helix.
//!
//! The work is done on points shifted to the root and scaled to size 1, so that coordinates far
//! from the origin or of any size behave alike; points that repeat their predecessor are left out
//! and get its arc length back.

use glam::DVec3;
use tress_geometry::polyline::defect;
use tress_geometry::{Element, Frame, SuperHelix, align_frame};

use crate::{Elements, FitOptions, KeptReason, Spline, direct, refined};

/// A super-helix fitted to a polyline.
#[derive(Clone, Debug, PartialEq)]
pub struct StrandFit {
    /// The frame at the root.
    pub root: Frame,
    /// The arcs from root to tip.
    pub elements: Vec<Element>,
    /// The arc length on the super-helix that each point of the polyline corresponds to;
    /// ascending.
    pub arc_lengths: Vec<f64>,
}

impl StrandFit {
    /// The super-helix.
    #[must_use]
    pub fn super_helix(&self) -> SuperHelix<'_> {
        SuperHelix { root: self.root, elements: &self.elements }
    }
}

/// Segments shorter than this part of the strand's size are rounding: their direction says
/// nothing.
const SAME_PLACE: f64 = 1e-14;

/// Sizes of strands that can be fitted: elements take fifth powers of lengths and curvatures.
const SIZES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// Fits one polyline. The options are taken as valid (see [`FitOptions::validate`]).
///
/// ```
/// use glam::DVec3;
/// use tress_fit::{FitOptions, fit_strand};
///
/// let points = [DVec3::ZERO, DVec3::X, DVec3::new(2.0, 1.0, 0.0)];
/// let fit = fit_strand(&points, &FitOptions::default())?;
/// assert_eq!((fit.elements.len(), fit.arc_lengths.len()), (2, 3));
/// assert!(fit.super_helix().tip().position.distance(points[2]) < 0.5);
/// # Ok::<(), tress_fit::KeptReason>(())
/// ```
///
/// # Errors
///
/// The reason why the polyline cannot become a super-helix; see [`KeptReason`].
pub fn fit_strand(points: &[DVec3], options: &FitOptions) -> Result<StrandFit, KeptReason> {
    if let Some(defect) = defect(points) {
        return Err(KeptReason::Defect(defect));
    }
    let strand = Normalized::new(points);
    if !SIZES.contains(&strand.size) {
        return Err(KeptReason::Size);
    }
    if strand.points.len() < 2 {
        return Err(KeptReason::Defect(tress_geometry::polyline::Defect::ZeroLength));
    }
    let spline = Spline::through(&strand.points, options.tangents);
    let fit = match (options.refine, options.elements) {
        (None, Elements::Count(n)) if direct::is_enough(&spline, n) => {
            direct::evenly(&spline, n, options.floating)
        }
        (None, Elements::PerSegment) => direct::per_segment(&spline, options.floating),
        (refine, elements) => {
            let elements = elements.scaled(strand.size);
            refined::fit(&spline, elements, options.floating, &refine.unwrap_or_default())
        }
    };
    Ok(strand.restore(fit))
}

/// A polyline of size 1 that begins at the origin, without repeated points.
struct Normalized {
    points: Vec<DVec3>,
    /// For each point that was given, its place in `points`.
    places: Vec<usize>,
    origin: DVec3,
    size: f64,
}

impl Normalized {
    /// Of a polyline without a defect.
    fn new(given: &[DVec3]) -> Self {
        let origin = given[0];
        let size = given.iter().map(|p| (*p - origin).abs().max_element()).fold(0.0, f64::max);
        let mut points: Vec<DVec3> = Vec::with_capacity(given.len());
        let mut places = Vec::with_capacity(given.len());
        for point in given {
            let point = (*point - origin) / size;
            if points.last().is_none_or(|last| SAME_PLACE < last.distance(point)) {
                points.push(point);
            }
            places.push(points.len() - 1);
        }
        Self { points, places, origin, size }
    }

    /// The fit in the units and place of the polyline given.
    fn restore(&self, fit: StrandFit) -> StrandFit {
        let scale = |element: &Element| Element {
            curvature: element.curvature / self.size,
            length: element.length * self.size,
        };
        let position = self.origin + fit.root.position * self.size;
        let mut root = Frame { position, axes: fit.root.axes };
        let mut elements: Vec<Element> = fit.elements.iter().map(scale).collect();
        // What the frame is turned to about the tangent so far was chosen by axes of the world.
        align_frame(&mut root, &mut elements);
        let mut along = 0.0;
        let arc_length = |&i: &usize| {
            // Rounding must not make a point precede the one before it.
            along = f64::max(along, fit.arc_lengths[i] * self.size);
            along
        };
        let arc_lengths = self.places.iter().map(arc_length).collect();
        StrandFit { root, elements, arc_lengths }
    }
}

#[cfg(test)]
mod tests;
