//! A groom between two grooms, in three spaces [CSE Fig. 9].
//!
//! *Curvature*: curvatures and lengths are mixed element by element. A coil between two coils is a
//! coil: bends open and close, nothing shrinks. *Darboux*: the world vectors `W = F q` are mixed
//! and the chain is walked with them; *position*: points are mixed. Both of these let opposite
//! bends cancel, which flattens coils half way; they are here to show it and for comparison.

use glam::{DMat3, DQuat, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::{Element, Frame, Groom, HelixGroom, SuperHelix};

use crate::ruffle::mix;

/// The space in which super-helices are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum BlendSpace {
    /// Material curvatures.
    #[default]
    Curvature,
    /// World Darboux vectors.
    Darboux,
}

/// Why two grooms cannot be blended.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BlendError {
    /// The amount is not finite.
    #[error("the amount of a blend is {0}, expected a number")]
    Amount(f64),
    /// The grooms have different numbers of strands.
    #[error("grooms of {a} and {b} strands cannot be blended: strands must correspond")]
    Strands {
        /// Strands of the first groom.
        a: usize,
        /// Strands of the second groom.
        b: usize,
    },
    /// A strand has different numbers of elements or points.
    #[error("strand {strand} has {a} elements or points in one groom and {b} in the other")]
    Counts {
        /// The strand.
        strand: usize,
        /// Its number in the first groom.
        a: usize,
        /// Its number in the second groom.
        b: usize,
    },
}

/// The groom at `amount` from `a` (0) to `b` (1); beyond them it extrapolates.
///
/// Roots move on straight lines and turn by the shortest rotation. A strand that is kept as a
/// polyline in either groom stays as it is in `a`. Attributes are those of `a`.
///
/// ```
/// use tress_edit::{BlendSpace, blend};
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
///
/// let coil = |radius| {
///     let element = Element { length: 5.0, ..Element::coil(radius, 1.0) };
///     HelixGroom::new(vec![Frame::IDENTITY], Strands::from_counts([1], vec![element])?)
///         .map_err(Box::<dyn std::error::Error>::from)
/// };
/// let middle = blend(&coil(0.5)?, &coil(1.0)?, 0.5, BlendSpace::Curvature)?;
/// assert_eq!(middle.strand(0).length(), 5.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the grooms do not correspond strand by strand and element by element.
pub fn blend(
    a: &HelixGroom,
    b: &HelixGroom,
    amount: f64,
    space: BlendSpace,
) -> Result<HelixGroom, BlendError> {
    check(amount, a.elements().counts(), b.elements().counts(), |i| {
        a.kept_polyline(i).is_some() || b.kept_polyline(i).is_some()
    })?;
    let mut middle = a.clone();
    let fixed = |i: usize| a.kept_polyline(i).is_some() || b.kept_polyline(i).is_some();
    for (i, root) in middle.roots_mut().iter_mut().enumerate().filter(|(i, _)| !fixed(*i)) {
        *root = mix_frames(root, &b.roots()[i], amount);
    }
    let roots = middle.roots().to_vec();
    let strands: Vec<(usize, &mut [Element])> =
        middle.elements_mut().iter_mut().enumerate().filter(|(i, _)| !fixed(*i)).collect();
    strands.into_par_iter().for_each(|(i, elements)| match space {
        BlendSpace::Curvature => {
            let pairs = elements.iter_mut().zip(b.strand(i).elements);
            pairs.for_each(|(element, other)| *element = mix(element, other, amount));
        }
        BlendSpace::Darboux => mix_darboux(&a.strand(i), &b.strand(i), amount, roots[i], elements),
    });
    Ok(middle)
}

/// The groom whose points lie at `amount` from those of `a` to those of `b`.
///
/// # Errors
///
/// If the grooms do not correspond strand by strand and point by point.
pub fn blend_positions(a: &Groom, b: &Groom, amount: f64) -> Result<Groom, BlendError> {
    check(amount, a.strands().counts(), b.strands().counts(), |_| false)?;
    let mut middle = a.clone();
    for (point, other) in middle.positions_mut().iter_mut().zip(b.strands().points()) {
        *point += (*other - *point) * amount;
    }
    Ok(middle)
}

fn check(
    amount: f64,
    a: impl ExactSizeIterator<Item = usize>,
    b: impl ExactSizeIterator<Item = usize>,
    fixed: impl Fn(usize) -> bool,
) -> Result<(), BlendError> {
    if !amount.is_finite() {
        return Err(BlendError::Amount(amount));
    }
    if a.len() != b.len() {
        return Err(BlendError::Strands { a: a.len(), b: b.len() });
    }
    match a.zip(b).enumerate().find(|&(i, (a, b))| a != b && !fixed(i)) {
        Some((strand, (a, b))) => Err(BlendError::Counts { strand, a, b }),
        None => Ok(()),
    }
}

fn mix_frames(a: &Frame, b: &Frame, t: f64) -> Frame {
    let (from, to) = (DQuat::from_mat3(&a.axes), DQuat::from_mat3(&b.axes));
    // Extrapolation turns on by the same rotation, which `slerp` alone would not promise.
    let turn = (to * from.conjugate()).normalize();
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let turn = DQuat::from_scaled_axis(turn.to_scaled_axis() * t);
    Frame {
        position: a.position + (b.position - a.position) * t,
        axes: DMat3::from_quat(turn) * a.axes,
    }
}

/// Walks from `root` with the mixed world Darboux vectors of two strands.
fn mix_darboux(
    a: &SuperHelix<'_>,
    b: &SuperHelix<'_>,
    t: f64,
    root: Frame,
    elements: &mut [Element],
) {
    let darboux = |frame: Frame, element: &Element| frame.axes * element.curvature;
    let mut frame = root;
    let joints = a.joints().zip(b.joints());
    let pairs = a.elements.iter().zip(b.elements).zip(joints);
    for (element, ((ea, eb), (fa, fb))) in elements.iter_mut().zip(pairs) {
        let (wa, wb): (DVec3, DVec3) = (darboux(fa, ea), darboux(fb, eb));
        let length = ea.length + (eb.length - ea.length) * t;
        *element = Element { curvature: frame.axes.transpose() * (wa + (wb - wa) * t), length };
        frame = element.advance(&frame);
    }
}

#[cfg(test)]
mod tests;
