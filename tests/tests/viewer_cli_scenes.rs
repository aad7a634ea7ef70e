//! Scenes of many objects: files and options say the same, every command takes them, and what makes no sense is refused.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use tam_tests::command::{Run, listing, tam_viewer};
use tam_viewer::scene_file::SceneFile;
use tempfile::{TempDir, tempdir};

const SCENE: &str = r##"
map = "pencil"
camera = [35, 14]
light = ["-30,50", "at:2,1,2,0.4"]
lines = 1

[[object]]
name = "left"
mesh = "chair"
triangles = 900
place = [-1.1, 0, 0, 30]
[object.part.seat]
method = "stripes"
ink = "#23407a"
[object.part."top rail"]
visible = false

[[object]]
name = "box"
mesh = "models/box.obj"
place = [0.9, -0.5, 0.4, 20, 0.4]
method = "six-way"
mapping = "triplanar"
colour = "0.9,0.5,0.2"
"##;

const BOX: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
                   f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n";

fn folder_with_scene() -> TempDir {
    let folder = tempdir().expect("a folder");
    fs::create_dir_all(folder.path().join("scenes/models")).expect("a folder");
    fs::write(folder.path().join("scenes/models/box.obj"), BOX).expect("a file");
    fs::write(folder.path().join("scenes/room.toml"), SCENE).expect("a file");
    folder
}

fn ok(folder: &Path, args: &[&str]) -> Run {
    let run = tam_viewer(folder, args);
    assert_eq!(run.status, 0, "{args:?}: {run:?}");
    run
}

fn picture(folder: &Path, name: &str) -> Vec<u8> {
    image::open(folder.join(name)).expect("a picture").into_bytes()
}

#[test]
fn a_scene_file_and_the_options_that_say_the_same_draw_one_picture() {
    let folder = folder_with_scene();
    let at = folder.path();
    let json = ok(at, &["render", "--scene", "scenes/room.toml", "--size", "96x72", "--json"]).json();
    assert_eq!(json["path"], "room.png");
    let names: Vec<&str> =
        json["objects"].as_array().expect("a list").iter().filter_map(|o| o["name"].as_str()).collect();
    assert_eq!(names, ["left", "left", "box"], "the seat is drawn by itself");
    let wanted = picture(at, "room.png");

    let options = SceneFile::load(at.join("scenes/room.toml")).expect("a scene").to_options();
    let words: Vec<&str> = options
        .iter()
        .flat_map(|(name, value)| [name, value])
        .filter(|word| !word.is_empty())
        .map(String::as_str)
        .collect();
    ok(at, &[&["render", "--size", "96x72", "-o", "options.png"], &words[..]].concat());
    assert!(picture(at, "options.png") == wanted, "{words:?}");

    // Written anew, into another folder, it is the same scene.
    let moved = SceneFile::load(at.join("scenes/room.toml")).expect("a scene").relative_to(at).to_toml();
    fs::write(at.join("moved.toml"), &moved).expect("a file");
    assert!(moved.contains("scenes/models/box.obj"), "{moved}");
    ok(at, &["render", "--scene", "moved.toml", "--size", "96x72"]);
    assert!(picture(at, "moved.png") == wanted, "{moved}");

    // Options go before what the file says of all, not before what it says of one.
    for (option, changes) in [(["--method", "phong"], true), (["--light", "90,10"], true), (["--tiles", "1.5"], false)]
    {
        ok(
            at,
            &[
                &["render", "--scene", "scenes/room.toml", "--size", "96x72", "-o", "changed.png", "--force"],
                &option[..],
            ]
            .concat(),
        );
        assert_eq!(picture(at, "changed.png") != wanted, changes, "{option:?}");
    }
}

