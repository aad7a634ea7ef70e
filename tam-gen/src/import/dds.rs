//! Reading DDS.
//!
//! The `ddsfile` crate reads the headers; sizes and layout are worked out here, with every length checked.

use ddsfile::{Caps2, D3D10ResourceDimension, Dds, DxgiFormat, FourCC, MiscFlag, PixelFormat, PixelFormatFlags};

use super::error::DecodeError;
use super::texture::{Layout, Shape, Texture, TextureLevel};

/// Reads a 2D texture or array: R8, L8, RGB8, RGBA8, BGRA8 (linear or sRGB) or BC4, with or without the DX10 header.
///
/// # Errors
///
/// Any but these bytes give an error; memory is bounded by the size of the file.
pub fn decode(bytes: &[u8]) -> Result<Texture, DecodeError> {
    if !bytes.starts_with(b"DDS ") {
        return Err(DecodeError::Kind("DDS"));
    }
    let dds = Dds::read(bytes).map_err(|error| DecodeError::Damaged(format!("its header: {error}")))?;
    let header = &dds.header;
    let layout = match &dds.header10 {
        Some(header10) => dxgi_layout(header10.dxgi_format)?,
        None => legacy_layout(&header.spf)?,
    };
    let flat = dds.header10.as_ref().is_none_or(|header10| {
        header10.resource_dimension == D3D10ResourceDimension::Texture2D
            && !header10.misc_flag.contains(MiscFlag::TEXTURECUBE)
    });
    if !flat || header.caps2.intersects(Caps2::CUBEMAP | Caps2::VOLUME) {
        return Err(DecodeError::Unsupported(
            "it is no 2D texture or array (1D, 3D and cube maps are not read)".into(),
        ));
    }
    let shape = Shape {
        width: header.width,
        height: header.height,
        layers: dds.header10.as_ref().map_or(1, |header10| header10.array_size),
        levels: header.mip_map_count.unwrap_or(1).max(1),
    };
    shape.check(layout)?;

    let sizes: Vec<(u32, u32)> = (0..shape.levels).map(|level| shape.level(level)).collect();
    let needed: u64 =
        sizes.iter().map(|&(width, height)| layout.bytes(width, height)).sum::<u64>() * u64::from(shape.layers);
    if (dds.data.len() as u64) < needed {
        let headers = (bytes.len() - dds.data.len()) as u64;
        let what = format!("{} layers of {} levels", shape.layers, shape.levels);
        return Err(DecodeError::Truncated { what, needed: headers + needed, given: bytes.len() as u64 });
    }
    let mut levels: Vec<TextureLevel> =
        sizes.iter().map(|&(width, height)| TextureLevel { width, height, layers: Vec::new() }).collect();
    let mut rest = &dds.data[..];
    for _ in 0..shape.layers {
        for level in &mut levels {
            let (data, after) = rest.split_at(layout.bytes(level.width, level.height) as usize);
            level.layers.push(layout.decode(data, level.width, level.height));
            rest = after;
        }
    }
    Ok(Texture { channels: layout.channels(), levels, key_values: Default::default(), was_srgb: layout.is_srgb() })
}

fn dxgi_layout(format: DxgiFormat) -> Result<Layout, DecodeError> {
    Ok(match format {
        DxgiFormat::R8_UNorm => Layout::grey(false),
        DxgiFormat::BC4_UNorm => Layout::Bc4,
        DxgiFormat::R8G8B8A8_UNorm => Layout::colour(4, [0, 1, 2], false),
        DxgiFormat::R8G8B8A8_UNorm_sRGB => Layout::colour(4, [0, 1, 2], true),
        DxgiFormat::B8G8R8A8_UNorm | DxgiFormat::B8G8R8X8_UNorm => Layout::colour(4, [2, 1, 0], false),
        DxgiFormat::B8G8R8A8_UNorm_sRGB | DxgiFormat::B8G8R8X8_UNorm_sRGB => Layout::colour(4, [2, 1, 0], true),
        other => return Err(unsupported(&format!("{other:?}"))),
    })
}

/// Formats from before DirectX 10, told by a four-character code or by colour masks.
fn legacy_layout(format: &PixelFormat) -> Result<Layout, DecodeError> {
    const ATI1: u32 = u32::from_le_bytes(*b"ATI1");
    const BC4U: u32 = u32::from_le_bytes(*b"BC4U");
    if let Some(FourCC(code)) = format.fourcc {
        if [ATI1, BC4U].contains(&code) {
            return Ok(Layout::Bc4);
        }
        return Err(unsupported(&format!("four-character code {:?}", String::from_utf8_lossy(&code.to_le_bytes()))));
    }
    // The byte of a texel that a mask selects whole.
    let byte = |mask: Option<u32>| [0xff, 0xff00, 0xff_0000, 0xff00_0000].iter().position(|&byte| Some(byte) == mask);
    let channels = [byte(format.r_bit_mask), byte(format.g_bit_mask), byte(format.b_bit_mask)];
    match (format.rgb_bit_count, channels) {
        (Some(8), [Some(0), ..]) => Ok(Layout::grey(false)),
        (Some(8), _) if format.flags.contains(PixelFormatFlags::LUMINANCE) => Ok(Layout::grey(false)),
        (Some(bits @ (24 | 32)), [Some(r), Some(g), Some(b)]) if r.max(g).max(b) < bits as usize / 8 => {
            Ok(Layout::colour(bits as usize / 8, [r, g, b], false))
        }
        (bits, _) => Err(unsupported(&format!("{} bits, red mask {:x?}", bits.unwrap_or(0), format.r_bit_mask))),
    }
}

fn unsupported(format: &str) -> DecodeError {
    DecodeError::Unsupported(format!("its texel format ({format}) is not read; R8, L8, RGB8, RGBA8, BGRA8 and BC4 are"))
}
