//! Wisps: the neighbours that a hair's field already knows [GH 3.3].
//!
//! A wisp is traced from roots spread evenly over a disc about the guide's root, across its
//! tangent. What the hairs do then is the field's: they run along with the guide, fan out with
//! `kN` above 0, run together below.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::{Attributes, Column, Groom, Strands, names};

use crate::random::hair_rng;
use crate::waviness::{Waviness, perturb};
use crate::{HelicoidGroom, PHelicoid, SampleError, TraceError, Tracing};

/// What a wisp looks like.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WispOptions {
    /// Hairs of a wisp, the guide first. Default 256, as in the figures of \[GH\].
    pub hairs: usize,
    /// Radius of the disc of roots, in the groom's unit. Default 0.05.
    pub radius: f64,
    /// Standard deviation of each hair's turn about its root, in radians. Default 0.
    pub fanning: f64,
    /// Standard deviation of each segment's turn, in radians. Default 0.
    pub frizz: f64,
    /// Factors of the distance from the guide, evenly from root to tip, linear between. None leaves
    /// the distance to the field, which is the default.
    pub profile: Vec<f64>,
    /// Waves about every hair. Default none.
    pub waviness: Waviness,
    /// Points of each hair. Default 40.
    pub points: usize,
}

impl Default for WispOptions {
    fn default() -> Self {
        Self {
            hairs: 256,
            radius: 0.05,
            fanning: 0.0,
            frizz: 0.0,
            profile: Vec::new(),
            waviness: Waviness::default(),
            points: 40,
        }
    }
}

