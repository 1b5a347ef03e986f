//! Hairs from guides, as in [CC Figs. 3, 8 and 10 to 12].

use tress::fit::centerline;
use tress::geometry::glam::{DMat3, DVec3};
use tress::geometry::{Groom, Strands};
use tress::grow::{
    Coils, Curve, Density, GrowOptions, Skip, SkipUnit, grow, preset, preset_names, scatter,
};
use tress::view::View;
use tress_fixtures::{PatchOptions, coily_patch, scalp};

use crate::Outcome;

use super::Frame;

pub(super) fn make() -> Outcome {
    one_wisp()?;
    skipping()?;
    let swatch = Swatch::new(110, 0.5, 9.0, 3000)?;
    layers()?;
    skipped_swatches(&swatch)?;
    lengths()?;
    head()
}

/// Guides on a patch of head, and roots between them.
struct Swatch {
    guides: Strands<DVec3>,
    roots: Vec<DVec3>,
}

impl Swatch {
    fn new(guides: usize, patch_angle: f64, length: f64, roots: usize) -> Outcome<Self> {
        let options = PatchOptions {
            wisps: guides,
            strands_per_wisp: 1,
            patch_angle,
            length,
            ..PatchOptions::default()
        };
        let roots = scatter(&scalp(&options), roots, Density::Even, 1)?;
        Ok(Self { guides: coily_patch(&options, 2).strands().clone(), roots })
    }

    fn grow(&self, options: &GrowOptions) -> Outcome<Groom> {
        Ok(grow(&self.guides, &self.roots, Coils::shipped()?, options, 1)?)
    }
}

/// Wisps that hold their coil up to the root, as [CC Fig. 10] makes them for comparison.
fn wig_like() -> GrowOptions {
    let options = preset("long-coils").unwrap_or_default();
    GrowOptions { loose: (0.0, 0.0), skip: Skip::default(), ..options }
}

/// The steps from a guide to a wisp.
fn one_wisp() -> Outcome {
    let guide = hanging(12.0);
    let roots = around(guide[0], 40, 0.55);
    let mut guides = Strands::default();
    guides.push(guide.iter().copied())?;
    let line = centerline(&guide).map_err(|defect| defect.describe())?;
    let with = |others: &Groom| -> Outcome<Groom> {
        let mut strands = others.strands().clone();
        strands.push(guide.iter().copied())?;
        Ok(Groom::new(strands))
    };
    let axis = Groom::new(Strands::from_counts([guide.len()], line.points().collect())?);
    let options = GrowOptions { loose: (0.25, 0.45), shorter: 0.1, ..GrowOptions::default() };
    let smooth = Coils::new(&tress::fit::Spectra::default());
    let bare = GrowOptions { opening: 0.0, ..options.clone() };
    let uncoiled = grow(&guides, &roots[..5], smooth, &bare, 4)?;
    let coiled = grow(&guides, &roots[..5], Coils::shipped()?, &options, 4)?;
    let wisp = grow(&guides, &roots, Coils::shipped()?, &options, 4)?;
    let grooms = [with(&axis)?, uncoiled, coiled, wisp];
    let frame = Frame::around(&grooms, View::Side, (330, 640), 0.03);
    let captions =
        ["a guide and its centerline", "from roots to the centerline", "with coils", "a wisp"];
    let panels: Vec<_> = grooms.iter().zip(captions).collect();
    frame.sheet("grow-steps.png", 4, &panels)
}

/// One wisp that leaves out more and more, by points and by turns.
fn skipping() -> Outcome {
    let guide = hanging(14.0);
    let roots = around(guide[0], 60, 0.55);
    let mut guides = Strands::default();
    guides.push(guide.iter().copied())?;
    let mut grooms = Vec::new();
    let mut captions = Vec::new();
    for (each, what) in [(SkipUnit::Points, "points"), (SkipUnit::Turns, "turns")] {
        for probability in [0.0, 0.25, 0.5, 0.75] {
            let options = GrowOptions {
                skip: Skip { probability, each },
                loose: (0.1, 0.25),
                wisp: Curve::constant(0.25),
                ..GrowOptions::default()
            };
            grooms.push(grow(&guides, &roots, Coils::shipped()?, &options, 5)?);
            captions.push(format!("{what}, {probability}"));
        }
    }
    let frame = Frame::around(&grooms, View::Side, (300, 560), 0.022);
    let panels: Vec<_> = grooms.iter().zip(captions.iter().map(String::as_str)).collect();
    frame.sheet("skip-wisp.png", 4, &panels)
}

