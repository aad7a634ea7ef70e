//! Reading KTX 2.0.
//!
//! The `ktx2` crate reads header and index; every length is checked here before it is used. The data format descriptor
//! is not looked at (`vkFormat` says the same).

use std::collections::BTreeMap;

use ktx2::{Format, Header, KeyValueDataIterator, LevelIndex, SupercompressionScheme};

use super::error::DecodeError;
use super::texture::{Layout, Shape, Texture, TextureLevel};

/// No Zstandard frame expands further: a block of 4 bytes can stand for 128 KiB.
const ZSTD_EXPANSION_MAX: u64 = 40_000;

/// Reads a 2D texture or array: R8, RGB8, BGR8, RGBA8, BGRA8 (linear or sRGB) or BC4, plain or with Zstandard.
///
/// # Errors
///
/// Any but these bytes give an error; memory is bounded by [`super::texture::BYTES_MAX`].
pub fn decode(bytes: &[u8]) -> Result<Texture, DecodeError> {
    let header_bytes = bytes.first_chunk::<{ Header::LENGTH }>().ok_or(DecodeError::Kind("KTX2"))?;
    let header = Header::from_bytes(header_bytes).map_err(|_| DecodeError::Kind("KTX2"))?;
    if header.pixel_height == 0 || header.pixel_depth != 0 || header.face_count != 1 {
        return Err(DecodeError::Unsupported(
            "it is no 2D texture or array (1D, 3D and cube maps are not read)".into(),
        ));
    }
    let layout = layout(header.format)?;
    let shape = Shape {
        width: header.pixel_width,
        height: header.pixel_height,
        layers: header.layer_count.max(1),
        levels: header.level_count.max(1),
    };
    shape.check(layout)?;
    let compressed = match header.supercompression_scheme {
        None => false,
        Some(SupercompressionScheme::Zstandard) => true,
        Some(other) => {
            return Err(DecodeError::Unsupported(format!(
                "its supercompression {} is not read, only Zstandard; `ktx deflate --zstd 9` converts it",
                other.value()
            )));
        }
    };

    let mut levels = Vec::new();
    for number in 0..shape.levels {
        let at = Header::LENGTH + number as usize * LevelIndex::LENGTH;
        let entry = part(bytes, at as u64, LevelIndex::LENGTH as u64, "the level index")?;
        let entry = entry.first_chunk().map(LevelIndex::from_bytes).ok_or(DecodeError::Kind("KTX2"))?;
        let data = part(bytes, entry.byte_offset, entry.byte_length, &format!("level {number}"))?;
        levels.push(level(data, entry.uncompressed_byte_length, compressed, layout, shape, number)?);
    }
    let index = header.index;
    let key_values = part(bytes, index.kvd_byte_offset.into(), index.kvd_byte_length.into(), "the key/value section")?;
    Ok(Texture {
        channels: layout.channels(),
        levels,
        key_values: text_key_values(key_values),
        was_srgb: layout.is_srgb(),
    })
}

fn layout(format: Option<Format>) -> Result<Layout, DecodeError> {
    Ok(match format {
        Some(Format::R8_UNORM) => Layout::grey(false),
        Some(Format::R8_SRGB) => Layout::grey(true),
        Some(Format::R8G8B8_UNORM) => Layout::colour(3, [0, 1, 2], false),
        Some(Format::R8G8B8_SRGB) => Layout::colour(3, [0, 1, 2], true),
        Some(Format::B8G8R8_UNORM) => Layout::colour(3, [2, 1, 0], false),
        Some(Format::B8G8R8_SRGB) => Layout::colour(3, [2, 1, 0], true),
        Some(Format::R8G8B8A8_UNORM) => Layout::colour(4, [0, 1, 2], false),
        Some(Format::R8G8B8A8_SRGB) => Layout::colour(4, [0, 1, 2], true),
        Some(Format::B8G8R8A8_UNORM) => Layout::colour(4, [2, 1, 0], false),
        Some(Format::B8G8R8A8_SRGB) => Layout::colour(4, [2, 1, 0], true),
        Some(Format::BC4_UNORM_BLOCK) => Layout::Bc4,
        other => {
            let name = other.map_or("undefined".into(), |format| format!("{format:?}"));
            let known = "R8, RGB8, BGR8, RGBA8, BGRA8 (UNORM or SRGB) and BC4";
            return Err(DecodeError::Unsupported(format!("its texel format, {name}, is not read; {known} are")));
        }
    })
}

fn level(
    data: &[u8],
    declared: u64,
    compressed: bool,
    layout: Layout,
    shape: Shape,
    number: u32,
) -> Result<TextureLevel, DecodeError> {
    let (width, height) = shape.level(number);
    let layer_bytes = layout.bytes(width, height);
    let expected = layer_bytes * u64::from(shape.layers);
    let given = if compressed { declared } else { data.len() as u64 };
    if given != expected {
        return Err(DecodeError::Damaged(format!("level {number} has {given} bytes of texels, not {expected}")));
    }
    let inflated;
    let texels = if compressed {
        if expected > (data.len() as u64 + 1) * ZSTD_EXPANSION_MAX {
            return Err(DecodeError::Damaged(format!("level {number} cannot expand to {expected} bytes")));
        }
        inflated = zstd::bulk::decompress(data, expected as usize)
            .map_err(|error| DecodeError::Damaged(format!("level {number}: {error}")))?;
        if inflated.len() as u64 != expected {
            let problem = format!("level {number} expands to {} bytes, not {expected}", inflated.len());
            return Err(DecodeError::Damaged(problem));
        }
        &inflated[..]
    } else {
        data
    };
    let layers = texels.chunks_exact(layer_bytes as usize).map(|layer| layout.decode(layer, width, height)).collect();
    Ok(TextureLevel { width, height, layers })
}

/// A part of the file that is known to lie in it.
fn part<'a>(bytes: &'a [u8], offset: u64, length: u64, what: &str) -> Result<&'a [u8], DecodeError> {
    let truncated = |needed| DecodeError::Truncated { what: what.into(), needed, given: bytes.len() as u64 };
    let end = offset.checked_add(length).ok_or_else(|| truncated(u64::MAX))?;
    if end > bytes.len() as u64 {
        return Err(truncated(end));
    }
    Ok(&bytes[offset as usize..end as usize])
}

/// The values that are text, without the NUL at their end.
fn text_key_values(section: &[u8]) -> BTreeMap<String, String> {
    KeyValueDataIterator::new(section)
        .filter_map(|(key, value)| {
            let value = value.strip_suffix(&[0]).unwrap_or(value);
            Some((key.to_owned(), std::str::from_utf8(value).ok()?.to_owned()))
        })
        .collect()
}
