//! Grooms as Unreal imports them: Alembic in its groom schema 1.5, within its limits.
//!
//! Unreal takes centimetres with Y up, at most 255 points a strand (it cuts off what is beyond),
//! and in each group at most 2^22 - 1 strands and 2^24 - 1 points. [`write()`] turns and scales a
//! groom whose axis and unit are known, gives strands with more points fewer (see [`Placement`]),
//! and says how far the segments that Unreal draws are then from the hair. The version of the
//! schema stands in the user properties of the topmost transform. The module [`alembic`] has the
//! rest of the file; the parameters are
//!
//! | column | parameter | scope | type |
//! |---|---|---|---|
//! | `group` | `groom_group_id`, and `groom_group_name` as `group_ID` | uniform | `int32`, text |
//! | `guide` (1 or 0) | `groom_guide` | uniform | `int32` |
//! | `id` | `groom_id` | uniform | `int32` |
//! | `clump` | `groom_clumpid` | uniform | `int32` |
//! | `uv` | `groom_root_uv` | uniform | `float32[2]` |
//! | `closest_guides` | `groom_closest_guides` | uniform | `int32[3]` |
//! | `guide_weights` | `groom_guide_weights` | uniform | `float32[3]` |
//! | `color` | `groom_color` | vertex | `float32[3]` |
//! | `roughness`, `ao` | `groom_roughness`, `groom_ao` | vertex | `float32` |
//!
//! and every other column under its own name. Widths are those of the curves, a row a point;
//! without them Unreal would draw hair 1 cm thick, so a groom that has none gets a hair's.
//!
//! This follows Epic's documents. It was not tried in Unreal itself.

mod place;

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use tress_geometry::{Column, Groom, Strands, UpAxis, names};

use crate::alembic::{self, writer::Names};
use crate::columns::Rows;
use crate::write::whole;
use crate::{EncodeError, WriteError};

/// Metres in Unreal's unit.
const CENTIMETRE: f64 = 0.01;
/// The most strands of a group.
const MOST_STRANDS: usize = (1 << 22) - 1;
/// The most points of a group.
const MOST_POINTS: usize = (1 << 24) - 1;

/// Where a strand of too many points gets its fewer ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Placement {
    /// Closer where it bends more, and at bends a little outside of it, so that the segments are
    /// inside of it as far as their ends are outside.
    #[default]
    Curvature,
    /// On it, evenly by arc length: what tools do that know nothing of hair. For comparison.
    Uniform,
}

/// How a groom is made fit for Unreal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct UnrealOptions {
    /// Points that a strand may have, at least 2. Default 255.
    pub most_points: usize,
    /// Where they are put.
    pub placement: Placement,
}

impl Default for UnrealOptions {
    fn default() -> Self {
        Self { most_points: 255, placement: Placement::Curvature }
    }
}

/// What became of a groom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnrealReport {
    /// Strands that had too many points.
    pub resampled: usize,
    /// The most points that a strand had.
    pub most_points: usize,
    /// For each strand the greatest distance of the hair, a Catmull-Rom curve through the points
    /// given, from the segments between the points written; 0 for a strand whose points are kept.
    /// In centimetres, or in the groom's own unit where that is unknown.
    pub errors: Vec<f64>,
    /// Whether the unit was unknown, so that numbers are taken for centimetres.
    pub unit_is_assumed: bool,
}

impl UnrealReport {
    /// The greatest error of all strands.
    #[must_use]
    pub fn greatest_error(&self) -> f64 {
        self.errors.iter().copied().fold(0.0, f64::max)
    }
}

/// Writes a groom to an `.abc` file for Unreal.
///
/// # Errors
///
/// If a group has more strands or points than Unreal takes, a number does not fit its parameter, or
/// the disk does not take the file; what was there before is then as it was.
pub fn write(
    path: impl AsRef<Path>,
    groom: &Groom,
    options: &UnrealOptions,
) -> Result<UnrealReport, WriteError> {
    let path = path.as_ref();
    let (fit, report) = prepare(groom, options);
    whole(path, |out| {
        check_groups(&fit)?;
        alembic::write_as(Names::Unreal, &fit, out)
    })?;
    Ok(report)
}

