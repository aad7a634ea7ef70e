//! `tam-gen presets`, `schema`, `completions`, `man` and the help.

use std::fs;

use tam_gen::Preset;
use tam_tests::command::{listing, tam_gen};
use tempfile::tempdir;

#[test]
fn the_list_has_every_preset_with_a_description() {
    let folder = tempdir().expect("a folder");
    for args in [&["presets"][..], &["presets", "list"]] {
        let run = tam_gen(folder.path(), args);
        assert_eq!((run.status, run.stdout.lines().count()), (0, 9), "{run:?}");
        for ((name, _), line) in Preset::embedded().iter().zip(run.stdout.lines()) {
            assert!(line.starts_with(name) && line.len() > name.len() + 20, "{line}");
        }
    }
    let json = tam_gen(folder.path(), &["presets", "--json"]).json();
    assert_eq!(json["presets"].as_array().map(Vec::len), Some(9));
}

#[test]
fn a_shown_preset_is_the_preset() {
    let folder = tempdir().expect("a folder");
    let run = tam_gen(folder.path(), &["presets", "show", "engraving"]);
    assert_eq!(Preset::from_toml(&run.stdout, "shown").ok(), Preset::named("engraving").and_then(Result::ok));
    let json = tam_gen(folder.path(), &["presets", "show", "engraving", "--json"]).json();
    assert_eq!((json["name"].as_str(), json["preset"]["seed"].as_u64()), (Some("engraving"), Some(4)));
}

#[test]
fn a_new_preset_is_explained_valid_and_never_replaces_one() {
    let folder = tempdir().expect("a folder");
    let run = tam_gen(folder.path(), &["presets", "new", "mine", "--from", "charcoal"]);
    assert_eq!((run.status, listing(folder.path())), (0, vec!["mine.toml".to_owned()]), "{run:?}");
    let path = folder.path().join("mine.toml");
    let preset = Preset::load(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(Some(preset), Preset::named("charcoal").and_then(Result::ok));
    let text = fs::read_to_string(&path).expect("the preset");
    assert!(text.contains("# Width, the same in every level. From 0.3 to 128 px."), "{text}");

    fs::write(&path, "mine").expect("a file");
    let refused = tam_gen(folder.path(), &["presets", "new", "mine"]);
    assert_eq!(refused.status, 2, "{refused:?}");
    assert!(refused.stderr.contains("--force"), "{refused:?}");
    assert_eq!(fs::read_to_string(&path).expect("the file"), "mine");
    assert_eq!(tam_gen(folder.path(), &["presets", "new", "mine", "--force"]).status, 0);
    assert!(Preset::load(&path).is_ok());
}

#[test]
fn the_schema_is_printed_or_written() {
    let folder = tempdir().expect("a folder");
    let run = tam_gen(folder.path(), &["schema"]);
    assert_eq!(run.json()["title"], "tam-gen preset");
    assert_eq!(tam_gen(folder.path(), &["schema", "-o", "a/s.json"]).status, 0);
    assert_eq!(fs::read_to_string(folder.path().join("a/s.json")).expect("the schema"), run.stdout);
    assert_eq!(tam_gen(folder.path(), &["schema", "-o", "a/s.json"]).status, 2);
}

#[test]
fn completions_exist_for_every_shell() {
    let folder = tempdir().expect("a folder");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = tam_gen(folder.path(), &["completions", shell]);
        assert_eq!(run.status, 0, "{run:?}");
        assert!(
            run.stdout.contains("generate") && run.stdout.contains("strokes-svg") | run.stdout.contains("placement")
        );
    }
}

#[test]
fn manual_pages_are_written_for_every_command() {
    let folder = tempdir().expect("a folder");
    let page = tam_gen(folder.path(), &["man"]);
    assert!(page.status == 0 && page.stdout.contains(".TH tam-gen 1"), "{page:?}");
    assert_eq!(tam_gen(folder.path(), &["man", "-o", "man1"]).status, 0);
    let pages = listing(&folder.path().join("man1"));
    for page in ["tam-gen.1", "tam-gen-generate.1", "tam-gen-presets-new.1", "tam-gen-watch.1"] {
        assert!(pages.contains(&page.to_owned()), "{page} is not among {pages:?}");
    }
}

#[test]
fn the_help_of_every_command_has_examples() {
    let folder = tempdir().expect("a folder");
    let main = tam_gen(folder.path(), &["--help"]);
    assert!(main.stdout.contains("Exit status") && main.stdout.contains("130"), "{main:?}");
    for command in ["generate", "check", "sheet", "presets", "schema", "watch", "completions", "man"] {
        let run = tam_gen(folder.path(), &[command, "--help"]);
        assert_eq!(run.status, 0, "{run:?}");
        assert!(run.stdout.contains("Examples:"), "{command} has no examples");
    }
}
