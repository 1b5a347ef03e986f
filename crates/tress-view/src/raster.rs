//! One piece of hair on the pixels: how much of each it covers.
//!
//! Hair is thinner than a pixel, so what counts is coverage. A pixel's value is a weighted mean
//! around its centre, with the tent `1 - |x|` across the hair: the weights of all pixels add up to
//! one wherever the hair lies, so a thin hair neither sparkles nor beads as it crosses the rows.
//! With the tent's integral `H`, a hair of half-width `h` whose axis passes at distance `d` covers
//!
//! `H(d + h) - H(d - h)`.
//!
//! Along the hair, pieces divide the pixels among them at their joints, by the line that halves the
//! angle between neighbours: a pixel belongs to one piece, none is drawn twice and none left out.

use glam::{Vec2, Vec3, Vec3Swizzles};

use crate::flatten::Vertex;

/// The integral of the tent from minus infinity.
fn tent_integral(x: f32) -> f32 {
    if x <= -1.0 {
        0.0
    } else if x <= 0.0 {
        0.5 * (1.0 + x) * (1.0 + x)
    } else if x < 1.0 {
        1.0 - 0.5 * (1.0 - x) * (1.0 - x)
    } else {
        1.0
    }
}

/// Neighbouring pieces that turn by more than this (the cosine of the angle) end for themselves.
const SHARP: f32 = 0.2;

/// A straight piece of hair between two vertices, ready to be drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    ends: [Vec2; 2],
    radii: [f32; 2],
    /// Unit vectors along the hair at the ends, across which the pixels are divided.
    cuts: [Vec2; 2],
    /// Whether the hair ends here.
    caps: [bool; 2],
    /// Unit vector across the hair.
    across: Vec2,
}

/// What a piece covers of one pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fragment {
    /// Column and row.
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// Share of the pixel that is covered.
    pub(crate) coverage: f32,
    /// Place along the piece, 0 to 1.
    pub(crate) along: f32,
    /// Place across the hair, 0 on its axis and 1 at its edges or beyond.
    pub(crate) off_axis: f32,
    /// Half of the width here.
    pub(crate) radius: f32,
}

/// Unit tangent of the hair at vertex `i`, from root to tip; zero where there is none.
pub(crate) fn tangent(vertices: &[Vertex], i: usize) -> Vec3 {
    let step = |a: usize, b: usize| {
        let ends = vertices.get(a).zip(vertices.get(b));
        let along = ends.map_or(Vec3::ZERO, |(a, b)| b.position - a.position);
        if along.is_finite() { along.normalize_or_zero() } else { Vec3::ZERO }
    };
    (step(i.wrapping_sub(1), i) + step(i, i + 1)).normalize_or_zero()
}

impl Piece {
    /// The piece between vertices `i` and `i + 1`, unless it is too short to be seen.
    pub(crate) fn new(vertices: &[Vertex], i: usize) -> Option<Self> {
        let place = |i: usize| vertices.get(i).map_or(Vec2::NAN, |v| v.position.xy());
        let direction = |i: usize| {
            let along = place(i.wrapping_add(1)) - place(i);
            if along.is_finite() { along.normalize_or_zero() } else { Vec2::ZERO }
        };
        let here = direction(i);
        if here == Vec2::ZERO {
            return None;
        }
        let cut = |neighbour: Vec2| {
            if here.dot(neighbour) < SHARP {
                (here, true)
            } else {
                ((here + neighbour).normalize_or(here), false)
            }
        };
        let (first, last) = (cut(direction(i.wrapping_sub(1))), cut(direction(i + 1)));
        Some(Self {
            ends: [place(i), place(i + 1)],
            radii: [vertices[i].radius, vertices[i + 1].radius],
            cuts: [first.0, last.0],
            caps: [first.1, last.1],
            across: here.perp(),
        })
    }

    /// Calls `put` for every pixel with some coverage, of columns and rows `x` and `y`.
    pub(crate) fn cover(
        &self,
        x: std::ops::Range<i32>,
        y: std::ops::Range<i32>,
        mut put: impl FnMut(Fragment),
    ) {
        let [a, b] = self.ends;
        let reach = self.radii[0].max(self.radii[1]) + 1.0;
        let (low, high) = (a.min(b) - reach, a.max(b) + reach);
        let columns = clip(low.x, high.x, &x);
        for row in clip(low.y, high.y, &y) {
            let center_y = row as f32 + 0.5;
            // |(p - a) . across| < reach, solved for x.
            let at_a = (center_y - a.y) * self.across.y;
            let columns = if self.across.x.abs() < 1e-3 {
                columns.clone()
            } else {
                let p = a.x + (-reach - at_a) / self.across.x;
                let q = a.x + (reach - at_a) / self.across.x;
                clip(p.min(q), p.max(q), &columns)
            };
            for column in columns {
                let p = Vec2::new(column as f32 + 0.5, center_y);
                if let Some((coverage, along, off_axis, radius)) = self.at(p) {
                    put(Fragment { x: column, y: row, coverage, along, off_axis, radius });
                }
            }
        }
    }

    /// Coverage, place along, place across and half-width for a pixel centred at `p`.
    fn at(&self, p: Vec2) -> Option<(f32, f32, f32, f32)> {
        let [a, b] = self.ends;
        let behind = (p - a).dot(self.cuts[0]);
        let before = (b - p).dot(self.cuts[1]);
        let mut share = 1.0;
        for (inside, cap) in [(behind, self.caps[0]), (before, self.caps[1])] {
            if cap {
                share *= tent_integral(inside);
            } else if inside < 0.0 {
                return None;
            }
        }
        // The second cut is open: a centre on a joint belongs to the piece behind it.
        if before == 0.0 && !self.caps[1] {
            return None;
        }
        let along = (behind / (behind + before)).clamp(0.0, 1.0);
        let radius = self.radii[0] + (self.radii[1] - self.radii[0]) * along;
        let d = (p - a).dot(self.across);
        let covered = tent_integral(d + radius) - tent_integral(d - radius);
        let coverage = share * covered;
        (0.0 < coverage).then(|| (coverage, along, (d.abs() / radius).min(1.0), radius))
    }
}

/// Pixels whose centres lie between `low` and `high`, of those in `range`.
fn clip(low: f32, high: f32, range: &std::ops::Range<i32>) -> std::ops::Range<i32> {
    let first = crate::num::floor(low + 0.5).max(range.start);
    let behind = crate::num::floor(high + 0.5).min(range.end);
    first..behind.max(first)
}

#[cfg(test)]
mod tests;
