//! A texture as any container held it, before it is known to be a map.

use std::collections::BTreeMap;

use super::error::DecodeError;
use crate::export::decode_bc4;
use crate::srgb;

/// Largest side that is read, in texels.
pub const SIDE_MAX: u32 = 16_384;
/// Most layers that are read.
pub const LAYERS_MAX: u32 = 2_048;
/// Most bytes of texels that are read, decompressed.
pub const BYTES_MAX: u64 = 2 << 30;

/// Levels of layers of texels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// Numbers per texel: 1 (luminance or whatever it stands for), or 3 (R, G, B).
    pub channels: usize,
    /// Levels, as ordered in the file.
    pub levels: Vec<TextureLevel>,
    /// Metadata as text; empty where the container has none.
    pub key_values: BTreeMap<String, String>,
    /// Whether texels were in sRGB and have been converted to linear light.
    pub was_srgb: bool,
}

/// One level of a texture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextureLevel {
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
    /// For each layer the texels by rows, `width * height * channels` bytes.
    pub layers: Vec<Vec<u8>>,
}

impl TextureLevel {
    /// One channel of one layer by rows; the luminance of R, G and B (BT.709) where `channel` is `None`.
    pub(super) fn plane(&self, layer: usize, channels: usize, channel: Option<usize>) -> Vec<u8> {
        let texels = &self.layers[layer];
        match channel {
            _ if channels == 1 => texels.clone(),
            Some(channel) => texels.iter().skip(channel).step_by(channels).copied().collect(),
            None => texels.chunks_exact(channels).map(|rgb| luminance(rgb[0], rgb[1], rgb[2])).collect(),
        }
    }
}

/// How the texels of a file lie in its bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    /// BC4 blocks.
    Bc4,
    /// Whole texels: bytes in each, offsets of its channels, and whether the numbers are sRGB.
    Plain { bytes: usize, channels: [usize; 3], grey: bool, srgb: bool },
}

impl Layout {
    pub(super) const fn grey(srgb: bool) -> Self {
        Self::Plain { bytes: 1, channels: [0; 3], grey: true, srgb }
    }

    pub(super) const fn colour(bytes: usize, channels: [usize; 3], srgb: bool) -> Self {
        Self::Plain { bytes, channels, grey: false, srgb }
    }

    pub(super) fn channels(self) -> usize {
        if matches!(self, Self::Plain { grey: false, .. }) { 3 } else { 1 }
    }

    pub(super) fn is_srgb(self) -> bool {
        matches!(self, Self::Plain { srgb: true, .. })
    }

    /// Bytes of one layer of a level in the file.
    pub(super) fn bytes(self, width: u32, height: u32) -> u64 {
        match self {
            Self::Bc4 => u64::from(width.div_ceil(4)) * u64::from(height.div_ceil(4)) * 8,
            Self::Plain { bytes, .. } => u64::from(width) * u64::from(height) * bytes as u64,
        }
    }

    /// The texels of one layer of a level: [`Layout::channels`] bytes each, by rows, in linear light.
    pub(super) fn decode(self, data: &[u8], width: u32, height: u32) -> Vec<u8> {
        match self {
            Self::Bc4 => decode_bc4(data, width as usize, height as usize),
            Self::Plain { bytes, channels, grey, srgb: is_srgb } => {
                let linear: [u8; 256] = std::array::from_fn(|i| {
                    let encoded = i as u8;
                    if is_srgb { (srgb::linear(encoded) * 255.0).round() as u8 } else { encoded }
                });
                let read = if grey { &channels[..1] } else { &channels[..] };
                data.chunks_exact(bytes)
                    .flat_map(|texel| read.iter().map(|&at| linear[usize::from(texel[at])]))
                    .collect()
            }
        }
    }
}

/// What a container says of its content, checked against the limits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) layers: u32,
    pub(super) levels: u32,
}

impl Shape {
    /// Whether the shape is one that is read; nothing is allocated before.
    pub(super) fn check(self, layout: Layout) -> Result<(), DecodeError> {
        let limit = |what, given: u32, limit: u32| {
            if given > limit {
                return Err(DecodeError::TooLarge { what, given: given.into(), limit: limit.into() });
            }
            if given == 0 { Err(DecodeError::Damaged(format!("{what} is 0"))) } else { Ok(()) }
        };
        limit("the width", self.width, SIDE_MAX)?;
        limit("the height", self.height, SIDE_MAX)?;
        limit("the number of layers", self.layers, LAYERS_MAX)?;
        limit("the number of levels", self.levels, self.width.max(self.height).ilog2() + 1)?;
        let (stored, decoded) = (0..self.levels)
            .map(|level| self.level(level))
            .map(|(w, h)| (layout.bytes(w, h), u64::from(w) * u64::from(h) * layout.channels() as u64))
            .fold((0, 0), |sum, level| (sum.0 + level.0, sum.1 + level.1));
        let given = stored.max(decoded) * u64::from(self.layers);
        if given > BYTES_MAX {
            return Err(DecodeError::TooLarge { what: "the size in bytes", given, limit: BYTES_MAX });
        }
        Ok(())
    }

    /// Width and height of a level.
    pub(super) fn level(self, level: u32) -> (u32, u32) {
        ((self.width >> level).max(1), (self.height >> level).max(1))
    }
}

/// Luminance of linear R, G, B (BT.709); exact for greys.
pub(super) fn luminance(r: u8, g: u8, b: u8) -> u8 {
    ((13_933 * u32::from(r) + 46_871 * u32::from(g) + 4_732 * u32::from(b) + 32_768) >> 16) as u8
}
