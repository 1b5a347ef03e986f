//! A real droop brought back from three anchors a strand; only where the two frames are at hand.

use tress::fit::{FitOptions, StrandFit, fit_strand};
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, HelixGroom, Strands, UpAxis};
use tress::optimize::{Control, SculptOptions, sculpt};
use tress::view::{
    Camera, Coloring, Panel, RenderOptions, Scale, Size, StrandWidth, View, render_seen_by, sheet,
};

use crate::Outcome;
use crate::grooms;
use crate::metric::say;

use super::save;

pub(super) fn make() -> Outcome {
    let frames = ["curlycue/curlycue_guides_f00.obj", "curlycue/curlycue_guides_f70.obj"];
    let [Some(before), Some(after)] = frames.map(grooms::real) else {
        say("# the two frames of the droop are not there: no picture of it");
        return Ok(());
    };
    let (before, after) = (grooms::polylines(&before)?, grooms::polylines(&after)?);
    let sculpted = Groom::new(sculpted(before.strands(), after.strands())?);
    let off = |groom: &Groom| -> Vec<f64> {
        let pairs = groom.strands().points().iter().zip(after.strands().points());
        pairs.map(|(a, b)| a.distance(*b)).collect()
    };
    let scale = Scale { min: 0.0, max: 2.0, ..Scale::default() };
    let options = RenderOptions { width: StrandWidth::Fixed(0.06), ..RenderOptions::default() };
    let options = RenderOptions { background: options.value_background, ..options };
    let points = before.strands().points().iter().chain(after.strands().points()).copied();
    let camera = Camera::fit(points, UpAxis::Y, View::Front, Size::new(700, 560), options.margin);
    let draw = |groom: &Groom| {
        let values = off(groom);
        render_seen_by(&camera, groom, &Coloring::Points(&values, &scale), &options)
    };
    let images = [draw(&before)?, draw(&sculpted)?, draw(&after)?];
    let captions = ["before the droop", "sculpted to 3 points a strand", "after the droop"];
    let panels: Vec<Panel<'_>> =
        images.iter().zip(captions).map(|(image, caption)| Panel { image, caption }).collect();
    save("droop.png", &sheet(&panels, 3, RenderOptions::default().background)?)
}

/// The strands before, fitted, with a third, two thirds and the tip of their points drawn to where
/// they are after.
fn sculpted(before: &Strands<DVec3>, after: &Strands<DVec3>) -> Outcome<Strands<DVec3>> {
    let fits: Vec<StrandFit> = before
        .iter()
        .map(|points| fit_strand(points, &FitOptions::default()))
        .collect::<Result<_, _>>()?;
    let counts = fits.iter().map(|fit| fit.elements.len());
    let elements = fits.iter().flat_map(|fit| fit.elements.clone()).collect();
    let roots = fits.iter().map(|fit| fit.root).collect();
    let mut groom = HelixGroom::new(roots, Strands::from_counts(counts, elements)?)?;
    let controls = fits.iter().zip(after.iter()).flat_map(|(fit, truth)| {
        let last = truth.len() - 1;
        [last / 3, 2 * last / 3, last].map(|i| Control::new(fit.arc_lengths[i], truth[i]))
    });
    let controls: Vec<Control> = controls.collect();
    let controls = Strands::from_counts(std::iter::repeat_n(3, fits.len()), controls)?;
    sculpt(&mut groom, &controls, &SculptOptions::default())?;
    let points = groom.iter().zip(&fits).flat_map(|(strand, fit)| {
        let places: Vec<DVec3> =
            strand.frames_at(fit.arc_lengths.iter().copied()).map(|f| f.position).collect();
        places
    });
    Ok(before.with_points(points.collect())?)
}
