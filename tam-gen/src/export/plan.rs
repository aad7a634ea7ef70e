//! Which files an export consists of, and how the bytes of each are made.

use image::{ColorType, ImageEncoder, codecs::png};

use super::ktx2::{TexelFormat, Texture};
use super::sheet::{SheetOptions, contact_sheet};
use super::{ExportError, ExportOptions, Format, VERSION, bc4, dds, json, ktx2, svg};
use crate::map::{Grid, Level, Map};
use crate::preset::ToneMeasure;

/// A file to be made.
pub(super) struct Planned<'a> {
    /// Path relative to the folder, with `/` between its parts.
    pub(super) path: String,
    /// What it is, in a few words.
    pub(super) what: String,
    /// Makes its content, or says why not.
    pub(super) make: Box<dyn Fn() -> Result<Content, String> + Send + Sync + 'a>,
}

/// The content of a file.
pub(super) struct Content {
    pub(super) bytes: Vec<u8>,
    /// Continues [`Planned::what`] with what turned out while making it.
    pub(super) remark: String,
}

impl From<Vec<u8>> for Content {
    fn from(bytes: Vec<u8>) -> Self {
        Self { bytes, remark: String::new() }
    }
}

/// The columns that one packed texture holds: R, G and B.
pub(crate) const PACKED_COLUMNS: usize = 3;

/// All files but the manifest.
pub(super) fn plan<'a>(
    map: &'a Map,
    name: &str,
    options: &ExportOptions,
    preset_toml: &'a str,
) -> Result<Vec<Planned<'a>>, ExportError> {
    let mut files: Vec<Planned<'a>> = Vec::new();
    let (grid, columns) = (&map.grid, map.grid.columns());
    let file = |path: String, what: &str, make: Box<dyn Fn() -> Result<Content, String> + Send + Sync + 'a>| Planned {
        path,
        what: what.into(),
        make,
    };
    let has_stroke_map = !map.stroke_map.levels.is_empty();
    for format in Format::ALL.into_iter().filter(|format| options.formats.contains(format)) {
        match format {
            Format::Ktx2 => files.push(file(
                format!("{name}.ktx2"),
                "tonal art map, KTX2 array R8",
                Box::new(move || Ok(array(map, preset_toml)?.into())),
            )),
            Format::Ktx2Bc4 => files.push(file(
                format!("{name}.bc4.ktx2"),
                "tonal art map, KTX2 array BC4",
                Box::new(move || bc4_array(map, preset_toml)),
            )),
            Format::DdsArray => {
                files.push(file(
                    format!("{name}.dds"),
                    "tonal art map, DDS array R8",
                    Box::new(move || Ok(dds_of(grid, 0..columns).into())),
                ));
                if has_stroke_map {
                    files.push(file(
                        format!("{name}.strokemap.dds"),
                        "stroke map, DDS R8",
                        Box::new(move || {
                            let levels = map.stroke_map.levels.iter().map(|level| &level.threshold[..]).collect();
                            Ok(dds::write(map.stroke_map.levels[0].size, &[levels]).into())
                        }),
                    ));
                }
            }
            Format::DdsSlices => files.extend((0..columns).map(|column| {
                file(
                    format!("{name}.tone{column}.dds"),
                    "one tone, DDS R8",
                    Box::new(move || Ok(dds_of(grid, column..column + 1).into())),
                )
            })),
            Format::RgbaPacked => files.extend((0..columns.div_ceil(PACKED_COLUMNS)).map(|index| {
                file(
                    format!("{name}.packed{index}.ktx2"),
                    "three tones packed, KTX2 RGBA8",
                    Box::new(move || Ok(packed(map, preset_toml, index)?.into())),
                )
            })),
            Format::Png => {
                for (l, level) in grid.levels.iter().enumerate() {
                    files.extend((0..columns).map(|k| {
                        let make = move || grey_png(&luminance(&level.cells[k]), level.size);
                        file(format!("cells/tone{k}_level{l}.png"), "one cell, grey PNG", Box::new(make))
                    }));
                }
                files.extend(map.stroke_map.levels.iter().enumerate().map(|(l, level)| {
                    let make = move || grey_png(&level.threshold, level.size);
                    file(format!("cells/strokemap_level{l}.png"), "stroke map level, grey PNG", Box::new(make))
                }));
            }
            Format::StrokesJson => files.push(file(
                format!("{name}.strokes.json"),
                "strokes, JSON",
                Box::new(move || Ok(json(&map.strokes)?.into())),
            )),
            Format::StrokesSvg => {
                let (paper, ink) = colours(map)?;
                let css = |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}");
                files.push(file(
                    format!("{name}.strokes.svg"),
                    "strokes of the darkest tone, SVG",
                    Box::new(move || Ok(svg::strokes_svg(map, &css(paper), &css(ink)).into_bytes().into())),
                ));
            }
        }
    }
    if has_stroke_map {
        files.push(file(
            format!("{name}.strokemap.ktx2"),
            "stroke map, KTX2 R8",
            Box::new(move || Ok(stroke_map(map, preset_toml)?.into())),
        ));
    }
    if options.sheet {
        let (paper, ink) = colours(map)?;
        let title = name.to_owned();
        files.push(file(
            format!("{name}.sheet.png"),
            "contact sheet, PNG",
            Box::new(move || {
                let description = map.preset.description.clone();
                let measure = ToneMeasure::named(map.preset.map.tone_measure);
                let sheet = contact_sheet(
                    grid,
                    &SheetOptions { title: title.clone(), description, paper, ink, measure, ..Default::default() },
                );
                encode_png(&sheet, sheet.dimensions(), ColorType::Rgb8)
            }),
        ));
    }
    Ok(files)
}

