//! One helicoid to a part of the strand [GH 5.2].

use glam::{DMat3, DVec3};
use tress_geometry::Frame;

use super::chain::{Chain, Points, bent};
use super::flow::{FINE, ROUGH};
use super::levenberg::{Effort, Prior, refine};
use super::options::{FitOptions, Method, Roll};
use super::simplex;
use super::target::Target;
use crate::frechet::frechet_at_most;
use crate::{Helicoid, Piece};

/// A part of the strand from one of its points to another, and where a piece is to begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fragment<'a> {
    pub(super) target: &'a Target,
    pub(super) first: usize,
    pub(super) last: usize,
    pub(super) base: Frame,
}

/// Turning of the target, in radians, from which curvature at the root is told.
const FIRST_BEND: f64 = 0.7;

/// Turning of the part fitted first; it doubles until the whole fragment is fitted. More, and the
/// fit may settle on a wrong number of turns.
const FIRST_PART: f64 = 1.5;

/// How much a radian off the strand's direction at the end counts, in lengths of the fragment at
/// each point.
const END: f64 = 0.2;

/// What parameters cost in parts of a strand, over what they cost in the end: a part has few points
/// and need not be followed closer than the tolerance.
pub(super) const HELD: f64 = 10.0;

/// So many segments tell a helicoid's parameters without a prior.
const MANY: usize = 10;

/// What parameters cost there, over what they cost else: enough that what a straight strand leaves
/// open stays 0.
const TOLD: f64 = 0.01;

/// Elevations that a fit with a free root is begun with.
const STARTS: [f64; 3] = [0.0, 1.0, -1.0];

/// Further ones where a single helicoid comes near a strand.
const ELEVATIONS: [f64; 6] = [0.5, -0.5, 1.6, -1.6, 3.0, -3.0];

/// Elevations with `kB` over the strand, where points may come from a helicoid.
const CORNERS: [(f64, f64); 4] = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];

/// Mean squared distance, over the squared length of the strand, below which a strand is a helicoid
/// but for rounding and the curves between steps.
const EXACTLY: f64 = 1e-10;

/// The same below which a strand may be one but for the arc lengths of its points.
const NEARLY: f64 = 1e-6;

/// How often those are found anew.
const REALIGNMENTS: usize = 3;

/// Another beginning is followed to its end if it comes within this factor of the best cost at
/// once.
const WORTH_IT: f64 = 30.0;

/// A part that is farther from its strand than this many tolerances will not come within one.
const GIVEN_UP: f64 = 2.0;

const DRAFT: Effort = Effort { steps: 8, gain: 1e-2 };
const LAST: Effort = Effort { steps: 30, gain: 1e-4 };