/// A parting's hair, its wisps coherent up to the scalp, and with a spongy layer.
fn layers() -> Outcome {
    let mut guides = Strands::default();
    for i in 0..9_u32 {
        let aside = DVec3::new(1.1 * f64::from(i), 0.0, 0.0);
        let turned = DMat3::from_rotation_y(2.4 * f64::from(i));
        guides
            .push(hanging(11.0 + 0.5 * f64::from(i % 3)).into_iter().map(|p| aside + turned * p))?;
    }
    // Even over a strip, by ratios that no small number divides.
    let along = |i: u32, ratio: f64| (f64::from(i) * ratio).fract();
    let root = |i| DVec3::new(9.9 * along(i, 0.618034) - 0.55, 0.0, along(i, 0.414214) - 0.5);
    let swatch = Swatch { guides, roots: (0..540).map(root).collect() };
    let phase_locked = GrowOptions { loose: (0.15, 0.45), ..wig_like() };
    let grooms = [swatch.grow(&wig_like())?, swatch.grow(&phase_locked)?];
    let frame = Frame::around(&grooms, View::Front, (760, 640), 0.02);
    let panels: Vec<_> = grooms.iter().zip(["coils to the root", "phase locked"]).collect();
    frame.sheet("grow-layers.png", 2, &panels)
}

fn skipped_swatches(swatch: &Swatch) -> Outcome {
    let of = |probability| {
        let skip = Skip { probability, each: SkipUnit::Points };
        swatch.grow(&GrowOptions { skip, ..preset("long-coils").unwrap_or_default() })
    };
    let grooms: Vec<Groom> = [0.0, 0.25, 0.5, 0.75].into_iter().map(of).collect::<Outcome<_>>()?;
    let frame = Frame::around(&grooms, View::Side, (480, 520), 0.02);
    let captions = ["rho 0", "0.25", "0.5", "0.75"];
    let panels: Vec<_> = grooms.iter().zip(captions).collect();
    frame.sheet("skip-swatch.png", 4, &panels)
}

/// The presets, each on guides of a length that it is for.
fn lengths() -> Outcome {
    let mut grooms = Vec::new();
    for (name, length) in preset_names().zip([1.6, 4.5, 10.0, 10.0]) {
        let swatch = Swatch::new(130, 0.5, length, 4000)?;
        grooms.push(swatch.grow(&preset(name).unwrap_or_default())?);
    }
    let frame = Frame::around(&grooms, View::Side, (480, 560), 0.02);
    let panels: Vec<_> = grooms.iter().zip(preset_names()).collect();
    frame.sheet("grow-presets.png", 4, &panels)
}

/// A whole head.
fn head() -> Outcome {
    let swatch = Swatch::new(1800, 1.75, 7.0, 60_000)?;
    let options = GrowOptions {
        skip: Skip { probability: 0.3, each: SkipUnit::Turns },
        ..preset("long-coils").unwrap_or_default()
    };
    let groom = swatch.grow(&options)?;
    let frame = |view| Frame::around([&groom], view, (760, 760), 0.02);
    let images = [frame(View::Front), frame(View::Side)]
        .map(|frame| frame.draw(&groom, &tress::view::Coloring::Natural));
    let [front, side] = images;
    let (front, side) = (front?, side?);
    let panels = [
        tress::view::Panel { image: &front, caption: "60,000 hairs on 1,800 guides" },
        tress::view::Panel { image: &side, caption: "from the side" },
    ];
    let paper = tress::view::RenderOptions::default().background;
    super::save("grow-head.png", &tress::view::sheet(&panels, 2, paper)?)
}

/// A guide that hangs and sways, eight points a turn.
fn hanging(turns: f64) -> Vec<DVec3> {
    let n = turns * 8.0;
    let mut points = Vec::new();
    let mut i = 0.0;
    while i <= n {
        let t = i / n;
        let (sine, cosine) = (t * turns * std::f64::consts::TAU).sin_cos();
        let open = 1.0 - (-t * turns * 2.0).exp();
        let way = DVec3::new(1.2 * (2.5 * t).sin(), -0.62 * turns * t, 0.8 * t);
        points.push(way + 0.5 * open * DVec3::new(cosine, 0.0, sine));
        i += 1.0;
    }
    points
}

/// Roots about a place, even over a disc (a sunflower's spiral).
fn around(place: DVec3, n: u32, radius: f64) -> Vec<DVec3> {
    let at = |i: u32| {
        let (sine, cosine) = (2.399963 * f64::from(i)).sin_cos();
        let r = radius * (f64::from(i) / f64::from(n)).sqrt();
        place + DVec3::new(r * cosine, 0.0, r * sine)
    };
    (0..n).map(at).collect()
}
