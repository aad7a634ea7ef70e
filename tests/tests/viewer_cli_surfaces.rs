//! `tam-viewer` with strokes that follow the surface: mappings, fields, guides, kept surfaces and the picture of a field.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use tam_tests::command::{Run, listing, tam_viewer};
use tempfile::tempdir;

/// Small and quick.
const SMALL: [&str; 10] =
    ["render", "--mesh", "hand", "--triangles", "1500", "--size", "64x64", "--samples", "1", "--force"];

fn ok(folder: &Path, args: &[&str]) -> Run {
    let run = tam_viewer(folder, args);
    assert_eq!(run.status, 0, "{args:?}: {run:?}");
    run
}

fn refused(folder: &Path, args: &[&str], status: i32, expected: &[&str]) {
    let before = listing(folder);
    let run = tam_viewer(folder, args);
    assert_eq!(run.status, status, "{args:?}: {run:?}");
    assert_eq!(listing(folder), before, "{args:?} wrote something");
    for part in expected {
        assert!(run.stderr.contains(part), "{args:?}: {part:?} is missing in\n{}", run.stderr);
    }
}

#[test]
fn mappings_fields_and_ways_to_follow_differ() {
    let folder = tempdir().expect("a folder");
    fs::write(
        folder.path().join("guides.json"),
        r#"{"version": 1, "guides": [{"points": [[0.0, -0.8, 0.2], [0.0, 0.0, 0.2]]}]}"#,
    )
    .expect("a file");
    let ways: &[&[&str]] = &[
        &["--mapping", "patches"],
        &["--mapping", "lapped"],
        &["--mapping", "triplanar"],
        &["--mapping", "patches", "--field", "lower"],
        &["--mapping", "patches", "--field", "light"],
        &["--mapping", "patches", "--field", "1,1,0"],
        &["--mapping", "patches", "--field", "guides:guides.json"],
        &["--mapping", "patches", "--smoothing", "4"],
        &["--mapping", "patches", "--follow", "light"],
        &["--mapping", "patches", "--planar"],
        &["--method", "stripes"],
        &["--method", "stripes", "--cross", "none"],
        &["--method", "stripes", "--stripes", "9"],
    ];
    let pictures: BTreeSet<Vec<u8>> = ways
        .iter()
        .map(|way| {
            ok(folder.path(), &[&SMALL[..], &["-o", "x.png"], way].concat());
            fs::read(folder.path().join("x.png")).expect("a picture")
        })
        .collect();
    assert_eq!(pictures.len(), ways.len(), "two ways draw the same");
}

#[test]
fn a_kept_surface_draws_the_same_and_is_made_anew_for_another_mesh() {
    let folder = tempdir().expect("a folder");
    let with = |more: &[&str]| {
        let run = ok(folder.path(), &[&SMALL[..], &["--mapping", "patches", "-o", "x.png"], more].concat());
        (fs::read(folder.path().join("x.png")).expect("a picture"), run.stderr)
    };
    let (plain, _) = with(&[]);
    let (written, _) = with(&["--surface", "hand.surface"]);
    let kept = fs::read(folder.path().join("hand.surface")).expect("a file");
    let (read, remarks) = with(&["--surface", "hand.surface"]);
    assert!(plain == written && plain == read && !remarks.contains("anew"), "{remarks}");
    let (_, remarks) = with(&["--surface", "hand.surface", "--smoothing", "3"]);
    assert!(remarks.contains("made anew"), "{remarks}");
    // Half a file is made anew too; a file of another kind is left alone.
    fs::write(folder.path().join("hand.surface"), &kept[..kept.len() / 2]).expect("a file");
    let (again, remarks) = with(&["--surface", "hand.surface"]);
    assert!(again == plain && remarks.contains("damaged"), "{remarks}");
    fs::write(folder.path().join("notes.txt"), "mine").expect("a file");
    let args = [&SMALL[..], &["--mapping", "patches", "-o", "y.png", "--surface", "notes.txt"]].concat();
    refused(folder.path(), &args, 1, &["holds no surface"]);
}

#[test]
fn bad_fields_and_guides_are_told() {
    let folder = tempdir().expect("a folder");
    let with = |more: &[&'static str]| [&SMALL[..], &["--mapping", "patches", "-o", "x.png"], more].concat();
    refused(folder.path(), &with(&["--field", "wind"]), 2, &["curvature, lower, light"]);
    refused(folder.path(), &with(&["--field", "0,0,0"]), 2, &["no direction"]);
    refused(folder.path(), &with(&["--field", "uv"]), 2, &["has no uv"]);
    refused(folder.path(), &with(&["--field", "guides:none.json"]), 1, &["none.json", "No such file"]);
    for (text, expected) in [
        ("", "EOF"),
        ("[]", "guides"),
        (r#"{"version": 2, "guides": []}"#, "version 2"),
        (r#"{"version": 1, "guides": [{"points": [[0, 0, 0]]}]}"#, "guide 1 has less than two points"),
        (r#"{"version": 1, "guides": [{"points": [[0, 0, 0], [0, 0, 0]]}]}"#, "no length"),
        (r#"{"version": 1, "guides": [{"points": [[0, 0, 0], [1e9, 0, 0]]}]}"#, "million"),
        (r#"{"version": 1, "guides": [], "more": 1}"#, "unknown field"),
    ] {
        fs::write(folder.path().join("bad.json"), text).expect("a file");
        refused(folder.path(), &with(&["--field", "guides:bad.json"]), 1, &["bad.json", expected]);
    }
}

#[test]
fn the_field_of_a_mesh_is_drawn_without_an_adapter() {
    let folder = tempdir().expect("a folder");
    let args = ["field", "--mesh", "hand", "--triangles", "3000", "--side", "160", "-o", "field.png"];
    let run = ok(folder.path(), &args);
    assert!(run.stdout.contains("singularit") && run.stdout.contains("patches"), "{run:?}");
    let picture = image::open(folder.path().join("field.png")).expect("a picture").into_rgb8();
    let colours: BTreeSet<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() > 500, "{} colours", colours.len());
    refused(folder.path(), &args, 1, &["field.png"]);
    let json = ok(folder.path(), &[&args[..], &["--force", "--json"]].concat()).json();
    assert!(json["patches"].as_u64().is_some_and(|patches| patches > 20), "{json}");
    assert!(json["patches_per_triangle"].as_f64().is_some_and(|mean| (1.0..8.0).contains(&mean)), "{json}");
}
