//! Pictures as PNG files.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError, RgbImage};

/// The bytes of a PNG file; the same picture gives the same bytes.
///
/// ```
/// let bytes = tress_view::png(&image::RgbImage::new(4, 4))?;
/// assert_eq!(&bytes[1..4], b"PNG");
/// # Ok::<(), image::ImageError>(())
/// ```
///
/// # Errors
///
/// If the picture has no pixels, or memory for its bytes runs out.
pub fn png(image: &RgbImage) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Vec::new();
    // Hair has no flat areas that slower compression would gain on.
    let encoder =
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive);
    encoder.write_image(image, image.width(), image.height(), ExtendedColorType::Rgb8)?;
    Ok(bytes)
}
