//! Strands in pieces: the recursive splitting of [GH 5.3].
//!
//! A helicoid is fitted to all that is left of the strand. Where its Frechet distance is not small
//! enough, the longest beginning whose own distance stays below 60 % of it gives an upper limit;
//! from there back, as far as the least length of a piece, the place is taken where the curvatures
//! of strand and fit differ least, and the helicoid is fitted anew to the part before it. The next
//! piece begins in the frame where that fit ends, so the chain is C1.

use super::chain::{Chain, Points};
use super::fragment::{Fragment, HELD};
use super::levenberg::{Effort, Prior, refine};
use super::options::{FitOptions, Method, Pieces, Roll};
use super::target::{Target, curvature_profile};
use crate::frechet::{frechet, frechet_of_prefixes};

/// Segments of a piece at least: a helicoid has four parameters.
const FEWEST_SEGMENTS: usize = 3;

/// No points at all.
const NOWHERE: Points<'_> = Points { positions: &[], arc_lengths: &[], window: 1, end: None };

/// What parameters cost in pieces that are to be mixed, over what they cost alone: `kN` and `kB`
/// add little to short pieces, and what they add is not alike from strand to strand.
const ALIKE: f64 = 100.0;

const TOGETHER: Effort = Effort { steps: 12, gain: 1e-2 };

/// Fits a chain to the whole target.
pub(super) fn fit(target: &Target, options: &FitOptions) -> Option<Chain> {
    let mut chain = match options.pieces {
        Pieces::UpTo(most) => split(target, most, options)?,
        Pieces::Equal(n) => equal(target, n, options)?,
    };
    if options.method == Method::Newton && 1 < chain.pieces.len() {
        let free_roll = options.roll == Roll::Bend;
        let curvature = match options.pieces {
            Pieces::UpTo(_) => HELD * options.regularization,
            Pieces::Equal(_) => ALIKE * options.regularization,
        };
        let prior = Prior { curvature, stretch: 0.01, keep: 0.0, free_root: true, free_roll };
        let points = behind_root(target);
        let before = chain.clone();
        if !refine(&mut chain, points, prior, TOGETHER) {
            chain = before;
        }
    }
    Some(chain)
}

/// All points but the root.
pub(super) fn behind_root(target: &Target) -> Points<'_> {
    Points {
        positions: &target.points[1..],
        arc_lengths: &target.arc_lengths[1..],
        window: 1,
        end: None,
    }
}

fn split(target: &Target, most: usize, options: &FitOptions) -> Option<Chain> {
    let mut whole: Option<Chain> = None;
    let mut first = 0;
    let mut base = target.root(options.roll);
    while first < target.last() {
        let n_pieces = whole.as_ref().map_or(0, |chain| chain.pieces.len());
        let free_root = first == 0;
        let (piece, last) = if n_pieces + 1 == most {
            let rest = Fragment { target, first, last: target.last(), base };
            let hurried = FitOptions { tolerance: f64::INFINITY, ..*options };
            rest.fit(&hurried, free_root)
        } else {
            next_piece(target, first, base, options)
        };
        base = piece.trace(NOWHERE, &mut Vec::new())?;
        first = last;
        match &mut whole {
            None => whole = Some(piece),
            Some(chain) => {
                chain.pieces.extend(piece.pieces);
                chain.breaks.push(target.arc_lengths[last]);
            }
        }
    }
    whole
}

