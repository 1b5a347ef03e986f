//! A real droop brought back from a few anchors a strand.
//!
//! Two frames of one simulation: the same strands before and after they sagged. The strands before
//! are fitted and sculpted to M points of those after; what is measured is the distance of all
//! points to where they truly went.

use tress::optimize::SculptOptions;

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures, say};

#[expect(unreachable_pub, reason = "the example prints the same measurement as a table")]
#[path = "../../../tress-optimize/examples/droop/measure.rs"]
mod measure;

pub(crate) const NAMES: &[&str] = &[
    "droop_rms_m1",
    "droop_rms_m2",
    "droop_rms_m3",
    "droop_rms_m5",
    "droop_rms_m9",
    "droop_rms_m1_baseline",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    let frames = ["curlycue/curlycue_guides_f00.obj", "curlycue/curlycue_guides_f70.obj"];
    let [Some(before), Some(after)] = frames.map(grooms::real) else {
        say("# the two frames of the droop are not there: not measured");
        return Ok(());
    };
    let (before, after) = (grooms::polylines(&before)?, grooms::polylines(&after)?);
    let scene = measure::Scene::new(before.strands(), after.strands());
    let scene = scene.ok_or("the two frames are not the same strands")?;
    for (m, bar) in [(1, 0.27), (2, 0.16), (3, 0.14), (5, 0.095), (9, 0.056)] {
        let droop = scene.droop(m, &SculptOptions::default())?;
        figures.add(&format!("droop_rms_m{m}"), droop.sculpted, "unit", Bar::AtMost(bar));
        figures.add(&format!("droop_rms_m{m}_baseline"), droop.baseline, "unit", Bar::None);
        if m == 1 {
            let (moved, fitted) = (droop.moved, droop.fitted);
            say(&format!("# points move by {moved:.4} rms; the fit before is off by {fitted:.4}"));
        }
    }
    Ok(())
}
