//! KTX 2.0 files: arrays with explicit levels, Zstandard and key/values.
//!
//! Source: KTX File Format Specification 2.0 (Khronos), sections 3 to 5; Khronos Data Format Specification 1.3 for the
//! descriptor. `bytesPlane` keeps the size of the uncompressed texel, as the specification's revision of 2025 asks.

use std::borrow::Cow;
use std::io;

use rayon::prelude::*;

/// Zstandard level: above 6, hatching gains under a per cent and takes three times as long.
const ZSTD_LEVEL: i32 = 6;

const IDENTIFIER: [u8; 12] = *b"\xABKTX 20\xBB\r\n\x1A\n";
const HEADER_BYTES: usize = 80;
const LEVEL_INDEX_BYTES: usize = 24;

/// The texel formats that are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TexelFormat {
    /// `VK_FORMAT_R8_UNORM`.
    R8,
    /// `VK_FORMAT_R8G8B8A8_UNORM`.
    Rgba8,
    /// `VK_FORMAT_BC4_UNORM_BLOCK`, blocks of 4 x 4 texels.
    Bc4,
}

/// A square texture to be written.
pub struct Texture<'a> {
    /// How texels are stored.
    pub format: TexelFormat,
    /// Side of level 0 in texels.
    pub size: u32,
    /// Number of array layers; 0 for a texture that is no array.
    pub layers: u32,
    /// How many levels it has.
    pub levels: usize,
    /// Makes the texels of a level, 0 the finest: those of all layers, one after the other, each by rows. Asked once for each
    /// level, so that not all of them are in memory at once.
    pub texels: &'a (dyn Fn(usize) -> Cow<'a, [u8]> + Sync),
    /// Metadata as text; keys of one's own must not begin with `KTX`.
    pub key_values: Vec<(&'a str, String)>,
}

impl TexelFormat {
    const fn vk_format(self) -> u32 {
        match self {
            Self::R8 => 9,
            Self::Rgba8 => 37,
            Self::Bc4 => 139,
        }
    }

    /// The data format descriptor with its total size: linear light, BT.709 primaries, straight alpha.
    fn descriptor(self) -> Vec<u8> {
        const MODEL_RGBSDA: u8 = 1;
        const MODEL_BC4: u8 = 131;
        const PRIMARIES_BT709: u8 = 1;
        const TRANSFER_LINEAR: u8 = 1;
        const CHANNEL_ALPHA: u8 = 15;
        // Channel, bit offset, bits, value that means 1.
        type Sample = (u8, u16, u8, u32);
        const RGBA: [Sample; 4] = [(0, 0, 8, 255), (1, 8, 8, 255), (2, 16, 8, 255), (CHANNEL_ALPHA, 24, 8, 255)];
        let (model, block, bytes, samples): (u8, [u8; 4], u8, &[Sample]) = match self {
            Self::R8 => (MODEL_RGBSDA, [0; 4], 1, &[(0, 0, 8, 255)]),
            Self::Rgba8 => (MODEL_RGBSDA, [0; 4], 4, &RGBA),
            Self::Bc4 => (MODEL_BC4, [3, 3, 0, 0], 8, &[(0, 0, 64, u32::MAX)]),
        };
        let block_bytes = 24 + 16 * samples.len() as u16;
        let mut out = Vec::with_capacity(4 + usize::from(block_bytes));
        out.extend((4 + u32::from(block_bytes)).to_le_bytes());
        out.extend([0; 4]); // vendor Khronos, type basic
        out.extend(2_u16.to_le_bytes());
        out.extend(block_bytes.to_le_bytes());
        out.extend([model, PRIMARIES_BT709, TRANSFER_LINEAR, 0]);
        out.extend(block);
        out.extend([bytes, 0, 0, 0, 0, 0, 0, 0]);
        for &(channel, offset, bits, upper) in samples {
            out.extend(offset.to_le_bytes());
            out.extend([bits - 1, channel]);
            out.extend([0; 4]); // position
            out.extend(0_u32.to_le_bytes());
            out.extend(upper.to_le_bytes());
        }
        out
    }
}

/// The bytes of a KTX2 file in pieces, every level compressed by Zstandard.
///
/// # Errors
///
/// Those of the compressor, which for input in memory means out of memory.
pub fn write(texture: &Texture<'_>) -> io::Result<Vec<Vec<u8>>> {
    let compress = |level| {
        let texels = (texture.texels)(level);
        let mut compressed = zstd::bulk::compress(&texels, ZSTD_LEVEL).map_err(io::Error::other)?;
        compressed.shrink_to_fit();
        Ok((compressed, texels.len()))
    };
    let compressed: Vec<(Vec<u8>, usize)> =
        (0..texture.levels).into_par_iter().map(compress).collect::<io::Result<_>>()?;
    let descriptor = texture.format.descriptor();
    let key_values = key_value_bytes(&texture.key_values);

    let descriptor_at = HEADER_BYTES + LEVEL_INDEX_BYTES * texture.levels;
    let key_values_at = descriptor_at + descriptor.len();
    let data_at = key_values_at + key_values.len();

    let mut out = Vec::with_capacity(data_at);
    out.extend(IDENTIFIER);
    for word in [
        texture.format.vk_format(),
        1, // typeSize: bytes need no swapping
        texture.size,
        texture.size,
        0, // depth
        texture.layers,
        1, // faces
        texture.levels as u32,
        2, // Zstandard
        descriptor_at as u32,
        descriptor.len() as u32,
        key_values_at as u32,
        key_values.len() as u32,
    ] {
        out.extend(word.to_le_bytes());
    }
    out.extend([0; 16]); // no supercompression global data

    // Levels lie in the file coarsest first, so that a stream can show something early; the index is finest first.
    let mut offset = data_at;
    let mut offsets = vec![0; compressed.len()];
    for (level, (data, _)) in compressed.iter().enumerate().rev() {
        offsets[level] = offset;
        offset += data.len();
    }
    for (offset, (data, plain)) in offsets.iter().zip(&compressed) {
        for number in [*offset, data.len(), *plain] {
            out.extend((number as u64).to_le_bytes());
        }
    }
    out.extend(descriptor);
    out.extend(key_values);
    let levels = compressed.into_iter().rev().map(|(data, _)| data);
    Ok(std::iter::once(out).chain(levels).collect())
}

/// The key/value section: sorted by key, values as text that ends in NUL, entries padded to four bytes.
fn key_value_bytes(key_values: &[(&str, String)]) -> Vec<u8> {
    let mut sorted: Vec<_> = key_values.iter().collect();
    sorted.sort_by_key(|(key, _)| *key);
    let mut out = Vec::new();
    for (key, text) in sorted {
        out.extend(((key.len() + text.len() + 2) as u32).to_le_bytes());
        out.extend(key.as_bytes());
        out.push(0);
        out.extend(text.as_bytes());
        out.push(0);
        out.resize(out.len().next_multiple_of(4), 0);
    }
    out
}
