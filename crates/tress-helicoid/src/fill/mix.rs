//! One hair from the guides that count, with their weights.

use glam::{DQuat, DVec2, DVec3, Vec3Swizzles};
use tress_geometry::Frame;

use super::Mixing;
use super::rotation::mean_rotation;
use crate::fit::{KN, mean_curvature};
use crate::{Helicoid, Piece};

/// A guide as it is mixed.
#[derive(Clone, Debug)]
pub(super) struct Guide<'a> {
    /// Its place in the groom of guides.
    pub(super) index: usize,
    pub(super) root: DVec3,
    pub(super) rotation: DQuat,
    pub(super) normal: Option<&'a DVec3>,
    pub(super) pieces: Vec<Piece>,
    /// Mean curvature of each piece.
    pub(super) curvatures: Vec<f64>,
    pub(super) length: f64,
    /// Where it goes from its root, at the places where hairs are held.
    pub(super) points: Vec<DVec3>,
}

impl Guide<'_> {
    /// The turn that carries it to where the surface has another normal.
    fn turn(&self, normal: Option<DVec3>) -> DQuat {
        match (self.normal, normal) {
            (Some(&from), Some(to)) => DQuat::from_rotation_arc(from, to),
            _ => DQuat::IDENTITY,
        }
    }

    /// The frame, carried to where the surface has another normal.
    fn carried(&self, normal: Option<DVec3>) -> DQuat {
        self.turn(normal) * self.rotation
    }

    /// Piece `j`, if it has one.
    fn piece(&self, j: usize) -> Option<&Piece> {
        self.pieces.get(j)
    }
}

