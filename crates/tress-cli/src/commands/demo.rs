//! `tress demo`: the tour on a bundled groom.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, Parser};
use tress::analysis::{GroomSummary, Quantity, QuantityValues, quantity, summarize};
use tress::edit::{Grouping, RuffleOptions, RuffleReport, groups, ruffle};
use tress::fit::{Elements, FitOptions, FitReport, Sampling, fit, sample};
use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, HelixGroom, Strands, SuperHelix, UpAxis};
use tress::io::{WriteOptions, write, write_bytes, write_helices};
use tress::optimize::{Control, SculptOptions, sculpt};
use tress::view::{
    Camera, Coloring, Panel, RenderOptions, RgbImage, Scale, Size, View, png, render,
    render_seen_by, sheet,
};

use crate::args::{Cli, Everywhere};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::report::{Report, count, short, spread};
use crate::source::fit_as_json;

/// Wisps of coily hair on a patch of scalp, in centimetres; made by `cargo xtask fixtures`.
const PATCH: &[u8] = include_bytes!("../../../../fixtures/patch.hair");

/// Elements a strand, as the ruffle of [CSE Fig. 3] has it.
const ELEMENTS: usize = 90;

/// Wisps of the bundled groom.
const WISPS: usize = 30;

/// How far tips are drawn aside, in parts of their strand's distance from root to tip.
const DRAWN: f64 = 0.5;

/// The tour: a bundled groom read, fitted, analysed, ruffled, sculpted, written and pictured
///
/// Leaves in DIR: the groom (patch.hair), its super-helices (patch.tress), the ruffled groom
/// (ruffled.usda, ruffled.hair), the groom with its tips drawn aside (sculpted.hair), pictures
/// (before.png, after.png, before-after.png, sculpted.png, radius.png), what the groom is like
/// (analysis.html) and a report (report.md).
#[derive(Args, Debug)]
#[command(after_help = "Example: tress demo tour")]
pub(crate) struct DemoArgs {
    /// Folder to leave everything in; made if it is not there
    #[arg(default_value = "tress-demo")]
    pub(crate) dir: PathBuf,
}

pub(crate) fn run(args: &DemoArgs, everywhere: &Everywhere) -> Result<Report, Failure> {
    let progress = Progress::new(everywhere);
    let dir = &args.dir;
    fs::create_dir_all(dir).map_err(|error| {
        Failure::Failed(format!("{}: cannot make this folder: {error}", dir.display()))
    })?;
    let tour = Tour::take(everywhere.seed, &progress)?;
    progress.stage("writing grooms");
    tour.write_grooms(dir)?;
    progress.stage("drawing");
    tour.write_pictures(dir)?;
    write_bytes(dir.join("report.md"), tour.report().as_bytes())?;
    analyze(dir, everywhere)?;

    let mut report = Report::default();
    report.set("output", dir);
    report.set("strands", tour.before.strands().len());
    report.set("points", tour.before.strands().points().len());
    report.set("fit", fit_as_json(&tour.fit));
    report.set("summary", tour.measures);
    report.set("ruffle", tour.ruffle);
    for line in tour.report().lines().filter(|line| line.starts_with("- ")) {
        report.line(&line[2..]);
    }
    report.line(format!("look at {}", dir.join("before-after.png").display()));
    Ok(report)
}

/// `tress analyze` on the groom that was left.
fn analyze(dir: &Path, everywhere: &Everywhere) -> Result<(), Failure> {
    let (groom, page) = (dir.join("patch.hair"), dir.join("analysis.html"));
    let mut html = OsString::from("--html=");
    html.push(page);
    let line = ["tress", "analyze", "--unit", "cm", "--up", "y"].map(OsString::from);
    let cli = Cli::parse_from(line.into_iter().chain([html, "--".into(), groom.into()]));
    super::run(&cli.command, everywhere).map(drop)
}

/// What the tour goes through.
struct Tour {
    before: Groom,
    helices: HelixGroom,
    fit: FitReport,
    measures: GroomSummary,
    ruffled: HelixGroom,
    ruffle: RuffleReport,
    after: Groom,
    sculpted: Groom,
}

impl Tour {
    fn take(seed: u64, progress: &Progress) -> Result<Self, Failure> {
        progress.stage("reading the bundled groom");
        let before = tress::io::hair::read(PATCH)?.in_space(Some(0.01), Some(UpAxis::Y));
        progress.stage("fitting");
        let options = FitOptions { elements: Elements::Count(ELEMENTS), ..FitOptions::default() };
        let fitted = fit(&before, &options)?;
        progress.stage("measuring");
        let measures = summarize(&fitted.helices);
        progress.stage("ruffling");
        let wisps = groups(&fitted.helices, &Grouping::Clusters(WISPS), seed)?;
        let options = RuffleOptions { probability: 0.03, keep: 30, ..RuffleOptions::default() };
        let (ruffled, report) = ruffle(&fitted.helices, &wisps, &options, seed)?;
        let counts: Vec<usize> = before.strands().counts().collect();
        let after = sample(&ruffled, &Sampling::Counts(&counts))?;
        progress.stage("sculpting");
        let sculpted = sample(&drawn_aside(&fitted.helices)?, &Sampling::Counts(&counts))?;
        Ok(Self {
            before,
            helices: fitted.helices,
            fit: fitted.report,
            measures,
            ruffled,
            ruffle: report,
            after,
            sculpted,
        })
    }

