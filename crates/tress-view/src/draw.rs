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

/// The picture of flattened strands.
pub(crate) fn draw(
    strands: &Strands<Vertex>,
    paint: &impl Paint,
    stage: &Stage,
    size: Size,
) -> RgbImage {
    let vertices = strands.points();
    let (lit, tiles) = rayon::join(
        || light(vertices, paint, stage, &Shadows::new(strands, stage)),
        || Tiles::new(strands, size),
    );
    let painter = Painter { vertices, lit, background: stage.background };
    let encoder = Encoder::new();
    let width = size.width as usize;
    let mut bytes = vec![0_u8; 3 * width * size.height as usize];
    let band = 3 * width * EDGE as usize;
    let bands: Vec<(usize, &mut [u8])> = bytes.chunks_mut(band).enumerate().collect();
    bands.into_par_iter().for_each(|(row, band)| {
        let squares: Vec<Square> = (0..tiles.across)
            .into_par_iter()
            .map(|column| painter.square(&tiles, row * tiles.across + column))
            .collect();
        for (y, line) in band.chunks_exact_mut(3 * width).enumerate() {
            let pixels = squares.iter().flat_map(|square| square.row(y));
            for (bytes, light) in line.chunks_exact_mut(3).zip(pixels) {
                bytes.copy_from_slice(&encoder.encode(light));
            }
        }
    });
    RgbImage::from_raw(size.width, size.height, bytes).unwrap_or_default()
}

/// The light that each vertex sends to the viewer.
fn light(vertices: &[Vertex], paint: &impl Paint, stage: &Stage, shadows: &Shadows) -> Vec<Vec3> {
    let shade = |i: usize| {
        let Vertex { position, value, .. } = vertices[i];
        let (color, tilt) = paint.fibre(value);
        let fibre = Fibre { tangent: tangent(vertices, i), color, tilt };
        let mut light = color * stage.sky * shadows.sky.at(position);
        let depths = shadows.depths.at(position).to_array();
        for (source, tau) in stage.lights.iter().zip(depths) {
            light += scatter(&stage.material, &fibre, source, tau);
        }
        light
    };
    (0..vertices.len()).into_par_iter().with_min_len(1 << 12).map(shade).collect()
}

/// The accumulators of one square.
struct Square {
    /// Colour so far, and the share left free.
    pixels: Vec<(Vec3, f32)>,
    background: Vec3,
}

impl Square {
    fn row(&self, y: usize) -> impl Iterator<Item = Vec3> {
        let edge = EDGE as usize;
        let row = &self.pixels[y * edge..(y + 1) * edge];
        row.iter().map(|(color, free)| color + self.background * *free)
    }
}

struct Painter<'a> {
    vertices: &'a [Vertex],
    /// The light that each vertex sends to the viewer.
    lit: Vec<Vec3>,
    background: Vec3,
}

impl Painter<'_> {
    fn square(&self, tiles: &Tiles, tile: usize) -> Square {
        let edge = EDGE.cast_signed();
        let [left, top] = tiles.corner(tile);
        let mut pixels = vec![(Vec3::ZERO, 1.0_f32); (EDGE * EDGE) as usize];
        let mut open = pixels.len();
        for (piece, [a, b]) in self.by_depth(tiles.pieces(tile)) {
            piece.cover(left..left + edge, top..top + edge, |fragment: Fragment| {
                let (x, y) = (fragment.x - left, fragment.y - top);
                let (color, free) = &mut pixels[index(y * edge + x)];
                if *free < FULL {
                    return;
                }
                let here = (a + (b - a) * fragment.along) * round(&fragment);
                *color += here * (*free * fragment.coverage);
                *free *= 1.0 - fragment.coverage;
                if *free < FULL {
                    open -= 1;
                }
            });
            if open == 0 {
                break;
            }
        }
        Square { pixels, background: self.background }
    }

    /// The pieces behind these vertices with the light of their ends, the nearest piece first;
    /// equally near ones in their own order.
    fn by_depth(
        &self,
        first: impl Iterator<Item = u32>,
    ) -> impl Iterator<Item = (Piece, [Vec3; 2])> {
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
