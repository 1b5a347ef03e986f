//! Plots: lines by the thousand, bands, bars; SVG and PNG by the same code.
//!
//! A [`Plot`] is plain data: titles with units, and layers that are drawn one on the other.
//! Thousands of lines are no picture as lines: [`Density`] counts them in cells and says what
//! their quantiles are.
//!
//! ```
//! use tress_view::Size;
//! use tress_view::plot::{Layer, Plot, histogram};
//!
//! let radii = [3.8, 4.0, 4.1, 4.1, 4.2, 5.0];
//! let plot = Plot {
//!     title: "Coil radius".into(),
//!     x: "coil radius (mm)".into(),
//!     y: "strands".into(),
//!     layers: vec![Layer::bars(histogram(&radii, 4))],
//!     ..Plot::default()
//! };
//! let svg = plot.svg(Size::new(480, 320))?;
//! assert!(svg.starts_with("<svg") && svg.contains("coil radius (mm)"));
//! assert_eq!(plot.picture(Size::new(480, 320))?.dimensions(), (480, 320));
//! # Ok::<(), tress_view::plot::PlotError>(())
//! ```

mod density;
mod draw;
mod histogram;

use image::RgbImage;

pub use density::{Density, Line};
pub use histogram::{Bar, histogram, histogram_within};

use crate::{Rgb, Size};

/// A plot as data.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// What is shown.
    pub title: String,
    /// What runs along, with its unit.
    pub x: String,
    /// What runs up, with its unit.
    pub y: String,
    /// What is drawn, from the lowest to the topmost layer.
    pub layers: Vec<Layer>,
    /// The range along; that of the layers where it is not given.
    pub x_range: Option<[f64; 2]>,
    /// The range up; likewise.
    pub y_range: Option<[f64; 2]>,
    /// Whether places along are logarithms to base 2 of what ticks are to say.
    pub log2_x: bool,
}

/// One layer of a plot.
#[derive(Clone, Debug, PartialEq)]
pub enum Layer {
    /// Many lines, as the number of them in each cell.
    Density(Density),
    /// A line through places along and up.
    Line {
        /// Its places; those that are not finite break it.
        points: Vec<[f64; 2]>,
        /// What the legend calls it; empty for nothing.
        name: String,
        /// Its colour.
        color: Rgb,
        /// Its width, in pixels.
        width: u32,
    },
    /// What lies between two lines.
    Band {
        /// Places along, and the lower and upper end there.
        points: Vec<[f64; 3]>,
        /// What the legend calls it; empty for nothing.
        name: String,
        /// Its colour.
        color: Rgb,
        /// How much it covers, 0 to 1.
        opacity: f64,
    },
    /// Bars that stand on 0.
    Bars {
        /// The bars.
        bars: Vec<Bar>,
        /// What the legend calls them; empty for nothing.
        name: String,
        /// Their colour.
        color: Rgb,
        /// How much they cover, 0 to 1.
        opacity: f64,
    },
}

/// The colours of lines and bars of a first and a second groom.
pub const COLORS: [Rgb; 2] = [[31, 98, 142], [200, 92, 34]];

/// Why there is no plot.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// Too few pixels for axes and their words, or too many.
    ///
    /// ```
    /// # use tress_view::Size;
    /// # use tress_view::plot::{Plot, PlotError};
    /// let error = Plot::default().svg(Size::new(50, 3)).unwrap_err();
    /// assert_eq!(error, PlotError::Size { width: 50, height: 3 });
    /// ```
    #[error("a plot of {width} x {height} pixels cannot be made: at least 160 x 120")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The drawing library gave up; memory has run out, as a rule.
    #[error("the plot was not drawn: {0}")]
    Drawing(String),
}

impl Layer {
    /// Bars of the first colour, without a name.
    #[must_use]
    pub fn bars(bars: Vec<Bar>) -> Self {
        Self::Bars { bars, name: String::new(), color: COLORS[0], opacity: 0.75 }
    }

    /// A line of a colour, 2 pixels wide, without a name.
    #[must_use]
    pub fn line(points: Vec<[f64; 2]>, color: Rgb) -> Self {
        Self::Line { points, name: String::new(), color, width: 2 }
    }

    /// The same layer under a name.
    #[must_use]
    pub fn named(mut self, called: impl Into<String>) -> Self {
        match &mut self {
            Self::Density(_) => {}
            Self::Line { name, .. } | Self::Band { name, .. } | Self::Bars { name, .. } => {
                *name = called.into();
            }
        }
        self
    }

    /// What the legend calls it; empty for nothing.
    fn name(&self) -> &str {
        match self {
            Self::Density(_) => "",
            Self::Line { name, .. } | Self::Band { name, .. } | Self::Bars { name, .. } => name,
        }
    }

    /// Places that the range of the plot must hold.
    fn extent(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Density(density) => {
                let ([x0, x1], [y0, y1]) = (density.x_range(), density.y_range());
                vec![[x0, y0], [x1, y1]]
            }
            Self::Line { points, .. } => points.clone(),
            Self::Band { points, .. } => {
                points.iter().flat_map(|&[x, low, high]| [[x, low], [x, high]]).collect()
            }
            Self::Bars { bars, .. } => {
                bars.iter().flat_map(|b| [[b.from, 0.0], [b.to, b.height]]).collect()
            }
        }
    }
}

impl Plot {
    /// The plot as SVG; the same plot gives the same text.
    ///
    /// # Errors
    ///
    /// If there is no room for it.
    pub fn svg(&self, size: Size) -> Result<String, PlotError> {
        draw::svg(self, size)
    }

    /// The plot as a picture, to be written as PNG or laid on a sheet.
    ///
    /// # Errors
    ///
    /// If there is no room for it.
    pub fn picture(&self, size: Size) -> Result<RgbImage, PlotError> {
        draw::picture(self, size)
    }

    /// The ranges along and up, both of some width.
    fn ranges(&self) -> [[f64; 2]; 2] {
        let extent: Vec<[f64; 2]> = self.layers.iter().flat_map(Layer::extent).collect();
        let span = |axis: usize, given: Option<[f64; 2]>| {
            let finite = extent.iter().map(|place| place[axis]).filter(|v| v.is_finite());
            let [low, high] = given.unwrap_or_else(|| {
                finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
            });
            // A range without a width, or of nothing, gets one about its middle.
            let width = high - low;
            if !width.is_finite() {
                [0.0, 1.0]
            } else if width <= 1e-12 * low.abs().max(high.abs()) {
                let half = if low == 0.0 { 0.5 } else { 0.05 * low.abs() };
                [low - half, low + half]
            } else {
                [low, high]
            }
        };
        [span(0, self.x_range), span(1, self.y_range)]
    }
}

#[cfg(test)]
mod tests;
