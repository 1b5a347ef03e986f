//! Gauss-Newton with Levenberg's and Marquardt's damping, on the unknowns of a chain.

use glam::DVec3;
use nalgebra::{DMatrix, DVector};

use super::chain::{Chain, OF_PIECE, OF_ROOT, Points};
use crate::{Helicoid, Piece};

/// How much further a fit is driven.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Steps at most.
    pub(super) steps: usize,
    /// It ends with a step that takes less than this part of the cost away.
    pub(super) gain: f64,
}

/// What is asked beside passing the points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prior {
    /// A curvature of one over the piece's length costs as much as this distance, in lengths of the
    /// piece, at each point.
    pub(super) curvature: f64,
    /// A piece longer by a factor of e costs as much as this distance, in lengths of the piece, at
    /// each point.
    pub(super) stretch: f64,
    /// A curvature that differs from what it was at the start by one over the piece's length costs
    /// as much.
    pub(super) keep: f64,
    /// Whether the root may turn.
    pub(super) free_root: bool,
    /// Whether it may turn about its tangent.
    pub(super) free_roll: bool,
}

/// The normal equations of a chain.
struct Normal {
    matrix: DMatrix<f64>,
    gradient: DVector<f64>,
    cost: f64,
}

/// What the chain is compared with: itself at the start.
struct Rest {
    lengths: Vec<f64>,
    curvatures: Vec<[f64; 4]>,
}

impl Rest {
    fn new(chain: &Chain) -> Self {
        Self {
            lengths: chain.pieces.iter().map(|piece| piece.length).collect(),
            curvatures: chain.pieces.iter().map(|piece| curvatures(&piece.k)).collect(),
        }
    }
}

/// The unknowns of a piece that are curvatures: `a, c, kN, kB`.
fn curvatures(k: &Helicoid) -> [f64; 4] {
    [k.kt, k.alpha * k.kt, k.kn, k.kb]
}

/// What one piece adds to the cost: a weight times the square of each unknown's distance from a
/// place.
struct Pull {
    weights: [f64; OF_PIECE],
    gradient: [f64; OF_PIECE],
    cost: f64,
}

impl Pull {
    /// Of piece `i`; `each` is how many points there are to a piece.
    fn new(chain: &Chain, prior: Prior, rest: &Rest, i: usize, each: f64) -> Self {
        let Piece { k, length } = chain.pieces[i];
        let l = rest.lengths[i];
        let own = each * (prior.curvature * l * l).powi(2);
        let own = [BEND * own, BEND * own, own, own * (1.0 + k.alpha * k.alpha)];
        let kept = each * (prior.keep * l * l).powi(2);
        let mut pull = Self { weights: [0.0; OF_PIECE], gradient: [0.0; OF_PIECE], cost: 0.0 };
        for (j, (value, before)) in curvatures(&k).into_iter().zip(rest.curvatures[i]).enumerate() {
            pull.add(j, own[j], value);
            pull.add(j, kept, value - before);
        }
        pull.add(4, each * (prior.stretch * l).powi(2), (length / l).ln());
        pull
    }

    fn add(&mut self, unknown: usize, weight: f64, off: f64) {
        self.weights[unknown] += weight;
        self.gradient[unknown] += weight * off;
        self.cost += weight * off * off;
    }
}

/// Damping of the first step: with less, the first steps from a rough beginning lead too far and
/// are taken back.
const FIRST_DAMPING: f64 = 1e-2;

/// Damping beyond which no step helps any more.
const MOST_DAMPING: f64 = 1e7;

/// A refinement ends without trying a step that promises less than this part of the gain it would
/// have to make.
const UNPROMISING: f64 = 0.2;

/// What the bend costs over what `kN` and `kB` cost: the points tell it better than those.
const BEND: f64 = 1e-4;

/// Weight of an unknown that is not to change.
const HELD: f64 = 1e12;

/// Squared distances below this part of a squared unit are rounding.
const EXACT: f64 = 1e-26;

