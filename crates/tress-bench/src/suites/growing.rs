//! Hairs from guides: centerlines, time, memory, and how like the authors' own output they are.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use tress::analysis::{Quantiles, Winding, wasserstein};
use tress::fit::centerline;
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, Strands, polyline};
use tress::grow::{Assignment, Coils, Density, GrowOptions, Plan, assign, joint_report, scatter};
use tress::io::WriteOptions;
use tress_fixtures::{PatchOptions, coily_patch, scalp};

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures, say};
use crate::process;

use super::best_of;

pub(crate) const NAMES: &[&str] = &[
    "centerline_worst",
    "centerline_worst_ends",
    "assign_100k_seconds",
    "scatter_100k_seconds",
    "grow_swatch_seconds",
    "grow_swatch_obj_seconds",
    "grow_swatch_length_wasserstein",
    "grow_swatch_turns_wasserstein",
    "grow_swatch_radius_wasserstein",
    "grow_swatch_neighbours_wasserstein",
    "grow_joint_turning",
    "grow_joint_sharpest",
    "grow_sequence_change",
    "grow_head_seconds",
    "memory_peak_ratio_grow_head",
];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    centerlines(figures)?;
    roots(figures)?;
    let folder = tempfile::tempdir()?;
    let program = process::program()?;
    swatch(figures, &program, folder.path())?;
    joints(figures)?;
    head(figures, &program, folder.path())
}

/// Greatest distance of the centerline from the axis, over coil radius: 2 to 40 turns on straight
/// axes, quarter circles and circles of five coil radii.
fn centerlines(figures: &mut Figures) -> Outcome {
    let (mut worst, mut worst_ends) = (0.0, 0.0);
    let few = (0..80).map(|i| 2.0 + 0.05 * f64::from(i));
    for turns in few.chain((0..50).map(|i| 6.0 + 0.68 * f64::from(i))) {
        for per_turn in [5.0, 9.0, 20.0] {
            for pitch in [0.6, 1.5, 3.0] {
                for bend in [0.0, 0.25 * TAU, TAU.min(turns * pitch / 5.0)] {
                    let (inside, ends) = centerline_errors(turns, per_turn, pitch, bend)?;
                    worst = f64::max(worst, inside);
                    worst_ends = f64::max(worst_ends, ends);
                }
            }
        }
    }
    figures.add("centerline_worst", worst, "radii", Bar::AtMost(0.1));
    figures.add("centerline_worst_ends", worst_ends, "radii", Bar::AtMost(0.3));
    Ok(())
}

/// Errors away from the last half turns, and there, of a coil of radius 1 about an arc.
fn centerline_errors(turns: f64, per_turn: f64, pitch: f64, bend: f64) -> Outcome<(f64, f64)> {
    let n = (turns * per_turn).ceil();
    let length = turns * pitch;
    let (mut points, mut axis) = (Vec::new(), Vec::new());
    let mut i = 0.0;
    while i <= n {
        let t = i / n;
        let (sine, cosine) = (bend * t).sin_cos();
        let on = if bend > 0.0 {
            DVec3::new(sine, 1.0 - cosine, 0.0) * (length / bend)
        } else {
            DVec3::X * (t * length)
        };
        let angle = 1.0 + TAU * turns * t;
        points.push(on + DVec3::new(-sine, cosine, 0.0) * angle.cos() + DVec3::Z * angle.sin());
        axis.push(on);
        i += 1.0;
    }
    let line = centerline(&points).map_err(|defect| defect.describe())?;
    let mut worst = (0.0, 0.0);
    for (i, (p, q)) in line.points().zip(&axis).enumerate() {
        let from_end = (i as f64).min(n - i as f64) / n * turns;
        let error = if from_end < 0.5 { &mut worst.1 } else { &mut worst.0 };
        *error = f64::max(*error, p.distance(*q));
    }
    Ok(worst)
}

/// 100,000 roots scattered on a patch of head, and assigned to a thousand guides.
fn roots(figures: &mut Figures) -> Outcome {
    let mesh = scalp(&PatchOptions { patch_angle: 1.8, ..PatchOptions::default() });
    let roots = scatter(&mesh, 100_000, Density::Even, 1)?;
    let guides = scatter(&mesh, 1000, Density::Even, 2)?;
    let rule = Assignment::NoisyByDistance(3);
    let assigning = best_of(3, || assign(&roots, &guides, rule, 1))?;
    figures.add("assign_100k_seconds", assigning, "s", Bar::AtMost(0.5));
    let scattering = best_of(1, || scatter(&mesh, 100_000, Density::Even, 3))?;
    figures.add("scatter_100k_seconds", scattering, "s", Bar::None);
    Ok(())
}