/// Whether all images have the sizes that the grid says.
pub(super) fn check_map(map: &Map) -> Result<(), ExportError> {
    let (grid, columns) = (&map.grid, map.grid.columns());
    let wrong = |problem: String| Err(ExportError::Map(problem));
    if columns == 0 || grid.levels.is_empty() || !(1..=grid.levels.len()).contains(&grid.hand_built) {
        return wrong("it has no columns or no levels".into());
    }
    let mut wanted = grid.levels[0].size;
    for (index, Level { size, cells }) in grid.levels.iter().enumerate() {
        if !size.is_power_of_two() || *size != wanted {
            return wrong(format!("level {index} is {size} px, not {wanted} px"));
        }
        let texels = *size as usize * *size as usize;
        if cells.len() != columns || cells.iter().any(|cell| cell.len() != texels) {
            return wrong(format!("level {index} does not hold {columns} cells of {texels} texels"));
        }
        wanted /= 2;
    }
    for (index, level) in map.stroke_map.levels.iter().enumerate() {
        let size = map.stroke_map.levels[0].size >> index;
        if !level.size.is_power_of_two()
            || level.size != size
            || level.threshold.len() != level.size as usize * level.size as usize
        {
            return wrong(format!("level {index} of the stroke map is not {size} px square"));
        }
    }
    Ok(())
}

fn colours(map: &Map) -> Result<([u8; 3], [u8; 3]), ExportError> {
    let parse = |key: &str, css: &str| match csscolorparser::parse(css) {
        Ok(colour) => {
            let [r, g, b, _] = colour.to_rgba8();
            Ok([r, g, b])
        }
        Err(error) => Err(ExportError::Map(format!("colours.{key} = \"{css}\" is no colour: {error}"))),
    };
    let colours = &map.preset.colours;
    Ok((parse("paper", &colours.paper)?, parse("ink", &colours.ink)?))
}

