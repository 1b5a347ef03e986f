//! Interpolation: hairs between guides [GH 4].
//!
//! The parameters of a new hair are a weighted mean of the guides', Shepard's inverse distances to
//! a power: `w_i = f_i / sum f`, `f_i = |x - x_i|^-alpha`. Curvature then changes smoothly from
//! guide to guide, where a mean of points would straighten all that curls out of step. Frames are
//! mixed as [rotations](mean_rotation); on a surface, each guide's frame is first carried to the
//! new root by the least turn of the normals, which is what [GH 4.3] gets from frames of a surface
//! without having to choose how they stand about the normal.
//!
//! What is mixed is said by [`Mixing`]. As published it is `(kT, kN, kB, alpha)`, after every guide
//! is given a positive `kT`. But `alpha` is a quotient: two hairs that bend by the same little to
//! either side of `E_N`'s plane may have any two, and all four depend on how the frame stands about
//! the tangent. The default mixes what does not, and puts it together again (`Mixing::Bends`).

mod mix;
mod rotation;
mod surface;
mod weights;

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::{Column, Frame, Strands};

use crate::fit::{hold, mean_curvature};
use crate::{HelicoidGroom, PHelicoid, Piece, TraceError, Tracing, positive_tangential};
use mix::Guide;
pub use rotation::mean_rotation;
pub use surface::normals_at;
pub use weights::shepard;

/// What of the guides is mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mixing {
    /// The curvature at the beginning of a piece, its growth along it, its mean over it and its
    /// direction, and the piece's part of the length. The size of a curvature and its direction are
    /// mixed apart: curls that are out of step stay curls.
    #[default]
    Bends,
    /// `(kT, kN, kB, alpha)` of guides with a positive `kT`, pieces equally long, as published.
    Parameters,
}

/// How hairs are mixed from guides.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FillOptions {
    /// What is mixed. Default the bends.
    pub mixing: Mixing,
    /// The power `alpha` of the inverse distance, at least 0. Default 3, as published; with 0 all
    /// hairs are alike, with more they clump about the guides.
    pub exponent: f64,
    /// How many of the nearest guides count; 0 for all, as published. Default 8.
    pub neighbors: usize,
    /// Stretches of each hair that are held to the mean of the guides' points, each on the average
    /// of its length; 0, as published and the default, leaves the hair where its parameters lead.
    /// What is mixed of parameters bends right and ends anywhere, for every error of direction
    /// grows along the hair; the mean of points ends right, but its curls have cancelled. So the
    /// course of a hair is taken from the points and what is shorter than a stretch from the
    /// parameters: there should be no more stretches than turns of a coil. At most 1000.
    pub hold: usize,
}

impl Default for FillOptions {
    fn default() -> Self {
        Self { mixing: Mixing::default(), exponent: 3.0, neighbors: 8, hold: 0 }
    }
}

/// Where new hairs begin: their roots, and the normals of the surface they stand on if there is
/// one.
#[derive(Clone, Copy, Debug)]
pub enum Roots<'a> {
    /// On a line or a plane, or on nothing known: frames are mixed as they are.
    Points(&'a [DVec3]),
    /// On a surface.
    Surface {
        /// The roots.
        positions: &'a [DVec3],
        /// The surface's unit normal at each.
        normals: &'a [DVec3],
        /// The surface's unit normal at each guide's root.
        at_guides: &'a [DVec3],
    },
}

impl<'a> Roots<'a> {
    fn positions(&self) -> &'a [DVec3] {
        match self {
            Self::Points(positions) | Self::Surface { positions, .. } => positions,
        }
    }
}

/// Hairs between guides.
#[derive(Clone, Debug, PartialEq)]
pub struct Filled {
    /// One hair a root, with the strand attributes of the guide nearest to it.
    pub hairs: HelicoidGroom,
    /// Hairs whose mixed parameters were singular on their path: they have those of the nearest
    /// guide instead.
    pub replaced: Vec<usize>,
}

