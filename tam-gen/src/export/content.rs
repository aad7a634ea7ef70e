//! The bytes of each file.

use image::{ColorType, ImageEncoder, codecs::png};

use super::ktx2::{TexelFormat, Texture};
use super::{VERSION, bc4, dds, ktx2};
use crate::map::{Grid, Level, Map};

/// The content of a file.
pub(super) struct Content {
    /// Its bytes, in pieces.
    pub(super) pieces: Vec<Vec<u8>>,
    /// Continues [`Planned::what`] with what turned out while making it.
    pub(super) remark: String,
}

impl From<Vec<u8>> for Content {
    fn from(bytes: Vec<u8>) -> Self {
        vec![bytes].into()
    }
}

impl From<Vec<Vec<u8>>> for Content {
    fn from(pieces: Vec<Vec<u8>>) -> Self {
        Self { pieces, remark: String::new() }
    }
}

/// The columns that one packed texture holds: R, G and B.
pub(super) const PACKED_COLUMNS: usize = 3;

pub(super) fn luminance(ink: &[u8]) -> Vec<u8> {
    ink.iter().map(|ink| 255 - ink).collect()
}

fn key_values(map: &Map, preset_toml: &str) -> Result<Vec<(&'static str, String)>, String> {
    Ok(vec![
        ("KTXorientation", "rd".into()),
        ("KTXwriter", format!("tam-gen {VERSION}")),
        ("tam.handBuiltLevels", map.grid.hand_built.to_string()),
        ("tam.preset", preset_toml.into()),
        ("tam.tones", serde_json::to_string(&map.grid.tones).map_err(|error| error.to_string())?),
        ("tam.version", VERSION.into()),
    ])
}

pub(super) fn array(map: &Map, preset_toml: &str) -> Result<Vec<Vec<u8>>, String> {
    let texels = |level: usize| {
        let Level { size, cells } = &map.grid.levels[level];
        let mut texels = Vec::with_capacity(cells.len() * *size as usize * *size as usize);
        cells.iter().for_each(|ink| texels.extend(ink.iter().map(|ink| 255 - ink)));
        texels.into()
    };
    let texture = Texture {
        format: TexelFormat::R8,
        size: map.grid.levels[0].size,
        layers: map.grid.columns() as u32,
        levels: map.grid.levels.len(),
        texels: &texels,
        key_values: key_values(map, preset_toml)?,
    };
    ktx2::write(&texture).map_err(|error| error.to_string())
}

pub(super) fn bc4_array(map: &Map, preset_toml: &str) -> Result<Content, String> {
    let compressed = bc4::compress(&map.grid);
    let texture = Texture {
        format: TexelFormat::Bc4,
        size: map.grid.levels[0].size,
        layers: map.grid.columns() as u32,
        levels: compressed.levels.len(),
        texels: &|level| compressed.levels[level][..].into(),
        key_values: key_values(map, preset_toml)?,
    };
    let nesting = match compressed.violations {
        0 => "nesting holds at every texel".into(),
        count => format!("nesting breaks at {count} texels"),
    };
    let remark = format!("; {nesting}, tones are off by up to {:.4}", compressed.tone_error);
    Ok(Content { pieces: ktx2::write(&texture).map_err(|error| error.to_string())?, remark })
}

pub(super) fn stroke_map(map: &Map, preset_toml: &str) -> Result<Vec<Vec<u8>>, String> {
    let mut key_values = key_values(map, preset_toml)?;
    let distribution = serde_json::to_string(&map.stroke_map.distribution).map_err(|error| error.to_string())?;
    key_values.push(("tam.distribution", distribution));
    let texture = Texture {
        format: TexelFormat::R8,
        size: map.stroke_map.levels[0].size,
        layers: 0,
        levels: map.stroke_map.levels.len(),
        texels: &|level| map.stroke_map.levels[level].threshold[..].into(),
        key_values,
    };
    ktx2::write(&texture).map_err(|error| error.to_string())
}

/// Columns `3 index ..` in R, G and B (Praun and others 2001, section 5), white where there are no more.
///
/// Alpha is 255 throughout: loaders that multiply by alpha, and browsers do by default, would spoil the other three.
pub(super) fn packed(map: &Map, preset_toml: &str, index: usize) -> Result<Vec<Vec<u8>>, String> {
    let texels = |level: usize| {
        let level = &map.grid.levels[level];
        let texels = level.size as usize * level.size as usize;
        let mut rgba = vec![255; 4 * texels];
        for (channel, ink) in level.cells.iter().skip(PACKED_COLUMNS * index).take(PACKED_COLUMNS).enumerate() {
            for (texel, ink) in rgba.chunks_exact_mut(4).zip(ink) {
                texel[channel] = 255 - ink;
            }
        }
        rgba.into()
    };
    let mut key_values = key_values(map, preset_toml)?;
    key_values.push(("tam.packed", index.to_string()));
    let texture = Texture {
        format: TexelFormat::Rgba8,
        size: map.grid.levels[0].size,
        layers: 0,
        levels: map.grid.levels.len(),
        texels: &texels,
        key_values,
    };
    ktx2::write(&texture).map_err(|error| error.to_string())
}

pub(super) fn dds_of(grid: &Grid, columns: std::ops::Range<usize>) -> Vec<u8> {
    let cells: Vec<Vec<Vec<u8>>> =
        columns.map(|column| grid.levels.iter().map(|level| luminance(&level.cells[column])).collect()).collect();
    let layers: Vec<Vec<&[u8]>> = cells.iter().map(|levels| levels.iter().map(Vec::as_slice).collect()).collect();
    dds::write(grid.levels[0].size, &layers)
}

pub(super) fn grey_png(texels: &[u8], size: u32) -> Result<Content, String> {
    encode_png(texels, (size, size), ColorType::L8)
}

pub(super) fn encode_png(texels: &[u8], (width, height): (u32, u32), colour: ColorType) -> Result<Content, String> {
    let mut bytes = Vec::new();
    png::PngEncoder::new_with_quality(&mut bytes, png::CompressionType::Fast, png::FilterType::Adaptive)
        .write_image(texels, width, height, colour.into())
        .map_err(|error| error.to_string())?;
    Ok(bytes.into())
}
