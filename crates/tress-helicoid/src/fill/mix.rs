//! One hair from the guides that count, with their weights.

use glam::{DQuat, DVec2, DVec3, Vec3Swizzles};
use tress_geometry::Frame;

use super::Mixing;
use super::rotation::mean_rotation;
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

/// The mean bend, `kN` and `kB` over the guides that have a piece `j`, and its part of the length.
fn bends<'a>(guides: impl Iterator<Item = (&'a Guide<'a>, f64, Rolled)>, j: usize) -> Piece {
    let (mut bend, mut kn, mut kb, mut part, mut total) = (DVec2::ZERO, 0.0, 0.0, 0.0, 0.0);
    for (guide, w, rolled) in guides {
        let Some(Piece { k, length }) = guide.piece(j) else { continue };
        bend += w * rolled.bend(k);
        kn += w * k.kn;
        kb += w * k.kb;
        part += w * length / guide.length;
        total += w;
    }
    let bend = bend / total;
    let least = LEAST_KT * bend.y.abs();
    let kt = if bend.x.abs() < least { least.copysign(bend.x) } else { bend.x };
    let alpha = if kt == 0.0 { 0.0 } else { bend.y / kt };
    Piece { k: Helicoid::new(kt, kn / total, kb / total, alpha), length: part / total }
}
