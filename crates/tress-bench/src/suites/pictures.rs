//! Drawing.

use tress::view::{Coloring, RenderOptions, Size, png, render};

use crate::Outcome;
use crate::grooms;
use crate::metric::{Bar, Figures};

use super::best_of;

pub(crate) const NAMES: &[&str] = &["render_10k_seconds"];

pub(crate) fn run(figures: &mut Figures) -> Outcome {
    let groom = grooms::groom("blender/bl_coily_10k.usdc", 10_000, 160)?;
    let options = RenderOptions { size: Size::new(1600, 1600), ..RenderOptions::default() };
    let seconds = best_of(2, || {
        let image = render(&groom, &Coloring::Natural, &options)?;
        Ok::<_, Box<dyn std::error::Error>>(png(&image)?)
    })?;
    figures.add("render_10k_seconds", seconds, "s", Bar::AtMost(3.0));
    Ok(())
}
