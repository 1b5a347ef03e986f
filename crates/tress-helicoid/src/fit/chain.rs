//! The chain under fit, its residuals and their derivatives.
//!
//! A change of a parameter of one piece moves all that lies behind the piece as a rigid body. With
//! the body's motion written as `v + omega x p`, a point behind costs one cross product a
//! parameter, and no table of transformations is needed.
//!
//! Pieces are bent through `a = kT` and `c = alpha kT`, the two components of their curvature at
//! the beginning: the hair is smooth in those where `alpha` runs away, which is where it bends
//! straight out of the plane. A fifth unknown is the logarithm of the piece's length, because the
//! length of a curve is not known from a few of its points.

use glam::DVec3;
use tress_geometry::Frame;

use super::flow::{Along, End, walk};
use crate::{Helicoid, Piece};

/// Unknowns of a piece: `a, c, kN, kB` and the logarithm of its length.
pub(super) const OF_PIECE: usize = 5;

/// Unknowns of the root: a turn about each axis.
pub(super) const OF_ROOT: usize = 3;

/// `|kT|` is at least this part of `|c|`, so that `alpha = c / kT` stays a number.
const LEAST_KT: f64 = 1e-3;

/// Bounds of `kN` over the piece: below -1 the line would run into its singular line, and from 4 on
/// it is straight but for its first fifth.
pub(crate) const KN: (f64, f64) = (-0.8, 4.0);

/// Bound of `|kB|` over the piece.
const KB: f64 = 3.0;

/// What is nearer to a bound than this stands at it.
const NEXT_TO: f64 = 1e-6;

/// Pieces under fit, in the normal form of the target.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) root: Frame,
    pub(super) pieces: Vec<Piece>,
    /// Arc lengths of the target where pieces begin, and where the last ends.
    pub(super) breaks: Vec<f64>,
    /// Radians that its flow may turn in one step of tracing.
    pub(super) turn: f64,
}

/// The points that a chain is to pass, and their arc lengths on the target, ascending behind the
/// chain's beginning.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points<'a> {
    pub(super) positions: &'a [DVec3],
    pub(super) arc_lengths: &'a [f64],
    /// How many points in a row are passed on the average only: 1 where each counts.
    pub(super) window: usize,
    /// The direction that the chain is to end with, and the length that a radian off it counts as.
    pub(super) end: Option<(DVec3, f64)>,
}

impl Points<'_> {
    /// Whether point `i` is the last of its window.
    fn closes(&self, i: usize) -> bool {
        (i + 1).is_multiple_of(self.window) || i + 1 == self.positions.len()
    }

    /// How many points there are to a piece.
    pub(super) fn per_piece(&self, chain: &Chain) -> f64 {
        self.positions.len() as f64 / chain.pieces.len() as f64
    }

    /// What a sum over a window is multiplied by: a window that is off by a distance throughout
    /// costs as much as its points would.
    fn of_sum(&self) -> f64 {
        (self.window as f64).sqrt().recip()
    }
}

/// A motion of everything behind a piece, by one unknown: `v + omega x p`.
#[derive(Clone, Copy, Debug, Default)]
struct Motion {
    velocity: DVec3,
    turning: DVec3,
}

impl Motion {
    fn at(&self, p: DVec3) -> DVec3 {
        self.velocity + self.turning.cross(p)
    }

    /// That moves `p` by `moved` and turns by `turning`.
    fn through(p: DVec3, moved: DVec3, turning: DVec3) -> Self {
        Self { velocity: moved - turning.cross(p), turning }
    }
}

/// `(a, c)` as parameters of a helicoid with the curvature `scale` where there is no bend at all.
pub(super) fn bent(a: f64, c: f64, kn: f64, kb: f64, scale: f64) -> Helicoid {
    let least = (LEAST_KT * c.abs()).max(1e-6 * scale);
    let kt = if a.abs() < least { least.copysign(a) } else { a };
    Helicoid::new(kt, kn, kb, c / kt)
}

impl Chain {
    /// The pieces' points in turn, then the piece's end; `None` at a singular line.
    ///
    /// `visit` gets the point's index, the piece's index and base, and the place on its line.
    fn walk<const N: usize>(
        &self,
        points: Points<'_>,
        mut visit: impl FnMut(usize, usize, &Frame, &Along<N>),
        mut ended: impl FnMut(usize, &Frame, &End<N>),
    ) -> Option<Frame> {
        let mut base = self.root;
        let mut first = 0;
        for (j, piece) in self.pieces.iter().enumerate() {
            let (begins, ends) = (self.breaks[j], self.breaks[j + 1]);
            let rest = &points.arc_lengths[first..];
            let last = j + 1 == self.pieces.len();
            let count = if last { rest.len() } else { rest.partition_point(|&s| s <= ends) };
            let stretch = piece.length / (ends - begins);
            let stops = rest[..count].iter().map(|s| ((s - begins) * stretch).max(0.0));
            let mut i = first;
            let end = walk::<N>(&piece.k, piece.length, self.turn, stops, |along| {
                visit(i, j, &base, &along);
                i += 1;
            })?;
            ended(j, &base, &end);
            base = Frame {
                position: base.position + base.axes * end.position,
                axes: base.axes * piece.k.frame(end.theta),
            };
            first += count;
        }
        Some(base)
    }

