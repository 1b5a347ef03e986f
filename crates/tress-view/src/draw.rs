//! From strands to pixels: light, shade, and the nearest hair first.
//!
//! Within a square of the picture the pieces of hair are taken from front to back. A pixel keeps
//! the colour so far and the share `T` of it that is still free; a fragment of coverage `a` and
//! colour `c` adds `T a c` and leaves `T (1 - a)`; where nothing is free, the rest is not drawn.

use glam::{Vec2, Vec3};
use image::RgbImage;
use rayon::prelude::*;
use tress_geometry::Strands;

use crate::camera::Size;
use crate::color::Encoder;
use crate::density::Grid;
use crate::flatten::Vertex;
use crate::num::index;
use crate::raster::{Fragment, Piece, tangent};
use crate::shade::{Fibre, scatter};
use crate::stage::Stage;
use crate::tiles::{EDGE, Tiles};

/// A pixel with less than this left free counts as full: a step of an 8-bit colour.
const FULL: f32 = 1.0 / 256.0;

/// Cells of the shadow grid along its longest side.
const SHADOW_CELLS: u32 = 160;

/// What a hair is like, by the value its vertices carry.
pub(crate) trait Paint: Sync {
    /// Its colour, as linear light, and how far its scales are tilted beyond the usual.
    fn fibre(&self, value: f32) -> (Vec3, f32);
}

/// Light that has found its way into the hair.
struct Shadows {
    /// Optical depth from each of the two lights.
    depths: Grid<Vec2>,
    /// Share of the sky that is seen.
    sky: Grid,
}

impl Shadows {
    fn new(strands: &Strands<Vertex>, stage: &Stage) -> Self {
        let hair = Grid::of_hair(strands, SHADOW_CELLS);
        let coarse = hair.coarser();
        let [key, rim] = stage.lights.map(|light| light.towards);
        let ((key, rim), sky) = rayon::join(
            || rayon::join(|| hair.optical_depth(key), || hair.optical_depth(rim)),
            || coarse.visibility(&sky_directions()),
        );
        Self { depths: key.beside(&rim), sky }
    }
}

/// The corners of an icosahedron, those above weighing more.
fn sky_directions() -> Vec<(Vec3, f32)> {
    let golden = 0.5 * (1.0 + 5.0_f32.sqrt());
    let mut directions = Vec::new();
    for a in [-1.0, 1.0] {
        for b in [-golden, golden] {
            for v in [Vec3::new(0.0, a, b), Vec3::new(a, b, 0.0), Vec3::new(b, 0.0, a)] {
                let towards = v.normalize();
                // Up is minus y.
                directions.push((towards, 1.0 - 0.7 * towards.y));
            }
        }
    }
    directions
}

/// `N` pictures of flattened strands, each by a paint of its own: the strands differ by the values
/// of their vertices alone, so that coverage and shadows are worked out once for all pictures.
pub(crate) fn draw<const N: usize, P: Paint>(
    strands: &[Strands<Vertex>],
    paints: &[P],
    stage: &Stage,
    size: Size,
) -> Vec<RgbImage> {
    let Some(first) = strands.first() else { return vec![] };
    let (lit, tiles) = rayon::join(
        || light::<N, P>(strands, paints, stage, &Shadows::new(first, stage)),
        || Tiles::new(first, size),
    );
    let painter = Painter { vertices: first.points(), lit };
    let encoder = Encoder::new();
    let (width, height) = (size.width as usize, size.height as usize);
    let edge = EDGE as usize;
    let band = |row: usize| -> [Vec<u8>; N] {
        let squares: Vec<Square<N>> = (0..tiles.across)
            .into_par_iter()
            .map(|column| painter.square(&tiles, row * tiles.across + column))
            .collect();
        let lines = edge.min(height - row * edge);
        std::array::from_fn(|n| {
            let mut bytes = Vec::with_capacity(3 * width * lines);
            for y in 0..lines {
                let pixels = squares.iter().flat_map(|square| square.row(y, n, stage.background));
                bytes.extend(pixels.take(width).flat_map(|light| encoder.encode(light)));
            }
            bytes
        })
    };
    let bands: Vec<[Vec<u8>; N]> = (0..height.div_ceil(edge)).into_par_iter().map(band).collect();
    let whole = |n: usize| {
        let bytes = bands.iter().flat_map(|band| band[n].iter().copied()).collect();
        RgbImage::from_raw(size.width, size.height, bytes).unwrap_or_default()
    };
    (0..N).map(whole).collect()
}

