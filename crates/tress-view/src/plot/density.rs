//! Many lines as a density: how many pass through each cell, and their quantiles.

use rayon::prelude::*;

/// A line: places along, which ascend, and values there.
#[derive(Clone, Copy, Debug)]
pub struct Line<'a> {
    /// Places along.
    pub x: &'a [f64],
    /// Values.
    pub y: &'a [f64],
}

/// How many lines pass through each cell of a grid, and quantiles of their values in each column.
///
/// Lines are read at the columns' middles; between neighbouring columns a line counts once in every
/// cell it crosses. Beyond its ends, and where a value is not finite, it does not count.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    x_range: [f64; 2],
    y_range: [f64; 2],
    /// Cells up, column after column.
    counts: Vec<u32>,
    /// At each column the 5, 25, 50, 75 and 95 % quantiles of the lines there.
    quantiles: Vec<Option<[f64; 5]>>,
}

/// Columns and rows of the grid: cells of two or three pixels, of which SVG files hold few enough.
const COLUMNS: usize = 240;
const ROWS: usize = 140;

/// The shares of lines below each of the quantiles.
const SHARES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

impl Density {
    /// Counts lines within a range along; up, the range holds all but the outermost half percent
    /// of the values, and 0 if it is near.
    #[must_use]
    pub fn of<'a>(lines: impl IntoIterator<Item = Line<'a>>, x_range: [f64; 2]) -> Self {
        let lines: Vec<Line<'a>> = lines.into_iter().collect();
        let at_columns: Vec<Vec<f64>> =
            lines.par_iter().map(|&line| sampled(line, x_range)).collect();
        let sorted = |column: usize| {
            let values = at_columns.iter().map(|line| line[column]);
            let mut sorted: Vec<f64> = values.filter(|value| value.is_finite()).collect();
            sorted.sort_unstable_by(f64::total_cmp);
            sorted
        };
        let columns: Vec<Vec<f64>> = (0..COLUMNS).into_par_iter().map(sorted).collect();
        let y_range = central_range(&columns);
        let mut counts = vec![0; COLUMNS * ROWS];
        counts.par_chunks_mut(ROWS).enumerate().for_each(|(column, cells)| {
            at_columns.iter().for_each(|line| count(line, column, y_range, cells));
        });
        Self { x_range, y_range, counts, quantiles: columns.iter().map(|c| quantiles(c)).collect() }
    }

    /// The range along.
    #[must_use]
    pub fn x_range(&self) -> [f64; 2] {
        self.x_range
    }

    /// The range up.
    #[must_use]
    pub fn y_range(&self) -> [f64; 2] {
        self.y_range
    }

    /// Places along and the 5, 25, 50, 75 and 95 % quantiles of the lines there, for the columns
    /// that lines reach.
    pub fn quantiles(&self) -> impl Iterator<Item = (f64, [f64; 5])> + '_ {
        let places = self.quantiles.iter().enumerate();
        places.filter_map(|(i, quantiles)| quantiles.map(|q| (self.column_middle(i), q)))
    }

    /// Runs of cells of one row that are as dark as each other: left, bottom, right and top, and
    /// how dark, 0 to 1 by the square root of the count.
    pub(crate) fn runs(&self) -> Vec<([f64; 4], f64)> {
        let most = self.counts.iter().copied().max().unwrap_or(0);
        let level = |count: u32| {
            let share = (f64::from(count) / f64::from(most.max(1))).sqrt();
            if count == 0 { 0 } else { crate::num::ceil_to_count(share * LEVELS, 255).max(1) }
        };
        let [width, height] = [self.x_range, self.y_range].map(|[a, b]| b - a);
        let mut runs = Vec::new();
        for row in 0..ROWS {
            let mut first = 0;
            for column in 0..COLUMNS {
                let here = level(self.counts[column * ROWS + row]);
                let next =
                    (column + 1 < COLUMNS).then(|| level(self.counts[(column + 1) * ROWS + row]));
                if next == Some(here) {
                    continue;
                }
                if 0 < here {
                    let x = |i: usize| self.x_range[0] + width * i as f64 / COLUMNS as f64;
                    let y = |i: usize| self.y_range[0] + height * i as f64 / ROWS as f64;
                    let cell = [x(first), y(row), x(column + 1), y(row + 1)];
                    runs.push((cell, f64::from(here) / LEVELS));
                }
                first = column + 1;
            }
        }
        runs
    }

    fn column_middle(&self, i: usize) -> f64 {
        let [low, high] = self.x_range;
        low + (high - low) * ((i as f64 + 0.5) / COLUMNS as f64)
    }
}

