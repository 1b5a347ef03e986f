//! Several pictures on one sheet, each with its caption.

use image::{Rgb as Pixel, RgbImage, imageops};

use crate::color::Rgb;
use crate::num::{floor, index};
use crate::text::{Type, ink};

/// A picture and the words below it.
#[derive(Clone, Copy, Debug)]
pub struct Panel<'a> {
    /// The picture.
    pub image: &'a RgbImage,
    /// The words; cut where they are wider than the picture.
    pub caption: &'a str,
}

/// Why there is no sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SheetError {
    /// No picture, or no column to put one in.
    ///
    /// ```
    /// # use tress_view::{SheetError, sheet};
    /// assert_eq!(sheet(&[], 2, [255; 3]), Err(SheetError::Empty));
    /// ```
    #[error("a sheet without a picture or without a column")]
    Empty,
    /// More pixels than a picture can have.
    #[error("a sheet of {width} x {height} pixels is too large")]
    TooLarge {
        /// Pixels across.
        width: u64,
        /// Pixels down.
        height: u64,
    },
}

/// Lays pictures out in rows of `columns` on paper of one colour, with captions below them.
///
/// Columns are as wide as the widest picture, rows as high as their highest, and pictures stand in
/// the middle. A row without a caption leaves no room for one.
///
/// ```
/// use image::RgbImage;
/// use tress_view::{Panel, sheet};
///
/// let (before, after) = (RgbImage::new(300, 200), RgbImage::new(300, 200));
/// let panels = [
///     Panel { image: &before, caption: "before" },
///     Panel { image: &after, caption: "after" },
/// ];
/// let sheet = sheet(&panels, 2, [236, 233, 228])?;
/// assert!(sheet.width() > 600 && sheet.height() > 200);
/// # Ok::<(), tress_view::SheetError>(())
/// ```
///
/// # Errors
///
/// Without a picture or a column, and when the sheet would have more than 2^28 pixels.
pub fn sheet(panels: &[Panel<'_>], columns: usize, paper: Rgb) -> Result<RgbImage, SheetError> {
    if panels.is_empty() || columns == 0 {
        return Err(SheetError::Empty);
    }
    let columns = columns.min(panels.len());
    let widest = panels.iter().map(|p| p.image.width()).max().unwrap_or(0);
    let highest = panels.iter().map(|p| p.image.height()).max().unwrap_or(0);
    let line = (widest.min(highest) as f32 / 28.0).clamp(12.0, 48.0).round();
    let gap = index(floor(0.6 * line)) as u64;
    let rows: Vec<Row<'_>> = panels.chunks(columns).map(|panels| Row::new(panels, line)).collect();
    let height = rows.iter().map(|row| row.height + row.caption + gap).sum::<u64>() + gap;
    let width = columns as u64 * (u64::from(widest) + gap) + gap;
    let too_large = SheetError::TooLarge { width, height };
    if 1 << 28 < width.saturating_mul(height) {
        return Err(too_large);
    }
    let pixels = |n: u64| u32::try_from(n).map_err(|_| too_large);
    let mut sheet = RgbImage::from_pixel(pixels(width)?, pixels(height)?, Pixel(paper));
    let letters = Type::new(line);
    let mut top = gap;
    for row in rows {
        let mut x = gap;
        for panel in row.panels {
            let left = x + u64::from((widest - panel.image.width()) / 2);
            let inset = (row.height - u64::from(panel.image.height())) / 2;
            let place = [left, top + inset].map(u64::cast_signed);
            imageops::replace(&mut sheet, panel.image, place[0], place[1]);
            let words = letters.fitted(panel.caption, widest as f32);
            let left = x as f32 + 0.5 * (widest as f32 - letters.width(&words));
            let below = (top + row.height) as f32 + 0.35 * line;
            letters.draw(&mut sheet, left.round(), below.round(), &words, ink(paper));
            x += u64::from(widest) + gap;
        }
        top += row.height + row.caption + gap;
    }
    Ok(sheet)
}

/// Pictures side by side.
struct Row<'a> {
    panels: &'a [Panel<'a>],
    /// Pixels that the highest picture takes.
    height: u64,
    /// Pixels that captions take; none where no picture has one.
    caption: u64,
}

impl<'a> Row<'a> {
    fn new(panels: &'a [Panel<'a>], line: f32) -> Self {
        let height = panels.iter().map(|p| p.image.height()).max().unwrap_or(0);
        let captioned = panels.iter().any(|panel| !panel.caption.is_empty());
        let caption = if captioned { index(floor(1.9 * line)) as u64 } else { 0 };
        Self { panels, height: u64::from(height), caption }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_stand_whole_in_their_places() {
        let paint = |w, h, v| RgbImage::from_pixel(w, h, Pixel([v; 3]));
        let (a, b, c) = (paint(120, 80, 10), paint(60, 80, 20), paint(120, 40, 30));
        let panels = [&a, &b, &c].map(|image| Panel { image, caption: "x" });
        let sheet = sheet(&panels, 2, [255; 3]).expect("a sheet");
        for (image, v) in [(&a, 10), (&b, 20), (&c, 30)] {
            let count = sheet.pixels().filter(|p| p.0 == [v; 3]).count();
            assert_eq!(count, (image.width() * image.height()) as usize);
        }
        assert!(sheet.width() < 2 * 120 + 60 && sheet.height() < 80 + 40 + 150);
    }

    #[test]
    fn rows_are_no_higher_than_their_pictures_and_captions_need() {
        let paint = |h| RgbImage::from_pixel(100, h, Pixel([9; 3]));
        let (high, low) = (paint(300), paint(50));
        let of = |caption| {
            let panels = [&high, &low, &low].map(|image| Panel { image, caption });
            sheet(&panels, 1, [255; 3]).expect("a sheet").height()
        };
        let gaps = of("") - (300 + 50 + 50);
        assert!(gaps < 50, "{gaps}");
        assert_eq!((of("x") - of("")) % 3, 0);
        assert!(of("") + 3 * 12 < of("x"));
    }

    #[test]
    fn captions_are_read_on_light_and_dark_paper_and_cut_when_long() {
        let image = RgbImage::from_pixel(200, 100, Pixel([128; 3]));
        for paper in [[255; 3], [20; 3]] {
            let with = |caption| {
                let panels = [Panel { image: &image, caption }];
                sheet(&panels, 9, paper).expect("a sheet")
            };
            let (blank, short) = (with(" "), with("after"));
            assert_eq!(blank.dimensions(), with(&"long ".repeat(99)).dimensions());
            let inked = short.pixels().zip(blank.pixels()).filter(|(a, b)| a != b).count();
            assert!(50 < inked && inked < 2000, "{inked}");
        }
    }
}
