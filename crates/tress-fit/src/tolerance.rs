//! As few elements as keep every point within a tolerance, long where curvature is even and short
//! where it changes.
//!
//! From the root on, each element takes as many points as one helix of its own keeps near enough,
//! found by galloping and halving. Hardly any chain has fewer elements, and where a strand is made
//! of helices these are they. A chain's elements also have to meet with one tangent, which on other
//! strands asks for more: numbers are raised until the chain, drafted on joints for that number and
//! refined as a whole, keeps the tolerance, and then halved in between. At last neighbours of like
//! curvature become one where the tolerance allows it.

use glam::DVec3;

use crate::Refine;
use crate::draft::Draft;
use crate::refine::{Hold, Problem, Refiner};
use crate::spacing::Spacing;

/// A search for few elements.
pub(crate) struct Search<'a> {
    /// An element a segment, through the points.
    pub(crate) through: &'a Draft,
    pub(crate) points: &'a [DVec3],
    /// The greatest distance allowed.
    pub(crate) bound: f64,
    pub(crate) settings: &'a Refine,
    pub(crate) refiner: &'a mut Refiner,
}

/// The first raise of the number of elements, as a part of the least; it doubles.
const RAISE: usize = 8;

/// Steps for a single helix, which is only asked whether it can follow some points.
const PIECE_STEPS: usize = 8;

/// Joints that are tried to be left out before the rest are taken to be needed.
const TRIES: usize = 2;

impl Search<'_> {
    /// The chain found, of fewer elements than segments; `None` where there is none.
    pub(crate) fn fewest(mut self) -> Option<Draft> {
        let most = self.points.len() - 1;
        let (helices, joints) = self.helices();
        let least = joints.len() - 1;
        if most <= least {
            return None;
        }
        if let Some(draft) = self.refined(helices) {
            return Some(draft);
        }
        let spacings = [Spacing::of(self.through), Spacing::like(joints)];
        let (mut too_few, mut enough, mut raise) = (least, least + 1, least.div_ceil(RAISE));
        let mut best = loop {
            if most <= enough {
                return None;
            }
            if let Some(draft) = self.chain(&spacings, enough) {
                break draft;
            }
            too_few = enough;
            enough += raise;
            raise *= 2;
        };
        while 1 < enough - too_few {
            let middle = too_few.midpoint(enough);
            match self.chain(&spacings, middle) {
                Some(draft) => (enough, best) = (middle, draft),
                None => too_few = middle,
            }
        }
        Some(self.joined(best))
    }

    /// The refined chain of `n` elements, if it keeps to the bound.
    fn chain(&mut self, spacings: &[Spacing], n: usize) -> Option<Draft> {
        let drafts = spacings.iter().map(|spacing| self.through.redrawn(&spacing.joints(n)));
        drafts.collect::<Vec<_>>().into_iter().find_map(|draft| self.refined(draft))
    }

    /// The draft, refined, if it keeps to the bound.
    fn refined(&mut self, mut draft: Draft) -> Option<Draft> {
        let Self { points, settings, .. } = *self;
        let cost =
            self.refiner.refine(Problem { points, hold: Hold::Nearest, settings }, &mut draft);
        (cost.is_finite() && draft.greatest_distance(points) <= self.bound).then_some(draft)
    }

    /// Elements that each follow as many points as one helix does, which need not meet, and arc
    /// lengths on the curve through the points where they do.
    fn helices(&mut self) -> (Draft, Vec<f64>) {
        let last = self.points.len() - 1;
        let mut all = Draft::default();
        let mut joints = vec![0.0];
        let (mut begin, mut taken, mut s) = (0, 1, 0.0);
        while begin < last {
            let (end, piece) = self.reach(begin, taken);
            s +=
                self.through.elements[begin..end].iter().map(|element| element.length).sum::<f64>();
            joints.push(s);
            let j = all.elements.len();
            all.places.extend(piece.places[..end - begin].iter().map(|&(_, s)| (j, s)));
            all.joints.push(piece.joints[0]);
            all.elements.extend(piece.elements);
            if end == last {
                all.places.extend(piece.places.last().map(|&(_, s)| (j, s)));
                all.joints.extend(piece.joints.last());
            }
            taken = end - begin;
            begin = end;
        }
        (all, joints)
    }

    /// The last point that one helix follows from `begin` on, and that helix; `guess` points are
    /// tried first.
    fn reach(&mut self, begin: usize, guess: usize) -> (usize, Draft) {
        let last = self.points.len() - 1;
        let (mut follows, mut leaves) = (begin + 1, last + 1);
        let mut found = self.through.piece(begin, follows);
        let mut ahead = guess.max(2);
        while follows < last && begin + ahead < leaves {
            let end = last.min(begin + ahead);
            match self.helix(begin, end) {
                Some(piece) => (follows, found) = (end, piece),
                None => {
                    leaves = end;
                    break;
                }
            }
            ahead *= 2;
        }
        while 1 < leaves - follows && follows < last {
            let middle = follows.midpoint(leaves);
            match self.helix(begin, middle) {
                Some(piece) => (follows, found) = (middle, piece),
                None => leaves = middle,
            }
        }
        (follows, found)
    }

    /// One helix from one point to another, if it follows all between.
    fn helix(&mut self, begin: usize, end: usize) -> Option<Draft> {
        let points = &self.points[begin..=end];
        let mut piece = self.through.piece(begin, end);
        piece.joints[0].position = points[0];
        let settings = &Refine { steps: self.settings.steps.min(PIECE_STEPS), ..*self.settings };
        let problem = Problem { points, hold: Hold::Nearest, settings };
        let cost = self.refiner.refine(problem, &mut piece);
        (cost.is_finite() && piece.greatest_distance(points) <= self.bound).then_some(piece)
    }

    /// The chain without the joints that it does not need.
    fn joined(&mut self, mut draft: Draft) -> Draft {
        while let Some(fewer) = self.without_a_joint(&draft) {
            draft = fewer;
        }
        draft
    }

    fn without_a_joint(&mut self, draft: &Draft) -> Option<Draft> {
        let elements = &draft.elements;
        let mut joints: Vec<f64> = vec![0.0];
        for element in elements {
            joints.push(joints[joints.len() - 1] + element.length);
        }
        // What one element in the place of two misses goes with the jump and with both lengths.
        let need = |j: usize| {
            let before = draft.joints[j - 1].axes * elements[j - 1].curvature;
            let jump = draft.joints[j].axes * elements[j].curvature - before;
            jump.length() * elements[j - 1].length * elements[j].length
        };
        let mut needs: Vec<(f64, usize)> = (1..elements.len()).map(|j| (need(j), j)).collect();
        needs.sort_by(|a, b| a.0.total_cmp(&b.0));
        needs.iter().take(TRIES).find_map(|&(_, j)| {
            let mut fewer = joints.clone();
            fewer.remove(j);
            self.refined(draft.redrawn(&fewer))
        })
    }
}
