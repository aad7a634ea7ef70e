//! `tam-gen generate` writes what it says, and only where it may.

use std::fs;

use tam_tests::command::{listing, tam_gen};
use tempfile::tempdir;

/// Small and quick.
const SMALL: [&str; 4] = ["--size", "64", "--levels", "2"];

fn generate<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["generate", "pencil"], &SMALL[..], more].concat()
}

#[test]
fn a_preset_by_name_becomes_a_checked_map_with_sheet_and_manifest() {
    let folder = tempdir().expect("a folder");
    let run = tam_gen(folder.path(), &["generate", "pencil"]);
    assert_eq!(run.status, 0, "{run:?}");
    let expected = ["out", "out/pencil.json", "out/pencil.ktx2", "out/pencil.sheet.png", "out/pencil.strokemap.ktx2"];
    assert_eq!(listing(folder.path()), expected);
    for part in ["out/pencil.ktx2", "tone-average", "tone-nesting", "every constraint holds; took "] {
        assert!(run.stdout.contains(part), "{part:?} is missing in\n{}", run.stdout);
    }
    assert!(run.stderr.is_empty(), "{run:?}");
}

#[test]
fn json_is_one_object_with_files_and_verdicts() {
    let folder = tempdir().expect("a folder");
    let run = tam_gen(folder.path(), &generate(&["--json", "--no-sheet", "--name", "map", "-o", "a/b"]));
    let json = run.json();
    assert_eq!(run.status, if json["holds"] == true { 0 } else { 1 }, "{run:?}");
    assert_eq!(
        (json["name"].as_str(), json["size"].as_u64(), json["levels"].as_u64()),
        (Some("map"), Some(64), Some(2))
    );
    let files = json["files"].as_array().expect("a list");
    assert_eq!(files.len(), 3, "{json}");
    for file in files {
        let path = folder.path().join(file["path"].as_str().expect("a path"));
        assert_eq!(fs::metadata(path).expect("a file").len(), file["bytes"].as_u64().expect("a size"));
    }
    assert!(json["report"]["findings"].as_array().is_some_and(|findings| findings.len() >= 8), "{json}");
}

#[test]
fn existing_output_is_replaced_only_by_force() {
    let folder = tempdir().expect("a folder");
    let target = folder.path().join("out/pencil.strokemap.ktx2");
    fs::create_dir(folder.path().join("out")).expect("a folder");
    fs::write(&target, "mine").expect("a file");
    let refused = tam_gen(folder.path(), &generate(&[]));
    assert_eq!(refused.status, 2, "{refused:?}");
    assert!(refused.stderr.contains("--force") && refused.stderr.contains("pencil.strokemap.ktx2"), "{refused:?}");
    assert_eq!(listing(folder.path()), ["out", "out/pencil.strokemap.ktx2"]);
    assert_eq!(fs::read(&target).expect("the file"), b"mine");
    let forced = tam_gen(folder.path(), &generate(&["--force"]));
    assert!(forced.status < 2, "{forced:?}");
    assert_ne!(fs::read(&target).expect("the file"), b"mine");
}

#[test]
fn formats_select_or_add() {
    let folder = tempdir().expect("a folder");
    let selected = tam_gen(folder.path(), &generate(&["-o", "a", "--format", "png,strokes-json", "--no-sheet"]));
    assert!(selected.status < 2, "{selected:?}");
    let files = listing(&folder.path().join("a"));
    assert!(files.iter().any(|file| file == "cells/tone0_level0.png"), "{files:?}");
    assert!(!files.contains(&"pencil.ktx2".to_owned()), "{files:?}");
    for (dir, added) in [("b", ["--format", "+dds-array"]), ("c", ["--also", "dds-array"])] {
        let run = tam_gen(folder.path(), &generate(&[&["-o", dir][..], &added].concat()));
        assert!(run.status < 2, "{run:?}");
        let files = listing(&folder.path().join(dir));
        assert!(files.contains(&"pencil.ktx2".to_owned()) && files.contains(&"pencil.dds".to_owned()), "{files:?}");
    }
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let folder = tempdir().expect("a folder");
    for threads in ["1", "3"] {
        let run = tam_gen(folder.path(), &generate(&["--threads", threads, "-o", threads]));
        assert!(run.status < 2, "{run:?}");
    }
    for file in listing(&folder.path().join("1")) {
        let [one, three] = ["1", "3"].map(|dir| fs::read(folder.path().join(dir).join(&file)).expect("a file"));
        assert!(one == three, "{file} differs");
    }
}

#[test]
fn options_replace_what_the_preset_says() {
    let folder = tempdir().expect("a folder");
    let args = ["--json", "--tones", "0.1,0.3,0.6", "--seed", "7", "--placement", "random", "--no-sheet"];
    let json = tam_gen(folder.path(), &generate(&args)).json();
    assert_eq!(json["tones"], serde_json::json!([0.1, 0.3, 0.6]));
    let manifest = fs::read(folder.path().join("out/pencil.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_slice(&manifest).expect("JSON");
    assert_eq!(
        (&manifest["preset"]["seed"], &manifest["preset"]["placement"]["method"]),
        (&7.into(), &"random".into())
    );
}

#[test]
fn a_tone_out_of_reach_is_reported_with_its_remedy_and_status_1() {
    let folder = tempdir().expect("a folder");
    let preset = "[map]\nsize = 64\ncoarsest = 32\ntones = [0.3, 1.0]\n[stroke]\nopacity = 0.3\ngrain = 0.9\n";
    fs::write(folder.path().join("faint.toml"), preset).expect("a preset");
    let run = tam_gen(folder.path(), &["generate", "faint.toml"]);
    assert_eq!(run.status, 1, "{run:?}");
    for part in ["wanted 1.0000, reached 0.", "raise stroke.opacity", "the files are written all the same"] {
        assert!(run.stdout.contains(part), "{part:?} is missing in\n{}", run.stdout);
    }
    assert!(folder.path().join("out/faint.ktx2").is_file());
    let json = tam_gen(folder.path(), &["generate", "faint.toml", "--force", "--json"]).json();
    let deficit = &json["deficits"][0];
    assert!(
        deficit["deficit"].as_f64().is_some_and(|deficit| deficit > 0.01) && deficit["remedy"].is_string(),
        "{json}"
    );
    assert_eq!(json["holds"], false);
}

#[test]
fn quiet_prints_nothing() {
    let folder = tempdir().expect("a folder");
    let run = tam_gen(folder.path(), &generate(&["--quiet"]));
    assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("", ""));
    let run = tam_gen(folder.path(), &generate(&["--force", "-v"]));
    assert!(run.stderr.contains("generated in"), "{run:?}");
}
