//! What readers that are not ours see.

use ddsfile::{Dds, DxgiFormat};
use ktx2::{ColorModel, Reader, SupercompressionScheme, TransferFunction};
use tam_gen::export::{Format, Manifest};

use crate::{sample, write};

fn reader(path: std::path::PathBuf) -> Reader<Vec<u8>> {
    Reader::new(std::fs::read(path).unwrap()).unwrap()
}

fn text(reader: &Reader<Vec<u8>>, wanted: &str) -> String {
    let (_, value) = reader.key_value_data().find(|(key, _)| *key == wanted).unwrap();
    String::from_utf8(value.strip_suffix(b"\0").unwrap().to_vec()).unwrap()
}

#[test]
fn ktx2_reader_sees_every_field_level_and_texel() {
    let (map, dir) = (sample::map(5, 128, 32, true), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::Ktx2]);
    let reader = reader(dir.path().join("lines.ktx2"));
    let header = reader.header();
    assert_eq!(header.format, Some(ktx2::Format::R8_UNORM));
    assert_eq!((header.pixel_width, header.pixel_height, header.pixel_depth), (128, 128, 0));
    assert_eq!((header.layer_count, header.face_count, header.level_count), (5, 1, 8));
    assert_eq!(header.type_size, 1);
    assert_eq!(header.supercompression_scheme, Some(SupercompressionScheme::Zstandard));

    let (expected, _) = ktx2::dfd::Basic::from_format(ktx2::Format::R8_UNORM).unwrap();
    assert_eq!(reader.basic_dfd(), Some(&expected));
    assert_eq!(reader.transfer_function(), Some(TransferFunction::Linear));
    assert_eq!(reader.color_model(), Some(ColorModel::RGBSDA));

    for (level, ours) in reader.levels().zip(&map.grid.levels) {
        let texels = zstd::bulk::decompress(level.data, level.uncompressed_byte_length as usize).unwrap();
        let wanted: Vec<u8> = ours.cells.iter().flatten().map(|ink| 255 - ink).collect();
        assert!(texels == wanted, "{} px", ours.size);
    }
    assert!(reader.writer().unwrap().starts_with("tam-gen"));
    assert_eq!(text(&reader, "KTXorientation"), "rd");
    assert_eq!(text(&reader, "tam.handBuiltLevels"), "3");
    assert_eq!(text(&reader, "tam.tones"), serde_json::to_string(&map.grid.tones).unwrap());
    assert_eq!(toml::from_str::<tam_gen::Preset>(&text(&reader, "tam.preset")).unwrap(), map.preset);
    let keys: Vec<&str> = reader.key_value_data().map(|(key, _)| key).collect();
    assert!(keys.is_sorted(), "{keys:?}");
}

#[test]
fn ktx2_descriptors_of_all_texel_formats_are_those_of_the_specification() {
    let (map, dir) = (sample::map(4, 64, 8, true), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::Ktx2Bc4, Format::RgbaPacked]);
    for (file, format, layers) in [
        ("lines.bc4.ktx2", ktx2::Format::BC4_UNORM_BLOCK, 4),
        ("lines.packed0.ktx2", ktx2::Format::R8G8B8A8_UNORM, 0),
        ("lines.packed1.ktx2", ktx2::Format::R8G8B8A8_UNORM, 0),
        ("lines.strokemap.ktx2", ktx2::Format::R8_UNORM, 0),
    ] {
        let reader = reader(dir.path().join(file));
        let (expected, type_size) = ktx2::dfd::Basic::from_format(format).unwrap();
        assert_eq!((reader.header().format, reader.header().layer_count), (Some(format), layers), "{file}");
        assert_eq!((reader.basic_dfd(), reader.header().type_size), (Some(&expected), type_size), "{file}");
    }
    let distribution = text(&reader(dir.path().join("lines.strokemap.ktx2")), "tam.distribution");
    assert_eq!(serde_json::from_str::<Vec<Vec<f32>>>(&distribution).unwrap(), map.stroke_map.distribution);
}

#[test]
fn packed_textures_hold_three_columns_and_opaque_white() {
    let (map, dir) = (sample::map(4, 64, 16, false), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::RgbaPacked]);
    for (file, first) in [("lines.packed0.ktx2", 0), ("lines.packed1.ktx2", 3)] {
        let reader = reader(dir.path().join(file));
        for (level, ours) in reader.levels().zip(&map.grid.levels) {
            let rgba = zstd::bulk::decompress(level.data, level.uncompressed_byte_length as usize).unwrap();
            for (i, texel) in rgba.chunks_exact(4).enumerate() {
                let luminance = |k: usize| ours.cells.get(k).map_or(255, |ink| 255 - ink[i]);
                assert_eq!(texel, [luminance(first), luminance(first + 1), luminance(first + 2), 255]);
            }
        }
    }
}