    /// Where the chain passes the points, appended to `positions`, and the frame at its tip.
    pub(super) fn trace(&self, points: Points<'_>, positions: &mut Vec<DVec3>) -> Option<Frame> {
        self.walk::<0>(
            points,
            |_, _, base, here| positions.push(base.position + base.axes * here.position),
            |_, _, _| (),
        )
    }

    /// Directions of the chain where it passes the points.
    pub(super) fn tangents(&self, points: Points<'_>) -> Vec<DVec3> {
        let mut tangents = Vec::with_capacity(points.positions.len());
        self.walk::<0>(
            points,
            |_, _, base, here| tangents.push(base.axes * here.direction),
            |_, _, _| (),
        );
        tangents
    }

    /// Sum of squared distances from the points (and of the end's direction); infinite where the
    /// chain is singular.
    pub(super) fn cost(&self, points: Points<'_>) -> f64 {
        let (mut sum, mut off) = (0.0, DVec3::ZERO);
        let whole = self.walk::<0>(
            points,
            |i, _, base, here| {
                off += base.position + base.axes * here.position - points.positions[i];
                if points.closes(i) {
                    sum += (points.of_sum() * off).length_squared();
                    off = DVec3::ZERO;
                }
            },
            |_, _, _| (),
        );
        let Some(tip) = whole else { return f64::INFINITY };
        let turned = points.end.map(|(wanted, lever)| lever * (tip.tangent() - wanted));
        sum + turned.map_or(0.0, DVec3::length_squared)
    }

    /// How many unknowns there are.
    pub(super) fn unknowns(&self, free_root: bool) -> usize {
        self.pieces.len() * OF_PIECE + if free_root { OF_ROOT } else { 0 }
    }

    /// Residuals with their derivatives: `take` gets a residual and how it changes with the first
    /// unknowns; those behind do not change it. `None` at a singular line.
    pub(super) fn linearize(
        &self,
        points: Points<'_>,
        free_root: bool,
        mut take: impl FnMut(DVec3, &[DVec3]),
    ) -> Option<()> {
        // Both closures of the walk carry the motions on; they never run at the same time.
        let motions = std::cell::RefCell::new(Vec::with_capacity(self.unknowns(free_root)));
        if free_root {
            let axes = self.root.axes;
            let turns = [axes.x_axis, axes.y_axis, axes.z_axis];
            let root = self.root.position;
            motions.borrow_mut().extend(turns.map(|t| Motion::through(root, DVec3::ZERO, t)));
        }
        let mut columns: Vec<DVec3> = Vec::with_capacity(self.unknowns(free_root));
        let mut off = DVec3::ZERO;
        let tip = self.walk::<4>(
            points,
            |i, j, base, here| {
                let position = base.position + base.axes * here.position;
                let motions = motions.borrow();
                columns.resize(motions.len() + OF_PIECE, DVec3::ZERO);
                let (before, own) = columns.split_at_mut(motions.len());
                for (column, motion) in before.iter_mut().zip(motions.iter()) {
                    *column += motion.at(position);
                }
                let k = &self.pieces[j].k;
                let part = (points.arc_lengths[i] - self.breaks[j])
                    / (self.breaks[j + 1] - self.breaks[j]);
                let stretch = part.min(1.0) * self.pieces[j].length * here.direction;
                let by = unknowns_of(k, here.by_k);
                for (column, &v) in own.iter_mut().zip(by.iter().chain([&stretch])) {
                    *column += base.axes * v;
                }
                off += position - points.positions[i];
                if points.closes(i) {
                    columns.iter_mut().for_each(|column| *column *= points.of_sum());
                    take(points.of_sum() * off, &columns);
                    columns.clear();
                    off = DVec3::ZERO;
                }
            },
            |j, base, here| {
                let k = &self.pieces[j].k;
                let position = base.position + base.axes * here.position;
                let turning = here.turning(k);
                let (by, turns) = (unknowns_of(k, here.by_k), unknowns_of(k, turning));
                let motion = |moved: DVec3, turned: DVec3| {
                    Motion::through(position, base.axes * moved, base.axes * turned)
                };
                let frame = k.frame(here.theta);
                let q = k.curvatures(here.position, here.theta).unwrap_or_default();
                let l = self.pieces[j].length;
                let mut motions = motions.borrow_mut();
                motions.extend(by.iter().zip(&turns).map(|(&v, &w)| motion(v, w)));
                motions.push(motion(l * frame.x_axis, l * (frame * q)));
            },
        )?;
        if let Some((wanted, lever)) = points.end {
            let t = tip.tangent();
            columns.clear();
            columns.extend(motions.borrow().iter().map(|motion| lever * motion.turning.cross(t)));
            take(lever * (t - wanted), &columns);
        }
        Some(())
    }

