//! The presets that come with the tool, and the schema beside them.

use std::path::{Path, PathBuf};

use tam_gen::Preset;
use tam_gen::preset::{self, Range};

fn presets_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../presets")
}

#[test]
fn every_embedded_preset_is_valid_and_described_in_one_line() {
    assert_eq!(Preset::embedded().len(), 9);
    for (name, _) in Preset::embedded() {
        let preset = Preset::named(name).expect("a known name").unwrap_or_else(|error| panic!("{error}"));
        assert!((20..=120).contains(&preset.description.len()), "{name}: {:?}", preset.description);
    }
}

#[test]
fn every_preset_file_is_embedded_and_names_its_schema() {
    let names: Vec<_> = Preset::embedded().iter().map(|(name, _)| (*name).to_owned()).collect();
    for entry in std::fs::read_dir(presets_folder()).expect("the presets") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let name = path.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_owned();
            assert!(names.contains(&name), "{name} is not embedded");
            let source = std::fs::read_to_string(&path).expect("a preset");
            assert!(source.starts_with("#:schema ./preset.schema.json\n"), "{name} names no schema");
        }
    }
}

#[test]
fn a_preset_survives_being_written_and_read() {
    for (name, _) in Preset::embedded() {
        let preset = Preset::named(name).expect("a known name").expect("a valid preset");
        let text = preset.to_toml();
        let again = Preset::from_toml(&text, "again").unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(again, preset, "{name}");
        assert_eq!(again.to_toml(), text, "{name}");
    }
}

#[test]
fn the_schema_file_is_the_schema_of_the_structs() {
    let path = presets_folder().join("preset.schema.json");
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        std::fs::write(&path, preset::schema_text()).expect("a written schema");
    }
    let file = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(file == preset::schema_text(), "presets/preset.schema.json is stale: run the test with UPDATE_SCHEMA=1");
}

#[test]
fn the_schema_states_every_range_once_declared() {
    let schema = preset::schema();
    let definition = |table: &str| match table {
        "map" => "MapOptions",
        "placement" => "PlacementOptions",
        "stroke" => "StrokeOptions",
        "tip" => "TipOptions",
        _ => "FamilyOptions",
    };
    for Range { table, key, min, max, .. } in preset::RANGES.iter() {
        let property = &schema["$defs"][definition(table)]["properties"][key];
        assert_eq!(property["minimum"].as_f64(), Some(*min), "{table}.{key}");
        assert_eq!(property["maximum"].as_f64(), Some(*max), "{table}.{key}");
        let described = property["description"].as_str().is_some_and(|text| text.contains(" to "));
        assert!(described, "{table}.{key} has no range in words");
    }
}

#[test]
fn the_preset_on_the_front_page_is_valid() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    let readme = std::fs::read_to_string(readme).expect("the front page");
    let source = readme.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a preset");
    Preset::from_toml(source, "README.md").unwrap_or_else(|error| panic!("{error}"));
}
