//! `tam-viewer` draws what it says, and only where it may.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use image::AnimationDecoder;
use tam_tests::command::{Run, listing, tam_viewer};
use tempfile::tempdir;

/// Small and quick: a coarse mesh, a small picture, one sample.
const SMALL: [&str; 8] = ["--mesh", "torus-knot", "--triangles", "600", "--size", "48x40", "--samples", "1"];

fn small<'a>(command: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&[command], &SMALL[..], more].concat()
}

fn ok(folder: &Path, args: &[&str]) -> Run {
    let run = tam_viewer(folder, args);
    assert_eq!(run.status, 0, "{args:?}: {run:?}");
    run
}

/// A picture that shows something: its size, after checking that it is not all of one colour.
fn drawn(path: &Path) -> (u32, u32) {
    let picture = image::open(path).expect("a picture").into_rgba8();
    let colours: BTreeSet<[u8; 4]> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() > 8, "{} is blank", path.display());
    picture.dimensions()
}

#[test]
fn every_method_draws_a_picture_and_they_differ() {
    let folder = tempdir().expect("a folder");
    let mut pictures = BTreeSet::new();
    for method in ["phong", "six-way", "face-frame", "stroke-map", "halftone", "fine-tone"] {
        let file = format!("{method}.png");
        let run = ok(folder.path(), &small("render", &["--method", method, "--out", &file]));
        assert!(run.stdout.contains("48 x 40 px"), "{run:?}");
        for part in ["adapter: ", "mesh: torus-knot", "map: pencil", "B per triangle", "frame: "] {
            assert!(run.stderr.contains(part), "{part:?} is missing in\n{}", run.stderr);
        }
        assert_eq!(drawn(&folder.path().join(&file)), (48, 40));
        pictures.insert(image::open(folder.path().join(&file)).expect("a picture").into_bytes());
    }
    assert_eq!(pictures.len(), 6, "two methods draw the same");
}

#[test]
fn json_is_one_object_with_what_was_drawn() {
    let folder = tempdir().expect("a folder");
    let run = ok(folder.path(), &small("render", &["--json", "--mapping", "triplanar"]));
    let json = run.json();
    assert!(run.stderr.is_empty(), "{run:?}");
    assert_eq!((json["path"].as_str(), json["mesh"]["name"].as_str()), (Some("torus-knot.png"), Some("torus-knot")));
    assert_eq!(
        (json["frame"]["method"].as_str(), json["frame"]["mapping"].as_str()),
        (Some("fine-tone"), Some("triplanar"))
    );
    assert!(json["frame"]["frame_ms"].as_f64().is_some_and(|time| time > 0.0), "{json}");
    assert!(json["mesh"]["gpu_bytes_per_triangle"].as_f64().is_some_and(|bytes| bytes > 50.0), "{json}");
    assert!(json["adapter"]["name"].is_string() && json["mesh"]["notes"].is_array(), "{json}");
    drawn(&folder.path().join("torus-knot.png"));
}

#[test]
fn every_option_changes_the_picture() {
    let folder = tempdir().expect("a folder");
    let base = ["render", "--mesh", "chair", "--triangles", "900", "--size", "64x64", "-o"];
    ok(folder.path(), &[&base[..], &["base.png"]].concat());
    let reference = fs::read(folder.path().join("base.png")).expect("a picture");
    let options: &[&[&str]] = &[
        &["--map", "engraving"],
        &["--mapping", "frames"],
        &["--camera", "-70,40"],
        &["--camera", "30,18,9"],
        &["--target", "0.5,0,0"],
        &["--fov", "60"],
        &["--light", "100,10"],
        &["--light", "at:2,1,1,0.7", "--light", "spot:0,3,0,0,0,0,30,2"],
        &["--ambient", "0.6"],
        &["--specular", "0.9,4"],
        &["--paper", "rgb(200 220 255)"],
        &["--ink", "firebrick"],
        &["--colours", "none"],
        &["--tiles", "20"],
        &["--rotate", "45"],
        &["--scale", "0.5"],
        &["--shift", "0.3,-0.2"],
        &["--level-bias", "-1"],
        &["--lines", "none"],
        &["--lines", "6"],
        &["--crease", "20"],
        &["--deform", "twist,0.25"],
        &["--stretch", "1,0.5,2"],
        &["--samples", "1"],
        &["--transparent"],
    ];
    for option in options {
        ok(folder.path(), &[&base[..], &["changed.png", "--force"], *option].concat());
        let changed = fs::read(folder.path().join("changed.png")).expect("a picture");
        assert!(changed != reference, "{option:?} changes nothing");
    }
    ok(folder.path(), &[&base[..], &["again.png"]].concat());
    assert_eq!(fs::read(folder.path().join("again.png")).expect("a picture"), reference, "a frame is not repeatable");
}