fn luminance(ink: &[u8]) -> Vec<u8> {
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

fn array(map: &Map, preset_toml: &str) -> Result<Vec<u8>, String> {
    let level = |level: &Level| level.cells.iter().flatten().map(|ink| 255 - ink).collect();
    let texture = Texture {
        format: TexelFormat::R8,
        size: map.grid.levels[0].size,
        layers: map.grid.columns() as u32,
        levels: map.grid.levels.iter().map(level).collect(),
        key_values: key_values(map, preset_toml)?,
    };
    ktx2::write(&texture).map_err(|error| error.to_string())
}

fn bc4_array(map: &Map, preset_toml: &str) -> Result<Content, String> {
    let compressed = bc4::compress(&map.grid);
    let texture = Texture {
        format: TexelFormat::Bc4,
        size: map.grid.levels[0].size,
        layers: map.grid.columns() as u32,
        levels: compressed.levels,
        key_values: key_values(map, preset_toml)?,
    };
    let nesting = match compressed.violations {
        0 => "nesting holds at every texel".into(),
        count => format!("nesting breaks at {count} texels"),
    };
    let remark = format!("; {nesting}, tones are off by up to {:.4}", compressed.tone_error);
    Ok(Content { bytes: ktx2::write(&texture).map_err(|error| error.to_string())?, remark })
}

fn stroke_map(map: &Map, preset_toml: &str) -> Result<Vec<u8>, String> {
    let mut key_values = key_values(map, preset_toml)?;
    let distribution = serde_json::to_string(&map.stroke_map.distribution).map_err(|error| error.to_string())?;
    key_values.push(("tam.distribution", distribution));
    let texture = Texture {
        format: TexelFormat::R8,
        size: map.stroke_map.levels[0].size,
        layers: 0,
        levels: map.stroke_map.levels.iter().map(|level| level.threshold.clone()).collect(),
        key_values,
    };
    ktx2::write(&texture).map_err(|error| error.to_string())
}

/// Columns `3 index ..` in R, G and B (Praun and others 2001, section 5), white where there are no more.
///
/// Alpha is 255 throughout: loaders that multiply by alpha, and browsers do by default, would spoil the other three.
fn packed(map: &Map, preset_toml: &str, index: usize) -> Result<Vec<u8>, String> {
    let level = |level: &Level| {
        let texels = level.size as usize * level.size as usize;
        let mut rgba = vec![255; 4 * texels];
        for (channel, ink) in level.cells.iter().skip(PACKED_COLUMNS * index).take(PACKED_COLUMNS).enumerate() {
            for (texel, ink) in rgba.chunks_exact_mut(4).zip(ink) {
                texel[channel] = 255 - ink;
            }
        }
        rgba
    };
    let mut key_values = key_values(map, preset_toml)?;
    key_values.push(("tam.packed", index.to_string()));
    let texture = Texture {
        format: TexelFormat::Rgba8,
        size: map.grid.levels[0].size,
        layers: 0,
        levels: map.grid.levels.iter().map(level).collect(),
        key_values,
    };
    ktx2::write(&texture).map_err(|error| error.to_string())
}

fn dds_of(grid: &Grid, columns: std::ops::Range<usize>) -> Vec<u8> {
    let cells: Vec<Vec<Vec<u8>>> =
        columns.map(|column| grid.levels.iter().map(|level| luminance(&level.cells[column])).collect()).collect();
    let layers: Vec<Vec<&[u8]>> = cells.iter().map(|levels| levels.iter().map(Vec::as_slice).collect()).collect();
    dds::write(grid.levels[0].size, &layers)
}

fn grey_png(texels: &[u8], size: u32) -> Result<Content, String> {
    encode_png(texels, (size, size), ColorType::L8)
}

fn encode_png(texels: &[u8], (width, height): (u32, u32), colour: ColorType) -> Result<Content, String> {
    let mut bytes = Vec::new();
    png::PngEncoder::new_with_quality(&mut bytes, png::CompressionType::Default, png::FilterType::Adaptive)
        .write_image(texels, width, height, colour.into())
        .map_err(|error| error.to_string())?;
    Ok(bytes.into())
}