#[test]
fn bc4_stays_near_the_map_and_says_what_it_broke() {
    let (map, dir) = (sample::map(6, 64, 8, true), tempfile::tempdir().unwrap());
    let written = write(&map, dir.path(), &[Format::Ktx2Bc4]);
    assert!(written[0].what.contains("nesting"), "{}", written[0].what);
    let reader = reader(dir.path().join("lines.bc4.ktx2"));
    for (level, ours) in reader.levels().zip(&map.grid.levels) {
        let blocks = zstd::bulk::decompress(level.data, level.uncompressed_byte_length as usize).unwrap();
        let size = ours.size as usize;
        let per_layer = texpresso::Format::Bc4.compressed_size(size, size);
        assert_eq!(blocks.len(), per_layer * 6);
        for (blocks, ink) in blocks.chunks_exact(per_layer).zip(&ours.cells) {
            let mut rgba = vec![0; 4 * size * size];
            texpresso::Format::Bc4.decompress(blocks, size, size, &mut rgba);
            for (texel, ink) in rgba.chunks_exact(4).zip(ink) {
                assert!(texel[0].abs_diff(255 - ink) <= 18, "half a step of eight shades: {texel:?} {ink}");
            }
        }
    }
}

#[test]
fn ddsfile_sees_arrays_slices_and_the_stroke_map() {
    let (map, dir) = (sample::map(3, 64, 16, false), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::DdsArray, Format::DdsSlices]);
    let open = |name: &str| Dds::read(std::fs::File::open(dir.path().join(name)).unwrap()).unwrap();
    let column = |k: usize| map.grid.levels.iter().flat_map(move |level| level.cells[k].iter().map(|ink| 255 - ink));

    let array = open("lines.dds");
    assert_eq!(array.get_dxgi_format(), Some(DxgiFormat::R8_UNorm));
    assert_eq!((array.get_width(), array.get_height(), array.get_num_mipmap_levels()), (64, 64, 3));
    assert_eq!(array.get_num_array_layers(), 3);
    for k in 0..3 {
        assert!(array.get_data(k as u32).unwrap().iter().copied().eq(column(k)), "column {k}");
        let slice = open(&format!("lines.tone{k}.dds"));
        assert_eq!(slice.get_num_array_layers(), 1);
        assert!(slice.get_data(0).unwrap().iter().copied().eq(column(k)), "slice {k}");
    }
    let thresholds: Vec<u8> = map.stroke_map.levels.iter().flat_map(|level| level.threshold.clone()).collect();
    assert!(open("lines.strokemap.dds").get_data(0).unwrap() == thresholds);
}

#[test]
fn pngs_are_grey_luminance() {
    let (map, dir) = (sample::map(2, 64, 16, true), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::Png]);
    for (l, level) in map.grid.levels.iter().enumerate() {
        for (k, ink) in level.cells.iter().enumerate() {
            let png = image::open(dir.path().join(format!("cells/tone{k}_level{l}.png"))).unwrap();
            assert_eq!(png.color(), image::ColorType::L8);
            assert!(png.into_luma8().iter().zip(ink).all(|(luminance, ink)| *luminance == 255 - ink));
        }
    }
    let png = image::open(dir.path().join("cells/strokemap_level1.png")).unwrap();
    assert!(png.into_luma8().into_raw() == map.stroke_map.levels[1].threshold);
}

#[test]
fn svg_renders_like_the_darkest_cell() {
    let (mut map, dir) = (sample::map(3, 64, 16, false), tempfile::tempdir().unwrap());
    map.preset.colours.paper = "white".into();
    write(&map, dir.path(), &[Format::StrokesSvg]);
    let svg = std::fs::read_to_string(dir.path().join("lines.strokes.svg")).unwrap();
    for group in ["h", "h-tone0", "h-tone1", "h-tone2"] {
        assert!(svg.contains(&format!("<g id=\"{group}\"")), "{group}");
    }
    let tree = resvg::usvg::Tree::from_str(&svg, &Default::default()).unwrap();
    let mut pixmap = resvg::tiny_skia::Pixmap::new(64, 64).unwrap();
    resvg::render(&tree, Default::default(), &mut pixmap.as_mut());
    // Lines fill whole texels and wrap at u = 0.75, so even a seam of one texel would show.
    for (i, (pixel, ink)) in pixmap.pixels().iter().zip(&map.grid.levels[0].cells[2]).enumerate() {
        assert!(pixel.red().abs_diff(255 - ink) <= 2, "texel {i}: {} for ink {ink}", pixel.red());
    }
}

#[test]
fn strokes_and_manifest_are_read_back() {
    let (map, dir) = (sample::map(3, 64, 16, true), tempfile::tempdir().unwrap());
    let written = write(&map, dir.path(), &[Format::StrokesJson, Format::Ktx2]);
    let json = |name: &str| std::fs::read(dir.path().join(name)).unwrap();
    let strokes: tam_gen::StrokeList = serde_json::from_slice(&json("lines.strokes.json")).unwrap();
    assert!(strokes == map.strokes);

    let manifest: Manifest = serde_json::from_slice(&json("lines.json")).unwrap();
    assert_eq!((manifest.name.as_str(), manifest.seed, manifest.hand_built), ("lines", 1, 3));
    assert_eq!(manifest.preset, map.preset);
    assert_eq!(toml::from_str::<tam_gen::Preset>(&manifest.preset_toml).unwrap(), map.preset);
    assert_eq!(manifest.levels.len(), 7);
    assert!((manifest.levels[0].measured[1] - 0.5).abs() < 1e-12);
    assert_eq!(manifest.levels[0].strokes, [[8.0], [16.0], [24.0]]);
    assert!(manifest.levels[3].strokes.is_empty());
    assert_eq!(manifest.files.len() + 1, written.len());
    for (file, written) in manifest.files.iter().zip(&written) {
        assert_eq!(dir.path().join(&file.path), written.path);
        assert_eq!(file.bytes, std::fs::metadata(&written.path).unwrap().len());
    }
}