#[test]
fn options_of_single_methods_change_their_picture() {
    let folder = tempdir().expect("a folder");
    let cases: &[(&str, &[&str])] = &[
        ("stroke-map", &["--blend", "linear", "--mapping", "triplanar"]),
        ("stroke-map", &["--form", "literal"]),
        ("halftone", &["--line-period", "12"]),
        ("face-frame", &["--form", "literal"]),
    ];
    for (method, option) in cases {
        let mapping: &[&str] = if option.contains(&"--mapping") { &["--mapping", "triplanar"] } else { &[] };
        ok(
            folder.path(),
            &[&small("render", &["--method", method, "-o", "base.png", "--force"])[..], mapping].concat(),
        );
        ok(
            folder.path(),
            &[&small("render", &["--method", method, "-o", "changed.png", "--force"])[..], option].concat(),
        );
        let [base, changed] =
            ["base.png", "changed.png"].map(|file| fs::read(folder.path().join(file)).expect("a picture"));
        assert!(base != changed, "{method} {option:?} changes nothing");
    }
}

#[test]
fn objects_have_settings_of_their_own() {
    let folder = tempdir().expect("a folder");
    let json = ok(folder.path(), &["render", "--mesh", "chair", "--triangles", "900", "--size", "64", "--json"]).json();
    let objects = json["mesh"]["objects"].as_array().expect("a list").clone();
    let name = objects[0].as_str().expect("a name");
    assert!(objects.len() > 1 && !name.is_empty(), "{json}");
    let setting = format!("{name}:map=woodcut,colour=gold,rotate=30,scale=2,shift=0.1,0.2,specular=0.5,9");
    let args =
        ["render", "--mesh", "chair", "--triangles", "900", "--size", "64", "-o", "own.png", "--object", &setting];
    ok(folder.path(), &args);
    let [base, own] = ["chair.png", "own.png"].map(|file| fs::read(folder.path().join(file)).expect("a picture"));
    assert!(base != own, "the settings change nothing");
    let unknown = tam_viewer(folder.path(), &[&args[..8], &["x.png", "--object", "nose:scale=2"]].concat());
    assert_eq!(unknown.status, 2, "{unknown:?}");
    assert!(unknown.stderr.contains("`nose`") && unknown.stderr.contains(name), "{unknown:?}");
}

#[test]
fn a_mesh_file_is_drawn_and_what_was_mended_is_said() {
    let folder = tempdir().expect("a folder");
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.4\nf 1 2 3\nf 1 3 4\nf 1 1 2\n";
    fs::write(folder.path().join("sheet.obj"), obj).expect("a file");
    // As it is: for patches it would be cut.
    let args = ["render", "--mesh", "./sheet.obj", "--size", "48", "--camera", "20,10", "--mapping", "triplanar"];
    let run = ok(folder.path(), &args);
    assert!(run.stderr.contains("note: ") && run.stderr.contains("mesh: sheet, 2 triangles"), "{run:?}");
    drawn(&folder.path().join("sheet.png"));
    let json = ok(folder.path(), &[&args[..], &["--force", "--json"]].concat()).json();
    assert!(json["mesh"]["notes"].as_array().is_some_and(|notes| !notes.is_empty()), "{json}");
}

#[test]
fn compare_draws_a_sheet_with_ratios() {
    let folder = tempdir().expect("a folder");
    let run = ok(folder.path(), &small("compare", &["--rounds", "5", "--json"]));
    let json = run.json();
    let methods = json["methods"].as_array().expect("a list");
    // phong, face-frame, stripes, and four methods with four mappings: the knot has uv.
    assert_eq!(methods.len(), 19, "{json}");
    assert!(methods.iter().all(|method| method["ratio_to_phong"].as_f64().is_some_and(|ratio| ratio > 0.0)), "{json}");
    assert_eq!(methods[0]["ratio_to_phong"], 1.0);
    drawn(&folder.path().join("compare.png"));
    let chosen =
        small("compare", &["--methods", "six-way,stroke-map", "--forms", "--mapping", "triplanar", "--rounds", "5"]);
    let run = ok(folder.path(), &[&chosen[..], &["-o", "forms.png"]].concat());
    for part in ["six-way, triplanar, literal", "stroke-map, triplanar, hardened", "x phong"] {
        assert!(run.stdout.contains(part), "{part:?} is missing in\n{}", run.stdout);
    }
    drawn(&folder.path().join("forms.png"));
}

#[test]
fn turntables_become_animated_png_gif_and_folders() {
    let folder = tempdir().expect("a folder");
    for (path, out) in [("orbit", "a.png"), ("light", "b.gif"), ("zoom", "c/"), ("deform", "d.png")] {
        ok(folder.path(), &small("turntable", &["--path", path, "--frames", "5", "-o", out]));
    }
    let open = |name: &str| std::io::BufReader::new(fs::File::open(folder.path().join(name)).expect("a file"));
    let png =
        |name| image::codecs::png::PngDecoder::new(open(name)).expect("PNG").apng().expect("animated").into_frames();
    let gif = image::codecs::gif::GifDecoder::new(open("b.gif")).expect("GIF").into_frames();
    for frames in [png("a.png"), png("d.png"), gif] {
        let frames = frames.collect_frames().expect("frames");
        let different: BTreeSet<_> = frames.iter().map(|frame| frame.buffer().as_raw().clone()).collect();
        assert_eq!((frames.len(), different.len()), (5, 5));
    }
    for frame in ["c/frame_0000.png", "c/frame_0004.png"] {
        assert_eq!(drawn(&folder.path().join(frame)), (48, 40));
    }
    assert_eq!(listing(folder.path()).len(), 3 + 1 + 5);
}