/// The light that each vertex sends to the viewer, in each of the pictures.
fn light<const N: usize, P: Paint>(
    strands: &[Strands<Vertex>],
    paints: &[P],
    stage: &Stage,
    shadows: &Shadows,
) -> Vec<[Vec3; N]> {
    let Some(first) = strands.first().map(Strands::points) else { return vec![] };
    let shade = |i: usize| {
        let (position, tangent) = (first[i].position, tangent(first, i));
        let sky = stage.sky * shadows.sky.at(position);
        let depths = shadows.depths.at(position).to_array();
        std::array::from_fn(|n| {
            let picture = paints.get(n).zip(strands.get(n));
            let (color, tilt) = picture.map_or((Vec3::ZERO, 0.0), |(paint, strands)| {
                paint.fibre(strands.points()[i].value)
            });
            let fibre = Fibre { tangent, color, tilt };
            let mut light = color * sky;
            for (source, tau) in stage.lights.iter().zip(depths) {
                light += scatter(&stage.material, &fibre, source, tau);
            }
            light
        })
    };
    (0..first.len()).into_par_iter().with_min_len(1 << 12).map(shade).collect()
}

/// The accumulators of one square.
struct Square<const N: usize> {
    pixels: Vec<Accumulator<N>>,
}

/// A pixel under way: its colour so far in each picture, and the share left free.
#[derive(Clone, Copy)]
struct Accumulator<const N: usize> {
    colors: [Vec3; N],
    free: f32,
}

impl<const N: usize> Square<N> {
    /// A row of one of the pictures.
    fn row(&self, y: usize, n: usize, background: Vec3) -> impl Iterator<Item = Vec3> {
        let edge = EDGE as usize;
        let row = &self.pixels[y * edge..(y + 1) * edge];
        row.iter().map(move |pixel| pixel.colors[n] + background * pixel.free)
    }
}

struct Painter<'a, const N: usize> {
    vertices: &'a [Vertex],
    /// The light that each vertex sends to the viewer.
    lit: Vec<[Vec3; N]>,
}

impl<const N: usize> Painter<'_, N> {
    fn square(&self, tiles: &Tiles, tile: usize) -> Square<N> {
        let edge = EDGE.cast_signed();
        let [left, top] = tiles.corner(tile);
        let nothing = Accumulator { colors: [Vec3::ZERO; N], free: 1.0 };
        let mut pixels = vec![nothing; (EDGE * EDGE) as usize];
        let mut open = pixels.len();
        for (piece, [a, b]) in self.by_depth(tiles.pieces(tile)) {
            piece.cover(left..left + edge, top..top + edge, |fragment: Fragment| {
                let (x, y) = (fragment.x - left, fragment.y - top);
                let pixel = &mut pixels[index(y * edge + x)];
                if pixel.free < FULL {
                    return;
                }
                let seen = round(&fragment) * (pixel.free * fragment.coverage);
                for (color, (a, b)) in pixel.colors.iter_mut().zip(a.iter().zip(&b)) {
                    *color += (*a + (*b - *a) * fragment.along) * seen;
                }
                pixel.free *= 1.0 - fragment.coverage;
                if pixel.free < FULL {
                    open -= 1;
                }
            });
            if open == 0 {
                break;
            }
        }
        Square { pixels }
    }

    /// The pieces behind these vertices with the light of their ends, the nearest piece first;
    /// equally near ones in their own order.
    fn by_depth(
        &self,
        first: impl Iterator<Item = u32>,
    ) -> impl Iterator<Item = (Piece, [[Vec3; N]; 2])> {
        // Read in the order of the strands and sorted by number, because to read all over the
        // groom in the order of depth would miss the cache at every piece.
        let mut pieces = Vec::new();
        let mut order: Vec<u64> = Vec::new();
        for i in first.map(|i| i as usize) {
            let Some(piece) = Piece::new(self.vertices, i) else { continue };
            let depth = self.vertices[i].position.z + self.vertices[i + 1].position.z;
            order.push(u64::from(ascending(depth)) << 32 | pieces.len() as u64);
            pieces.push((piece, [self.lit[i], self.lit[i + 1]]));
        }
        order.sort_unstable();
        order.into_iter().map(move |key| pieces[low_half(key) as usize])
    }
}

/// Bits that ascend as the numbers do.
fn ascending(x: f32) -> u32 {
    let bits = x.to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}

/// The lower 32 bits.
#[expect(clippy::cast_possible_truncation, reason = "the truncation is what is asked for")]
fn low_half(key: u64) -> u32 {
    key as u32
}

/// How much darker a hair is off its axis, once it is wide enough for its roundness to be seen.
fn round(fragment: &Fragment) -> f32 {
    let seen = ((fragment.radius - 0.6) / 1.5).clamp(0.0, 1.0);
    1.0 - 0.55 * seen * fragment.off_axis * fragment.off_axis
}