#[test]
fn objects_and_parts_are_placed_hidden_and_drawn_in_looks_of_their_own() {
    let folder = tempdir().expect("a folder");
    let at = folder.path();
    let base = ["render", "--mesh", "chair", "--mesh", "chair", "--mesh", "cube", "--triangles", "900", "--size", "64"];
    let draw = |name: &str, options: &[&str]| {
        ok(at, &[&base[..], &["-o", name, "--force"], options].concat());
        picture(at, name)
    };
    let placed = ["--place", "chair-2:2,0,0,90", "--place", "cube:0,1.2,0,0,0.4"];
    let wanted = draw("base.png", &placed);
    for option in [
        &["--place", "chair-2:2,0,0,80"][..],
        &["--place", "seat:0,0.5,0"],
        &["--place", "chair/seat:0,0.5,0"],
        &["--object", "chair-2:visible=false"],
        &["--object", "seat:visible=false"],
        &["--object", "cube:method=phong"],
        &["--object", "cube:mapping=patches,blend=linear,tiles=3"],
        &["--object", "chair/seat:method=halftone,line-period=4"],
        &["--object", "cube:ink=firebrick,lines=none"],
        &["--object", "cube:stretch=1,0.3,1"],
        &["--object", "cube:lit=1,0.2"],
        &["--object", "chair:triangles=2000"],
    ] {
        assert!(draw("changed.png", &[&placed[..], option].concat()) != wanted, "{option:?} changes nothing");
    }
    let own = ["--object", "seat:map=pencil", "--object", "cube:visible=true,rotate=0,scale=1"];
    assert!(draw("same.png", &[&placed[..], &own].concat()) == wanted, "what was said already changes nothing");
}

#[test]
fn instances_are_one_upload_and_hundreds_of_objects_are_all_drawn() {
    let folder = tempdir().expect("a folder");
    let at = folder.path();
    let mut scene = String::from("camera = [0, 0]\nmethod = \"phong\"\nlines = \"none\"\nambient = 1\n");
    for k in 0..400 {
        let (x, y) = (k % 20, k / 20);
        let shade = f64::from(k) / 400.0;
        writeln!(
            scene,
            "[[object]]\nmesh = \"cube\"\ntriangles = 12\nplace = [{x}, {y}, 0, 0, 0.4]\ncolour = [{shade}, 0.5, {}]",
            1.0 - shade
        )
        .expect("a string");
    }
    fs::write(at.join("wall.toml"), scene).expect("a file");
    let json = ok(at, &["render", "--scene", "wall.toml", "--size", "240", "--samples", "1", "--json"]).json();
    assert_eq!(json["objects"].as_array().map(Vec::len), Some(400));
    let once =
        ok(at, &["render", "--mesh", "cube", "--triangles", "12", "--method", "phong", "--size", "16", "--json"])
            .json();
    let bytes = |json: &serde_json::Value| json["gpu_bytes"].as_u64().expect("a number");
    // What is computed where each stands, and one mesh.
    assert!(bytes(&json) < 300 * bytes(&once), "{} for {}", bytes(&json), bytes(&once));
    let picture = image::open(at.join("wall.png")).expect("a picture").into_rgb8();
    let colours: std::collections::BTreeSet<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() >= 200, "{} colours", colours.len());
}

#[test]
fn every_command_that_takes_a_mesh_takes_a_scene() {
    let folder = folder_with_scene();
    let at = folder.path();
    // One map for all, and small pictures.
    let scene = ["--scene", "scenes/room.toml"];
    let with = |words: &[&str]| ok(at, &[words, &scene].concat());
    with(&[
        "compare",
        "--methods",
        "phong,six-way",
        "--mapping",
        "triplanar",
        "--size",
        "32",
        "--rounds",
        "5",
        "-o",
        "c.png",
    ]);
    with(&["turntable", "--size", "32", "--frames", "2", "--samples", "1", "-o", "t.gif"]);
    with(&["field", "--side", "64", "-o", "f.png"]);
    with(&["chart", "--methods", "phong,six-way", "--mappings", "triplanar", "--size", "32", "--quick", "-o", "chart"]);
    let fit =
        ["fit", "--method", "six-way", "--mappings", "triplanar", "--size", "32", "--error", "0.5", "--pairs", "5"];
    with(&[&fit[..], &["--camera-range", "1:1", "--light-range", "0:0"]].concat());
    for made in ["c.png", "t.gif", "f.png", "chart/index.html"] {
        assert!(at.join(made).is_file(), "{made}");
    }
}

