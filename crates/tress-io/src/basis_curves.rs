//! Batches of curves as USD's `BasisCurves` and Alembic's `ICurves` hold them, turned into points
//! that lie on the curves.
//!
//! Such a batch is one array of control points cut by counts, and says once for all curves what
//! the points mean: a type (linear or a cubic basis) and a wrap (how a curve begins and ends).
//!
//! | type | wrap | on the curve are | what comes out |
//! |---|---|---|---|
//! | linear | any | all points | the points |
//! | Catmull-Rom | pinned | all points | the points |
//! | Catmull-Rom | nonperiodic | all but the first and last | the points between those |
//! | B-spline | any | none | the curve, evaluated |
//! | Bezier | any | every third | the curve, evaluated |
//!
//! A periodic curve closes: its first point comes out once more as its last. A curve with fewer
//! points than its basis needs has no place where it lies; its points come out as they are, so
//! that no strand is lost.
//!
//! # How densely a spline is evaluated
//!
//! What reads the points next puts a Catmull-Rom curve through them. With `n` points a turn that
//! curve leaves a circle of radius `r` by `r (1 - (9 cos(pi/n) - cos(3 pi/n)) / 8)`: 5 % of `r` at
//! `n = 5`, 0.35 % at 10, 0.023 % at 20. Real coils come with 5 control points a turn, so
//! [`SAMPLES_PER_CONTROL_POINT`] is 4: the B-spline of such a coil, which is no exact helix, is
//! met to 0.06 % of its radius.

mod join;
mod rows;
#[cfg(test)]
mod tests;

use std::collections::HashMap;

use glam::DVec3;
use tress_geometry::Column;
use tress_geometry::curves::CubicBasis;

pub(crate) use join::join;
pub(crate) use rows::{Rows, attach};

/// Points on an evaluated spline for each of its control points. With 2, a coil of 5 control
/// points a turn is off by a three-hundredth of its radius when it is made smooth again; more than
/// 4 only makes files longer.
pub(crate) const SAMPLES_PER_CONTROL_POINT: usize = 4;

/// What lies between control points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum CurveType {
    /// Straight segments.
    Linear,
    /// Cubic segments.
    Cubic(CubicBasis),
}

/// How a curve begins and ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Wrap {
    /// Where its first and last segments do.
    Nonperiodic,
    /// At its first and last control points.
    Pinned,
    /// Nowhere: it closes.
    Periodic,
}

/// Curves that share a type and a wrap.
#[derive(Debug)]
pub(crate) struct BasisCurves {
    kind: CurveType,
    wrap: Wrap,
    /// Control points of each curve.
    counts: Vec<usize>,
}

/// One point of the result, as a mix of control points and as a place between knots. Indices are
/// within the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    controls: [(usize, f64); 4],
    knots: (usize, usize),
    between: f64,
}

impl Place {
    /// Exactly control point `i`, which is knot `knot`.
    fn on(i: usize, knot: usize) -> Self {
        Self {
            controls: [(i, 1.0), (i, 0.0), (i, 0.0), (i, 0.0)],
            knots: (knot, knot),
            between: 0.0,
        }
    }
}

/// What one curve of `n` control points becomes.
enum Layout {
    /// The control points of a range, the first once more at the end if `closed`.
    Points { first: usize, count: usize, closed: bool },
    /// This many cubic segments, evaluated.
    Segments { basis: CubicBasis, count: usize },
}

impl BasisCurves {
    /// Curves of `counts` control points each.
    pub(crate) fn new(kind: CurveType, wrap: Wrap, counts: Vec<usize>) -> Self {
        Self { kind, wrap, counts }
    }

    /// How many curves there are.
    pub(crate) fn len(&self) -> usize {
        self.counts.len()
    }

    /// How many control points there are; counts too large to sum give `usize::MAX`.
    pub(crate) fn control_points(&self) -> usize {
        self.counts.iter().fold(0, |sum, &n| sum.saturating_add(n))
    }

    /// How many values an attribute has that is given at knots: both ends of every segment.
    pub(crate) fn knots(&self) -> usize {
        self.counts.iter().map(|&n| self.knots_of(n)).sum()
    }

