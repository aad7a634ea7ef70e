//! Which files an export consists of.

use image::ColorType;

use super::content::{
    Content, PACKED_COLUMNS, array, bc4_array, dds_of, encode_png, grey_png, luminance, packed, stroke_map,
};
use super::sheet::{SheetOptions, contact_sheet};
use super::{ExportError, ExportOptions, Format, dds, json, svg};
use crate::map::{Level, Map};

/// A file to be made.
pub(super) struct Planned<'a> {
    /// Path relative to the folder, with `/` between its parts.
    pub(super) path: String,
    /// What it is, in a few words.
    pub(super) what: String,
    /// Makes its content, or says why not.
    pub(super) make: Box<dyn Fn() -> Result<Content, String> + Send + Sync + 'a>,
}

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
                let (paper, ink) = map.preset.colours.srgb().map_err(ExportError::Map)?;
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
        let sheet_options = SheetOptions::of(name, &map.preset).map_err(ExportError::Map)?;
        files.push(file(
            format!("{name}.sheet.png"),
            "contact sheet, PNG",
            Box::new(move || {
                let sheet = contact_sheet(grid, &sheet_options);
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
