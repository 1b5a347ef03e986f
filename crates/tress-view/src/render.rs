//! A groom, and how it is to be seen, to a picture.

use glam::{DVec3, Vec3};
use image::{Rgb as Pixel, RgbImage, imageops};
use serde::{Deserialize, Serialize};
use tress_geometry::{Groom, OffsetsError, UpAxis};

use crate::bounds::Bounds;
use crate::camera::{Camera, Size, View};
use crate::color::{HairColor, Rgb, decode};
use crate::draw::{Paint, draw};
use crate::flatten::{Dress, flatten};
use crate::legend::{self, NO_VALUE, legend};
use crate::num::narrow;
use crate::scale::Scale;
use crate::stage::Stage;
use crate::width::{StrandWidth, radii};

/// How a groom is to be seen.
///
/// ```
/// use tress_view::{RenderOptions, View};
///
/// let options: RenderOptions = ron::from_str("(view: Back, hair: Dyed((200, 60, 30)))")?;
/// assert_eq!(options, RenderOptions {
///     view: View::Back,
///     hair: tress_view::HairColor::Dyed([200, 60, 30]),
///     ..RenderOptions::default()
/// });
/// # Ok::<(), ron::de::SpannedError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RenderOptions {
    /// From where. Default the front.
    pub view: View,
    /// Pixels of the picture, legend included. Default 1200 by 1200.
    pub size: Size,
    /// The hair's colour, where it is not coloured by values. Default dark brown.
    pub hair: HairColor,
    /// The hair's width. Default the groom's own, or a sensible one.
    pub width: StrandWidth,
    /// What is seen where there is no natural hair. Default a warm light grey.
    pub background: Rgb,
    /// What is seen where there is no hair coloured by values: default a dark grey, before which
    /// the light colours of a map stand out as well as the others.
    pub value_background: Rgb,
    /// Share of the picture's shorter side that is left free around the groom. Default 0.05.
    pub margin: f64,
}

impl Default for RenderOptions {
    fn default() -> Self {
        Self {
            view: View::default(),
            size: Size::new(1200, 1200),
            hair: HairColor::default(),
            width: StrandWidth::default(),
            background: [236, 233, 228],
            value_background: [44, 46, 50],
            margin: 0.05,
        }
    }
}

/// What the hair's colour says.
#[derive(Clone, Copy, Debug, Default)]
pub enum Coloring<'a> {
    /// Nothing: natural hair, of the colour that the options give.
    #[default]
    Natural,
    /// One number a strand, shown by a scale. NaN is drawn grey.
    Strands(&'a [f64], &'a Scale),
    /// One number a point, shown by a scale. NaN is drawn grey.
    Points(&'a [f64], &'a Scale),
}

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// No pixels, or more than 2^28.
    ///
    /// ```
    /// # use tress_geometry::{Groom, Strands};
    /// # use tress_view::{Coloring, RenderError, RenderOptions, Size, render};
    /// let flat = RenderOptions { size: Size::new(100, 0), ..RenderOptions::default() };
    /// let error = render(&Groom::new(Strands::default()), &Coloring::Natural, &flat).unwrap_err();
    /// assert_eq!(error, RenderError::Size { width: 100, height: 0 });
    /// ```
    #[error("a picture of {width} x {height} pixels cannot be made")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// Not one value a strand or a point.
    ///
    /// ```
    /// # use tress_geometry::{Groom, Strands};
    /// # use tress_view::{Coloring, RenderError, RenderOptions, Scale, render};
    /// let coloring = Coloring::Strands(&[1.0], &Scale::default());
    /// let bald = Groom::new(Strands::default());
    /// let error = render(&bald, &coloring, &RenderOptions::default()).unwrap_err();
    /// assert_eq!(error, RenderError::Values { values: 1, of: "strands", expected: 0 });
    /// ```
    #[error("{values} values for {expected} {of}")]
    Values {
        /// Values given.
        values: usize,
        /// Strands or points.
        of: &'static str,
        /// How many of them there are.
        expected: usize,
    },
    /// More pieces of hair than can be told apart: billions.
    #[error(transparent)]
    TooMuchHair(#[from] OffsetsError),
}

/// Draws a groom as hair, seen whole from the view that the options name.
///
/// Y is taken for up where the groom does not say. Coordinates that are not finite break a strand;
/// strands of fewer than two points are not seen.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Groom, Strands};
/// use tress_view::{Coloring, RenderOptions, Size, render};
///
/// let strand = |i: u32| [0.0, 1.0].map(|y| DVec3::new(f64::from(i), 90.0 * y, 0.0));
/// let groom = Groom::new(Strands::from_counts([2; 90], (0..90).flat_map(strand).collect())?);
/// let options = RenderOptions { size: Size::new(120, 120), ..RenderOptions::default() };
/// let image = render(&groom, &Coloring::Natural, &options)?;
/// let (hair, corner) = (image.get_pixel(60, 60), image.get_pixel(0, 0));
/// assert_eq!(corner.0, options.background);
/// assert!(hair.0 < corner.0, "dark hair on a light ground");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the picture has no or too many pixels, or the values do not match the groom.
pub fn render(
    groom: &Groom,
    coloring: &Coloring<'_>,
    options: &RenderOptions,
) -> Result<RgbImage, RenderError> {
    let points = groom.strands().points().iter().copied();
    render_around(groom, points, coloring, options)
}

