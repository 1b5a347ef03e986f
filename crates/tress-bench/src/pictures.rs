//! The pictures of README and docs/, each made by the layers that the program is made of.

mod analysis;
mod blending;
mod droop;
mod growing;
mod helicoid;
mod operators;
mod posing;
mod procedural;
mod ruffling;
mod switchback;

use std::fs;
use std::path::PathBuf;

use tress::geometry::glam::DVec3;
use tress::geometry::{Groom, HelixGroom, UpAxis};
use tress::view::{
    Camera, Coloring, Panel, RenderOptions, RgbImage, Size, StrandWidth, View, png, render_seen_by,
    sheet,
};

use crate::Outcome;
use crate::grooms::root;
use crate::metric::say;

type Maker = fn() -> Outcome;

/// What is pictured, and what makes the pictures of it.
const MAKERS: &[(&str, Maker)] = &[
    ("demo", demo),
    ("ruffling", ruffling::make),
    ("blending", blending::make),
    ("posing", posing::make),
    ("droop", droop::make),
    ("switchback", switchback::make),
    ("growing", growing::make),
    ("procedural", procedural::make),
    ("helicoid", helicoid::make),
    ("operators", operators::make),
    ("analysis", analysis::make),
];

/// Makes again those whose name begins with one of the arguments, or all.
pub(crate) fn make(names: &[String]) -> Outcome {
    fs::create_dir_all(root().join("docs/images"))?;
    fs::create_dir_all(root().join("docs/poses"))?;
    let wanted = |name: &str| names.is_empty() || names.iter().any(|begin| name.starts_with(begin));
    for (_, make) in MAKERS.iter().filter(|(name, _)| wanted(name)) {
        make()?;
    }
    Ok(())
}

/// The README's picture is the demo's.
fn demo() -> Outcome {
    let folder = tempfile::tempdir()?;
    let program = crate::process::program()?;
    let status = std::process::Command::new(program)
        .args(["demo", "--quiet"])
        .arg(folder.path())
        .status()?;
    if !status.success() {
        return Err("the demo failed".into());
    }
    save_bytes("before-after.png", &fs::read(folder.path().join("before-after.png"))?)?;
    save_bytes("radius.png", &fs::read(folder.path().join("radius.png"))?)
}

/// Where a picture goes.
fn path(name: &str) -> PathBuf {
    root().join("docs/images").join(name)
}

fn save_bytes(name: &str, bytes: &[u8]) -> Outcome {
    tress::io::write_bytes(path(name), bytes)?;
    say(&format!("docs/images/{name}"));
    Ok(())
}

fn save(name: &str, image: &RgbImage) -> Outcome {
    save_bytes(name, &png(image)?)
}

/// One size of panels, seen by one camera that sees all grooms.
struct Frame {
    camera: Camera,
    options: RenderOptions,
}

impl Frame {
    fn around<'a>(
        grooms: impl IntoIterator<Item = &'a Groom>,
        view: View,
        size: (u32, u32),
        width: f64,
    ) -> Self {
        let options = RenderOptions {
            view,
            size: Size::new(size.0, size.1),
            width: StrandWidth::Fixed(width),
            ..RenderOptions::default()
        };
        let points: Vec<DVec3> =
            grooms.into_iter().flat_map(|groom| groom.strands().points().to_vec()).collect();
        let camera = Camera::fit(points, UpAxis::Y, view, options.size, options.margin);
        Self { camera, options }
    }

    fn draw(&self, groom: &Groom, coloring: &Coloring<'_>) -> Outcome<RgbImage> {
        Ok(render_seen_by(&self.camera, groom, coloring, &self.options)?)
    }

    /// Grooms side by side.
    fn sheet(&self, name: &str, columns: usize, grooms: &[(&Groom, &str)]) -> Outcome {
        let images: Vec<RgbImage> = grooms
            .iter()
            .map(|(groom, _)| self.draw(groom, &Coloring::Natural))
            .collect::<Outcome<_>>()?;
        let panels = images.iter().zip(grooms);
        let panels: Vec<Panel<'_>> =
            panels.map(|(image, (_, caption))| Panel { image, caption }).collect();
        save(name, &sheet(&panels, columns, self.options.background)?)
    }
}

/// Fine polylines of super-helices.
fn sampled(helices: &HelixGroom) -> Outcome<Groom> {
    Ok(tress::fit::sample(helices, &tress::fit::Sampling::PerTurn(16.0))?)
}