/// Why there is nothing between the guides.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FillError {
    /// Not one guide that is a helicoid of some length.
    ///
    /// ```
    /// use tress_geometry::Strands;
    /// use tress_helicoid::{FillError, FillOptions, HelicoidGroom, Roots, fill};
    ///
    /// let none = HelicoidGroom::new(vec![], Strands::default())?;
    /// let error = fill(&none, Roots::Points(&[]), &FillOptions::default());
    /// assert_eq!(error, Err(FillError::NoGuide));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[error("no guide is a helicoid of some length")]
    NoGuide,
    /// A guide that cannot be traced.
    #[error("guide {guide}: {source}")]
    Guide {
        /// Which one.
        guide: usize,
        /// Why.
        source: TraceError,
    },
    /// The exponent is negative or not finite.
    #[error("the exponent is {0}, expected at least 0")]
    Exponent(f64),
    /// Hairs held in more stretches than [`FillOptions::hold`] may be.
    ///
    /// ```
    /// use tress_geometry::Strands;
    /// use tress_helicoid::{FillError, FillOptions, HelicoidGroom, Roots, fill};
    ///
    /// let none = HelicoidGroom::new(vec![], Strands::default())?;
    /// let options = FillOptions { hold: 5000, ..FillOptions::default() };
    /// assert_eq!(fill(&none, Roots::Points(&[]), &options), Err(FillError::Hold(5000)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[error("hairs held in {0} stretches, expected at most 1000")]
    Hold(usize),
    /// A root, or a normal, that is not finite.
    #[error("root {0} or its normal is not finite")]
    Root(usize),
    /// Not one normal a root or a guide.
    #[error("{normals} normals for {roots} roots")]
    Normals {
        /// Normals given.
        normals: usize,
        /// Roots they are for.
        roots: usize,
    },
    /// More pieces than offsets can tell apart.
    #[error("more pieces than offsets can tell apart")]
    TooMany,
}

/// Hairs at new roots, mixed from guides.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Frame, Strands};
/// use tress_helicoid::{FillOptions, Helicoid, HelicoidGroom, Piece, Roots, fill};
///
/// // Two guides on a line, one bent twice as much: half way it is between.
/// let bent = |kt| Piece { k: Helicoid::new(kt, 0.0, 0.0, 0.0), length: 1.0 };
/// let roots = [0.0, 2.0].map(|x| Frame { position: DVec3::new(x, 0.0, 0.0), ..Frame::IDENTITY });
/// let pieces = Strands::from_counts([1, 1], vec![bent(1.0), bent(2.0)])?;
/// let guides = HelicoidGroom::new(roots.to_vec(), pieces)?;
/// let filled = fill(&guides, Roots::Points(&[DVec3::X]), &FillOptions::default())?;
/// assert!((filled.hairs.hair(0).pieces[0].k.kt - 1.5).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// See [`FillError`].
pub fn fill(
    guides: &HelicoidGroom,
    roots: Roots<'_>,
    options: &FillOptions,
) -> Result<Filled, FillError> {
    if !(0.0 <= options.exponent && options.exponent.is_finite()) {
        return Err(FillError::Exponent(options.exponent));
    }
    if MOST_STRETCHES < options.hold {
        return Err(FillError::Hold(options.hold));
    }
    check_roots(guides, roots)?;
    let usable = usable_guides(guides, roots, options)?;
    let positions = roots.positions();
    let at_guides: Vec<DVec3> = usable.iter().map(|guide| guide.root).collect();
    let hairs: Vec<Mixed> = positions
        .par_iter()
        .enumerate()
        .with_min_len(64)
        .map_init(Vec::new, |scratch, (i, &position)| {
            shepard(position, &at_guides, options, scratch);
            let normal = match roots {
                Roots::Points(_) => None,
                Roots::Surface { normals, .. } => Some(normals[i]),
            };
            Mixed::new(position, normal, &usable, scratch, options)
        })
        .collect();
    gather(guides, hairs)
}

/// Stretches that a hair can be held in: far more than any hair has turns.
const MOST_STRETCHES: usize = 1000;

/// Points over whose mean a hair is held in each of its stretches: enough to tell the mean of a
/// turn of a coil.
const WINDOW: usize = 4;

/// One new hair.
struct Mixed {
    root: Frame,
    pieces: Vec<Piece>,
    /// The nearest guide's place in the groom of guides.
    nearest: usize,
    replaced: bool,
}

