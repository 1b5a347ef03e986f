//! How much hair lies where, and how much light gets through it.
//!
//! Hair shadows hair: without it, a head is a flat tangle. Single shadows of thousands of thin
//! fibres are below a pixel, what the eye sees is how deep in the volume a fibre lies. So the hair
//! is counted into a grid of cubic cells as an extinction coefficient, the projected area of fibre
//! in a unit of volume,
//!
//! `sigma = (pi / 4) sum(length * width) / cell^3`
//!
//! (the mean over directions), and the light that reaches a place from direction `l` is
//! `exp(-tau)` with the optical depth `tau`, the integral of `sigma` towards the light. One sweep
//! over the grid gives `tau` everywhere: slice after slice, away from the light, a cell adds its
//! own half-way to what its neighbour towards the light has, which bilinear interpolation reads off
//! the slice before. The interpolation blurs shadows with distance, as scattering in hair does.

use std::ops::{Add, Mul, Sub};

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use tress_geometry::Strands;

use crate::flatten::Vertex;
use crate::num::{ceil_to_count, floor, index};

/// A quantity on a grid of cubic cells, in pixel space; read between cell centres.
#[derive(Clone, Debug)]
pub(crate) struct Grid<T = f32> {
    /// Where the first cell begins.
    origin: Vec3,
    /// A cell's edge, in pixels.
    cell: f32,
    // Invariant: at least 2 along each side.
    cells: [usize; 3],
    // Invariant: as many as cells; x runs fastest, then y.
    values: Vec<T>,
}

impl Grid {
    /// The extinction coefficient of the hair, on a grid of about `most` cells along its longest
    /// side.
    pub(crate) fn of_hair(strands: &Strands<Vertex>, most: u32) -> Self {
        let mut grid = Self::around(strands, most);
        let to_sigma = std::f32::consts::FRAC_PI_4 / grid.cell.powi(3);
        for strand in strands.iter() {
            for ends in strand.windows(2) {
                let [a, b] = [ends[0], ends[1]];
                let area = a.position.distance(b.position) * (a.radius + b.radius);
                if area.is_finite() {
                    let place = (0.5 * (a.position + b.position) - grid.origin) / grid.cell;
                    let [x, y, z] = place.to_array().map(|p| index(floor(p)));
                    let i = grid.index(x, y, z);
                    grid.values[i] += to_sigma * area;
                }
            }
        }
        grid
    }