/// The authors' swatch: 98 guides, 3,176 roots, their groupings and their spectra.
fn swatch(figures: &mut Figures, program: &Path, folder: &Path) -> Outcome {
    let real = |name: &str| grooms::real(&format!("curlycue/{name}"));
    let (Some(guides), Some(roots), Some(groups), Some(amplitudes), Some(phases)) = (
        real("curlycue_guides_f70.obj"),
        real("sideSwatchScalp.obj"),
        real("sideSwatchGuides-sideSwatchScalp-groupingsr30.csv"),
        real("fullComb.objAmps.npz"),
        real("fullComb.objAngs.npz"),
    ) else {
        say("# the authors' swatch is not there: nothing is held against it");
        return Ok(());
    };
    let text = |path: &Path| path.to_string_lossy().into_owned();
    for (name, extension, bar) in [
        ("grow_swatch_seconds", "hair", Bar::AtMost(0.15)),
        ("grow_swatch_obj_seconds", "obj", Bar::None),
    ] {
        let out = text(&folder.join(format!("swatch.{extension}")));
        let files = [&guides, &roots, &groups, &amplitudes, &phases].map(|path| text(path));
        let [guides, roots, groups, amplitudes, phases] = files.each_ref().map(String::as_str);
        let line = ["grow", guides, &out, "--roots", roots, "--groups", groups];
        let line = [&line[..], &["--spectra", amplitudes, phases]].concat();
        // What the authors' file was made with is not known; these come near it.
        let line = [&line[..], &["--skip", "0.5", "--shorter", "0.4"]].concat();
        figures.add(name, process::best(program, &line, 7)?.seconds, "s", bar);
    }
    let Some(theirs) = real("curlycue_swatch70_seed1337.obj") else { return Ok(()) };
    let (ours, theirs) =
        (grooms::polylines(&folder.join("swatch.obj"))?, grooms::polylines(&theirs)?);
    for (name, quantity) in QUANTITIES {
        let (ours, theirs) = (quantity(&ours), quantity(&theirs));
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let distance = wasserstein(&ours, &theirs).ok_or("a groom without strands")?;
        say(&format!("# {name}: mean {:.4}, the authors' {:.4}", mean(&ours), mean(&theirs)));
        let share = distance / mean(&theirs);
        figures.add(&format!("grow_swatch_{name}_wasserstein"), share, "of mean", Bar::None);
    }
    Ok(())
}

type Quantity = fn(&Groom) -> Vec<f64>;

/// What grown hair and the authors' are compared by.
const QUANTITIES: [(&str, Quantity); 4] =
    [("length", lengths), ("turns", turns), ("radius", radii), ("neighbours", neighbours)];

fn lengths(groom: &Groom) -> Vec<f64> {
    groom.strands().iter().map(polyline::length).collect()
}

/// Turns of the strands that wind.
fn turns(groom: &Groom) -> Vec<f64> {
    groom.strands().iter().filter_map(Winding::of_polyline).map(|w| w.turns()).collect()
}

/// The median radius of each strand that winds.
fn radii(groom: &Groom) -> Vec<f64> {
    let windings = groom.strands().iter().filter_map(Winding::of_polyline);
    windings.filter_map(|w| Some(Quantiles::of(w.radius)?.median)).collect()
}

/// From points here and there to the nearest point of another strand.
fn neighbours(groom: &Groom) -> Vec<f64> {
    let strands = groom.strands();
    let probes = (0..strands.len()).step_by(16).flat_map(|i| {
        let range = strands.range(i);
        range.clone().step_by((range.len() / 6).max(1)).map(move |at| (i, at))
    });
    let nearest = |(i, at): (usize, usize)| {
        let (own, here) = (strands.range(i), strands.points()[at]);
        let others = strands.points()[..own.start].iter().chain(&strands.points()[own.end..]);
        others.map(|p| p.distance_squared(here)).fold(f64::INFINITY, f64::min).sqrt()
    };
    probes.map(nearest).collect()
}

