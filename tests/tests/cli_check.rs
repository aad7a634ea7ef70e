//! `tam-gen check` and `sheet` on maps of our own and of others.

use std::fs;

use tam_tests::command::{listing, tam_gen};
use tempfile::{TempDir, tempdir};

/// A folder with a map as KTX2, DDS and pictures.
fn map() -> TempDir {
    let folder = tempdir().expect("a folder");
    let args = ["generate", "pencil", "-o", ".", "--name", "map", "--also", "png,dds-array"];
    let run = tam_gen(folder.path(), &args);
    assert_eq!(run.status, 0, "{run:?}");
    folder
}

#[test]
fn a_map_of_our_own_holds_with_its_strokes() {
    let folder = map();
    let json = tam_gen(folder.path(), &["check", "map.ktx2", "--json"]).json();
    assert_eq!(json["holds"], true, "{json}");
    let findings = json["report"]["findings"].as_array().expect("findings");
    for constraint in ["level-nesting-list", "level-nesting-centre-lines", "stroke-map-tone"] {
        let finding = findings.iter().find(|finding| finding["constraint"] == constraint).expect("a finding");
        assert_eq!(finding["verdict"], "pass", "{finding}");
    }
}

#[test]
fn pictures_are_checked_with_what_is_said_about_them() {
    let folder = map();
    let tones = ["--tones", "6"];
    for source in [&["check", "cells"][..], &["check", "cells", "--pattern", "tone{tone}_level{level}.png"]] {
        let run = tam_gen(folder.path(), &[source, &tones].concat());
        assert_eq!(run.status, 0, "{run:?}");
        assert!(run.stdout.contains("every constraint that could be judged holds"), "{run:?}");
    }
    let run = tam_gen(folder.path(), &["check", "map.dds"]);
    assert_eq!(run.status, 0, "{run:?}");
}

#[test]
fn a_broken_cell_fails_with_status_1_and_a_page_that_shows_it() {
    let folder = map();
    let cell = folder.path().join("cells/tone4_level0.png");
    let mut picture = image::open(&cell).expect("a cell").into_luma8();
    for y in 100..110 {
        for x in 100..110 {
            picture.put_pixel(x, y, image::Luma([255]));
        }
    }
    picture.save(&cell).expect("a changed cell");
    let args = ["check", "cells", "--tones", "6", "--report", "page/out.html"];
    let run = tam_gen(folder.path(), &args);
    assert_eq!(run.status, 1, "{run:?}");
    assert!(run.stdout.contains("not hold"), "{run:?}");
    let page = fs::read_to_string(folder.path().join("page/out.html")).expect("a page");
    assert!(page.contains("tone-nesting") || page.contains("Tone nesting"));
    let again = tam_gen(folder.path(), &args);
    assert_eq!(again.status, 2, "an existing report is not replaced: {again:?}");
}

#[test]
fn a_sheet_is_drawn_of_maps_and_presets() {
    let folder = map();
    fs::remove_file(folder.path().join("map.sheet.png")).expect("the sheet");
    for (args, name) in [
        (&["sheet", "map.ktx2"][..], "map.sheet.png"),
        (&["sheet", "stipple", "--size", "64", "--levels", "2"], "stipple.sheet.png"),
        (&["sheet", "cells", "-o", "cells.png"], "cells.png"),
        (&["sheet", "map.ktx2", "--tile"], "map.tile.png"),
    ] {
        let json = tam_gen(folder.path(), &[args, &["--json"]].concat()).json();
        assert_eq!(json["path"], name, "{json}");
        let picture = image::open(folder.path().join(name)).expect("a picture");
        assert_eq!(Some(u64::from(picture.width())), json["width"].as_u64());
    }
    let tile = image::open(folder.path().join("map.tile.png")).expect("a picture");
    assert_eq!((tile.width(), tile.height()), (768, 768));
    let before = listing(folder.path());
    assert_eq!(tam_gen(folder.path(), &["sheet", "map.ktx2"]).status, 2);
    assert_eq!(listing(folder.path()), before);
}
