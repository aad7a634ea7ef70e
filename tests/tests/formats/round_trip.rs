//! What was exported is what is imported.

use tam_gen::export::Format;
use tam_gen::import::{ImportOptions, read};

use crate::{sample, write};

#[test]
fn every_format_comes_back_as_it_went() {
    let map = sample::map(5, 64, 16, true);
    for (format, source) in [
        (Format::Ktx2, "lines.ktx2"),
        (Format::DdsArray, "lines.dds"),
        (Format::DdsSlices, "lines.tone0.dds"),
        (Format::DdsSlices, "lines.tone{tone}.dds"),
        (Format::RgbaPacked, "lines.packed0.ktx2"),
        (Format::Png, ""),
        (Format::Png, "cells"),
    ] {
        let dir = tempfile::tempdir().unwrap();
        write(&map, dir.path(), &[format]);
        let imported = read(&dir.path().join(source), &ImportOptions::default()).unwrap();
        assert!(imported.grid == map.grid, "{format} {source}");
        assert!(imported.tones_given && imported.notes.is_empty(), "{format} {source}: {:?}", imported.notes);
        assert_eq!(imported.version.as_deref(), Some(env!("CARGO_PKG_VERSION")));
        let preset: tam_gen::Preset = toml::from_str(&imported.preset_toml.unwrap()).unwrap();
        assert_eq!(preset, map.preset);
        if !source.is_empty() && source != "cells" {
            assert!(imported.stroke_map.as_ref() == Some(&map.stroke_map), "{format} {source}");
        }
    }
}

#[test]
fn bc4_comes_back_nearly() {
    let (map, dir) = (sample::map(5, 64, 16, true), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::Ktx2Bc4]);
    let imported = read(&dir.path().join("lines.bc4.ktx2"), &ImportOptions::default()).unwrap();
    assert_eq!((&imported.grid.tones, imported.grid.hand_built), (&map.grid.tones, 3));
    for (ours, theirs) in map.grid.levels.iter().zip(&imported.grid.levels) {
        for (a, b) in ours.cells.iter().flatten().zip(theirs.cells.iter().flatten()) {
            assert!(a.abs_diff(*b) <= 18, "half a step of eight shades");
        }
    }
}

#[test]
fn files_without_their_manifest_still_come_back() {
    let map = sample::map(4, 64, 8, false);
    for (format, source) in
        [(Format::DdsArray, "lines.dds"), (Format::DdsSlices, "lines.tone0.dds"), (Format::Png, "cells")]
    {
        let dir = tempfile::tempdir().unwrap();
        write(&map, dir.path(), &[format]);
        std::fs::remove_file(dir.path().join("lines.json")).unwrap();
        let imported = read(&dir.path().join(source), &ImportOptions::default()).unwrap();
        assert!(imported.grid.levels == map.grid.levels, "{format}");
        assert!(!imported.tones_given);
        for (mean, tone) in imported.grid.tones.iter().zip(&map.grid.tones) {
            assert!((mean - tone).abs() < 0.06, "whole lines of an 8 px level: {mean} for {tone}");
        }
    }
}

#[test]
fn one_column_and_sixty_four_come_back() {
    for columns in [1, 64] {
        let (map, dir) = (sample::map(columns, 128, 32, false), tempfile::tempdir().unwrap());
        write(&map, dir.path(), &[Format::Ktx2, Format::RgbaPacked]);
        for source in ["lines.ktx2", "lines.packed0.ktx2"] {
            let imported = read(&dir.path().join(source), &ImportOptions::default()).unwrap();
            assert!(imported.grid == map.grid, "{columns} {source}");
        }
    }
}