/// How visible joints are, and how hairs follow guides that move: the two frames of the authors'
/// guides, or fixtures whose guides lean.
fn joints(figures: &mut Figures) -> Outcome {
    let at_rest = grooms::groom("curlycue/curlycue_guides_f00.obj", 98, 108)?;
    let guides = at_rest.strands();
    let firsts: Vec<DVec3> = guides.iter().filter_map(|points| points.first().copied()).collect();
    let aside = |i: u32| DVec3::new(f64::from(i).sin(), 0.0, (2.3 * f64::from(i)).sin()) * 0.4;
    let roots: Vec<DVec3> =
        firsts.iter().flat_map(|root| (0..30).map(move |i| *root + aside(i))).collect();
    let assigned = assign(&roots, &firsts, Assignment::NoisyByDistance(3), 1)?;
    let options = GrowOptions::default();
    let plan = Plan::new(guides, &roots, &assigned, Coils::shipped()?, &options, 1)?;
    let before = plan.grow(guides, &roots)?;
    let joints = joint_report(before.strands(), plan.joints());
    let ratio = joints.mean_turning / joints.mean_turning_elsewhere;
    figures.add("grow_joint_turning", ratio, "of elsewhere", Bar::AtMost(1.1));
    figures.add("grow_joint_sharpest", joints.sharpest_at_joint, "of hairs", Bar::None);
    say(&format!(
        "# greatest turning at a joint over the hair's own: {:.3}",
        joints.greatest_ratio
    ));

    let moved = match grooms::real("curlycue/curlycue_guides_f70.obj") {
        Some(path) => grooms::polylines(&path)?.strands().clone(),
        None => leaning(guides),
    };
    let plan = plan.moved(&moved)?;
    let after = plan.grow(&moved, &roots)?;
    // What a hair's points move, over what its guide's do.
    let mut worst: f64 = 0.0;
    for (i, guide) in plan.guides().enumerate() {
        let guide = guide as usize;
        let change = |a: &Strands<DVec3>, b: &Strands<DVec3>, i: usize| {
            let pairs = a.strand(i).iter().zip(b.strand(i));
            pairs.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
        };
        let own = change(before.strands(), after.strands(), i);
        worst = worst.max(own / change(guides, &moved, guide));
    }
    figures.add("grow_sequence_change", worst, "of guide's", Bar::AtMost(2.0));
    Ok(())
}

/// Guides that lean aside, the more the farther from their roots.
fn leaning(guides: &Strands<DVec3>) -> Strands<DVec3> {
    let mut moved = guides.clone();
    for points in moved.iter_mut() {
        let root = points[0];
        points.iter_mut().for_each(|p| *p += 0.02 * p.distance_squared(root) * DVec3::X);
    }
    moved
}

/// The head of [CC Table 1]: 8,546 guides, 233,933 hairs, about 13.1 million points.
fn head(figures: &mut Figures, program: &Path, folder: &Path) -> Outcome {
    let (guides, roots) = head_files(folder)?;
    let out = folder.join("head.hair");
    let text = |path: &Path| path.to_string_lossy().into_owned();
    let (guides, roots, out) = (text(&guides), text(&roots), text(&out));
    let line = ["grow", &guides, &out, "--roots", &roots, "--preset", "long-coils"];
    let taken = process::best(program, &line, 3)?;
    let bytes = std::fs::metadata(&out)?.len() as f64;
    let written = grooms::polylines(Path::new(&out))?;
    let (hairs, points) = (written.strands().len(), written.strands().points().len());
    say(&format!("# {hairs} hairs, {points} points, {:.1} MB", bytes / 1e6));
    figures.add("grow_head_seconds", taken.seconds, "s", Bar::AtMost(4.0));
    if let Some(peak) = taken.peak {
        figures.add("memory_peak_ratio_grow_head", peak / bytes, "of output", Bar::AtMost(2.5));
    }
    Ok(())
}

/// Guides and roots of a whole head, written to files.
pub(crate) fn head_files(folder: &Path) -> Outcome<(PathBuf, PathBuf)> {
    let options = PatchOptions {
        wisps: 8546,
        strands_per_wisp: 1,
        length: 5.5,
        patch_angle: 1.9,
        ..PatchOptions::default()
    };
    let guides = folder.join("guides.hair");
    tress::io::write(&guides, &coily_patch(&options, 1), &WriteOptions::default())?;
    let roots = scatter(&scalp(&options), 233_933, Density::Even, 1)?;
    let roots = Groom::new(Strands::from_counts(vec![1; roots.len()], roots)?);
    let path = folder.join("roots.npy");
    tress::io::write(&path, &roots, &WriteOptions::default())?;
    Ok((guides, path))
}
