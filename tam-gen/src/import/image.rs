//! Reading pictures.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, ImageReader, Limits};

use super::error::DecodeError;
use super::texture::{BYTES_MAX, SIDE_MAX, Texture, TextureLevel};

/// Reads a PNG, JPEG, TGA or BMP picture as the luminance of its colours (BT.709, taken as linear), over white where it
/// is transparent. Numbers of 16 bits are rounded to 8.
///
/// # Errors
///
/// Any but these bytes give an error; memory is bounded by [`super::texture::BYTES_MAX`].
pub fn decode(bytes: &[u8]) -> Result<Texture, DecodeError> {
    let mut reader = ImageReader::new(Cursor::new(bytes));
    // TGA has no mark at its beginning; all others do.
    reader.set_format(image::guess_format(bytes).unwrap_or(ImageFormat::Tga));
    let mut limits = Limits::default();
    limits.max_image_width = Some(SIDE_MAX);
    limits.max_image_height = Some(SIDE_MAX);
    limits.max_alloc = Some(BYTES_MAX / 2);
    reader.limits(limits);
    let picture = reader.decode().map_err(|error| match error {
        image::ImageError::Unsupported(_) => DecodeError::Kind("PNG, JPEG, TGA or BMP"),
        other => DecodeError::Damaged(other.to_string()),
    })?;
    let (width, height) = (picture.width(), picture.height());
    let texels = match picture {
        DynamicImage::ImageLuma8(grey) => grey.into_raw(),
        DynamicImage::ImageLuma16(grey) => grey.iter().map(|&x| byte(x)).collect(),
        other => other.into_rgba16().pixels().map(|pixel| byte(over_white(pixel.0))).collect(),
    };
    let level = TextureLevel { width, height, layers: vec![texels] };
    Ok(Texture { channels: 1, levels: vec![level], key_values: Default::default(), was_srgb: false })
}

/// Luminance of a colour with straight alpha over white, `0 ..= 65535`; exact for opaque greys.
fn over_white([r, g, b, alpha]: [u16; 4]) -> u16 {
    let luminance = (13_933 * u64::from(r) + 46_871 * u64::from(g) + 4_732 * u64::from(b) + 32_768) >> 16;
    let (alpha, full) = (u64::from(alpha), u64::from(u16::MAX));
    ((luminance * alpha + full * (full - alpha) + full / 2) / full) as u16
}

fn byte(x: u16) -> u8 {
    ((u32::from(x) * 255 + 32_767) / 65_535) as u8
}