/// Moves the chain towards the points until nothing is gained; false where it is singular.
pub(super) fn refine(chain: &mut Chain, points: Points<'_>, prior: Prior, effort: Effort) -> bool {
    let rest = Rest::new(chain);
    let mut damping = FIRST_DAMPING;
    for _ in 0..effort.steps {
        let Some(normal) = Normal::of(chain, points, prior, &rest) else { return false };
        if normal.cost < EXACT {
            return true;
        }
        // Steps in vain raise the damping ever faster (Nielsen, "Damping parameter in Marquardt's
        // method", 1999).
        let mut growth = 4.0;
        let gained = loop {
            if MOST_DAMPING < damping {
                return true;
            }
            if let Some((step, promised)) = normal.step(damping) {
                if promised < UNPROMISING * effort.gain * normal.cost {
                    return true;
                }
                let moved = chain.moved(prior.free_root, step.as_slice());
                let cost = moved.cost(points) + penalty(&moved, points, prior, &rest);
                if cost < normal.cost {
                    *chain = moved;
                    damping = (damping * 0.2).max(1e-10);
                    break 1.0 - cost / normal.cost;
                }
            }
            damping *= growth;
            growth *= 2.0;
        };
        if gained < effort.gain {
            return true;
        }
    }
    true
}

/// The prior's cost.
fn penalty(chain: &Chain, points: Points<'_>, prior: Prior, rest: &Rest) -> f64 {
    let each = points.per_piece(chain);
    (0..chain.pieces.len()).map(|i| Pull::new(chain, prior, rest, i, each).cost).sum()
}

impl Normal {
    fn of(chain: &Chain, points: Points<'_>, prior: Prior, rest: &Rest) -> Option<Self> {
        let n = chain.unknowns(prior.free_root);
        // Row by row; only the lower triangle is filled.
        let mut matrix = vec![0.0; n * n];
        let mut gradient = DVector::zeros(n);
        let mut cost = 0.0;
        let [mut xs, mut ys, mut zs] = [const { Vec::new() }; 3];
        chain.linearize(points, prior.free_root, |residual: DVec3, by| {
            cost += residual.length_squared();
            xs.clear();
            ys.clear();
            zs.clear();
            for a in by {
                xs.push(a.x);
                ys.push(a.y);
                zs.push(a.z);
            }
            for (j, a) in by.iter().enumerate() {
                gradient[j] += a.dot(residual);
                let row = &mut matrix[j * n..j * n + j + 1];
                for (((entry, x), y), z) in row.iter_mut().zip(&xs).zip(&ys).zip(&zs) {
                    *entry += a.x * x + a.y * y + a.z * z;
                }
            }
        })?;
        let first = if prior.free_root { OF_ROOT } else { 0 };
        if prior.free_root && !prior.free_roll {
            matrix[0] += HELD;
        }
        let each = points.per_piece(chain);
        for i in 0..chain.pieces.len() {
            let pull = Pull::new(chain, prior, rest, i, each);
            cost += pull.cost;
            let own = first + i * OF_PIECE..first + (i + 1) * OF_PIECE;
            for (j, at) in own.clone().enumerate() {
                matrix[at * n + at] += pull.weights[j];
                gradient[at] += pull.gradient[j];
            }
            let held = chain.at_bounds(i, &gradient.as_slice()[own.clone()]);
            for at in own.zip(held).filter_map(|(at, held)| held.then_some(at)) {
                matrix[at * n + at] += HELD;
                gradient[at] = 0.0;
            }
        }
        let matrix = DMatrix::from_row_slice(n, n, &matrix);
        Some(Self { matrix, gradient, cost })
    }

    /// The damped step and how much it promises to take from the cost, were the chain linear;
    /// `None` where the equations cannot be solved.
    fn step(&self, damping: f64) -> Option<(DVector<f64>, f64)> {
        let mut damped = self.matrix.clone();
        for j in 0..damped.nrows() {
            damped[(j, j)] += damping * self.matrix[(j, j)] + f64::MIN_POSITIVE;
        }
        let step = damped.cholesky()?.solve(&-&self.gradient);
        let weight = |j: usize| damping * self.matrix[(j, j)];
        let promised: f64 =
            (0..step.len()).map(|j| step[j] * (weight(j) * step[j] - self.gradient[j])).sum();
        promised.is_finite().then_some((step, promised))
    }
}