    /// A grid of zeros around all vertices that are there, with a cell of air on every side.
    fn around(strands: &Strands<Vertex>, most: u32) -> Self {
        let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let boxes: Vec<(Vec3, Vec3)> = strands
            .points()
            .par_chunks(1 << 16)
            .map(|chunk| {
                let there = chunk.iter().map(|v| v.position).filter(|p| p.is_finite());
                there.fold(nothing, |(min, max), p| (min.min(p), max.max(p)))
            })
            .collect();
        let (min, max) = boxes.iter().fold(nothing, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let (min, extent) =
            if min.is_finite() { (min, max - min) } else { (Vec3::ZERO, Vec3::ZERO) };
        // A pixel at least: finer shadows would not be seen.
        let cell = (extent.max_element() / most as f32).max(1.0);
        let inner = extent.to_array().map(|e| ceil_to_count(f64::from(e / cell), most) as usize);
        let cells = inner.map(|n| n.max(1) + 2);
        let values = vec![0.0; cells.iter().product()];
        Self { origin: min - Vec3::splat(cell), cell, cells, values }
    }

    fn index(&self, x: usize, y: usize, z: usize) -> usize {
        let [nx, ny, nz] = self.cells;
        x.min(nx - 1) + nx * (y.min(ny - 1) + ny * z.min(nz - 1))
    }

    /// The same quantity in cells of twice the edge.
    pub(crate) fn coarser(&self) -> Self {
        let cells = self.cells.map(|n| n.div_ceil(2).max(2));
        let mut coarse = Self {
            origin: self.origin,
            cell: 2.0 * self.cell,
            cells,
            values: vec![0.0; cells.iter().product()],
        };
        let [nx, ny, _] = self.cells;
        for (i, row) in self.values.chunks_exact(nx).enumerate() {
            for (x, value) in row.iter().enumerate() {
                let j = coarse.index(x / 2, i % ny / 2, i / ny / 2);
                coarse.values[j] += 0.125 * value;
            }
        }
        coarse
    }

    /// The optical depth between each cell's centre and a light far away in direction `towards`,
    /// where this grid is the extinction coefficient.
    pub(crate) fn optical_depth(&self, towards: Vec3) -> Self {
        let l = towards.normalize_or(Vec3::Y);
        let main = l.abs().max_position();
        let [b, c] = [(main + 1) % 3, (main + 2) % 3];
        let [nx, ny, _] = self.cells;
        let strides = [1, nx, nx * ny];
        let half_step = 0.5 * self.cell / l[main].abs();
        let shift = Shift::new(l[b] / l[main].abs(), l[c] / l[main].abs());

        let (n_b, n_c) = (self.cells[b], self.cells[c]);
        let mut before = Slice::new(n_b, n_c);
        let mut behind = Slice::new(n_b, n_c);
        let mut depth = vec![0.0; self.values.len()];
        for step in 0..self.cells[main] {
            let slice = if 0.0 < l[main] { self.cells[main] - 1 - step } else { step };
            for i_c in 0..n_c {
                let row = slice * strides[main] + i_c * strides[c];
                for i_b in 0..n_b {
                    let i = row + i_b * strides[b];
                    let own = half_step * self.values[i];
                    let here = before.shifted(i_b, i_c, &shift) + own;
                    depth[i] = here;
                    behind.set(i_b, i_c, here + own);
                }
            }
            std::mem::swap(&mut before, &mut behind);
        }
        Self { values: depth, ..*self }
    }

    /// Two quantities on the same cells, side by side: what is read together lies together.
    pub(crate) fn beside(&self, other: &Self) -> Grid<Vec2> {
        let pairs = self.values.iter().zip(&other.values);
        let values = pairs.map(|(&a, &b)| Vec2::new(a, b)).collect();
        Grid { origin: self.origin, cell: self.cell, cells: self.cells, values }
    }

    /// The mean of `exp(-tau)` over directions with weights, where this grid is the extinction
    /// coefficient: the share of the sky that is seen from each cell.
    pub(crate) fn visibility(&self, directions: &[(Vec3, f32)]) -> Self {
        let total: f32 = directions.iter().map(|(_, weight)| weight).sum();
        let depths: Vec<Self> =
            directions.par_iter().map(|(towards, _)| self.optical_depth(*towards)).collect();
        let mut values = vec![0.0; self.values.len()];
        // Cell by cell in the order of the directions, so that threads do not change the sum.
        values.par_iter_mut().enumerate().with_min_len(1 << 14).for_each(|(i, value)| {
            for (depth, (_, weight)) in depths.iter().zip(directions) {
                *value += weight / total * (-depth.values[i]).exp();
            }
        });
        Self { values, ..*self }
    }
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f32, Output = T>> Grid<T> {
    /// The value at a place; outside of the grid, that of the nearest place inside.
    pub(crate) fn at(&self, place: Vec3) -> T {
        let g = (place - self.origin) / self.cell - 0.5;
        let [(x, fx), (y, fy), (z, fz)] = [0, 1, 2].map(|axis| {
            let last = self.cells[axis] - 2;
            let base = index(floor(g[axis])).min(last);
            (base, (g[axis] - base as f32).clamp(0.0, 1.0))
        });
        let [nx, ny, _] = self.cells;
        let i = x + nx * (y + ny * z);
        let v = &self.values;
        let along_x = |i: usize| v[i] + (v[i + 1] - v[i]) * fx;
        let along_y = |i: usize| {
            let (a, b) = (along_x(i), along_x(i + nx));
            a + (b - a) * fy
        };
        let (a, b) = (along_y(i), along_y(i + nx * ny));
        a + (b - a) * fz
    }
}

/// Where, in the slice before, the light of a cell comes from: one cell off at most, the same for
/// all cells of a slice.
struct Shift {
    offset: [usize; 2],
    weights: [f32; 4],
}

impl Shift {
    fn new(b: f32, c: f32) -> Self {
        let split = |x: f32| if x < 0.0 { (0, 1.0 + x) } else { (1, x) };
        let ((i_b, f_b), (i_c, f_c)) = (split(b), split(c));
        let (g_b, g_c) = (1.0 - f_b, 1.0 - f_c);
        Self { offset: [i_b, i_c], weights: [g_b * g_c, f_b * g_c, g_b * f_c, f_b * f_c] }
    }
}

/// One slice across a grid with a rim of zeros: no hair outside, no shadow.
struct Slice {
    width: usize,
    values: Vec<f32>,
}

impl Slice {
    fn new(n_b: usize, n_c: usize) -> Self {
        Self { width: n_b + 2, values: vec![0.0; (n_b + 2) * (n_c + 3)] }
    }

    fn set(&mut self, b: usize, c: usize, value: f32) {
        self.values[b + 1 + self.width * (c + 1)] = value;
    }

    fn shifted(&self, b: usize, c: usize, shift: &Shift) -> f32 {
        let i = b + shift.offset[0] + self.width * (c + shift.offset[1]);
        let [p, q, r, s] = shift.weights;
        let v = &self.values;
        p * v[i] + q * v[i + 1] + r * v[i + self.width] + s * v[i + self.width + 1]
    }
}

#[cfg(test)]
mod tests;
