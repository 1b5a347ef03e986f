//! How wide hair is drawn.
//!
//! A groom file holds from a hundred to a hundred thousand strands for the same head, mostly
//! without a width. Drawn at the width of real hair, a hundred guides are hardly seen; drawn as
//! wide as guides, a full head is a solid. What makes both look like hair is that the strands cover
//! the volume equally often: with `A` the mean of the areas of the bounding box's faces and `L` the
//! sum of the strands' lengths, the width
//!
//! `w = LAYERS A / L`
//!
//! makes a line of sight meet about `LAYERS` hairs.

use serde::{Deserialize, Serialize};
use tress_geometry::{Groom, names, polyline};

use crate::bounds::Bounds;
use crate::camera::Camera;
use crate::num::narrow;

/// How many hairs a line of sight through the middle of a groom should meet. Fewer let the
/// background through, more make coils too thick to be told apart.
const LAYERS: f64 = 5.0;

/// The thinnest and widest hair chosen by itself, as a share of the bounding box's diagonal: below,
/// it is a haze; above, spaghetti.
const CHOSEN: [f64; 2] = [1.0 / 5000.0, 1.0 / 400.0];

/// The widths that are believed of a file, likewise. Some carry 1 in whatever unit for "default".
const BELIEVED: [f64; 2] = [1.0 / 50000.0, 1.0 / 100.0];

/// Where a strand begins to taper, as a share of its points, and what is left at the tip.
const TAPER: [f64; 2] = [0.6, 0.35];

/// How wide hair is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum StrandWidth {
    /// By the attribute `width` where the groom has one that can be true (between 1/50,000 and
    /// 1/100 of its diagonal in the middle strand), else [`sensible_width`], tapering to the tip.
    #[default]
    Auto,
    /// So many units of the groom's length, tapering to the tip. Negative and not finite are 0.
    Fixed(f64),
}

/// A width that makes this groom look like hair, in its own unit; 0 when it has no extent.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Groom, Strands};
/// use tress_view::sensible_width;
///
/// let strand = |i: u32| [0.0, 9.0].map(|y| DVec3::new(f64::from(i % 10), y, y));
/// let hair = |n: usize| {
///     let points = (0..n as u32).flat_map(strand).collect();
///     Strands::from_counts(vec![2; n], points).map(Groom::new)
/// };
/// let (few, many) = (sensible_width(&hair(2000)?), sensible_width(&hair(8000)?));
/// assert!((few / many - 4.0).abs() < 1e-9);
/// # Ok::<(), tress_geometry::OffsetsError>(())
/// ```
#[must_use]
pub fn sensible_width(groom: &Groom) -> f64 {
    let extent = 2.0 * Bounds::of(groom).half_extent();
    let diagonal = extent.length();
    let area = (extent.x * extent.y + extent.y * extent.z + extent.z * extent.x) / 3.0;
    let length: f64 = groom.strands().iter().map(polyline::length).filter(|l| l.is_finite()).sum();
    let width = (LAYERS * area / length).clamp(CHOSEN[0] * diagonal, CHOSEN[1] * diagonal);
    if width.is_finite() { width } else { 0.0 }
}

/// Half of the width in pixels, a point of the groom.
pub(crate) fn radii(groom: &Groom, width: StrandWidth, camera: &Camera) -> Vec<f32> {
    let half = 0.5 * camera.pixels_per_unit();
    let constant = match width {
        StrandWidth::Fixed(width) => width,
        StrandWidth::Auto => match attribute(groom) {
            Some(widths) => return widths.map(|w| narrow(half * w)).collect(),
            None => sensible_width(groom),
        },
    };
    let widest = if constant.is_finite() { half * constant.max(0.0) } else { 0.0 };
    let strands = groom.strands().iter();
    strands.flat_map(|s| (0..s.len()).map(move |i| narrow(widest * taper(i, s.len())))).collect()
}

fn taper(i: usize, n: usize) -> f64 {
    let s = i as f64 / n.saturating_sub(1).max(1) as f64;
    let behind = ((s - TAPER[0]) / (1.0 - TAPER[0])).max(0.0);
    1.0 - (1.0 - TAPER[1]) * behind
}

/// The groom's own widths, a point, if they can be true.
fn attribute(groom: &Groom) -> Option<impl Iterator<Item = f64>> {
    let strands = groom.strands();
    let by_point = groom.point_attributes().get(names::WIDTH);
    let by_strand = groom.strand_attributes().get(names::WIDTH);
    let widths: Vec<f64> = match (by_point, by_strand) {
        (Some(column), _) => column.first_components().collect(),
        (None, Some(column)) => {
            let each = column.first_components().zip(strands.counts());
            each.flat_map(|(width, n)| std::iter::repeat_n(width, n)).collect()
        }
        (None, None) => return None,
    };
    let diagonal = 2.0 * Bounds::of(groom).half_extent().length();
    let mut sorted = widths.clone();
    let middle = sorted.len() / 2;
    let (_, &mut median, _) =
        (middle < sorted.len()).then(|| sorted.select_nth_unstable_by(middle, f64::total_cmp))?;
    let believed = BELIEVED[0] * diagonal <= median && median <= BELIEVED[1] * diagonal;
    let held = move |w: f64| if w.is_finite() { w.clamp(0.0, 10.0 * median) } else { 0.0 };
    believed.then(|| widths.into_iter().map(held))
}