    /// How many points each strand of the result has.
    pub(crate) fn strand_counts(&self) -> impl Iterator<Item = usize> {
        self.counts.iter().map(|&n| match self.layout(n) {
            Layout::Points { count, closed, .. } => count + usize::from(closed),
            Layout::Segments { basis, count } => count * samples_per_segment(basis) + 1,
        })
    }

    /// The points of the result.
    pub(crate) fn points(&self, controls: Vec<DVec3>) -> Vec<DVec3> {
        if self.keeps_every_point() {
            return controls;
        }
        let values = controls.iter().flat_map(DVec3::to_array).collect();
        match self.at_control_points(Column::Float { components: 3, values }) {
            Column::Float { values, .. } => values.chunks_exact(3).map(DVec3::from_slice).collect(),
            Column::Int(_) => Vec::new(),
        }
    }

    /// A column with one row a control point, at the points of the result. Positions are such a
    /// column. A whole number is taken from the control point with the greatest weight.
    pub(crate) fn at_control_points(&self, column: Column) -> Column {
        if self.keeps_every_point() {
            return column;
        }
        let rows = |n| n;
        match column {
            Column::Float { components, values } => {
                let mixed = self.mix(&values, components, rows, |place| place.controls);
                Column::Float { components, values: mixed }
            }
            Column::Int(values) => Column::Int(self.pick(&values, rows, |place| {
                let heaviest = place.controls.iter().max_by(|a, b| a.1.total_cmp(&b.1));
                heaviest.map_or(0, |control| control.0)
            })),
        }
    }

    /// A column with one row a knot (USD's `varying`), at the points of the result.
    pub(crate) fn at_knots(&self, column: Column) -> Column {
        if self.keeps_every_point() {
            return column;
        }
        let rows = |n| self.knots_of(n);
        match column {
            Column::Float { components, values } => {
                let mixed = self.mix(&values, components, rows, |place| {
                    let (a, b) = place.knots;
                    [(a, 1.0 - place.between), (b, place.between), (a, 0.0), (a, 0.0)]
                });
                Column::Float { components, values: mixed }
            }
            Column::Int(values) => Column::Int(self.pick(&values, rows, |place| {
                if place.between < 0.5 { place.knots.0 } else { place.knots.1 }
            })),
        }
    }

    fn keeps_every_point(&self) -> bool {
        self.wrap != Wrap::Periodic && self.kind == CurveType::Linear
            || self.wrap == Wrap::Pinned && self.kind == CurveType::Cubic(CubicBasis::CatmullRom)
    }

    fn mix(
        &self,
        values: &[f64],
        components: usize,
        rows: impl Fn(usize) -> usize,
        weights: impl Fn(&Place) -> [(usize, f64); 4],
    ) -> Vec<f64> {
        let mut mixed = Vec::new();
        self.visit(rows, |base, place| {
            let start = mixed.len();
            mixed.resize(start + components, 0.0);
            // A weight of 0 does not let a value in that is not a number.
            for (i, weight) in weights(place).into_iter().filter(|(_, weight)| *weight != 0.0) {
                let row = &values[(base + i) * components..][..components];
                for (sum, value) in mixed[start..].iter_mut().zip(row) {
                    *sum += weight * value;
                }
            }
        });
        mixed
    }

    fn pick(
        &self,
        values: &[i64],
        rows: impl Fn(usize) -> usize,
        index: impl Fn(&Place) -> usize,
    ) -> Vec<i64> {
        let mut picked = Vec::new();
        self.visit(rows, |base, place| picked.push(values[base + index(place)]));
        picked
    }

    /// Calls `visit` for every point of the result, with where its curve's rows begin in a column
    /// that has `rows(n)` of them for a curve of `n` control points.
    fn visit(&self, rows: impl Fn(usize) -> usize, mut visit: impl FnMut(usize, &Place)) {
        // Most grooms have strands of a few lengths only.
        let mut known: HashMap<usize, Vec<Place>> = HashMap::new();
        let mut base = 0;
        for &n in &self.counts {
            let places = known.entry(n).or_insert_with(|| self.places(n));
            places.iter().for_each(|place| visit(base, place));
            base += rows(n);
        }
    }

