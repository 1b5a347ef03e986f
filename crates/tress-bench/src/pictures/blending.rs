//! Half way between two shapes in three spaces, as in [CSE Fig. 9].

use tress::edit::{BlendSpace, blend, blend_positions};
use tress::fit::{Sampling, sample};
use tress::geometry::glam::{DMat3, DQuat, DVec3};
use tress::geometry::{Element, Frame as Root, Groom, HelixGroom, Strands};
use tress::optimize::{Control, SculptOptions, sculpt};
use tress::view::View;

use crate::Outcome;

use super::Frame;

pub(super) fn make() -> Outcome {
    let from = coil()?;
    let to = bent(&from)?;
    let points = |helices: &HelixGroom| sample(helices, &Sampling::Points(1200));
    let (start, end) = (points(&from)?, points(&to)?);
    let amounts = [0.0, 0.25, 0.5, 0.75, 1.0];
    let mut grooms: Vec<(Groom, String)> = Vec::new();
    for (space, name) in [
        (Some(BlendSpace::Curvature), "curvature"),
        (Some(BlendSpace::Darboux), "Darboux"),
        (None, "position"),
    ] {
        for amount in amounts {
            let groom = match space {
                Some(space) => points(&blend(&from, &to, amount, space)?)?,
                None => blend_positions(&start, &end, amount)?,
            };
            grooms.push((groom, format!("{name}, {amount}")));
        }
    }
    let frame = Frame::around(grooms.iter().map(|(groom, _)| groom), View::Front, (340, 300), 0.1);
    let panels: Vec<_> = grooms.iter().map(|(groom, caption)| (groom, caption.as_str())).collect();
    frame.sheet("blend.png", amounts.len(), &panels)
}

/// A coil that hangs straight down: 24 turns.
fn coil() -> Outcome<HelixGroom> {
    let element = Element { length: 0.72, ..Element::coil(0.55, 0.55) };
    let n = 120;
    // The axis of the coil, not its tangent, is to point down.
    let axis = element.curvature.normalize();
    let turn = DQuat::from_rotation_arc(axis, DVec3::NEG_Y);
    let axes = DMat3::from_quat(turn);
    let elements = Strands::from_counts([n], vec![element; n])?;
    Ok(HelixGroom::new(vec![Root { position: DVec3::ZERO, axes }], elements)?)
}

/// The same coil, sculpted onto an arc that ends beside its root.
fn bent(coil: &HelixGroom) -> Outcome<HelixGroom> {
    let mut bent = coil.clone();
    let length = coil.strand(0).length();
    let reach = coil.strand(0).tip().position.length();
    let radius = reach / 3.2;
    let controls: Vec<Control> = (1..=8)
        .map(|k| {
            let part = f64::from(k) / 8.0;
            let angle = 3.2 * part;
            let on_arc = DVec3::new(radius * (1.0 - angle.cos()), -radius * angle.sin(), 0.0);
            Control::new(length * part, on_arc)
        })
        .collect();
    sculpt(&mut bent, &Strands::from_counts([8], controls)?, &SculptOptions::default())?;
    Ok(bent)
}