/// Why there is no wisp.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WispError {
    /// A number outside its range.
    ///
    /// ```
    /// use tress_geometry::Strands;
    /// use tress_helicoid::{HelicoidGroom, Tracing, WispError, WispOptions, wisps};
    ///
    /// let options = WispOptions { radius: -1.0, ..WispOptions::default() };
    /// let none = HelicoidGroom::new(vec![], Strands::default())?;
    /// let error = wisps(&none, &options, Tracing::default(), 0).unwrap_err();
    /// assert_eq!(error, WispError::Range { name: "radius", value: -1.0 });
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[error("{name} is {value}, expected at least 0")]
    Range {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Wisps that are to have no hair at all.
    ///
    /// ```
    /// use tress_geometry::Strands;
    /// use tress_helicoid::{HelicoidGroom, Tracing, WispError, WispOptions, wisps};
    ///
    /// let options = WispOptions { hairs: 0, ..WispOptions::default() };
    /// let none = HelicoidGroom::new(vec![], Strands::default())?;
    /// assert_eq!(wisps(&none, &options, Tracing::default(), 0), Err(WispError::NoHair));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[error("0 hairs a wisp, expected at least 1, the guide")]
    NoHair,
    /// Guides that cannot be traced, or too many points.
    #[error(transparent)]
    Sample(#[from] SampleError),
}

impl WispOptions {
    fn validate(&self) -> Result<(), WispError> {
        let numbers = [
            ("radius", self.radius),
            ("fanning", self.fanning),
            ("frizz", self.frizz),
            ("amplitude", self.waviness.amplitude),
            ("fade_in", self.waviness.fade_in),
            ("frequency", self.waviness.frequency.abs()),
        ];
        let factors = self.profile.iter().map(|&factor| ("profile", factor));
        let bad = |&(_, value): &(&str, f64)| !(0.0 <= value && value.is_finite());
        if let Some((name, value)) = numbers.into_iter().chain(factors).find(bad) {
            return Err(WispError::Range { name, value });
        }
        if self.hairs == 0 {
            return Err(WispError::NoHair);
        }
        if self.points < 2 {
            return Err(SampleError::Points(self.points).into());
        }
        Ok(())
    }

    /// The factor of the distance from the guide at the part `t` of the length.
    fn factor(&self, t: f64) -> f64 {
        let Some(last) = self.profile.len().checked_sub(1) else { return 1.0 };
        let place = t.clamp(0.0, 1.0) * last as f64;
        #[expect(clippy::cast_possible_truncation, reason = "within the profile")]
        let i = (place as usize).min(last);
        let (a, b) = (self.profile[i], self.profile[(i + 1).min(last)]);
        a + (b - a) * (place - i as f64)
    }
}

/// Offsets that run into a singular line are halved as often as this, then given up.
const HALVINGS: usize = 6;

/// The wisp of one hair.
///
/// Of a neighbour whose line of flow is singular the root is moved towards the guide's until it is
/// not.
///
/// ```
/// use rand::SeedableRng;
/// use tress_geometry::Frame;
/// use tress_helicoid::{Helicoid, PHelicoid, Piece, Tracing, WispOptions, wisp};
///
/// // Positive kN fans out.
/// let pieces = [Piece { k: Helicoid::new(0.5, 1.0, 0.0, 0.0), length: 2.0 }];
/// let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
/// let options = WispOptions { hairs: 30, radius: 0.1, ..WispOptions::default() };
/// let rng = &mut rand_pcg::Pcg64Mcg::seed_from_u64(1);
/// let strands = wisp(&hair, &options, Tracing::default(), rng)?;
/// let spread = |i: usize| {
///     strands.iter().map(|hair| hair[i].distance(strands.strand(0)[i])).fold(0.0, f64::max)
/// };
/// assert!(spread(0) <= 0.1 && 0.15 < spread(39));
/// # Ok::<(), tress_helicoid::WispError>(())
/// ```
///
/// # Errors
///
/// See [`WispError`].
pub fn wisp(
    hair: &PHelicoid<'_>,
    options: &WispOptions,
    tracing: Tracing,
    rng: &mut impl Rng,
) -> Result<Strands<DVec3>, WispError> {
    options.validate()?;
    let traced = |source| SampleError::Trace { strand: 0, source };
    let lines = lines(hair, options, tracing, rng).map_err(traced)?;
    let points = lines.concat();
    let strands = Strands::from_counts(vec![options.points; lines.len()], points);
    Ok(strands.map_err(SampleError::from)?)
}

/// The wisps of all hairs; the strands of one have its number as their group. Strands that are no
/// helicoids are left out.
///
/// # Errors
///
/// See [`WispError`].
pub fn wisps(
    hairs: &HelicoidGroom,
    options: &WispOptions,
    tracing: Tracing,
    seed: u64,
) -> Result<Groom, WispError> {
    options.validate()?;
    let guides: Vec<usize> =
        (0..hairs.len()).filter(|&i| !hairs.hair(i).pieces.is_empty()).collect();
    let total = guides.len().saturating_mul(options.hairs).saturating_mul(options.points);
    if u32::try_from(total).is_err() {
        return Err(
            SampleError::from(tress_geometry::OffsetsError::TooMany { points: total }).into()
        );
    }
    let parts: Vec<Result<Vec<Vec<DVec3>>, TraceError>> = guides
        .par_iter()
        .map(|&i| lines(&hairs.hair(i), options, tracing, &mut hair_rng(seed, i)))
        .collect();
    let mut strands = Strands::default();
    let mut groups = Vec::with_capacity(guides.len() * options.hairs);
    for (&strand, part) in guides.iter().zip(parts) {
        for line in part.map_err(|source| SampleError::Trace { strand, source })? {
            strands.push(line).map_err(SampleError::from)?;
            groups.push(i64::try_from(strand).unwrap_or(i64::MAX));
        }
    }
    let points = Attributes::new(strands.points().len());
    let mut table = Attributes::new(strands.len());
    table.insert(names::GROUP, Column::Int(groups)).expect("a group was pushed with every strand");
    let groom = Groom::with_attributes(strands, points, table);
    Ok(groom.expect("a row a strand was made").in_space(hairs.unit, hairs.up))
}

/// The hairs of one wisp, the guide first.
fn lines(
    hair: &PHelicoid<'_>,
    options: &WispOptions,
    tracing: Tracing,
    rng: &mut impl Rng,
) -> Result<Vec<Vec<DVec3>>, TraceError> {
    let last = (options.points - 1) as f64;
    let length = hair.length();
    let stops: Vec<f64> = (0..options.points).map(|i| length * (i as f64 / last)).collect();
    let frames = hair.frames_at(&stops, tracing)?;
    let mut lines = Vec::with_capacity(options.hairs);
    for i in 0..options.hairs {
        let (angle, spread) = (TAU * rng.random::<f64>(), rng.random::<f64>().sqrt());
        let radius = if i == 0 { 0.0 } else { options.radius * spread };
        let offset = radius * DVec3::new(0.0, angle.cos(), angle.sin());
        let mut line: Vec<DVec3> = frames.iter().map(|frame| frame.position).collect();
        neighbour(hair, offset, &stops, tracing, &mut line);
        for ((point, frame), &s) in line.iter_mut().zip(&frames).zip(&stops) {
            let aside =
                (*point - frame.position) * options.factor(s / length.max(f64::MIN_POSITIVE));
            *point = options.waviness.offset(frame, s) + aside;
        }
        let mut draw = || -> f64 { StandardNormal.sample(rng) };
        let turn = options.fanning * DVec3::new(0.0, draw(), draw());
        if 0 < i {
            let turn = DQuat::from_scaled_axis(hair.root.axes * turn);
            let root = line[0];
            line.iter_mut().for_each(|point| *point = root + turn * (*point - root));
            perturb(&mut line, options.frizz, 0.8, rng);
        }
        lines.push(line);
    }
    Ok(lines)
}

/// The streamline at `offset`, or as far from the guide as there is one; the guide stays otherwise.
fn neighbour(
    hair: &PHelicoid<'_>,
    offset: DVec3,
    stops: &[f64],
    tracing: Tracing,
    line: &mut [DVec3],
) {
    let guide = line.to_vec();
    let mut offset = offset;
    for _ in 0..HALVINGS {
        if hair.streamline(offset, stops, tracing, line).is_ok() {
            return;
        }
        offset *= 0.5;
    }
    line.copy_from_slice(&guide);
}

#[cfg(test)]
mod tests;