/// The piece that begins at a point, and the point where it ends.
fn next_piece(
    target: &Target,
    first: usize,
    base: tress_geometry::Frame,
    options: &FitOptions,
) -> (Chain, usize) {
    let shortest = shortest(target, first, options.shortest);
    let mut fragment = Fragment { target, first, last: target.last(), base };
    loop {
        let (chain, reached) = fragment.fit(options, first == 0);
        let tried = Fragment { last: reached, ..fragment };
        let points = &target.points[first..=reached];
        let traced = tried.traced(&chain);
        let distance = traced.as_ref().map_or(f64::INFINITY, |t| frechet(points, t));
        let whole = reached == fragment.last;
        if (whole && distance <= options.tolerance) || reached <= shortest {
            return (chain, reached);
        }
        let last = match traced {
            Some(traced) => {
                let limit = options.threshold * distance;
                let prefixes = frechet_of_prefixes(points, &traced);
                let below = prefixes.iter().take_while(|&&d| d <= limit).count();
                alike(&tried, &chain, shortest, first + below.saturating_sub(1))
            }
            None => first + (reached - first) / 2,
        };
        fragment.last = last.clamp(shortest, reached - 1);
    }
}

/// The first point that a piece may end at.
fn shortest(target: &Target, first: usize, part: f64) -> usize {
    let least = target.arc_lengths[first] + part;
    let by_length = target.arc_lengths.partition_point(|&s| s < least);
    by_length.max(first + FEWEST_SEGMENTS).min(target.last())
}

/// The point up to `limit` where curvatures of strand and fit differ least, the last such one; not
/// before `shortest` and not more than half way back.
fn alike(tried: &Fragment<'_>, chain: &Chain, shortest: usize, limit: usize) -> usize {
    let points = tried.points();
    let mut tangents = vec![chain.root.tangent()];
    tangents.extend(chain.tangents(points));
    let arc_lengths = &tried.target.arc_lengths[tried.first..=tried.last];
    let fit = curvature_profile(&tangents, arc_lengths);
    let strand = tried.target.curvatures();
    let least = shortest.max(tried.first + (limit - tried.first) / 2);
    let mut best = (f64::INFINITY, limit.max(shortest));
    for i in (least..=limit).rev() {
        let Some(k) = fit.get(i - tried.first) else { continue };
        let difference = (k - strand[i]).abs();
        if difference < best.0 {
            best = (difference, i);
        }
    }
    best.1
}

/// So many pieces of equal length, each begun where the one before ends.
fn equal(target: &Target, n: usize, options: &FitOptions) -> Option<Chain> {
    if n == 1 {
        return split(target, 1, options);
    }
    let mut whole: Option<Chain> = None;
    let mut base = target.root(options.roll);
    for j in 0..n {
        let (begins, ends) = (j as f64 / n as f64, (j + 1) as f64 / n as f64);
        let first = target.arc_lengths.partition_point(|&s| s <= begins).saturating_sub(1);
        let last = target.arc_lengths.partition_point(|&s| s < ends - 1e-12).max(first + 1);
        let last = last.min(target.last());
        let fragment = Fragment { target, first: first.min(last - 1), last, base };
        let from = target.arc_lengths.partition_point(|&s| s <= begins);
        let count = target.arc_lengths.partition_point(|&s| s <= ends + 1e-12) - from;
        let few = count < FEWEST_SEGMENTS;
        let k = if few { fragment.drift(begins, ends) } else { fragment.estimate() };
        let mut piece = fragment.chain(k);
        piece.pieces[0].length = ends - begins;
        piece.breaks = vec![begins, ends];
        if !few {
            let points = Points {
                positions: &target.points[from..from + count],
                arc_lengths: &target.arc_lengths[from..from + count],
                window: 1,
                end: (j + 1 < n).then(|| {
                    (target.tangents[last], 0.2 * (ends - begins) * (count as f64).sqrt())
                }),
            };
            let prior = Prior {
                curvature: HELD * options.regularization,
                stretch: 0.01,
                keep: 0.0,
                free_root: j == 0,
                free_roll: options.roll == Roll::Bend,
            };
            let kept = piece.clone();
            if !refine(&mut piece, points, prior, Effort { steps: 6, gain: 1e-2 }) {
                piece = kept;
            }
        }
        base = piece.trace(NOWHERE, &mut Vec::new())?;
        match &mut whole {
            None => whole = Some(piece),
            Some(chain) => {
                chain.pieces.extend(piece.pieces);
                chain.breaks.push(ends);
            }
        }
    }
    whole
}
