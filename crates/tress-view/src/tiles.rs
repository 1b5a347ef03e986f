//! Which pieces of hair reach into which square of the picture.
//!
//! Squares are drawn one by one, each with its own pieces in the order of depth, so threads never
//! write to the same pixel and the accumulators stay in the nearest cache. Strands are sorted into
//! squares in runs, each run into lists of its own (a counting sort), and a square reads its lists
//! run after run: what a square draws does not depend on the number of threads.

use rayon::prelude::*;
use tress_geometry::Strands;

use crate::camera::Size;
use crate::flatten::Vertex;
use crate::num::{floor, index};

/// Pixels along a square's edge: its accumulators take 64 kB; smaller squares sort more pieces
/// twice, larger ones leave the cache.
pub(crate) const EDGE: u32 = 64;

/// Strands in a run.
const RUN: usize = 128;

/// Pieces by square.
#[derive(Debug)]
pub(crate) struct Tiles {
    /// Squares across the picture.
    pub(crate) across: usize,
    runs: Vec<Run>,
}

/// The pieces of some strands by square, each the index of its first vertex.
#[derive(Debug)]
struct Run {
    // Square `t` owns `pieces[starts[t]..starts[t + 1]]`.
    starts: Vec<u32>,
    pieces: Vec<u32>,
}

impl Tiles {
    pub(crate) fn new(strands: &Strands<Vertex>, size: Size) -> Self {
        let across = size.width.div_ceil(EDGE) as usize;
        let down = size.height.div_ceil(EDGE) as usize;
        let n_runs = strands.len().div_ceil(RUN);
        let runs = (0..n_runs).into_par_iter().map(|run| {
            let first = strands.offsets()[run * RUN];
            let behind = strands.offsets()[((run + 1) * RUN).min(strands.len())];
            Run::new(strands.points(), first..behind, across, down)
        });
        Self { across, runs: runs.collect() }
    }

    /// The pixel in a square's upper left corner.
    pub(crate) fn corner(&self, tile: usize) -> [i32; 2] {
        // Pictures have at most 2^28 pixels.
        let pixel = |square: usize| i32::try_from(square * EDGE as usize).unwrap_or(i32::MAX);
        [pixel(tile % self.across), pixel(tile / self.across)]
    }

    /// The pieces that reach into a square, by their first vertices.
    pub(crate) fn pieces(&self, tile: usize) -> impl Iterator<Item = u32> {
        self.runs.iter().flat_map(move |run| {
            let range = run.starts[tile] as usize..run.starts[tile + 1] as usize;
            run.pieces[range].iter().copied()
        })
    }
}

impl Run {
    fn new(vertices: &[Vertex], range: std::ops::Range<u32>, across: usize, down: usize) -> Self {
        let mut starts = vec![0; across * down + 1];
        let for_each = |put: &mut dyn FnMut(usize, u32)| {
            for i in range.clone() {
                let ends = vertices.get(i as usize).zip(vertices.get(i as usize + 1));
                let Some((a, b)) = ends else { continue };
                for tile in touched(a, b, across, down) {
                    put(tile, i);
                }
            }
        };
        for_each(&mut |tile, _| starts[tile + 1] += 1);
        for tile in 1..starts.len() {
            starts[tile] += starts[tile - 1];
        }
        let mut next = starts.clone();
        let mut pieces = vec![0; starts.last().map_or(0, |&n| n as usize)];
        for_each(&mut |tile, i| {
            pieces[next[tile] as usize] = i;
            next[tile] += 1;
        });
        Self { starts, pieces }
    }
}

/// The squares that the piece between two vertices may reach into.
fn touched(a: &Vertex, b: &Vertex, across: usize, down: usize) -> impl Iterator<Item = usize> {
    let (p, q) = (a.position, b.position);
    let reach = a.radius.max(b.radius) + 1.0;
    let edge = EDGE as f32;
    let squares = |low: f32, high: f32, count: usize| {
        let first = index(floor((low - reach) / edge));
        let behind = index(floor((high + reach) / edge).saturating_add(1)).min(count);
        first..behind.max(first)
    };
    let there = (p + q).is_finite() && reach.is_finite();
    let columns = if there { squares(p.x.min(q.x), p.x.max(q.x), across) } else { 0..0 };
    let rows = if there { squares(p.y.min(q.y), p.y.max(q.y), down) } else { 0..0 };
    rows.flat_map(move |row| columns.clone().map(move |column| row * across + column))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn every_piece_is_in_every_square_it_reaches(
            points in prop::collection::vec((-50.0_f32..400.0, -50.0_f32..300.0), 2..300),
        ) {
            let vertex = |&(x, y): &(f32, f32)| {
                Vertex { position: Vec3::new(x, y, 0.0), radius: 0.5, value: 0.0 }
            };
            let vertices: Vec<Vertex> = points.iter().map(vertex).collect();
            let n = vertices.len();
            let strands = Strands::from_counts(vec![1; n], vertices).expect("one point a strand");
            let tiles = Tiles::new(&strands, Size::new(300, 200));
            for (i, ends) in points.windows(2).enumerate() {
                for (x, y) in ends {
                    if (0.0..300.0).contains(x) && (0.0..200.0).contains(y) {
                        let square = |v: &f32| index(floor(v / EDGE as f32));
                        let tile = square(y) * tiles.across + square(x);
                        let i = u32::try_from(i).expect("few pieces");
                        prop_assert_eq!(tiles.pieces(tile).filter(|&p| p == i).count(), 1);
                    }
                }
            }
        }
    }
}