/// As [`render`], but with a camera that sees all of `bounds`: pictures of several grooms within
/// the same bounds, before and after an edit say, can be laid over each other.
///
/// Where the edit changes how long the strands are, give the options one
/// [`StrandWidth::Fixed`] too.
///
/// # Errors
///
/// As [`render`].
pub fn render_within(
    groom: &Groom,
    bounds: Bounds,
    coloring: &Coloring<'_>,
    options: &RenderOptions,
) -> Result<RgbImage, RenderError> {
    render_around(groom, bounds.corners(), coloring, options)
}

/// Draws a groom once for each of several colourings, all seen as by [`render`].
///
/// Pictures coloured by values share the work that does not depend on colours.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Groom, Strands};
/// use tress_view::{Coloring, RenderOptions, Scale, Size, render, render_each};
///
/// let strand = |i: u32| [0.0, 1.0].map(|y| DVec3::new(f64::from(i), 9.0 * y, 0.0));
/// let groom = Groom::new(Strands::from_counts([2; 9], (0..9).flat_map(strand).collect())?);
/// let scale = Scale::spanning([0.0, 8.0]);
/// let (up, down) = ([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0], [4.0; 9]);
/// let colorings = [Coloring::Strands(&up, &scale), Coloring::Strands(&down, &scale)];
/// let options = RenderOptions { size: Size::new(120, 120), ..RenderOptions::default() };
/// let both = render_each(&groom, &colorings, &options)?;
/// assert_eq!(both[1], render(&groom, &colorings[1], &options)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// As [`render`].
pub fn render_each(
    groom: &Groom,
    colorings: &[Coloring<'_>],
    options: &RenderOptions,
) -> Result<Vec<RgbImage>, RenderError> {
    let Size { width, height } = check_size(options.size)?;
    let points = || groom.strands().points().iter().copied();
    let up = groom.up.unwrap_or(UpAxis::Y);
    let mut images = Vec::with_capacity(colorings.len());
    for alike in colorings.chunk_by(|a, b| a.scale().is_some() == b.scale().is_some()) {
        let legend = legend_height(&alike[0], options);
        let seen = Size::new(width, height - legend);
        let camera = Camera::fit(points(), up, options.view, seen, options.margin);
        let pictures = seen_by(&camera, groom, alike, options)?;
        let pairs = pictures.into_iter().zip(alike);
        images.extend(pairs.map(|(picture, coloring)| with_legend(picture, coloring, options)));
    }
    Ok(images)
}

/// The picture by a camera that sees all `points`, with its legend.
fn render_around(
    groom: &Groom,
    points: impl IntoIterator<Item = DVec3>,
    coloring: &Coloring<'_>,
    options: &RenderOptions,
) -> Result<RgbImage, RenderError> {
    let Size { width, height } = check_size(options.size)?;
    let legend = legend_height(coloring, options);
    let up = groom.up.unwrap_or(UpAxis::Y);
    let seen = Size::new(width, height - legend);
    let camera = Camera::fit(points, up, options.view, seen, options.margin);
    Ok(with_legend(render_seen_by(&camera, groom, coloring, options)?, coloring, options))
}

/// Pixels that the legend takes of a picture: none where colours mean nothing.
fn legend_height(coloring: &Coloring<'_>, options: &RenderOptions) -> u32 {
    coloring.scale().map_or(0, |_| legend::height(options.size))
}

/// A picture with the legend of its colours below it, if they mean anything.
fn with_legend(picture: RgbImage, coloring: &Coloring<'_>, options: &RenderOptions) -> RgbImage {
    let (Coloring::Strands(values, scale) | Coloring::Points(values, scale)) = coloring else {
        return picture;
    };
    let (size, paper) = (options.size, options.value_background);
    let mut whole = RgbImage::from_pixel(size.width, size.height, Pixel(paper));
    imageops::replace(&mut whole, &picture, 0, 0);
    if 0 < legend::height(size) {
        let strip = legend(scale, missing(coloring, values).as_deref(), size, paper);
        imageops::replace(&mut whole, &strip, 0, i64::from(picture.height()));
    }
    whole
}

/// Draws a groom as a camera sees it, without a legend; the options' view, size and margin are the
/// camera's.
///
/// # Errors
///
/// As [`render`].
pub fn render_seen_by(
    camera: &Camera,
    groom: &Groom,
    coloring: &Coloring<'_>,
    options: &RenderOptions,
) -> Result<RgbImage, RenderError> {
    let images = seen_by(camera, groom, std::slice::from_ref(coloring), options)?;
    Ok(images.into_iter().next().unwrap_or_default())
}

/// One picture for each of the colourings, which are all natural or all by values: these three at a
/// time, of which more would leave the cache.
fn seen_by(
    camera: &Camera,
    groom: &Groom,
    colorings: &[Coloring<'_>],
    options: &RenderOptions,
) -> Result<Vec<RgbImage>, RenderError> {
    check_size(camera.size())?;
    let radii = radii(groom, options.width, camera);
    let flat = |coloring: &Coloring<'_>| {
        let dress = Dress { radii: radii.clone(), values: coloring.places(groom)? };
        Ok(flatten(groom.strands(), &dress, camera)?)
    };
    let mut images = Vec::with_capacity(colorings.len());
    for part in colorings.chunks(3) {
        let flats: Vec<_> = part.iter().map(flat).collect::<Result<_, RenderError>>()?;
        let maps: Vec<_> = part.iter().filter_map(Coloring::scale).map(Mapped::new).collect();
        let stage = Stage::plain(decode(options.value_background));
        images.extend(match maps.len() {
            0 => {
                let paint = Natural(options.hair.linear());
                let stage = Stage::natural(decode(options.background));
                let draw = |flat| draw::<1, _>(&[flat], &[paint], &stage, camera.size());
                flats.into_iter().flat_map(draw).collect()
            }
            1 => draw::<1, _>(&flats, &maps, &stage, camera.size()),
            2 => draw::<2, _>(&flats, &maps, &stage, camera.size()),
            _ => draw::<3, _>(&flats, &maps, &stage, camera.size()),
        });
    }
    Ok(images)
}

impl<'a> Coloring<'a> {
    /// What shows the values, if there are any.
    fn scale(&self) -> Option<&'a Scale> {
        match self {
            Self::Natural => None,
            Self::Strands(_, scale) | Self::Points(_, scale) => Some(scale),
        }
    }

    /// What the hair is coloured by at each point: for natural hair a number of each strand's own.
    fn places(&self, groom: &Groom) -> Result<Vec<f32>, RenderError> {
        match self {
            Self::Natural => Ok(each_point(groom, |i| chance(i as u64))),
            Self::Strands(values, scale) => {
                check_values(values, "strands", groom.strands().len())?;
                Ok(each_point(groom, |i| place(scale, values[i])))
            }
            Self::Points(values, scale) => {
                check_values(values, "points", groom.strands().points().len())?;
                Ok(values.iter().map(|&value| place(scale, value)).collect())
            }
        }
    }
}