    fn layout(&self, n: usize) -> Layout {
        use CubicBasis::{BSpline, Bezier, CatmullRom};
        let as_they_are = Layout::Points { first: 0, count: n, closed: false };
        match (self.kind, self.wrap) {
            (CurveType::Linear | CurveType::Cubic(CatmullRom), Wrap::Periodic) if 3 <= n => {
                Layout::Points { first: 0, count: n, closed: true }
            }
            (CurveType::Cubic(CatmullRom), Wrap::Nonperiodic) if 4 <= n => {
                Layout::Points { first: 1, count: n - 2, closed: false }
            }
            (CurveType::Cubic(BSpline), Wrap::Nonperiodic) if 4 <= n => {
                Layout::Segments { basis: BSpline, count: n - 3 }
            }
            (CurveType::Cubic(BSpline), Wrap::Pinned) if 2 <= n => {
                Layout::Segments { basis: BSpline, count: n - 1 }
            }
            (CurveType::Cubic(BSpline), Wrap::Periodic) if 3 <= n => {
                Layout::Segments { basis: BSpline, count: n }
            }
            (CurveType::Cubic(Bezier), Wrap::Periodic) if 3 <= n && n.is_multiple_of(3) => {
                Layout::Segments { basis: Bezier, count: n / 3 }
            }
            (CurveType::Cubic(Bezier), Wrap::Nonperiodic | Wrap::Pinned)
                if 4 <= n && n % 3 == 1 =>
            {
                Layout::Segments { basis: Bezier, count: (n - 1) / 3 }
            }
            _ => as_they_are,
        }
    }

    fn knots_of(&self, n: usize) -> usize {
        match self.layout(n) {
            Layout::Points { count, .. } => count,
            Layout::Segments { count, .. } => count + usize::from(self.wrap != Wrap::Periodic),
        }
    }

    fn places(&self, n: usize) -> Vec<Place> {
        match self.layout(n) {
            Layout::Points { first, count, closed } => {
                let kept = (0..count).map(|i| Place::on(first + i, i));
                kept.chain(closed.then(|| Place::on(first, 0))).collect()
            }
            Layout::Segments { basis, count } => {
                let per_segment = samples_per_segment(basis);
                let knots = self.knots_of(n);
                let place = |sample: usize| {
                    // The last sample is the end of the last segment.
                    let segment = (sample / per_segment).min(count - 1);
                    let t = (sample - segment * per_segment) as f64 / per_segment as f64;
                    Place {
                        controls: self.controls(basis, segment, t, n),
                        knots: (segment, (segment + 1) % knots),
                        between: t,
                    }
                };
                (0..=count * per_segment).map(place).collect()
            }
        }
    }

    /// The control points that make the point at `t` of a segment, with their weights.
    fn controls(&self, basis: CubicBasis, segment: usize, t: f64, n: usize) -> [(usize, f64); 4] {
        let weights = basis.weights(t);
        let first = segment * basis.step();
        if !(self.wrap == Wrap::Pinned && basis == CubicBasis::BSpline) {
            return std::array::from_fn(|k| ((first + k) % n, weights[k]));
        }
        // A pinned B-spline has its ends mirrored: the point before the first is 2 P0 - P1. What
        // it weighs goes to those two.
        let [before, a, b, after] = weights;
        let mut controls = [(segment, a), (segment + 1, b), (segment, 0.0), (segment, 0.0)];
        match segment.checked_sub(1) {
            Some(previous) => controls[2] = (previous, before),
            None => {
                controls[0].1 += 2.0 * before;
                controls[1].1 -= before;
            }
        }
        if segment + 2 < n {
            controls[3] = (segment + 2, after);
        } else {
            controls[1].1 += 2.0 * after;
            controls[0].1 -= after;
        }
        controls
    }
}

fn samples_per_segment(basis: CubicBasis) -> usize {
    basis.step() * SAMPLES_PER_CONTROL_POINT
}
