//! A procedural groom: its guides, the strands blended from them, and what each operator does.

use tress::edit::{RecoilKeep, RecoilOptions, RuffleOptions};
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, Mesh, UpAxis};
use tress::grow::{Density, SkipUnit, scatter};
use tress::procedural::{
    Bend, Clump, Curl, EvenStrands, Frizz, Operator, ProceduralGroom, Roots, Scale, Skip, SkipKeep,
    Straighten, Surface, Switchback,
};
use tress::switchback::Placing;
use tress::view::{Coloring, Panel, RenderOptions, StrandWidth, View};
use tress_fixtures::{PatchOptions, scalp};

use crate::Outcome;

use super::{Frame, save};

/// Points of a guide and of every strand.
const POINTS: usize = 200;

/// Length of a guide.
const LENGTH: f64 = 11.0;

pub(super) fn make() -> Outcome {
    let groom = bare()?;
    published(&groom)?;
    own(&groom)
}

/// Guides on a patch of head, and strands between them.
fn bare() -> Outcome<ProceduralGroom> {
    let patch: Mesh = scalp(&PatchOptions::default());
    let roots = scatter(&patch, 70, Density::Even, 1)?;
    let guides = EvenStrands::new(POINTS, roots.iter().flat_map(|root| guide(*root)).collect())?;
    let positions = scatter(&patch, 2200, Density::Even, 2)?;
    let mut groom = ProceduralGroom::new(guides, Roots { positions, uv: None })?;
    groom.seed = 4;
    groom.up = Some(UpAxis::Y);
    let spacing = groom.guide_spacing();
    groom.instance_over(&Surface::new(&patch)?, 4, spacing)?;
    Ok(groom)
}

/// A guide that leaves the head, falls in front of it and sways.
fn guide(root: DVec3) -> impl Iterator<Item = DVec3> {
    let step = LENGTH / (POINTS - 1) as f64;
    let mut x = root;
    (0..POINTS).map(move |j| {
        let here = x;
        let f = j as f64 / (POINTS - 1) as f64;
        let fallen = 1.0 - (-5.0 * f).exp();
        let sway = |phase: f64| (0.5 * root.x + 0.3 * root.y + phase + 4.0 * f).sin();
        let aside = DVec3::new(sway(0.0), 0.0, sway(1.5)) * (0.3 * f);
        // It keeps clear of the head.
        let out = x.normalize() * (10.0 / x.length()).powi(6) * 0.5;
        let way = root.normalize() * (1.0 - fallen) + (DVec3::NEG_Y + out) * fallen + aside;
        x += way.normalize() * step;
        here
    })
}

fn with(groom: &ProceduralGroom, operators: Vec<Operator>) -> Outcome<Groom> {
    let mut groom = groom.clone();
    groom.chain.operators = operators;
    groom.draw_missing();
    Ok(groom.build_groom()?)
}

fn clump() -> Operator {
    Operator::Clump(Clump { profile: 2.5 })
}

fn curl() -> Operator {
    Operator::Curl(Curl { radius: 0.4, frequency: 0.3, random_frequency: 0.03, start: 0.1 })
}

/// The operators of [IPG appendix A], alone and in a chain.
fn published(groom: &ProceduralGroom) -> Outcome {
    let scale = Operator::Scale(Scale { random: 0.5 });
    let bend = Operator::Bend(Bend { angle_degrees: 70.0, start: 0.4 });
    let frizz = Operator::Frizz(Frizz { frequency: 1.2, amplitude: 0.8 });
    let chain = vec![
        Operator::Scale(Scale { random: 0.25 }),
        clump(),
        Operator::Bend(Bend { angle_degrees: 25.0, start: 0.6 }),
        curl(),
        Operator::Frizz(Frizz { frequency: 1.0, amplitude: 0.2 }),
    ];
    let guides = Groom::new(groom.guides.clone().into_strands()?);
    let cases = [
        (guides, "70 guides"),
        (with(groom, vec![])?, "2,200 strands blended from them"),
        (with(groom, vec![scale])?, "scale: random 0.5"),
        (with(groom, vec![clump()])?, "clump: profile 2.5"),
        (with(groom, vec![bend])?, "bend: 70 degrees, start 0.4"),
        (with(groom, vec![curl()])?, "curl: radius 0.4, frequency 0.3"),
        (with(groom, vec![frizz])?, "frizz: frequency 1.2, amplitude 0.8"),
        (with(groom, chain)?, "all five, one after the other"),
    ];
    sheet("operators.png", 4, &cases)
}

/// The operators of tress's own, on coils.
fn own(groom: &ProceduralGroom) -> Outcome {
    let straighten = Operator::Straighten(Straighten { amount: 0.7, span: 0.15 });
    let recoil = RecoilOptions { radius: 0.6, keep: RecoilKeep::Turns, frequency: 1.0 };
    let ruffle = RuffleOptions { probability: 0.15, keep: 20, blend: 1.0 };
    let places = Placing::Shares(vec![0.45]);
    let switchback = Switchback { places, ..Switchback::default() };
    let (each, keep) = (SkipUnit::Turns, SkipKeep::Coil);
    let skip = Operator::Skip(Skip { probability: 0.35, each, keep });
    let then = |operator: Operator| with(groom, vec![clump(), curl(), operator]);
    let cases = [
        (with(groom, vec![clump(), curl()])?, "clump and curl, then"),
        (then(straighten)?, "straighten: amount 0.7, span 0.15"),
        (then(Operator::Recoil(recoil))?, "recoil: radius 0.6, turns kept"),
        (then(Operator::Ruffle(ruffle))?, "ruffle: probability 0.15"),
        (then(Operator::Switchback(switchback))?, "switchback at 0.45 of the length"),
        (then(skip)?, "skip: 0.35 of the turns"),
    ];
    sheet("operators-own.png", 3, &cases)
}

/// Panels seen by one camera; a groom of few strands is drawn with thicker ones.
fn sheet(name: &str, columns: usize, cases: &[(Groom, &str)]) -> Outcome {
    let frame = Frame::around(cases.iter().map(|(groom, _)| groom), View::Front, (420, 520), 0.025);
    let thick = Frame {
        options: RenderOptions { width: StrandWidth::Fixed(0.07), ..frame.options },
        camera: frame.camera,
    };
    let draw = |groom: &Groom| {
        let frame = if groom.strands().len() < 200 { &thick } else { &frame };
        frame.draw(groom, &Coloring::Natural)
    };
    let images = cases.iter().map(|(groom, _)| draw(groom)).collect::<Outcome<Vec<_>>>()?;
    let panels = images.iter().zip(cases).map(|(image, (_, caption))| Panel { image, caption });
    let panels: Vec<Panel<'_>> = panels.collect();
    save(name, &tress::view::sheet(&panels, columns, frame.options.background)?)
}
