//! Sculpting: how stiffness acts, as in [CSE Fig. 10], and three recipes with their poses.

use ron::ser::PrettyConfig;
use tress::fit::{Elements, FitOptions, fit};
use tress::geometry::glam::DVec3;
use tress::geometry::{Element, Frame as Root, Groom, HelixGroom, Strands};
use tress::optimize::{
    ArmatureOptions, Clustering, Control, Pose, SculptOptions, Stiffness, apply_pose, armature,
    sculpt,
};
use tress::view::{Coloring, Scale, View};
use tress_fixtures::{PatchOptions, coily_patch};

use crate::Outcome;
use crate::grooms::root;
use crate::metric::say;

use super::{Frame, sampled, save};

pub(super) fn make() -> Outcome {
    stiffness()?;
    lock_over_the_eye()?;
    lengthen()?;
    rollers()
}

/// One coil drawn to one anchor with less and less stiffness.
fn stiffness() -> Outcome {
    let values = [1e3, 1.0, 1e-1, 1e-2, 1e-4];
    let element = Element { length: 0.6, ..Element::coil(0.5, 0.8) };
    let elements = Strands::from_counts([90], vec![element; 90])?;
    let one = HelixGroom::new(vec![Root::IDENTITY], elements)?;
    let tip = one.strand(0).tip().position;
    let anchor = DVec3::new(0.45 * tip.x, 0.5 * tip.length(), 0.2 * tip.length());
    let controls = Strands::from_counts([1], vec![Control::new(one.strand(0).length(), anchor)])?;
    let mut strands = Strands::default();
    for value in values {
        let mut sculpted = one.clone();
        let stiffness = Stiffness::Relative(value);
        sculpt(&mut sculpted, &controls, &SculptOptions { stiffness, ..Default::default() })?;
        strands.push(sampled(&sculpted)?.strands().points().iter().copied())?;
    }
    // The anchor, as a star.
    for axis in DVec3::AXES {
        strands.push([anchor - axis * 0.5, anchor + axis * 0.5])?;
    }
    let mut colors: Vec<f64> = values.iter().map(|value| value.log10()).collect();
    colors.extend([f64::NAN; 3]);
    let groom = Groom::new(strands);
    let title = "stiffness, as a power of ten; grey: the anchor of the tip".into();
    let range = Scale::spanning(colors.iter().copied());
    let scale = Scale { title, ..range };
    let frame = Frame::around([&groom], View::Front, (1100, 760), 0.12);
    let image = tress::view::render(&groom, &Coloring::Strands(&colors, &scale), &frame.options)?;
    save("stiffness.png", &image)
}

/// Grooms of the recipes as super-helices of 60 elements.
fn helices(options: &PatchOptions, seed: u64) -> Outcome<HelixGroom> {
    let fitted = FitOptions { elements: Elements::Count(60), ..FitOptions::default() };
    Ok(fit(&coily_patch(options, seed), &fitted)?.helices)
}

/// Changes the rest pose, sculpts, and shows both side by side.
fn recipe(
    name: &str,
    rest: &HelixGroom,
    armature_options: &ArmatureOptions,
    view: View,
    change: impl FnOnce(&mut Pose),
) -> Outcome {
    let mut pose = armature(rest, armature_options)?;
    change(&mut pose);
    let text = ron::ser::to_string_pretty(&pose, PrettyConfig::default())? + "\n";
    tress::io::write_bytes(root().join("docs/poses").join(format!("{name}.ron")), text.as_bytes())?;
    say(&format!("docs/poses/{name}.ron"));
    let mut posed = rest.clone();
    sculpt(&mut posed, &apply_pose(rest, &pose)?, &SculptOptions::default())?;
    let (before, after) = (sampled(rest)?, sampled(&posed)?);
    let frame = Frame::around([&before, &after], view, (640, 640), 0.035);
    frame.sheet(&format!("{name}.png"), 2, &[(&before, "at rest"), (&after, "sculpted")])
}

/// The foremost lock is pulled down and aside.
fn lock_over_the_eye() -> Outcome {
    let rest = helices(&PatchOptions { strands_per_wisp: 16, ..PatchOptions::default() }, 7)?;
    let clusters = Clustering { count: 12, ..Clustering::default() };
    let options = ArmatureOptions { clusters, lengths: vec![0.5, 1.0] };
    recipe("lock", &rest, &options, View::Front, |pose| {
        let front = |group: &tress::optimize::Group| group.joints[1].center.z;
        let foremost = pose.groups.iter_mut().max_by(|a, b| front(a).total_cmp(&front(b)));
        if let Some(group) = foremost {
            group.joints[0].translate = DVec3::new(-0.5, -1.5, 1.0);
            group.joints[1].translate = DVec3::new(-1.5, -5.0, 0.5);
        }
    })
}

/// All joints move down, those at the tips farthest.
fn lengthen() -> Outcome {
    let rest = helices(&PatchOptions { strands_per_wisp: 16, ..PatchOptions::default() }, 7)?;
    let clusters = Clustering { count: 8, blend: 0.5, ..Clustering::default() };
    let options = ArmatureOptions { clusters, lengths: vec![0.5, 1.0] };
    recipe("lengthen", &rest, &options, View::Front, |pose| {
        for group in &mut pose.groups {
            group.joints[0].translate = DVec3::NEG_Y * 3.0;
            group.joints[1].translate = DVec3::NEG_Y * 7.0;
        }
    })
}

/// A ponytail rolled up from its tips, as with a roller.
fn rollers() -> Outcome {
    let options = PatchOptions {
        wisps: 7,
        strands_per_wisp: 40,
        radius: 0.22,
        pitch: 0.9,
        length: 16.0,
        patch_angle: 0.09,
        points_per_turn: 8.0,
        ..PatchOptions::default()
    };
    let rest = helices(&options, 5)?;
    let clusters = Clustering { count: 1, ..Clustering::default() };
    let lengths = vec![0.4, 0.55, 0.7, 0.85, 1.0];
    recipe("rollers", &rest, &ArmatureOptions { clusters, lengths }, View::Side, |pose| {
        pose.chained = true;
        for group in &mut pose.groups {
            for joint in &mut group.joints[..4] {
                joint.rotate = DVec3::new(-55.0, 0.0, 0.0);
            }
        }
    })
}
