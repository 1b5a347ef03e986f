//! Pictures of grooms: strands as shaded, antialiased hair on the CPU, and what their colours mean.

mod bounds;
mod camera;
mod color;
mod density;
mod draw;
mod flatten;
mod legend;
mod num;
mod png;
mod raster;
mod render;
mod scale;
mod shade;
mod sheet;
mod stage;
mod text;
mod tiles;
mod width;

pub use bounds::Bounds;
pub use camera::{Camera, Size, View};
pub use color::{HairColor, Rgb};
pub use image::RgbImage;
pub use png::png;
pub use render::{Coloring, RenderError, RenderOptions, render, render_seen_by, render_within};
pub use scale::{ColorMap, Scale, Tick};
pub use sheet::{Panel, SheetError, sheet};
pub use width::{StrandWidth, sensible_width};