/// The mixed frame and pieces. `weights` name at least one guide, the nearest first.
pub(super) fn mix(
    guides: &[Guide<'_>],
    weights: &[(usize, f64)],
    normal: Option<DVec3>,
    mixing: Mixing,
) -> (DQuat, Vec<Piece>) {
    let with = || weights.iter().map(|&(i, w)| (&guides[i], w));
    let length: f64 = with().map(|(guide, w)| w * guide.length).sum();
    let count: f64 = with().map(|(guide, w)| w * guide.pieces.len() as f64).sum();
    let most = with().map(|(guide, _)| guide.pieces.len()).max().unwrap_or(1);
    let off = |n: &usize| (*n as f64 - count).abs();
    let n = (1..=most).min_by(|n, m| off(n).total_cmp(&off(m))).unwrap_or(1);
    match mixing {
        Mixing::Parameters => {
            let rotation = mean_rotation(with().map(|(guide, w)| (guide.carried(normal), w)));
            let piece = |j| Piece { k: parameters(with(), j), length: length / n as f64 };
            (rotation, (0..n).map(piece).collect())
        }
        Mixing::Bends => {
            let reference = guides[weights[0].0].carried(normal);
            let rolled = || {
                with().map(|(guide, w)| (guide, w, Rolled::to(reference, guide.carried(normal))))
            };
            let rotation = mean_rotation(rolled().map(|(_, w, rolled)| (rolled.rotation, w)));
            let mut pieces: Vec<Piece> = (0..n).map(|j| bends(rolled(), j)).collect();
            let total: f64 = pieces.iter().map(|piece| piece.length).sum();
            pieces.iter_mut().for_each(|piece| piece.length *= length / total);
            (rotation, pieces)
        }
    }
}

/// The mean of the guides' points, from the root.
pub(super) fn points(
    guides: &[Guide<'_>],
    weights: &[(usize, f64)],
    normal: Option<DVec3>,
    count: usize,
) -> Vec<DVec3> {
    let mut mean = vec![DVec3::ZERO; count];
    for &(i, w) in weights {
        let turn = guides[i].turn(normal);
        for (mean, &point) in mean.iter_mut().zip(&guides[i].points) {
            *mean += w * (turn * point);
        }
    }
    mean
}

/// The mean of `(kT, kN, kB, alpha)` over the guides that have a piece `j`.
fn parameters<'a>(guides: impl Iterator<Item = (&'a Guide<'a>, f64)>, j: usize) -> Helicoid {
    let mut sum = [0.0; 5];
    for (guide, w) in guides {
        let Some(Piece { k, .. }) = guide.piece(j) else { continue };
        for (sum, value) in sum.iter_mut().zip([k.kt, k.kn, k.kb, k.alpha, 1.0]) {
            *sum += w * value;
        }
    }
    let [kt, kn, kb, alpha, total] = sum;
    Helicoid::new(kt / total, kn / total, kb / total, alpha / total)
}

/// A guide's frame turned about its tangent to agree with another, and by how much.
#[derive(Clone, Copy)]
struct Rolled {
    rotation: DQuat,
    /// Cosine and sine of the turn.
    turn: DVec2,
}

impl Rolled {
    /// The frame with the tangent of `own` that is nearest to `reference`.
    fn to(reference: DQuat, own: DQuat) -> Self {
        let frame = Frame { position: DVec3::ZERO, axes: glam::DMat3::from_quat(reference) };
        let nearest = frame.turned_to((own * DVec3::X).normalize());
        let rotation = DQuat::from_mat3(&nearest.axes).normalize();
        // The own E_N in the nearest frame.
        let turn = (rotation.inverse() * (own * DVec3::Y)).yz().normalize_or(DVec2::X);
        Self { rotation, turn }
    }

    /// A bend in the own frame as it is in the rolled one.
    fn bend(&self, k: &Helicoid) -> DVec2 {
        self.turn.rotate(DVec2::new(k.kt, k.alpha * k.kt))
    }
}

/// `|kT|` is at least this part of `|alpha kT|`.
const LEAST_KT: f64 = 1e-3;

/// Sums over the guides that have a piece, by their weights, of what a turn of the frame about the
/// tangent does not change, and of the bend in frames turned to agree.
#[derive(Default)]
struct Sums {
    bend: DVec2,
    /// `|kT| sqrt(1 + alpha^2)`, the curvature where the piece begins.
    curvature: f64,
    /// `alpha kB - kN`, how fast the curvature grows there, over the curvature.
    growth: f64,
    /// `kB sqrt(1 + alpha^2)`, which bounds `alpha kB` whatever `alpha` the mean has. It is worth
    /// as much as the bends agree: without the guides' `alpha` their `kB` says nothing.
    climb: f64,
    /// The least and the greatest `kN` that the guides have or a fit could have given them.
    kn: (f64, f64),
    mean_curvature: f64,
    length: f64,
    part: f64,
    total: f64,
}

impl Sums {
    fn add(
        &mut self,
        guide: &Guide<'_>,
        piece: &Piece,
        mean_curvature: f64,
        w: f64,
        roll: &Rolled,
    ) {
        let Piece { k, length } = piece;
        let slope = 1.0_f64.hypot(k.alpha);
        self.bend += w * roll.bend(k);
        self.curvature += w * k.kt.abs() * slope;
        self.growth += w * (k.alpha * k.kb - k.kn);
        self.climb += w * k.kb * slope;
        let (least, most) = self.kn;
        self.kn = (least.min(k.kn).min(KN.0 / length), most.max(k.kn).max(KN.1 / length));
        self.mean_curvature += w * mean_curvature;
        self.length += w * length;
        self.part += w * length / guide.length;
        self.total += w;
    }

    /// The helicoid that bends in this direction with such a curvature.
    fn helicoid(&self, direction: DVec2, curvature: f64) -> Helicoid {
        let bend = curvature * direction;
        let least = LEAST_KT * bend.y.abs();
        let kt = if bend.x.abs() < least { least.copysign(bend.x) } else { bend.x };
        let alpha = if kt == 0.0 { 0.0 } else { bend.y / kt };
        let agreement = self.bend.length() / self.curvature.max(f64::MIN_POSITIVE);
        let climb = agreement.powi(4) * self.climb / self.total;
        let kb = climb / 1.0_f64.hypot(alpha);
        let (least, most) = self.kn;
        let kn = (alpha * kb - self.growth / self.total).clamp(least, most);
        Helicoid::new(kt, kn, kb, alpha)
    }

    /// The mixed piece, its length as a part of the hair's.
    fn piece(&self) -> Piece {
        let direction = self.bend.normalize_or(DVec2::X);
        let at_beginning = self.curvature / self.total;
        let mut k = self.helicoid(direction, at_beginning);
        // What the growth makes of it along the piece is put right by a factor.
        if let Some(own) = mean_curvature(&k, self.length / self.total)
            && 0.0 < own
        {
            let factor = (self.mean_curvature / self.total / own).clamp(0.5, 2.0);
            k = self.helicoid(direction, factor * at_beginning);
        }
        Piece { k, length: self.part / self.total }
    }
}

/// Piece `j`, mixed from the guides that have one.
fn bends<'a>(guides: impl Iterator<Item = (&'a Guide<'a>, f64, Rolled)>, j: usize) -> Piece {
    let mut sums = Sums::default();
    for (guide, w, rolled) in guides {
        if let Some(piece) = guide.piece(j) {
            sums.add(guide, piece, guide.curvatures[j], w, &rolled);
        }
    }
    sums.piece()
}