impl<'a> Fragment<'a> {
    /// The points behind the first.
    pub(super) fn points(&self) -> Points<'a> {
        let range = self.first + 1..self.last + 1;
        Points {
            positions: &self.target.points[range.clone()],
            arc_lengths: &self.target.arc_lengths[range],
            window: 1,
            end: None,
        }
    }

    /// The points behind the first, and the direction at the last where the strand goes on: what
    /// ends in a wrong direction is nothing to go on from.
    fn points_and_end(&self) -> Points<'a> {
        let points = self.points();
        let lever = END * self.length() * (points.positions.len() as f64).sqrt();
        let goes_on = self.last < self.target.last();
        Points { end: goes_on.then_some((self.target.tangents[self.last], lever)), ..points }
    }

    pub(super) fn length(&self) -> f64 {
        self.target.arc_lengths[self.last] - self.target.arc_lengths[self.first]
    }

    /// A chain of one piece over this fragment.
    pub(super) fn chain(&self, k: Helicoid) -> Chain {
        let arc_lengths = &self.target.arc_lengths;
        Chain {
            root: self.base,
            pieces: vec![Piece { k, length: self.length() }],
            breaks: vec![arc_lengths[self.first], arc_lengths[self.last]],
            turn: ROUGH,
        }
    }

    /// The first point at which the target has turned by so many radians, or the last.
    fn turned_by(&self, radians: f64) -> usize {
        let mut turned = 0.0;
        for i in self.first + 1..self.last {
            turned += self.target.tangents[i - 1].angle_between(self.target.tangents[i]);
            if radians < turned {
                return i;
            }
        }
        self.last
    }

    /// `kT` and `alpha` as the fragment's beginning has them: the parabola through the base that
    /// passes the first points best.
    pub(super) fn estimate(&self) -> Helicoid {
        let from = self.target.arc_lengths[self.first];
        let ahead = self.turned_by(FIRST_BEND).max((self.first + 2).min(self.last));
        let mut sums = DVec3::ZERO;
        let mut weight = 0.0;
        for i in self.first + 1..=ahead {
            let s = self.target.arc_lengths[i] - from;
            let off = self.base.axes.transpose() * (self.target.points[i] - self.base.position);
            sums += 2.0 * s * s * off;
            weight += s.powi(4);
        }
        let bend = sums / weight.max(f64::MIN_POSITIVE);
        bent(bend.y, bend.z, 0.0, 0.0, 1.0 / self.length())
    }

    /// `kT` and `alpha` that turn the base as the strand turns from one arc length to another.
    pub(super) fn drift(&self, begins: f64, ends: f64) -> Helicoid {
        let (from, to) = (self.target.tangent_at(begins), self.target.tangent_at(ends));
        let bend = self.base.axes.transpose() * (to - from) / (ends - begins);
        bent(bend.y, bend.z, 0.0, 0.0, 1.0 / (ends - begins))
    }

    /// The helicoid that fits, and the part of the fragment it was fitted to: all of it, or as much
    /// as shows that one helicoid does not do.
    pub(super) fn fit(&self, options: &FitOptions, free_root: bool) -> (Chain, usize) {
        match options.method {
            Method::Simplex => {
                let k = simplex::minimize(self, HELD * options.regularization);
                (self.chain(k), self.last)
            }
            Method::Newton => self.grow(options, free_root),
        }
    }

    /// Gauss-Newton on parts that turn twice as far each time.
    fn grow(&self, options: &FitOptions, free_root: bool) -> (Chain, usize) {
        let is_strand = self.first == 0 && self.last == self.target.last();
        let held = if is_strand { 1.0 } else { HELD };
        let prior = Prior {
            curvature: held * options.regularization,
            stretch: 0.01,
            keep: 0.0,
            free_root,
            free_roll: options.roll == Roll::Bend,
        };
        let mut turning = FIRST_PART;
        let mut part = self.up_to(turning);
        let Some(mut chain) = part.start(prior) else {
            return (part.chain(Helicoid::default()), part.last);
        };
        loop {
            if !refine(&mut chain, part.points_and_end(), prior, DRAFT) {
                return (part.chain(Helicoid::default()), part.last);
            }
            if !part.is_near(&chain, GIVEN_UP * options.tolerance) {
                return (chain, part.last);
            }
            if part.last == self.last {
                break;
            }
            turning *= 2.0;
            part = Self { base: chain.root, ..self.up_to(turning) };
            chain = part.chain(chain.pieces[0].k);
        }
        let tells = is_strand && MANY <= self.last;
        let curvature = if tells { TOLD * prior.curvature } else { prior.curvature };
        let prior = Prior { curvature, ..prior };
        refine(&mut chain, self.points_and_end(), prior, LAST);
        if tells && prior.free_roll && self.is_near(&chain, options.tolerance) {
            chain = self.exact(chain, prior);
        }
        (chain, self.last)
    }

    /// Follows points that may come from one helicoid to where they come from: the frame's turn
    /// about its tangent, `alpha`, `kN` and `kB` can stand for each other nearly, and only the
    /// right ones pass the points exactly.
    fn exact(&self, chain: Chain, prior: Prior) -> Chain {
        let mut best = self.begun_elsewhere(chain, &ELEVATIONS.map(|alpha| (alpha, 0.0)), prior);
        if NEARLY < self.mean_square(&best) {
            return best;
        }
        best.turn = FINE;
        refine(&mut best, self.points(), prior, LAST);
        best = self.begun_elsewhere(best, &CORNERS, prior);
        self.realigned(best, prior)
    }

    fn mean_square(&self, chain: &Chain) -> f64 {
        let points = self.points();
        chain.cost(points) / points.positions.len() as f64
    }

    /// The best chain of what is found from here and from other beginnings, each `alpha` and `kB`
    /// over the fragment; no further ones once the points are passed exactly.
    fn begun_elsewhere(&self, chain: Chain, others: &[(f64, f64)], prior: Prior) -> Chain {
        let points = self.points();
        let begin = Self { base: chain.root, ..*self };
        let k = Helicoid { kn: 0.0, ..chain.pieces[0].k };
        let mut best = chain;
        for &(alpha, kb) in others {
            if self.mean_square(&best) < EXACTLY {
                break;
            }
            let Some(mut other) = begin.turned(&k, alpha) else { continue };
            other.pieces[0].k.kb = kb / self.length();
            other.turn = best.turn;
            if refine(&mut other, points, prior, DRAFT)
                && other.cost(points) < WORTH_IT * best.cost(points)
                && refine(&mut other, points, prior, LAST)
                && other.cost(points) < best.cost(points)
            {
                best = other;
            }
        }
        best
    }

    /// Follows points whose arc lengths are not known: where the line bends sharply, those of a
    /// smooth curve through the points are not the helicoid's. Each is moved to where the chain
    /// passes the point, and the chain follows.
    fn realigned(&self, mut chain: Chain, prior: Prior) -> Chain {
        let points = self.points();
        let mut arc_lengths = points.arc_lengths.to_vec();
        let last = points.arc_lengths.last().copied().unwrap_or_default();
        for _ in 0..REALIGNMENTS {
            let points = Points { arc_lengths: &arc_lengths, ..points };
            let mut positions = Vec::with_capacity(arc_lengths.len());
            if chain.trace(points, &mut positions).is_none() {
                break;
            }
            let along = chain.tangents(points);
            let off = points.positions.iter().zip(&positions).zip(&along);
            let ahead: Vec<f64> = off.map(|((p, q), t)| (p - q).dot(*t)).collect();
            for (s, ahead) in arc_lengths.iter_mut().zip(ahead) {
                *s = (*s + ahead).min(last);
            }
            let ascend = arc_lengths.is_sorted();
            let points = Points { arc_lengths: &arc_lengths, ..self.points() };
            if !(ascend && refine(&mut chain, points, prior, LAST)) {
                break;
            }
        }
        // The hair ends where the strand does.
        let ends = arc_lengths.last().copied().unwrap_or(last);
        chain.pieces[0].length *= (ends / last).max(0.5);
        chain
    }

    /// The fragment as far as it turns by so many radians.
    fn up_to(&self, turning: f64) -> Self {
        let last = self.turned_by(turning).max((self.first + 2).min(self.last));
        Self { last, ..*self }
    }

    /// The best of a few beginnings that bend alike at first and differ in how they go on: with a
    /// free root, the frame is turned about the tangent to let `alpha` be of either sign.
    fn start(&self, prior: Prior) -> Option<Chain> {
        let k = self.estimate();
        if !(prior.free_root && prior.free_roll) {
            return Some(self.chain(k));
        }
        let mut best: Option<(f64, Chain)> = None;
        for alpha in STARTS {
            let Some(mut chain) = self.turned(&k, alpha) else { continue };
            if !refine(&mut chain, self.points_and_end(), prior, DRAFT) {
                continue;
            }
            let cost = chain.cost(self.points());
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, chain));
            }
        }
        best.map(|(_, chain)| chain)
    }

    /// A beginning that bends as `k` does with another `alpha`, in a frame turned to let it.
    fn turned(&self, k: &Helicoid, alpha: f64) -> Option<Chain> {
        let (sine, cosine) = (k.alpha - alpha).atan2(1.0 + k.alpha * alpha).sin_cos();
        let [t, n, b] = [self.base.axes.x_axis, self.base.axes.y_axis, self.base.axes.z_axis];
        let axes = DMat3::from_cols(t, n * cosine + b * sine, b * cosine - n * sine);
        let bend = k.kt.hypot(k.alpha * k.kt).copysign(k.kt);
        let kt = bend / 1.0_f64.hypot(alpha);
        let base = Frame { axes, ..self.base };
        let chain = Self { base, ..*self }.chain(Helicoid::new(kt, k.kn, 0.0, alpha));
        chain.pieces[0].k.is_finite().then_some(chain)
    }

    /// The chain at the fragment's points, its beginning included.
    pub(super) fn traced(&self, chain: &Chain) -> Option<Vec<DVec3>> {
        let mut positions = vec![chain.root.position];
        chain.trace(self.points(), &mut positions)?;
        Some(positions)
    }

    fn is_near(&self, chain: &Chain, bound: f64) -> bool {
        let target = &self.target.points[self.first..=self.last];
        self.traced(chain).is_some_and(|traced| frechet_at_most(target, &traced, bound))
    }
}
