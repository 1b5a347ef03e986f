//! Words in pictures.

use ab_glyph::{Font, FontRef, ScaleFont, point};
use image::{Rgb as Pixel, RgbImage};

use crate::color::{Rgb, lightness};
use crate::num::{byte, floor};

/// Text of one size in the one typeface there is (Ubuntu Light, under the Ubuntu font licence).
pub(crate) struct Type {
    font: Option<FontRef<'static>>,
    /// Height of a line from ascender to descender, in pixels.
    pub(crate) size: f32,
}

impl Type {
    pub(crate) fn new(size: f32) -> Self {
        let font = FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).ok();
        Self { font, size }
    }

    /// How wide a text is, in pixels.
    pub(crate) fn width(&self, text: &str) -> f32 {
        self.glyphs(text).1
    }

    /// The text, cut and ended by dots where it is wider than `width` pixels.
    pub(crate) fn fitted(&self, text: &str, width: f32) -> String {
        if self.width(text) <= width {
            return text.into();
        }
        let starts: Vec<usize> = text.char_indices().map(|(i, _)| i).collect();
        let cut = |end: &usize| format!("{}\u{2026}", text[..*end].trim_end());
        let fits = starts.iter().rev().map(cut).find(|text| self.width(text) <= width);
        fits.unwrap_or_default()
    }

    /// Draws a text whose left end lies at `x` and whose line reaches down from `top`.
    pub(crate) fn draw(&self, image: &mut RgbImage, x: f32, top: f32, text: &str, color: Rgb) {
        let Some(font) = &self.font else { return };
        let baseline = top + font.as_scaled(self.size).ascent();
        for mut glyph in self.glyphs(text).0 {
            glyph.position += point(x, baseline);
            let Some(outline) = font.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            let (left, above) = (floor(corner.x), floor(corner.y));
            outline.draw(|dx, dy, share| {
                let (x, y) = (i64::from(left) + i64::from(dx), i64::from(above) + i64::from(dy));
                if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
                    && let Some(Pixel(below)) = image.get_pixel_mut_checked(x, y)
                {
                    for (old, new) in below.iter_mut().zip(color) {
                        let (a, b) = (f32::from(*old), f32::from(new));
                        *old = byte(a + (b - a) * share.clamp(0.0, 1.0));
                    }
                }
            });
        }
    }

    /// Glyphs from 0 on, and how far they reach.
    fn glyphs(&self, text: &str) -> (Vec<ab_glyph::Glyph>, f32) {
        let Some(font) = &self.font else { return (Vec::new(), 0.0) };
        let scaled = font.as_scaled(self.size);
        let mut at = 0.0;
        let mut before = None;
        let mut glyphs = Vec::new();
        for character in text.chars().filter(|c| !c.is_control()) {
            let mut glyph = scaled.scaled_glyph(character);
            at += before.map_or(0.0, |before| scaled.kern(before, glyph.id));
            glyph.position = point(at, 0.0);
            at += scaled.h_advance(glyph.id);
            before = Some(glyph.id);
            glyphs.push(glyph);
        }
        (glyphs, at)
    }
}

/// The colour of words on a background: dark on light and light on dark.
pub(crate) fn ink(background: Rgb) -> Rgb {
    if lightness(background) < 0.55 { [236, 234, 230] } else { [42, 40, 38] }
}

/// Fills a rectangle, as far as it lies in the picture.
pub(crate) fn fill(image: &mut RgbImage, x: [f32; 2], y: [f32; 2], color: impl Fn(f32) -> Rgb) {
    let [left, right] = x.map(|x| floor(x + 0.5));
    for column in left..right {
        let t = (column - left) as f32 / (right - left - 1).max(1) as f32;
        for row in floor(y[0] + 0.5)..floor(y[1] + 0.5) {
            let place = u32::try_from(column).ok().zip(u32::try_from(row).ok());
            if let Some(pixel) = place.and_then(|(x, y)| image.get_pixel_mut_checked(x, y)) {
                *pixel = Pixel(color(t));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_typeface_is_there_and_has_the_signs_of_the_field() {
        let letters = Type::new(20.0);
        let font = letters.font.as_ref().expect("the typeface is read");
        for sign in "aZ09.,()/%\u{2212}\u{2026}\u{00b0}\u{00b5}\u{03ba}\u{03c9}\u{03b2}".chars() {
            assert_ne!(font.glyph_id(sign).0, 0, "{sign}");
        }
        assert!(letters.width("mm") > letters.width("ii"));
    }

    #[test]
    fn long_words_are_cut_to_fit() {
        let letters = Type::new(16.0);
        let cut = letters.fitted("a groom of many strands", 80.0);
        assert!(cut.ends_with('\u{2026}') && letters.width(&cut) <= 80.0 && 4 < cut.len(), "{cut}");
        assert_eq!(letters.fitted("short", 80.0), "short");
        assert_eq!(letters.fitted("anything", 0.0), "");
        assert_eq!(letters.fitted("anything", f32::NAN), "");
    }

    #[test]
    fn words_outside_of_the_picture_are_left_out() {
        let mut image = RgbImage::new(10, 10);
        for (x, y) in [(-50.0, 0.0), (0.0, -50.0), (9e9, 3.0), (f32::NAN, f32::NAN), (-3.0, -3.0)] {
            Type::new(12.0).draw(&mut image, x, y, "edge", [255; 3]);
        }
        assert!(image.pixels().any(|pixel| pixel.0 != [0; 3]), "the last one is seen in part");
    }
}
