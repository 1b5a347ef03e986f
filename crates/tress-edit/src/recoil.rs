//! Recoil: tighter or looser, wider or narrower coils.
//!
//! An element is an arc of a helix of radius `R = k / |q|^2` that rises by `h = k0 / |q|^2` for
//! each radian it turns; its spatial frequency is `omega = 1 / h` [CSE 12]. A coil of radius `x R`
//! and frequency `y omega` has
//!
//! `k' = R' / (R'^2 + h'^2)`, `k0' = h' / (R'^2 + h'^2)` with `R' = x R`, `h' = h / y`,
//!
//! bending in the same material direction. Changed so, a coil's axis leans against its tangent at
//! another angle: the root frame is turned by as much, about the root, so that the strand keeps its
//! direction. A straight element has no coil and stays as it is.
//!
//! Radius and frequency cannot change without either the length of a strand or its number of turns;
//! [`RecoilKeep`] says which stays.

use glam::{DMat3, DQuat, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_geometry::{Element, Frame, HelixGroom};

/// What stays when coils change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum RecoilKeep {
    /// Every element's arc length; the number of turns follows.
    #[default]
    Length,
    /// Every element's turns; the arc length follows.
    Turns,
    /// How far every element advances along its axis; arc length and turns follow. A planar arc,
    /// which advances nowhere, keeps its turns.
    Advance,
}

/// How coils change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RecoilOptions {
    /// Factor of the coil radius, above 0. Default 1.
    pub radius: f64,
    /// Factor of the spatial frequency (turns in a length of axis), above 0. Default 1.
    pub frequency: f64,
    /// What stays. Default the arc length.
    pub keep: RecoilKeep,
}

impl Default for RecoilOptions {
    fn default() -> Self {
        Self { radius: 1.0, frequency: 1.0, keep: RecoilKeep::default() }
    }
}

/// Why coils cannot change.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecoilError {
    /// A factor that is not a positive number.
    #[error("the factor of the {of} is {factor}, expected a number above 0")]
    Factor {
        /// Radius or frequency.
        of: &'static str,
        /// The factor given.
        factor: f64,
    },
}

/// The groom with its coils changed; strands kept as polylines stay as they are.
///
/// ```
/// use tress_edit::{RecoilOptions, recoil};
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
///
/// let coil = Element { length: 9.0, ..Element::coil(0.5, 1.0) };
/// let groom = HelixGroom::new(vec![Frame::IDENTITY], Strands::from_counts([1], vec![coil])?)?;
/// let options = RecoilOptions { radius: 2.0, frequency: 4.0, ..Default::default() };
/// let wide = recoil(&groom, &options)?;
/// let element = wide.strand(0).elements[0];
/// assert!((element.radius() - 1.0).abs() < 1e-12);
/// assert!((element.pitch() - 0.25).abs() < 1e-12);
/// assert_eq!(element.length, 9.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If a factor is not a positive number.
pub fn recoil(groom: &HelixGroom, options: &RecoilOptions) -> Result<HelixGroom, RecoilError> {
    for (of, factor) in [("radius", options.radius), ("frequency", options.frequency)] {
        if !(0.0 < factor && factor.is_finite()) {
            return Err(RecoilError::Factor { of, factor });
        }
    }
    let mut changed = groom.clone();
    let strands: Vec<&mut [Element]> = changed.elements_mut().iter_mut().collect();
    let turns: Vec<DQuat> = strands
        .into_par_iter()
        .map(|elements| {
            let before = first_axis(elements);
            elements.iter_mut().for_each(|element| *element = recoiled(element, options));
            lean(before, first_axis(elements))
        })
        .collect();
    for (root, turn) in changed.roots_mut().iter_mut().zip(turns) {
        *root = Frame { position: root.position, axes: root.axes * DMat3::from_quat(turn) };
    }
    Ok(changed)
}

fn recoiled(element: &Element, options: &RecoilOptions) -> Element {
    let q = element.curvature;
    let square = q.length_squared();
    if square == 0.0 {
        return *element;
    }
    let bending = element.bending();
    let radius = options.radius * bending / square;
    let rise = q.x / square / options.frequency;
    let inverse_square = radius * radius + rise * rise;
    let k = radius / inverse_square;
    let direction = if bending == 0.0 { DVec3::ZERO } else { DVec3::new(0.0, q.y, q.z) / bending };
    let curvature = DVec3::X * (rise / inverse_square) + direction * k;
    let per_turn = q.length() / curvature.length();
    if !curvature.is_finite() || !per_turn.is_finite() {
        // So nearly straight that its radius is no number.
        return *element;
    }
    let stretch = match options.keep {
        RecoilKeep::Length => 1.0,
        RecoilKeep::Advance if q.x != 0.0 => options.frequency * per_turn,
        RecoilKeep::Turns | RecoilKeep::Advance => per_turn,
    };
    Element { curvature, length: element.length * stretch }
}

/// The axis of the first turn in the frame of the root: the mean of the curvature vectors by
/// turning; zero where nothing turns.
fn first_axis(elements: &[Element]) -> DVec3 {
    let mut turned = 0.0;
    let mut axis = DVec3::ZERO;
    for element in elements {
        let angle = element.curvature.length() * element.length;
        axis += element.curvature * element.length;
        turned += angle;
        if std::f64::consts::TAU <= turned {
            break;
        }
    }
    axis.normalize_or_zero()
}

/// The rotation that takes axis `to` back to where `from` is.
fn lean(from: DVec3, to: DVec3) -> DQuat {
    if from == DVec3::ZERO || to == DVec3::ZERO {
        return DQuat::IDENTITY;
    }
    DQuat::from_rotation_arc(to, from)
}

#[cfg(test)]
mod tests;
