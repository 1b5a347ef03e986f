//! Gauss-Newton with Levenberg's and Marquardt's damping, on the unknowns of a chain.

use glam::DVec3;
use nalgebra::{DMatrix, DVector};

use super::chain::{Chain, OF_PIECE, OF_ROOT, Points};

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
    /// A piece longer by a factor of e costs as much as this distance.
    pub(super) stretch: f64,
    /// A bend that differs from the one before by one over the piece's length costs as much.
    pub(super) change: f64,
    /// Whether what changes already at the start is free: then only what is added costs.
    pub(super) keep_changes: bool,
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

/// What the prior leaves as it is.
struct Rest {
    lengths: Vec<f64>,
    /// Changes of the bend from each piece to the next.
    changes: Vec<[f64; 2]>,
}

impl Rest {
    fn new(chain: &Chain, prior: Prior) -> Self {
        let n = chain.pieces.len();
        let change = |i| if prior.keep_changes { bend_change(chain, i) } else { [0.0; 2] };
        Self {
            lengths: chain.pieces.iter().map(|piece| piece.length).collect(),
            changes: (1..n).map(change).collect(),
        }
    }

    /// How much more the bend changes to piece `i` than it did.
    fn added(&self, chain: &Chain, i: usize) -> [f64; 2] {
        let ([a, c], [b, d]) = (bend_change(chain, i), self.changes[i - 1]);
        [a - b, c - d]
    }
}

/// Damping beyond which no step helps any more.
const MOST_DAMPING: f64 = 1e7;

/// What the bend costs over what `kN` and `kB` cost: the points tell it better than those.
const BEND: f64 = 1e-4;

/// Weight of an unknown that is not to change.
const HELD: f64 = 1e12;

/// Squared distances below this part of a squared unit are rounding.
const EXACT: f64 = 1e-26;

/// Moves the chain towards the points until nothing is gained; false where it is singular.
pub(super) fn refine(chain: &mut Chain, points: Points<'_>, prior: Prior, effort: Effort) -> bool {
    let rest = Rest::new(chain, prior);
    let mut damping = 1e-4;
    for _ in 0..effort.steps {
        let Some(normal) = Normal::of(chain, points, prior, &rest) else { return false };
        if normal.cost < EXACT {
            return true;
        }
        let gained = loop {
            if MOST_DAMPING < damping {
                return true;
            }
            if let Some(step) = normal.step(damping) {
                let moved = chain.moved(prior.free_root, step.as_slice());
                let cost = moved.cost(points) + penalty(&moved, points, prior, &rest).0;
                if cost < normal.cost {
                    *chain = moved;
                    damping = (damping * 0.2).max(1e-10);
                    break 1.0 - cost / normal.cost;
                }
            }
            damping *= 6.0;
        };
        if gained < effort.gain {
            return true;
        }
    }
    true
}

/// The prior's cost, and how it weighs each piece's curvatures and stretch.
fn penalty(chain: &Chain, points: Points<'_>, prior: Prior, rest: &Rest) -> (f64, Vec<[f64; 2]>) {
    let each = points.positions.len() as f64 / chain.pieces.len() as f64;
    let weights = rest.lengths.iter().map(|l| {
        let curvature = prior.curvature * l * l;
        [each * curvature * curvature, each * (prior.stretch * l).powi(2)]
    });
    let weights: Vec<[f64; 2]> = weights.collect();
    let of = |(i, [w, v]): (usize, &[f64; 2])| {
        let (k, stretch) = (chain.pieces[i].k, (chain.pieces[i].length / rest.lengths[i]).ln());
        let c = k.alpha * k.kt;
        let kb = k.kb * k.kb * (1.0 + k.alpha * k.alpha);
        w * (BEND * (k.kt * k.kt + c * c) + k.kn * k.kn + kb) + v * stretch * stretch
    };
    let own: f64 = weights.iter().enumerate().map(of).sum();
    let changes = (1..rest.lengths.len()).map(|i| {
        let [a, c] = rest.added(chain, i);
        change_weight(points, prior, rest, i) * (a * a + c * c)
    });
    (own + changes.sum::<f64>(), weights)
}

/// How the bend changes from the piece before to piece `i`.
fn bend_change(chain: &Chain, i: usize) -> [f64; 2] {
    let (k, before) = (chain.pieces[i].k, chain.pieces[i - 1].k);
    [k.kt - before.kt, k.alpha * k.kt - before.alpha * before.kt]
}

/// What such a change costs.
fn change_weight(points: Points<'_>, prior: Prior, rest: &Rest, i: usize) -> f64 {
    let each = points.positions.len() as f64 / rest.lengths.len() as f64;
    let l = 0.5 * (rest.lengths[i] + rest.lengths[i - 1]);
    each * (prior.change * l * l).powi(2)
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
        let (more, weights) = penalty(chain, points, prior, rest);
        let first = if prior.free_root { OF_ROOT } else { 0 };
        if prior.free_root && !prior.free_roll {
            matrix[0] += HELD;
        }
        for (i, [w, v]) in weights.iter().enumerate() {
            let piece = chain.pieces[i];
            let k = piece.k;
            let stretch = (piece.length / rest.lengths[i]).ln();
            let values = [k.kt, k.alpha * k.kt, k.kn, k.kb, stretch];
            for (j, value) in values.into_iter().enumerate() {
                let weight = match j {
                    0 | 1 => BEND * w,
                    3 => w * (1.0 + k.alpha * k.alpha),
                    4 => *v,
                    _ => *w,
                };
                let at = first + i * OF_PIECE + j;
                matrix[at * n + at] += weight;
                gradient[at] += weight * value;
            }
        }
        for i in 1..rest.lengths.len() {
            let weight = change_weight(points, prior, rest, i);
            for (j, change) in rest.added(chain, i).into_iter().enumerate() {
                let at = first + i * OF_PIECE + j;
                let before = at - OF_PIECE;
                matrix[at * n + at] += weight;
                matrix[before * n + before] += weight;
                matrix[at * n + before] -= weight;
                gradient[at] += weight * change;
                gradient[before] -= weight * change;
            }
        }
        let matrix = DMatrix::from_row_slice(n, n, &matrix);
        Some(Self { matrix, gradient, cost: cost + more })
    }

    /// The damped step; `None` where the equations cannot be solved.
    fn step(&self, damping: f64) -> Option<DVector<f64>> {
        let mut damped = self.matrix.clone();
        for j in 0..damped.nrows() {
            damped[(j, j)] += damping * self.matrix[(j, j)] + f64::MIN_POSITIVE;
        }
        let step = damped.cholesky()?.solve(&-&self.gradient);
        step.iter().all(|x| x.is_finite()).then_some(step)
    }
}
