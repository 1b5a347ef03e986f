//! Pictures of grooms: strands as hair, and what their colours mean.
//!
//! A wireframe is not a picture of hair. What makes coils readable is drawn here: thin hairs that
//! cover a pixel in part, in the order of depth; curves that stay round at five points a turn;
//! highlights that run along the fibre; and the shadow of hair on hair, which gives a head its
//! volume. All of it runs on the processor, and the same groom gives the same bytes on any number
//! of threads.
//!
//! | item | what it is |
//! |---|---|
//! | [`render`] | a groom to a picture, seen whole; [`render_within`] for pictures to be compared |
//! | [`render_each`] | several pictures of a groom, by several numbers |
//! | [`RenderOptions`], [`Coloring`] | view, size, hair; natural, or by numbers |
//! | [`Scale`], [`ColorMap`] | numbers to colours, and the ticks of the legend |
//! | [`Camera`], [`render_seen_by`] | where a point is seen; pictures by a camera of one's own |
//! | [`sheet`], [`png`] | captioned pictures on one sheet; the bytes of the file |
//! | [`plot`] | lines by the thousand, histograms, spectra: SVG and PNG by the same code |
//! | [`Page`] | pictures, plots and tables as one HTML file that needs no other |
//!
//! ```
//! use glam::DVec3;
//! use tress_geometry::{Groom, Strands};
//! use tress_view::{Coloring, Panel, RenderOptions, Scale, Size, png, render, sheet};
//!
//! // Ten coils of three turns.
//! let coil = |i: u32| {
//!     (0..24).map(move |j| {
//!         let angle = 0.8 * f64::from(j);
//!         DVec3::new(f64::from(i) + 0.4 * angle.cos(), 0.3 * f64::from(j), 0.4 * angle.sin())
//!     })
//! };
//! let groom = Groom::new(Strands::from_counts([24; 10], (0..10).flat_map(coil).collect())?);
//!
//! let options = RenderOptions { size: Size::new(320, 240), ..RenderOptions::default() };
//! let hair = render(&groom, &Coloring::Natural, &options)?;
//!
//! let lengths: Vec<f64> = groom.strands().iter().map(tress_geometry::polyline::length).collect();
//! let spanning = Scale::spanning(lengths.iter().copied());
//! let scale = Scale { title: "length".into(), unit: "cm".into(), ..spanning };
//! let by_length = render(&groom, &Coloring::Strands(&lengths, &scale), &options)?;
//!
//! let panels = [
//!     Panel { image: &hair, caption: "as it grows" },
//!     Panel { image: &by_length, caption: "by length" },
//! ];
//! let file = png(&sheet(&panels, 2, options.background)?)?;
//! assert!(1000 < file.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How a picture is made
//!
//! 1. The camera takes every point to pixels, and strands become smooth curves there, cut into
//!    pieces that are straight to the eye.
//! 2. The pieces are counted into a grid of cells; sweeps over it from the lights say how much
//!    light reaches each place.
//! 3. Every vertex gets the light it sends to the viewer.
//! 4. The pieces are sorted into squares of the picture, and each square is drawn from front to
//!    back, by coverage.
//!
//! From the second step on, numbers are 32-bit floats in pixels: positions are good to a
//! ten-thousandth of a pixel.
//!
//! This crate never reads or writes a file and never fits a strand.

mod bounds;
mod camera;
mod color;
mod density;
mod draw;
mod flatten;
mod legend;
mod num;
mod page;
pub mod plot;
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
pub use page::Page;
pub use png::png;
pub use render::{
    Coloring, RenderError, RenderOptions, render, render_each, render_seen_by, render_within,
};
pub use scale::{ColorMap, Scale, Tick};
pub use sheet::{Panel, SheetError, sheet};
pub use width::{StrandWidth, sensible_width};