    fn write_grooms(&self, dir: &Path) -> Result<(), Failure> {
        let options = WriteOptions::default();
        write(dir.join("patch.hair"), &self.before, &options)?;
        write_helices(dir.join("patch.tress"), &self.helices)?;
        write_helices(dir.join("ruffled.tress"), &self.ruffled)?;
        write(dir.join("ruffled.usda"), &self.after, &options)?;
        write(dir.join("ruffled.hair"), &self.after, &options)?;
        write(dir.join("sculpted.hair"), &self.sculpted, &options)?;
        Ok(())
    }

    /// Before and after are seen by the same camera, so that they can be compared.
    fn write_pictures(&self, dir: &Path) -> Result<(), Failure> {
        let options = RenderOptions {
            view: View::ThreeQuarter,
            size: Size::new(900, 900),
            ..RenderOptions::default()
        };
        let grooms = [&self.before, &self.after, &self.sculpted];
        let points = grooms.iter().flat_map(|groom| groom.strands().points()).copied();
        let camera = Camera::fit(points, UpAxis::Y, options.view, options.size, options.margin);
        let draw = |groom: &Groom, coloring: &Coloring<'_>| {
            render_seen_by(&camera, groom, coloring, &options)
        };
        let before = draw(&self.before, &Coloring::Natural)?;
        let after = draw(&self.after, &Coloring::Natural)?;
        let panels = [
            Panel { image: &before, caption: "as it is" },
            Panel { image: &after, caption: "ruffled: strands of a wisp exchange curls" },
        ];
        let both = sheet(&panels, 2, options.background)?;
        let sculpted = draw(&self.sculpted, &Coloring::Natural)?;
        let panels = [
            Panel { image: &before, caption: "as it is" },
            Panel { image: &sculpted, caption: "sculpted: tips drawn aside" },
        ];
        let sculpted = sheet(&panels, 2, options.background)?;
        let radius = self.colored_by_radius(&options)?;
        for (name, picture) in [
            ("before.png", &before),
            ("after.png", &after),
            ("before-after.png", &both),
            ("sculpted.png", &sculpted),
            ("radius.png", &radius),
        ] {
            write_bytes(dir.join(name), &png(picture)?)?;
        }
        Ok(())
    }

    fn colored_by_radius(&self, options: &RenderOptions) -> Result<RgbImage, Failure> {
        let (QuantityValues::Strands(values) | QuantityValues::Joints(values)) =
            quantity(&self.helices, Quantity::Radius);
        let range = Scale::without_strays(values.iter().copied(), 0.01);
        let title = Quantity::Radius.title().into();
        let scale = Scale { title, unit: "cm".into(), ..range };
        Ok(render(&self.before, &Coloring::Strands(&values, &scale), options)?)
    }

    /// What was done, for people.
    fn report(&self) -> String {
        let strands = count(self.before.strands().len());
        let points = count(self.before.strands().points().len());
        let deviation = self.fit.deviation;
        let (rms, change) = (short(deviation.rms), short(100.0 * deviation.length_change));
        let turns = spread(self.measures.turns, "");
        let radius = spread(self.measures.coil_radius, " cm");
        let (left, right) = (self.measures.left_handed, self.measures.right_handed);
        let replaced = count(self.ruffle.replaced);
        let candidates = count(self.ruffle.candidates);
        format!(
            "# The tour\n\n\
             A generated groom of coily wisps on a patch of scalp, in centimetres.\n\n\
             - read {strands} strands of {points} points (patch.hair)\n\
             - fitted {ELEMENTS} helix arcs to each: rms distance {rms} cm, length changed by at \
             most {change} % (patch.tress)\n\
             - measured {turns} turns a strand, coil radius {radius}, {left} strands wind to the \
             left and {right} to the right (radius.png)\n\
             - ruffled: {replaced} of {candidates} elements replaced by those of a strand of the \
             same wisp (ruffled.tress, ruffled.usda, ruffled.hair)\n\
             - sculpted: every tip drawn aside, no length changed (sculpted.hair)\n\
             - analysed: analysis.html opens in a browser\n\
             - drew before-after.png, before.png, after.png, sculpted.png, radius.png\n\n\
             ![before and after](before-after.png)\n\n\
             ![sculpted](sculpted.png)\n\n\
             ![coil radius](radius.png)\n"
        )
    }
}

/// The groom with each tip drawn aside.
fn drawn_aside(helices: &HelixGroom) -> Result<HelixGroom, Failure> {
    let aside = |strand: SuperHelix<'_>| {
        let (root, tip) = (strand.root.position, strand.position_at(strand.length()));
        Control::new(strand.length(), tip + DRAWN * root.distance(tip) * DVec3::X)
    };
    let tips: Vec<Control> = helices.iter().map(aside).collect();
    let tips = Strands::from_counts(std::iter::repeat_n(1, helices.len()), tips)?;
    let mut drawn = helices.clone();
    sculpt(&mut drawn, &tips, &SculptOptions::default())?;
    Ok(drawn)
}
