//! One helicoid to a part of the strand [GH 5.2].

use glam::{DMat3, DVec3};
use tress_geometry::Frame;

use super::chain::{Chain, Points, bent};
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

/// Elevations that a fit with a free root is begun with.
const STARTS: [f64; 3] = [0.0, 1.0, -1.0];

/// Further ones where points seem to come from one helicoid.
const OTHERS: [f64; 6] = [0.0, 0.6, -0.6, 1.6, -1.6, 3.0];

/// Mean squared distances, over the squared length of the strand: above the first a strand is no
/// single helicoid, below the second it is.
const NEARLY: f64 = 1e-6;
const EXACTLY: f64 = 1e-11;

const DRAFT: Effort = Effort { steps: 8, gain: 1e-2 };
const LAST: Effort = Effort { steps: 30, gain: 1e-4 };

impl<'a> Fragment<'a> {
    /// The points behind the first.
    pub(super) fn points(&self) -> Points<'a> {
        let range = self.first + 1..self.last + 1;
        Points {
            positions: &self.target.points[range.clone()],
            arc_lengths: &self.target.arc_lengths[range],
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
        let curvature = held * options.regularization;
        let free_roll = options.roll == Roll::Bend;
        let prior = Prior {
            curvature,
            stretch: 0.01,
            change: 0.0,
            keep_changes: false,
            free_root,
            free_roll,
        };
        let mut turning = FIRST_PART;
        let mut part = self.up_to(turning);
        let Some(mut chain) = part.start(prior) else {
            return (part.chain(Helicoid::default()), part.last);
        };
        loop {
            let whole = part.last == self.last;
            let effort = if whole { LAST } else { DRAFT };
            if !refine(&mut chain, part.points_and_end(), prior, effort) {
                return (part.chain(Helicoid::default()), part.last);
            }
            if whole && is_strand && MANY <= self.last {
                let free = Prior { curvature: 0.01 * curvature, ..prior };
                chain = part.exact(chain, free);
            }
            if whole || !part.is_near(&chain, 2.0 * options.tolerance) {
                return (chain, part.last);
            }
            turning *= 2.0;
            part = Self { base: chain.root, ..self.up_to(turning) };
            chain = part.chain(chain.pieces[0].k);
        }
    }

    /// Follows points that seem to come from one helicoid to where they came from: the frame's turn
    /// about its tangent and `alpha` can stand for each other nearly, and only the right pair
    /// passes the points exactly.
    fn exact(&self, chain: Chain, prior: Prior) -> Chain {
        let points = self.points();
        let each = |chain: &Chain| chain.cost(points) / points.positions.len() as f64;
        let mut best = chain;
        if refine(&mut best, points, prior, LAST) && NEARLY < each(&best) {
            return best;
        }
        for alpha in OTHERS {
            if each(&best) < EXACTLY {
                break;
            }
            let base = best.root;
            let Some(mut other) = (Self { base, ..*self }).turned(&best.pieces[0].k, alpha) else {
                continue;
            };
            if refine(&mut other, points, prior, LAST) && other.cost(points) < best.cost(points) {
                best = other;
            }
        }
        best
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