fn check_size(size: Size) -> Result<Size, RenderError> {
    let Size { width, height } = size;
    let pixels = u64::from(width) * u64::from(height);
    if (1..=1 << 28).contains(&pixels) {
        Ok(size)
    } else {
        Err(RenderError::Size { width, height })
    }
}

fn check_values(values: &[f64], of: &'static str, expected: usize) -> Result<(), RenderError> {
    let values = values.len();
    if values == expected { Ok(()) } else { Err(RenderError::Values { values, of, expected }) }
}

/// A strand's number at each of its points.
fn each_point(groom: &Groom, number: impl Fn(usize) -> f32) -> Vec<f32> {
    let strands = groom.strands().counts().enumerate();
    strands.flat_map(|(i, n)| std::iter::repeat_n(number(i), n)).collect()
}

/// Where a value lies on the scale, NaN where there is none.
fn place(scale: &Scale, value: f64) -> f32 {
    scale.place(value).map_or(f32::NAN, narrow)
}

/// Words for the values that are not there.
fn missing(coloring: &Coloring<'_>, values: &[f64]) -> Option<String> {
    let count = values.iter().filter(|value| value.is_nan()).count();
    let of = if matches!(coloring, Coloring::Strands(..)) { "strands" } else { "points" };
    (0 < count).then(|| format!("no value: {count} of {} {of}", values.len()))
}

/// Hair of one colour, each strand a little lighter or darker, as hair grows.
#[derive(Clone, Copy)]
struct Natural(Vec3);

impl Paint for Natural {
    fn fibre(&self, value: f32) -> (Vec3, f32) {
        // A second number of the strand's own, from the digits the first does not show.
        let other = (value * 97.0).fract();
        (self.0 * (0.5 + value), 0.2 * (other - 0.5))
    }
}

/// Hair coloured by a map.
struct Mapped(Vec<Vec3>);

impl Mapped {
    /// Steps of a map, more than there are shades in an 8-bit picture.
    const STEPS: u16 = 511;

    fn new(scale: &Scale) -> Self {
        let step = |i: u16| decode(scale.map.rgb(f64::from(i) / f64::from(Self::STEPS)));
        Self((0..=Self::STEPS).map(step).collect())
    }
}

impl Paint for Mapped {
    fn fibre(&self, value: f32) -> (Vec3, f32) {
        if value.is_nan() {
            return (decode(NO_VALUE), 0.0);
        }
        let i = crate::num::index(crate::num::floor(value * f32::from(Self::STEPS) + 0.5));
        (self.0[i.min(self.0.len() - 1)], 0.0)
    }
}

/// A number in 0 to 1 that differs from strand to strand (the finalizer of `SplitMix64`).
fn chance(i: u64) -> f32 {
    let mut z = i.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 40) as f32 / (1_u64 << 24) as f32
}

#[cfg(test)]
mod tests;