    /// The unknowns, counted from the first of piece `i`, that stand at a bound beyond which a step
    /// against `gradient` would lead.
    pub(super) fn at_bounds(&self, i: usize, gradient: &[f64]) -> [bool; OF_PIECE] {
        let Piece { k, length } = self.pieces[i];
        let held = |value: f64, (least, most): (f64, f64), slope: f64| {
            let value = value * length;
            (value <= least + NEXT_TO && 0.0 < slope) || (most - NEXT_TO <= value && slope < 0.0)
        };
        [false, false, held(k.kn, KN, gradient[2]), held(k.kb, (-KB, KB), gradient[3]), false]
    }

    /// The chain with all unknowns moved by a step.
    pub(super) fn moved(&self, free_root: bool, step: &[f64]) -> Self {
        let mut moved = self.clone();
        let mut rest = step;
        if free_root && let Some((turn, behind)) = rest.split_first_chunk::<OF_ROOT>() {
            let turn = self.root.axes * DVec3::from_array(*turn);
            let turned =
                glam::DQuat::from_scaled_axis(turn) * glam::DQuat::from_mat3(&self.root.axes);
            moved.root.axes = glam::DMat3::from_quat(turned.normalize());
            rest = behind;
        }
        let steps = rest.as_chunks::<OF_PIECE>().0;
        for (piece, &[a, c, kn, kb, stretch]) in moved.pieces.iter_mut().zip(steps) {
            let k = piece.k;
            piece.length *= stretch.clamp(-0.5, 0.5).exp();
            let scale = 1.0 / piece.length;
            let kn = (k.kn + kn).clamp(KN.0 * scale, KN.1 * scale);
            let kb = (k.kb + kb).clamp(-KB * scale, KB * scale);
            piece.k = bent(k.kt + a, k.alpha * k.kt + c, kn, kb, scale);
        }
        moved
    }
}

/// Derivatives by `kT, kN, kB, alpha` as derivatives by `a, c, kN, kB`.
fn unknowns_of(k: &Helicoid, by: [DVec3; 4]) -> [DVec3; 4] {
    let [kt, kn, kb, alpha] = by;
    let c = alpha / k.kt;
    [kt - k.alpha * c, c, kn, kb]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::flow::FINE;

    #[test]
    fn derivatives_are_those_of_the_whole_chain() {
        let piece = |kt, kn, kb, alpha| Piece { k: Helicoid::new(kt, kn, kb, alpha), length: 0.4 };
        let chain = Chain {
            root: Frame::along(DVec3::ZERO, DVec3::ONE).expect("a direction"),
            pieces: vec![
                piece(2.0, 0.1, 0.4, 0.5),
                piece(-1.5, -0.2, 0.3, 2.0),
                piece(1.0, 0.0, 0.0, -0.7),
            ],
            breaks: vec![0.0, 0.4, 0.7, 1.0],
            turn: FINE,
        };
        let arc_lengths: Vec<f64> = (1..=20).map(|i| f64::from(i) / 20.0).collect();
        let positions = vec![DVec3::ZERO; 20];
        let points =
            Points { positions: &positions, arc_lengths: &arc_lengths, window: 1, end: None };
        let n = chain.unknowns(true);
        let e = 1e-6;
        let mut rows: Vec<(DVec3, Vec<DVec3>)> = Vec::new();
        chain.linearize(points, true, |r, by| rows.push((r, by.to_vec()))).expect("clear");
        let at = |step: &[f64]| {
            let mut traced = Vec::new();
            chain.moved(true, step).trace(points, &mut traced).expect("clear");
            traced
        };
        for j in 0..n {
            let mut step = vec![0.0; n];
            step[j] = e;
            let up = at(&step);
            step[j] = -e;
            let down = at(&step);
            for (i, (residual, by)) in rows.iter().enumerate() {
                let slope = (up[i] - down[i]) / (2.0 * e);
                let known = by.get(j).copied().unwrap_or_default();
                assert!(slope.distance(known) < 1e-4, "unknown {j}, point {i}: {slope} {known}");
                assert!(residual.is_finite());
            }
        }
    }
}