#[test]
fn existing_output_is_replaced_only_by_force() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("x.png"), "mine").expect("a file");
    for command in ["render", "compare", "turntable"] {
        let refused = tam_viewer(folder.path(), &small(command, &["-o", "x.png"]));
        assert_eq!(refused.status, 1, "{command}: {refused:?}");
        assert!(refused.stderr.contains("x.png") && refused.stderr.contains("--force"), "{refused:?}");
    }
    assert_eq!(fs::read(folder.path().join("x.png")).expect("the file"), b"mine");
    ok(folder.path(), &small("render", &["-o", "x.png", "--force"]));
    drawn(&folder.path().join("x.png"));
}

#[test]
fn meshes_are_listed_and_drawn() {
    let folder = tempdir().expect("a folder");
    let run = ok(folder.path(), &["meshes"]);
    let json = ok(folder.path(), &["meshes", "--json"]).json();
    let meshes = json["meshes"].as_array().expect("a list");
    assert!(
        meshes.len() >= 11 && meshes.iter().all(|mesh| run.stdout.contains(mesh["name"].as_str().expect("a name")))
    );
    ok(folder.path(), &["meshes", "--sheet", "all.png", "--side", "40"]);
    assert!(drawn(&folder.path().join("all.png")).0 > 4 * 40);
}

#[test]
fn adapters_are_listed_the_chosen_one_first() {
    let folder = tempdir().expect("a folder");
    let run = ok(folder.path(), &["adapters"]);
    let json = ok(folder.path(), &["adapters", "--json"]).json();
    assert_eq!(json["chosen"], json["adapters"][0]["name"], "{json}");
    assert!(run.stdout.starts_with(&format!("* {}", json["chosen"].as_str().expect("a name"))), "{run:?}");
}

#[test]
fn completions_and_pages_are_of_this_command() {
    let folder = tempdir().expect("a folder");
    assert!(ok(folder.path(), &["completions", "bash"]).stdout.contains("tam-viewer"));
    ok(folder.path(), &["man", "-o", "man"]);
    for page in ["man/tam-viewer.1", "man/tam-viewer-render.1", "man/tam-viewer-turntable.1"] {
        assert!(listing(folder.path()).contains(&page.to_owned()), "{page}");
    }
}

#[test]
fn quiet_prints_nothing() {
    let folder = tempdir().expect("a folder");
    let run = ok(folder.path(), &small("render", &["--quiet"]));
    assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("", ""));
}

#[test]
fn a_larger_picture_for_the_same_height_is_the_same_picture_in_more_pixels() {
    let folder = tempdir().expect("a folder");
    let ink = |file: &str, reduced: u32| {
        let picture = image::open(folder.path().join(file)).expect("a picture").into_luma8();
        let [width, height] = [picture.width() / reduced, picture.height() / reduced];
        let reduced = image::imageops::resize(&picture, width, height, image::imageops::FilterType::Triangle);
        reduced.pixels().map(|pixel| 1.0 - f64::from(pixel.0[0]) / 255.0).collect::<Vec<f64>>()
    };
    for method in ["six-way", "halftone", "stripes"] {
        let base = ["render", "--mesh", "hand", "--triangles", "3000", "--method", method, "--mapping", "triplanar"];
        let draw = |file: &str, size: &str, more: &[&str]| {
            ok(folder.path(), &[&base[..], &["--size", size, "-o", file, "--force"], more].concat());
        };
        draw("small.png", "160", &[]);
        draw("own.png", "160", &["--for-height", "160"]);
        draw("large.png", "320", &["--for-height", "160"]);
        draw("other.png", "320", &[]);
        let (small, large, other) = (ink("small.png", 1), ink("large.png", 2), ink("other.png", 2));
        assert_eq!(small, ink("own.png", 1), "{method}: its own height changes nothing");
        let mean = |ink: &[f64]| ink.iter().sum::<f64>() / ink.len() as f64;
        let apart = |a: &[f64], b: &[f64]| mean(&a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect::<Vec<_>>());
        let (same, otherwise) = (apart(&small, &large), apart(&small, &other));
        assert!(same < 0.6 * otherwise, "{method}: {same} for the same height, {otherwise} for its own");
        assert!((mean(&small) - mean(&large)).abs() < 0.01, "{method}: {} and {}", mean(&small), mean(&large));
    }
}
