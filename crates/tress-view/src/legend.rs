//! The strip below a picture that says what its colours mean.

use image::{Rgb as Pixel, RgbImage};

use crate::camera::Size;
use crate::color::Rgb;
use crate::num::narrow;
use crate::scale::Scale;
use crate::text::{Type, fill, ink};

/// The colour of hair without a value.
pub(crate) const NO_VALUE: Rgb = [128, 128, 128];

/// Where the parts of a legend lie, in pixels; everything follows from the size of its letters.
struct Layout {
    /// Height of a line of text.
    line: f32,
    margin: f32,
    bar: f32,
}

impl Layout {
    fn new(size: Size) -> Self {
        let line = (size.width.min(size.height) as f32 / 42.0).clamp(12.0, 40.0).round();
        Self { line, margin: line, bar: (0.8 * line).round() }
    }

    /// Caption, bar, tick and label, with air between.
    fn height(&self) -> f32 {
        (0.5 * self.margin + 1.35 * self.line + self.bar + 1.5 * self.line + 0.6 * self.margin)
            .round()
    }
}

/// Pixels that a legend takes from the lower edge of a picture of this size; 0 when it would take
/// more than a third, and is left out.
pub(crate) fn height(size: Size) -> u32 {
    let height = crate::num::index(crate::num::floor(Layout::new(size).height()));
    let height = u32::try_from(height).unwrap_or(u32::MAX);
    if height <= size.height / 3 { height } else { 0 }
}

/// The legend of a picture of this size; `missing` says how many have no value, if any.
pub(crate) fn legend(scale: &Scale, missing: Option<&str>, size: Size, paper: Rgb) -> RgbImage {
    let layout = Layout::new(size);
    let mut strip = RgbImage::from_pixel(size.width, height(size), Pixel(paper));
    let letters = Type::new(layout.line);
    let ink = ink(paper);
    let width = size.width as f32;
    let left = layout.margin;
    let bar_width = (0.5 * width).max(12.0 * layout.line).min(width - 2.0 * left).max(1.0);

    let caption = letters.fitted(&scale.caption(), width - 2.0 * left);
    let top = 0.5 * layout.margin;
    letters.draw(&mut strip, left, top, &caption, ink);

    let top = top + 1.35 * layout.line;
    let bottom = top + layout.bar;
    fill(&mut strip, [left, left + bar_width], [top, bottom], |t| scale.map.rgb(f64::from(t)));

    let most = crate::num::index(crate::num::floor(bar_width / (3.6 * layout.line))).clamp(3, 9);
    for tick in scale.ticks(most) {
        let place = narrow(scale.place(tick.value).unwrap_or(0.5));
        let x = left + place * (bar_width - 1.0);
        let half = (0.03 * layout.line).max(0.5);
        let ends = [bottom, bottom + 0.3 * layout.line];
        fill(&mut strip, [x + 0.5 - half, x + 0.5 + half], ends, |_| ink);
        let label = letters.width(&tick.label);
        let x = (x + 0.5 - 0.5 * label).clamp(0.3 * left, width - label);
        letters.draw(&mut strip, x, bottom + 0.35 * layout.line, &tick.label, ink);
    }

    if let Some(missing) = missing {
        let x = left + bar_width + 2.0 * layout.line;
        fill(&mut strip, [x, x + layout.bar], [top, bottom], |_| NO_VALUE);
        let x = x + layout.bar + 0.5 * layout.line;
        let words = letters.fitted(missing, width - x - 0.5 * left);
        letters.draw(&mut strip, x, top + 0.5 * (layout.bar - layout.line), &words, ink);
    }
    strip
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_legend_shows_its_map_from_end_to_end_at_any_size() {
        for (width, height) in [(100, 200), (400, 300), (1600, 1600)] {
            let size = Size::new(width, height);
            let scale = Scale { title: "turns".into(), ..Scale::spanning([2.0, 20.0]) };
            let strip = legend(&scale, Some("no value: 3 of 9 strands"), size, [30; 3]);
            assert_eq!(strip.width(), width);
            for color in [scale.map.rgb(0.0), scale.map.rgb(1.0), NO_VALUE] {
                let shown = strip.pixels().any(|pixel| pixel.0 == color);
                assert!(shown || (color == NO_VALUE && width < 300), "{color:?} at {width}");
            }
        }
    }

    #[test]
    fn a_picture_too_low_for_a_legend_has_none() {
        assert_eq!(height(Size::new(500, 30)), 0);
        let strip = legend(&Scale::default(), None, Size::new(500, 30), [0; 3]);
        assert_eq!(strip.dimensions(), (500, 0));
        assert!(0 < height(Size::new(500, 300)));
    }
}
