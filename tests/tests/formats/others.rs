//! Maps made by other tools.

use std::path::Path;

use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgba, RgbaImage};
use tam_gen::import::{ImportError, ImportOptions, LevelOrder, Polarity, read};

use crate::sample;

/// Writes the levels of a map as pictures, with names and polarity of someone's choice.
fn pictures(dir: &Path, map: &tam_gen::Map, name: impl Fn(usize, usize) -> String, ink: bool, format: ImageFormat) {
    for (l, level) in map.grid.levels.iter().enumerate() {
        for (k, cell) in level.cells.iter().enumerate() {
            let texel = |x, y| cell[(y * level.size + x) as usize];
            let picture = GrayImage::from_fn(level.size, level.size, |x, y| {
                Luma([if ink { texel(x, y) } else { 255 - texel(x, y) }])
            });
            DynamicImage::from(picture).save_with_format(dir.join(name(k, l)), format).unwrap();
        }
    }
}

fn with_pattern(pattern: &str) -> ImportOptions {
    ImportOptions { pattern: Some(pattern.into()), ..ImportOptions::default() }
}

#[test]
fn numbers_may_be_padded_start_at_one_and_count_levels_either_way() {
    let map = sample::map(3, 64, 16, false);
    for (format, extension) in [(ImageFormat::Png, "png"), (ImageFormat::Tga, "tga"), (ImageFormat::Bmp, "bmp")] {
        let dir = tempfile::tempdir().unwrap();
        pictures(dir.path(), &map, |k, l| format!("hatch_{:03}-{}.{extension}", k + 1, 3 - l), false, format);
        let options = with_pattern(&format!("hatch_{{tone}}-{{level}}.{extension}"));
        for level_order in [LevelOrder::Auto, LevelOrder::CoarsestFirst] {
            let imported = read(dir.path(), &ImportOptions { level_order, ..options.clone() }).unwrap();
            assert!(imported.grid.levels == map.grid.levels, "{extension}");
            assert!(!imported.tones_given && imported.version.is_none());
        }
        let wrong = ImportOptions { level_order: LevelOrder::FinestFirst, ..options };
        let error = read(dir.path(), &wrong).unwrap_err();
        assert!(matches!(&error, ImportError::Size(sizes) if sizes.contains("16 x 16, 32 x 32, 64 x 64")), "{error}");
    }
}

#[test]
fn polarity_is_told_from_the_trend_or_asked_for() {
    let (map, dir) = (sample::map(3, 64, 32, false), tempfile::tempdir().unwrap());
    pictures(dir.path(), &map, |k, l| format!("tone{k}_level{l}.png"), true, ImageFormat::Png);
    let imported = read(dir.path(), &ImportOptions::default()).unwrap();
    assert!(imported.grid.levels == map.grid.levels);
    assert!(imported.notes.iter().any(|note| note.contains("--polarity luminance")), "{:?}", imported.notes);
    // Read as luminance, the same pictures are a map that comes darkest first.
    let imported = read(dir.path(), &ImportOptions { polarity: Polarity::Luminance, ..Default::default() }).unwrap();
    assert!(imported.notes.iter().any(|note| note.contains("turned round")), "{:?}", imported.notes);
    assert!(imported.grid.tones.is_sorted());

    let (one, dir) = (sample::map(1, 64, 32, false), tempfile::tempdir().unwrap());
    pictures(dir.path(), &one, |k, l| format!("tone{k}_level{l}.png"), true, ImageFormat::Png);
    let error = read(dir.path(), &ImportOptions::default()).unwrap_err();
    assert!(error.to_string().contains("--polarity ink"), "{error}");
    let imported = read(dir.path(), &ImportOptions { polarity: Polarity::Ink, ..Default::default() }).unwrap();
    assert!(imported.grid.levels == one.grid.levels);
}

#[test]
fn tones_may_be_given_and_must_fit() {
    let (map, dir) = (sample::map(3, 64, 32, false), tempfile::tempdir().unwrap());
    pictures(dir.path(), &map, |k, l| format!("tone{k}_level{l}.png"), false, ImageFormat::Png);
    let with = |tones: &[f64]| read(dir.path(), &ImportOptions { tones: Some(tones.to_vec()), ..Default::default() });
    let imported = with(&[0.2, 0.5, 0.8]).unwrap();
    assert!(imported.tones_given && imported.grid.tones == [0.2, 0.5, 0.8]);
    for wrong in [&[0.2, 0.5][..], &[0.5, 0.2, 0.8], &[0.0, 0.2, 0.5], &[0.2, 0.5, f64::NAN], &[0.2, 0.5, 1.5]] {
        assert!(matches!(with(wrong).unwrap_err(), ImportError::Tones(_)), "{wrong:?}");
    }
}