impl Mixed {
    fn new(
        position: DVec3,
        normal: Option<DVec3>,
        guides: &[Guide<'_>],
        weights: &[(usize, f64)],
        options: &FillOptions,
    ) -> Self {
        let nearest = &guides[weights[0].0];
        let (rotation, mut pieces) = mix::mix(guides, weights, normal, options.mixing);
        let mut root = Frame { position, axes: glam::DMat3::from_quat(rotation) };
        if 0 < options.hold {
            let points = mix::points(guides, weights, normal, options.hold * WINDOW);
            let hair = PHelicoid { root, pieces: &pieces };
            let held = hold(&hair, &points, WINDOW);
            if let Some((turned, bent)) = held.filter(|(root, pieces)| is_clear(root, pieces)) {
                (root, pieces) = (turned, bent);
            }
        }
        let replaced = !is_clear(&root, &pieces);
        if replaced {
            pieces = nearest.pieces.to_vec();
        }
        Self { root, pieces, nearest: nearest.index, replaced }
    }
}

/// Clearance that needs no tracing: it falls by at most `|kappa|` a unit of length.
const SURELY_CLEAR: f64 = 0.9;

/// Whether the hair can be traced.
fn is_clear(root: &Frame, pieces: &[Piece]) -> bool {
    let surely = |piece: &Piece| piece.k.kt.hypot(piece.k.kn) * piece.length < SURELY_CLEAR;
    pieces.iter().all(surely) || PHelicoid { root: *root, pieces }.tip(Tracing::default()).is_ok()
}

/// An error unless all roots and normals are there and finite.
fn check_roots(guides: &HelicoidGroom, roots: Roots<'_>) -> Result<(), FillError> {
    let positions = roots.positions();
    if let Roots::Surface { normals, at_guides, .. } = roots {
        for (normals, roots) in [(normals, positions.len()), (at_guides, guides.len())] {
            if normals.len() != roots {
                return Err(FillError::Normals { normals: normals.len(), roots });
            }
        }
        let unit = |normal: &DVec3| (normal.length() - 1.0).abs() < 1e-6;
        if let Some(i) = normals.iter().chain(at_guides).position(|normal| !unit(normal)) {
            return Err(FillError::Root(i));
        }
    }
    match positions.iter().position(|position| !position.is_finite()) {
        Some(i) => Err(FillError::Root(i)),
        None => Ok(()),
    }
}

/// The guides that are helicoids of some length, each of which must be traceable.
fn usable_guides<'a>(
    guides: &HelicoidGroom,
    roots: Roots<'a>,
    options: &FillOptions,
) -> Result<Vec<Guide<'a>>, FillError> {
    let mut usable = Vec::with_capacity(guides.len());
    let mut line = vec![DVec3::ZERO; options.hold * WINDOW + 1];
    for (index, hair) in guides.iter().enumerate() {
        let length = hair.length();
        if hair.pieces.is_empty() || length <= 0.0 {
            continue;
        }
        hair.sample_evenly(Tracing::default(), &mut line)
            .map_err(|source| FillError::Guide { guide: index, source })?;
        let points = line[1..].iter().map(|point| point - hair.root.position).collect();
        let (mut root, mut pieces) = (hair.root, hair.pieces.to_vec());
        if options.mixing == Mixing::Parameters {
            positive_tangential(&mut root, &mut pieces);
        }
        let normal = match roots {
            Roots::Points(_) => None,
            Roots::Surface { at_guides, .. } => Some(&at_guides[index]),
        };
        let curvature = |piece: &Piece| mean_curvature(&piece.k, piece.length).unwrap_or(0.0);
        usable.push(Guide {
            index,
            root: root.position,
            rotation: DQuat::from_mat3(&root.axes).normalize(),
            normal,
            curvatures: pieces.iter().map(curvature).collect(),
            pieces,
            length,
            points,
        });
    }
    if usable.is_empty() { Err(FillError::NoGuide) } else { Ok(usable) }
}

/// The hairs as a groom in the guides' space.
fn gather(guides: &HelicoidGroom, hairs: Vec<Mixed>) -> Result<Filled, FillError> {
    let nearest: Vec<usize> = hairs.iter().map(|hair| hair.nearest).collect();
    let replaced = hairs.iter().enumerate().filter(|(_, hair)| hair.replaced).map(|(i, _)| i);
    let replaced: Vec<usize> = replaced.collect();
    let roots: Vec<Frame> = hairs.iter().map(|hair| hair.root).collect();
    let counts: Vec<usize> = hairs.iter().map(|hair| hair.pieces.len()).collect();
    let pieces: Vec<Piece> = hairs.into_iter().flat_map(|hair| hair.pieces).collect();
    let pieces = Strands::from_counts(counts, pieces).map_err(|_| FillError::TooMany)?;
    let rows = |column: &Column| column.select(nearest.iter().copied());
    let attributes = guides.strand_attributes().map(nearest.len(), rows);
    let hairs = HelicoidGroom::with_attributes(roots, pieces, attributes, Default::default())
        .map_err(|_| FillError::TooMany)?
        .in_space(guides.unit, guides.up);
    Ok(Filled { hairs, replaced })
}

#[cfg(test)]
mod tests;
