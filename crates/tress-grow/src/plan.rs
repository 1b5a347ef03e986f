//! Everything about hairs that is chosen once and kept through an animation.

use glam::DVec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use tress_edit::strand_rng;
use tress_geometry::{OffsetsError, Strands};

use crate::coils::Coil;
use crate::guide::{Guide, is_strand, merging};
use crate::lines::Lines;
use crate::loose::{Loose, LooseLine};
use crate::{CoilScale, Coils, GrowOptions, GrowOptionsError};

/// Hairs in one piece of work: a guide is prepared once for it.
pub(crate) const PIECE: usize = 128;

/// A loose region has at most so many times the guide's points: a root far away gets longer steps.
const MOST_STRETCH: usize = 4;

/// Why hairs do not grow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GrowError {
    /// An option is out of its range.
    #[error(transparent)]
    Options(#[from] GrowOptionsError),
    /// Not one guide a root.
    #[error("{assigned} guides are given for {roots} roots")]
    Assigned {
        /// Guides given.
        assigned: usize,
        /// Roots there are.
        roots: usize,
    },
    /// A root is to follow a guide that is not there.
    #[error("root {root} is to follow guide {guide}, but there are {guides}")]
    NoGuide {
        /// The root.
        root: usize,
        /// The guide it is given.
        guide: u32,
        /// How many there are.
        guides: usize,
    },
    /// A later frame has other guides or roots than the one the hairs were planned for.
    #[error("the frame has {found} {of}, the first had {expected}")]
    Frame {
        /// Guides, roots, or points of a guide.
        of: &'static str,
        /// How many the frame has.
        found: usize,
        /// How many the first had.
        expected: usize,
    },
    /// More points than offsets can tell apart.
    #[error(transparent)]
    TooMany(#[from] OffsetsError),
}

/// Where a hair is taken apart: all but its random numbers, which are drawn again when needed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    pub(crate) guide: u32,
    /// The guide's point where the strictly guided region begins.
    pub(crate) joint: u32,
    /// Points of the loosely guided region.
    pub(crate) loose: u32,
    /// The guide's last point that the hair follows.
    pub(crate) tip: u32,
    /// How far the library's coil is turned about the centerline.
    pub(crate) turn: f32,
}

/// A hair's random numbers.
pub(crate) struct Draw {
    loose: f64,
    shorter: f64,
    /// `alpha` and `beta` of [CC 2], even over the unit disc.
    pub(crate) place: [f64; 2],
    coil: f64,
}

impl Draw {
    /// The numbers of a hair, and what is left of its stream, for period skipping.
    pub(crate) fn new(seed: u64, hair: usize) -> (Self, Pcg64Mcg) {
        let mut rng = strand_rng(seed, hair);
        let (loose, shorter) = (rng.random(), rng.random());
        let (radius, angle): (f64, f64) = (rng.random(), rng.random());
        let (sine, cosine) = (angle * std::f64::consts::TAU).sin_cos();
        let place = [radius.sqrt() * cosine, radius.sqrt() * sine];
        (Self { loose, shorter, place, coil: rng.random() }, rng)
    }
}

/// Hairs planned on guides at rest; [`Plan::grow`] grows them there or wherever the guides move.
///
/// Each hair's choices are drawn once, from the seed and its number: its loose fraction, length,
/// place in the wisp, coil, phase and skipped turns. In every frame it has as many points, and
/// moves only as its guide and root do.
#[derive(Clone, Debug)]
pub struct Plan {
    pub(crate) options: GrowOptions,
    pub(crate) seed: u64,
    pub(crate) coils: Coils,
    pub(crate) lines: Lines,
    pub(crate) choices: Vec<Choice>,
    /// Hairs by guide, in pieces of one guide each.
    pub(crate) pieces: Vec<Vec<u32>>,
}

impl Plan {
    /// Plans a hair for each root, which follows the guide assigned to it.
    ///
    /// # Errors
    ///
    /// If an option is out of its range, or the assignment does not fit roots and guides.
    pub fn new(
        guides: &Strands<DVec3>,
        roots: &[DVec3],
        assigned: &[u32],
        coils: Coils,
        options: &GrowOptions,
        seed: u64,
    ) -> Result<Self, GrowError> {
        options.validate()?;
        if assigned.len() != roots.len() {
            return Err(GrowError::Assigned { assigned: assigned.len(), roots: roots.len() });
        }
        let absent = assigned.iter().position(|guide| guides.len() <= *guide as usize);
        if let Some(root) = absent {
            let (guide, guides) = (assigned[root], guides.len());
            return Err(GrowError::NoGuide { root, guide, guides });
        }
        let mut plan = Self {
            options: options.clone(),
            seed,
            coils,
            lines: Lines::new(guides),
            choices: Vec::new(),
            pieces: pieces(assigned, guides.len()),
        };
        plan.choices = plan.choose(guides, roots, assigned);
        Ok(plan)
    }