/// The groom in centimetres, with Y up, and with no more points a strand than asked for.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Groom, Strands};
/// use tress_io::unreal::{UnrealOptions, prepare};
///
/// // A coil of 30 turns, 20 points each, of radius 5 mm.
/// let coil = (0..=600).map(|i| {
///     let angle = f64::from(i) * std::f64::consts::TAU / 20.0;
///     DVec3::new(0.005 * angle.cos(), 0.0005 * angle, 0.005 * angle.sin())
/// });
/// let groom = Groom::new(Strands::from_counts([601], coil.collect())?);
/// let groom = groom.in_space(Some(1.0), None);
/// let (fit, report) = prepare(&groom, &UnrealOptions::default());
/// assert_eq!((fit.unit, fit.strands().points().len()), (Some(0.01), 255));
/// // Less than 4 % of the radius, 0.5 cm.
/// assert!(report.greatest_error() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn prepare(groom: &Groom, options: &UnrealOptions) -> (Groom, UnrealReport) {
    let groom = in_centimetres(groom);
    let mut report = UnrealReport {
        unit_is_assumed: groom.unit.is_none(),
        most_points: groom.strands().counts().max().unwrap_or(0),
        ..UnrealReport::default()
    };
    let most = options.most_points.max(2);
    if report.most_points <= most {
        report.errors = vec![0.0; groom.strands().len()];
        return (groom, report);
    }
    let mut strands = Strands::default();
    let mut rows = Vec::new();
    for (i, points) in groom.strands().iter().enumerate() {
        let first = groom.strands().range(i).start;
        let placed = if points.len() <= most {
            place::all(points)
        } else {
            report.resampled += 1;
            place::fewer(points, most, options.placement)
        };
        report.errors.push(placed.error);
        rows.extend(placed.rows.iter().map(|(row, between)| (first + row, *between)));
        // No more points than fitted before.
        let pushed = strands.push(placed.points);
        debug_assert!(pushed.is_ok(), "fewer points than there were");
    }
    (with_rows(&groom, strands, &rows), report)
}

/// The groom in Unreal's unit and with its axis up, where its own are known.
fn in_centimetres(groom: &Groom) -> Groom {
    let mut groom = groom.clone().with_up(UpAxis::Y);
    let Some(scale) = groom.unit.map(|metres| metres / CENTIMETRE) else { return groom };
    groom.unit = Some(CENTIMETRE);
    if (scale - 1.0).abs() < f64::EPSILON {
        return groom;
    }
    groom.positions_mut().iter_mut().for_each(|point| *point *= scale);
    let scaled = |column: &Column| match column {
        Column::Float { components: 1, values } => {
            Some(Column::scalar(values.iter().map(|width| width * scale).collect()))
        }
        _ => None,
    };
    // As many rows as before.
    if let Some(widths) = groom.point_attributes().get(names::WIDTH).and_then(scaled) {
        let _ = groom.insert_point_attribute(names::WIDTH, widths);
    }
    if let Some(widths) = groom.strand_attributes().get(names::WIDTH).and_then(scaled) {
        let _ = groom.insert_strand_attribute(names::WIDTH, widths);
    }
    groom
}

/// Strands in place of those of the groom, points taking their attributes from rows of its own.
fn with_rows(groom: &Groom, strands: Strands<DVec3>, rows: &[(usize, f64)]) -> Groom {
    let points =
        groom.point_attributes().map(rows.len(), |column| column.interpolate(rows.iter().copied()));
    let kept = groom.strand_attributes().clone();
    match Groom::with_attributes(strands, points, kept) {
        Ok(fit) => fit.in_space(groom.unit, groom.up),
        Err(_) => groom.clone(),
    }
}

fn check_groups(groom: &Groom) -> Result<(), EncodeError> {
    let groups: Vec<u64> = match Rows::of_strands(groom, names::GROUP, 1) {
        Some(rows) => rows.iter().map(f64::to_bits).collect(),
        None => vec![0; groom.strands().len()],
    };
    let mut sizes: BTreeMap<u64, (usize, usize)> = BTreeMap::new();
    for (group, count) in groups.iter().zip(groom.strands().counts()) {
        let (strands, points) = sizes.entry(*group).or_default();
        (*strands, *points) = (*strands + 1, *points + count);
    }
    for (group, (strands, points)) in sizes {
        let group = f64::from_bits(group);
        for (n, most, what) in [(strands, MOST_STRANDS, "strands"), (points, MOST_POINTS, "points")]
        {
            if most < n {
                let message = format!("group {group} has {n} {what}, Unreal takes at most {most}");
                return Err(EncodeError::Groom(message));
            }
        }
    }
    Ok(())
}
