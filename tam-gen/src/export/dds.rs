//! DDS files with the DX10 header: R8, arrays layer by layer.
//!
//! Source: Microsoft, "Programming Guide for DDS" and the `DDS_HEADER_DXT10` reference.

const DXGI_R8_UNORM: u32 = 61;
const DIMENSION_TEXTURE_2D: u32 = 3;
const ALPHA_OPAQUE: u32 = 3;

/// The bytes of a DDS file: a square R8 texture of `layers`, each a list of levels, finest first, by rows.
///
/// The legacy pixel format says only "see the DX10 header" (four-character code `DX10`): some readers believe zero
/// colour masks where they find them and decode black.
pub fn write(size: u32, layers: &[Vec<&[u8]>]) -> Vec<u8> {
    const CAPS: u32 = 0x1;
    const HEIGHT: u32 = 0x2;
    const WIDTH: u32 = 0x4;
    const PITCH: u32 = 0x8;
    const PIXEL_FORMAT: u32 = 0x1000;
    const MIPMAP_COUNT: u32 = 0x2_0000;
    const CAPS_COMPLEX: u32 = 0x8;
    const CAPS_TEXTURE: u32 = 0x1000;
    const CAPS_MIPMAP: u32 = 0x40_0000;

    let levels = layers.first().map_or(0, Vec::len) as u32;
    let (mut flags, mut caps) = (CAPS | HEIGHT | WIDTH | PITCH | PIXEL_FORMAT, CAPS_TEXTURE);
    if levels > 1 {
        flags |= MIPMAP_COUNT;
        caps |= CAPS_COMPLEX | CAPS_MIPMAP;
    }
    let texels: usize = layers.iter().flatten().map(|level| level.len()).sum();
    let mut out = Vec::with_capacity(148 + texels);
    let mut words = |words: &[u32]| words.iter().for_each(|word| out.extend(word.to_le_bytes()));
    words(&[u32::from_le_bytes(*b"DDS "), 124, flags, size, size, size, 0, levels]);
    words(&[0; 11]);
    words(&[32, 0x4, u32::from_le_bytes(*b"DX10"), 0, 0, 0, 0, 0]);
    words(&[caps, 0, 0, 0, 0]);
    words(&[DXGI_R8_UNORM, DIMENSION_TEXTURE_2D, 0, layers.len() as u32, ALPHA_OPAQUE]);
    for level in layers.iter().flatten() {
        out.extend_from_slice(level);
    }
    out
}
