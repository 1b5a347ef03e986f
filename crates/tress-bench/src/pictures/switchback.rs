//! Switchbacks: alone, and in a wisp as in [CC Fig. 13].

use tress::geometry::glam::{DMat3, DQuat, DVec3};
use tress::geometry::{Element, Frame as Root, Groom, HelixGroom, Strands};
use tress::switchback::{
    InsertOptions, Material, Placing, Ritz, RitzOptions, Switchback, insert, strand,
};
use tress::view::View;

use crate::Outcome;

use super::{Frame, sampled};

pub(super) fn make() -> Outcome {
    alone()?;
    wisps()
}

/// The equilibrium beside the published approximation, for a loose and a tight coil.
fn alone() -> Outcome {
    let material = Material::default();
    let mut grooms: Vec<(Groom, String)> = Vec::new();
    // As many turns as make strands about as long as each other.
    for (v, turns) in [(0.25, 7.0), (0.5, 3.5), (0.75, 2.0)] {
        let exact = Switchback::new(v, &material)?;
        let ritz = Ritz::new(v, &material, &RitzOptions::default())?;
        grooms.push((upright(strand(&exact, 0.5, turns, 32))?, format!("exact, v = {v}")));
        grooms.push((upright(strand(&ritz, 0.5, turns, 32))?, format!("Rayleigh-Ritz, v = {v}")));
    }
    let frame = Frame::around(grooms.iter().map(|(groom, _)| groom), View::Front, (240, 620), 0.14);
    let panels: Vec<_> = grooms.iter().map(|(groom, caption)| (groom, caption.as_str())).collect();
    frame.sheet("switchback-exact.png", grooms.len(), &panels)
}

/// A strand that was made along x, hung down, with its middle at the origin.
fn upright((root, elements): (Root, Vec<Element>)) -> Outcome<Groom> {
    let down = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::X, DVec3::NEG_Y));
    let root = Root { position: DVec3::ZERO, axes: down * root.axes };
    let n = elements.len();
    let helices = HelixGroom::new(vec![root], Strands::from_counts([n], elements)?)?;
    let middle = helices.strand(0).position_at(0.5 * helices.strand(0).length());
    let root = Root { position: -middle, ..root };
    let elements = helices.elements().clone();
    sampled(&HelixGroom::new(vec![root], elements)?)
}

/// A wisp without, with one near the tip, one in the middle, and both.
fn wisps() -> Outcome {
    let wisp = wisp()?;
    let groups = vec![0; wisp.len()];
    let mut grooms: Vec<(Groom, &str)> = Vec::new();
    for (places, caption) in [
        (vec![], "no switchback"),
        (vec![0.78], "near the tip"),
        (vec![0.45], "in the middle"),
        (vec![0.45, 0.78], "both"),
    ] {
        let placing = Placing::Shares(places);
        let (changed, report) = insert(&wisp, &groups, &placing, &InsertOptions::default(), 1)?;
        if 0 < report.no_room + report.no_coil {
            return Err("a switchback of the picture has no room".into());
        }
        grooms.push((sampled(&changed)?, caption));
    }
    let frame = Frame::around(grooms.iter().map(|(groom, _)| groom), View::Front, (300, 760), 0.06);
    let panels: Vec<_> = grooms.iter().map(|(groom, caption)| (groom, *caption)).collect();
    frame.sheet("switchback-wisp.png", panels.len(), &panels)
}

/// Strands of one curl, a little apart and a little unlike each other, that sways as it hangs.
fn wisp() -> Outcome<HelixGroom> {
    let coil = Element::coil(0.5, 0.9);
    let turn = std::f64::consts::TAU / coil.curvature.length();
    let axis = coil.curvature.normalize();
    let down = DMat3::from_quat(DQuat::from_rotation_arc(axis, DVec3::NEG_Y));
    let (mut roots, mut elements) = (Vec::new(), Strands::default());
    for i in 0..24_u32 {
        // Sunflower seeds over a small disc.
        let (r, angle) = (0.16 * (f64::from(i) / 24.0).sqrt(), 2.399963 * f64::from(i));
        let position = DVec3::new(r * angle.cos(), 0.0, r * angle.sin());
        let mut frame = Root { position, axes: down };
        roots.push(frame);
        let strand = (0..156).map(|j| {
            let length = turn / 6.0;
            let sway = DVec3::Z * (0.05 * (f64::from(j) * 0.06).cos());
            let bend = frame.axes.transpose() * sway;
            let element = Element { curvature: coil.curvature + bend, length };
            frame = element.advance(&frame);
            element
        });
        elements.push(strand.collect::<Vec<_>>())?;
    }
    Ok(HelixGroom::new(roots, elements)?)
}