/// Shades that counts are told apart by.
const LEVELS: f64 = 24.0;

/// A line's values at the columns' middles; NaN where it has none.
fn sampled(line: Line<'_>, [low, high]: [f64; 2]) -> Vec<f64> {
    let n = line.x.len().min(line.y.len());
    let mut behind = 0;
    let at = |i: usize| {
        let x = low + (high - low) * ((i as f64 + 0.5) / COLUMNS as f64);
        while behind < n && line.x[behind] <= x {
            behind += 1;
        }
        if behind == 0 || behind == n {
            // The tip itself is still on the line.
            let on_tip = 0 < n && behind == n && line.x[n - 1] >= x;
            return if on_tip { line.y[n - 1] } else { f64::NAN };
        }
        let (a, b) = (line.x[behind - 1], line.x[behind]);
        let t = (x - a) / (b - a);
        line.y[behind - 1] + (line.y[behind] - line.y[behind - 1]) * t
    };
    (0..COLUMNS).map(at).collect()
}

/// Counts a line in the cells of a column that it crosses.
fn count(line: &[f64], column: usize, [low, high]: [f64; 2], cells: &mut [u32]) {
    let value = line[column];
    if !value.is_finite() {
        return;
    }
    // Half way to either neighbour, so that steep lines have no gaps.
    let half = |other: Option<&f64>| match other {
        Some(other) if other.is_finite() => 0.5 * (value + other),
        _ => value,
    };
    let before = half(column.checked_sub(1).and_then(|i| line.get(i)));
    let behind = half(line.get(column + 1));
    let ends = [before, value, behind].map(|value| ROWS as f64 * (value - low) / (high - low));
    let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let most = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if most < 0.0 || ROWS as f64 <= least {
        return;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held to rows")]
    let (first, last) = (least.max(0.0) as usize, most.min(ROWS as f64 - 1.0) as usize);
    cells[first..=last].iter_mut().for_each(|cell| *cell += 1);
}

/// The range of nearly all values of sorted columns.
fn central_range(columns: &[Vec<f64>]) -> [f64; 2] {
    let mut all: Vec<f64> = columns.iter().flatten().copied().collect();
    let Some(last) = all.len().checked_sub(1) else { return [0.0, 1.0] };
    let stray = all.len() / 200;
    let mut ranked = |rank: usize| *all.select_nth_unstable_by(rank, f64::total_cmp).1;
    let (mut low, mut high) = (ranked(stray), ranked(last - stray));
    let width = high - low;
    if 0.0 < low && low < 1.5 * width {
        low = 0.0;
    }
    if high < 0.0 && -high < 1.5 * width {
        high = 0.0;
    }
    if high - low <= 1e-9 * high.abs().max(low.abs()) {
        let half = if high == 0.0 { 1.0 } else { 0.1 * high.abs() };
        return [low - half, high + half];
    }
    let air = 0.04 * (high - low);
    [if low == 0.0 { 0.0 } else { low - air }, if high == 0.0 { 0.0 } else { high + air }]
}

fn quantiles(sorted: &[f64]) -> Option<[f64; 5]> {
    let last = sorted.len().checked_sub(1)?;
    Some(SHARES.map(|share| {
        let place = share * last as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
        let i = place as usize;
        let (a, b) = (sorted[i], sorted[(i + 1).min(last)]);
        a + (b - a) * (place - i as f64)
    }))
}