    /// How many hairs it grows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.choices.len()
    }

    /// Whether it grows none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.choices.is_empty()
    }

    /// The guide of each hair.
    pub fn guides(&self) -> impl ExactSizeIterator<Item = u32> {
        self.choices.iter().map(|choice| choice.guide)
    }

    /// For each hair its first point on the strictly guided region.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = usize> {
        self.choices.iter().map(|choice| choice.loose as usize)
    }

    /// How many points each hair has.
    pub(crate) fn counts(&self) -> impl ExactSizeIterator<Item = usize> {
        self.choices.iter().map(|c| (c.loose + c.tip + 1 - c.joint) as usize)
    }

    fn choose(&self, guides: &Strands<DVec3>, roots: &[DVec3], assigned: &[u32]) -> Vec<Choice> {
        let of_piece = |piece: &Vec<u32>| {
            let Some(&first) = piece.first() else { return Vec::new() };
            let guide = self.guide(guides, assigned[first as usize]);
            let choose = |hair: &u32| {
                let hair = *hair as usize;
                self.choice(guide.as_ref(), assigned[hair], hair, roots[hair])
            };
            piece.iter().map(choose).collect()
        };
        let chosen: Vec<Vec<Choice>> = self.pieces.par_iter().map(of_piece).collect();
        let nothing = Choice { guide: 0, joint: 0, loose: 0, tip: 0, turn: 0.0 };
        let mut choices = vec![nothing; roots.len()];
        for (piece, chosen) in self.pieces.iter().zip(chosen) {
            for (hair, choice) in piece.iter().zip(chosen) {
                choices[*hair as usize] = choice;
            }
        }
        choices
    }

    /// A guide as its hairs see it, if it is a strand.
    pub(crate) fn guide<'a>(&self, guides: &'a Strands<DVec3>, i: u32) -> Option<Guide<'a>> {
        let i = i as usize;
        let (rest, line) = (self.lines.rests[i], self.lines.points.strand(i));
        let points = guides.strand(i);
        (rest.sound && is_strand(points)).then(|| Guide::new(points, line, rest, &self.options))
    }

    /// A hair on a guide that is no strand, or with a root that is no place, is its root alone.
    fn choice(&self, guide: Option<&Guide<'_>>, name: u32, hair: usize, root: DVec3) -> Choice {
        let alone = Choice { guide: name, joint: 0, loose: 0, tip: 0, turn: 0.0 };
        let Some(guide) = guide.filter(|_| root.is_finite()) else { return alone };
        let (draw, _) = Draw::new(self.seed, hair);
        let last = guide.points.len() - 1;
        let (from, to) = self.options.loose;
        let merged = merging(guide.rest.turns, &self.options);
        let tip = share(1.0 - self.options.shorter * draw.shorter, last).max(1);
        let joint = share(merged * (from + (to - from) * draw.loose), last).min(tip);
        if joint == 0 {
            return Choice { tip: narrow(tip), ..alone };
        }
        let line = LooseLine::new(guide, joint, root);
        let steps = line.length() / guide.step(joint);
        let most = MOST_STRETCH * joint + 8;
        let n =
            if steps.is_finite() { share(1.0, whole(steps.round())).clamp(1, most) } else { most };
        let loose = self.loose(guide, joint, root, &draw, 0.0);
        Choice {
            guide: name,
            joint: narrow(joint),
            loose: narrow(n),
            tip: narrow(tip),
            turn: single(loose.phase(guide, line.length())),
        }
    }

    /// The loose region of a hair.
    pub(crate) fn loose(
        &self,
        guide: &Guide<'_>,
        joint: usize,
        root: DVec3,
        draw: &Draw,
        turn: f64,
    ) -> Loose<'_> {
        let (place, opening, locking) = (draw.place, self.options.opening, self.options.locking);
        let coil = self.coil(guide, joint, draw);
        Loose { joint, root, place, coil, turn, opening, locking }
    }

    fn coil(&self, guide: &Guide<'_>, joint: usize, draw: &Draw) -> Option<Coil<'_>> {
        let scale = match self.options.coils {
            CoilScale::Guide if self.coils.radius() > 0.0 => {
                guide.rest.radius / self.coils.radius()
            }
            _ => 1.0,
        };
        let last = self.coils.len().checked_sub(1)?;
        let i = whole(draw.coil * self.coils.len() as f64).min(last);
        self.coils.coil(i, scale, guide.step(joint))
    }
}

/// Hairs of one guide after the other, at most [`PIECE`] of them together.
fn pieces(assigned: &[u32], guides: usize) -> Vec<Vec<u32>> {
    let mut of_guide: Vec<Vec<u32>> = vec![Vec::new(); guides];
    for (hair, guide) in (0..).zip(assigned) {
        of_guide[*guide as usize].push(hair);
    }
    of_guide.iter().flat_map(|hairs| hairs.chunks(PIECE)).map(<[u32]>::to_vec).collect()
}

/// The whole number nearest to a share of `last`.
fn share(share: f64, last: usize) -> usize {
    whole((share * last as f64).round()).min(last)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, never below 0"
)]
fn whole(x: f64) -> usize {
    x as usize
}

#[expect(clippy::cast_possible_truncation, reason = "points of a strand are told apart by 32 bits")]
fn narrow(n: usize) -> u32 {
    n as u32
}

#[expect(clippy::cast_possible_truncation, reason = "an angle to seven digits")]
fn single(x: f64) -> f32 {
    x as f32
}
