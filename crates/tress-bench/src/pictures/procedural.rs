//! Known grooms beside what was found from their strands, in the manner of [IPG Fig. 7].

use tress::geometry::Groom;
use tress::procedural::fit::{Fitter, Stage, StageOptions};
use tress::procedural::synthetic::{COUNT, Known, known};
use tress::view::View;

use crate::Outcome;

use super::Frame;

/// The share of a known groom's strands that is fitted.
const SHARE: f64 = 0.3;
/// Every so manieth strand is drawn, so that single ones can be told apart.
const DRAWN: usize = 4;

pub(super) fn make() -> Outcome {
    for style in 0..COUNT {
        side_by_side(&known(style, SHARE)?, &format!("recovered-{}.png", style + 1))?;
    }
    Ok(())
}

/// Target, recovered and guides, seen by the same camera.
fn side_by_side(known: &Known, name: &str) -> Outcome {
    let target = known.groom.build_groom()?;
    let options = StageOptions { own_weights: false, ..StageOptions::default() };
    let mut fitter = Fitter::new(&target, known.start.clone(), options)?;
    while fitter.advance(&mut |_| {})? != Stage::Done {}
    let found = fitter.groom().ok_or("nothing was found")?;
    let guides = Groom::new(found.guides.clone().into_strands()?).in_space(found.unit, found.up);
    let [target, recovered] = [&target, &found.build_groom()?].map(|groom| {
        let some: Vec<usize> = (0..groom.strands().len()).step_by(DRAWN).collect();
        groom.select(&some)
    });
    let frame = Frame::around([&target, &recovered], View::Front, (480, 520), 0.04);
    let caption = format!("{}: target", known.name);
    frame.sheet(name, 3, &[(&target, &caption), (&recovered, "recovered"), (&guides, "guides")])
}