#[test]
fn scenes_that_make_no_sense_are_refused_by_line_and_column() {
    let folder = folder_with_scene();
    let at = folder.path();
    let refuse = |text: &str, more: &[&str], status: i32, expected: &[&str]| {
        fs::write(at.join("bad.toml"), text).expect("a file");
        let before = listing(at);
        let run = tam_viewer(at, &[&["render", "--scene", "bad.toml", "--size", "16"], more].concat());
        assert_eq!(run.status, status, "{text}: {run:?}");
        assert_eq!(listing(at), before, "{text} wrote something");
        for part in expected {
            assert!(run.stderr.contains(part), "{part:?} is missing in\n{}", run.stderr);
        }
    };
    refuse("", &[], 1, &["no objects", "[[object]]"]);
    refuse("method = \"phong\n", &[], 1, &["bad.toml:1:"]);
    refuse("[[object]]\nmesh = \"cube\"\nmetod = 3\n", &[], 1, &["bad.toml:3:1", "did you mean `method`?"]);
    refuse("[[object]]\nmesh = \"cube\"\nplace = [0, 0, 0, 0, 0]\n", &[], 1, &["bad.toml:3:9", "SCALE", "0.01 to 100"]);
    refuse("[[object]]\nmesh = \"cube\"\nplace = [0, 0, 0, 0, -1]\n", &[], 1, &["SCALE", "-1"]);
    refuse("[[object]]\nmesh = \"cube\"\nplace = [nan, 0, 0]\n", &[], 1, &["X"]);
    refuse("[[object]]\nmesh = \"models/none.obj\"\n", &[], 1, &["models/none.obj"]);
    refuse("[[object]]\nmesh = \"cuba\"\n", &[], 2, &["did you mean `cube`?"]);
    refuse("[[object]]\nmesh = \"cube\"\nmap = \"pensil\"\n", &[], 2, &["did you mean `pencil`?"]);
    refuse("[[object]]\nmesh = \"chair\"\n[object.part.saet]\nrotate = 3\n", &[], 2, &["did you mean `seat`?"]);
    refuse("[[object]]\nmesh = \"cube\"\n", &["--object", "cuba:rotate=3"], 2, &["did you mean `cube`?"]);
    refuse("[[object]]\nmesh = \"cube\"\nvisible = false\n", &[], 2, &["visible"]);
    let many = "[[object]]\nmesh = \"cube\"\n".repeat(100_000);
    refuse(&many, &[], 1, &["100000 objects", "20000"]);
    let run = tam_viewer(at, &["render", "--scene", "scenes"]);
    assert!(run.status == 1 && run.stderr.contains("folder"), "{run:?}");
    fs::write(at.join("binary.toml"), [0xff, 0xfe, 0x00]).expect("a file");
    let json = tam_viewer(at, &["render", "--scene", "binary.toml", "--json"]).json();
    assert_eq!(json["error"]["kind"], "scene");
}

#[test]
fn the_schema_of_scenes_is_printed_and_written() {
    let folder = tempdir().expect("a folder");
    let printed = ok(folder.path(), &["schema"]).json();
    assert_eq!(printed["title"], "tam-viewer scene");
    ok(folder.path(), &["schema", "-o", "scene.schema.json"]);
    let written = fs::read_to_string(folder.path().join("scene.schema.json")).expect("a file");
    assert_eq!(serde_json::from_str::<serde_json::Value>(&written).expect("JSON"), printed);
}