#[test]
fn missing_cells_wrong_names_and_wrong_sizes_are_named() {
    let (map, dir) = (sample::map(3, 64, 16, false), tempfile::tempdir().unwrap());
    let error = read(dir.path(), &ImportOptions::default()).unwrap_err().to_string();
    assert!(error.contains("are no files"), "{error}");
    pictures(dir.path(), &map, |k, l| format!("tone{k}_level{l}.png"), false, ImageFormat::Png);
    let error = read(dir.path(), &with_pattern("t{tone}-{level}.png")).unwrap_err().to_string();
    assert!(error.contains("tone0_level0.png") && error.contains("--pattern"), "{error}");

    std::fs::remove_file(dir.path().join("tone1_level2.png")).unwrap();
    let error = read(dir.path(), &ImportOptions::default()).unwrap_err().to_string();
    assert!(error.contains("1 file is missing") && error.contains("tone1_level2.png"), "{error}");
    GrayImage::new(20, 16).save(dir.path().join("tone1_level2.png")).unwrap();
    let error = read(dir.path(), &ImportOptions::default()).unwrap_err().to_string();
    assert!(error.contains("20 x 16") && error.contains("64 x 64"), "{error}");
    std::fs::write(dir.path().join("tone01_level2.png"), "").unwrap();
    assert!(matches!(read(dir.path(), &ImportOptions::default()).unwrap_err(), ImportError::Twice { .. }));
}

#[test]
fn levels_that_do_not_halve_are_refused_with_their_sizes() {
    let dir = tempfile::tempdir().unwrap();
    for (name, size) in
        [("tone0_level0.png", 64), ("tone0_level1.png", 48), ("tone1_level0.png", 64), ("tone1_level1.png", 48)]
    {
        GrayImage::new(size, size).save(dir.path().join(name)).unwrap();
    }
    let error = read(dir.path(), &ImportOptions::default()).unwrap_err().to_string();
    assert!(error.contains("64 x 64, 48 x 48"), "{error}");
}

#[test]
fn transparency_is_paper_colours_are_luminance_and_sixteen_bits_are_rounded() {
    let dir = tempfile::tempdir().unwrap();
    let save = |name: &str, picture: DynamicImage| picture.save(dir.path().join(name)).unwrap();
    save("tone0_level0.png", RgbaImage::from_fn(8, 8, |x, _| Rgba([0, 0, 0, if x < 4 { 0 } else { 51 }])).into());
    save("tone1_level0.png", image::ImageBuffer::from_fn(8, 8, |_, _| Luma([0x8080_u16])).into());
    save("tone2_level0.png", RgbaImage::from_pixel(8, 8, Rgba([0, 0, 255, 255])).into());
    let imported = read(dir.path(), &ImportOptions::default()).unwrap();
    let cells = &imported.grid.levels[0].cells;
    assert_eq!((cells[0][0], cells[0][7]), (0, 51));
    assert_eq!(cells[1][0], 127);
    assert_eq!(cells[2][0], 255 - 18, "BT.709 gives blue 0.0722");
}

#[test]
fn a_blank_lightest_column_is_left_out() {
    let dir = tempfile::tempdir().unwrap();
    for (k, grey) in [255, 128, 0].into_iter().enumerate() {
        GrayImage::from_pixel(8, 8, Luma([grey])).save(dir.path().join(format!("tone{k}_level0.png"))).unwrap();
    }
    let imported = read(dir.path(), &ImportOptions::default()).unwrap();
    assert_eq!(imported.grid.columns(), 2);
    assert!(imported.notes.iter().any(|note| note.contains("blank paper")), "{:?}", imported.notes);
}

#[test]
fn a_stroke_map_is_no_map_but_may_be_given_with_one() {
    let (map, dir) = (sample::map(2, 64, 32, false), tempfile::tempdir().unwrap());
    crate::write(&map, dir.path(), &[tam_gen::export::Format::Png, tam_gen::export::Format::DdsArray]);
    let stroke_map = dir.path().join("lines.strokemap.ktx2");
    let error = read(&stroke_map, &ImportOptions::default()).unwrap_err().to_string();
    assert!(error.contains("stroke map"), "{error}");
    let options = ImportOptions { stroke_map: Some(stroke_map), ..Default::default() };
    assert!(read(&dir.path().join("cells"), &options).unwrap().stroke_map == Some(map.stroke_map.clone()));
    let options = ImportOptions { stroke_map: Some(dir.path().join("lines.strokemap.dds")), ..Default::default() };
    let read_back = read(&dir.path().join("cells"), &options).unwrap().stroke_map.unwrap();
    assert!(read_back.levels == map.stroke_map.levels);
}

#[test]
fn what_is_not_there_or_is_no_texture_is_said_so() {
    let dir = tempfile::tempdir().unwrap();
    let error = read(&dir.path().join("none.ktx2"), &ImportOptions::default()).unwrap_err().to_string();
    assert!(error.contains("none.ktx2"), "{error}");
    std::fs::write(dir.path().join("text.ktx2"), "once upon a time there was a text").unwrap();
    let error = read(&dir.path().join("text.ktx2"), &ImportOptions::default()).unwrap_err();
    assert!(matches!(error, ImportError::Decode { .. }), "{error}");
}
