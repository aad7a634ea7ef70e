//! Bad input gives `tam-viewer` one readable report with cause and way out, the right status, and nothing written.

use std::fs;

use tam_tests::command::{Run, listing, tam_gen, tam_viewer, tam_viewer_in};
use tempfile::{TempDir, tempdir};

/// Runs the command on bad input, and checks its status, its words, and that it wrote nothing.
fn refuse(folder: &TempDir, args: &[&str], status: i32, expected: &[&str]) {
    let before = listing(folder.path());
    let run = tam_viewer(folder.path(), args);
    assert_eq!(run.status, status, "{args:?}: {run:?}");
    assert_eq!(listing(folder.path()), before, "{args:?} wrote something");
    assert!(run.stdout.is_empty(), "{args:?}: {run:?}");
    for part in expected {
        assert!(run.stderr.contains(part), "{args:?}: {part:?} is missing in\n{}", run.stderr);
    }
    let with_json = tam_viewer(folder.path(), &[args, &["--json"]].concat());
    assert_eq!(with_json.status, status, "{args:?}: {with_json:?}");
    let error = with_json.json()["error"].clone();
    assert!(error["kind"].is_string() && error["message"].as_str().is_some_and(|text| !text.is_empty()), "{error}");
}

#[test]
fn options_out_of_range_are_named_with_value_and_range() {
    let folder = tempdir().expect("a folder");
    let cases: &[(&[&str], &[&str])] = &[
        (&["--size", "0x10"], &["--size", "without pixels"]),
        (&["--size", "big"], &["--size", "WIDTHxHEIGHT"]),
        (&["--size", "-4x4"], &["--size", "-4"]),
        (&["--camera", "10,95"], &["--camera", "EL: 95", "-90 to 90 degrees"]),
        (&["--camera", "10"], &["AZ,EL,DIST"]),
        (&["--camera", "0,0,-2"], &["DIST: -2", "0.01 to 1000"]),
        (&["--camera", "nan,0"], &["AZ"]),
        (&["--light", "at:1,2"], &["--light", "X,Y,Z,INTENSITY"]),
        (&["--light", "10,10,-1"], &["INTENSITY: -1", "0 to 100"]),
        (&["--light", "spot:0,0,0,0,0,0,10,1"], &["its own place"]),
        (&["--fov", "170"], &["170", "1 to 150 degrees"]),
        (&["--ambient", "2"], &["2 is out of range", "0 to 1"]),
        (&["--tiles", "0"], &["0.01 to 100"]),
        (&["--lines", "100"], &["0.25 to 64 px"]),
        (&["--lines", "thick"], &["thick"]),
        (&["--crease", "200"], &["0 to 180"]),
        (&["--line-period", "1"], &["2 to 256 px"]),
        (&["--level-bias", "9"], &["-4 to 4"]),
        (&["--slope", "1"], &["1.01"]),
        (&["--samples", "3"], &["1 or 4"]),
        (&["--stretch", "1,0,1"], &["Y: 0"]),
        (&["--paper", "papery"], &["--paper", "CSS colour"]),
        (&["--triangles", "1"], &["--triangles"]),
        (&["--method", "fine-tune"], &["fine-tone"]),
        (&["--mapping", "uvw"], &["triplanar"]),
        (&["--deform", "twits"], &["did you mean `twist`?"]),
        (&["--object", "seat"], &["NAME:key=value"]),
        (&["--object", "seat:rotate=x"], &["rotate"]),
        (&["--object", "seat:size=1"], &["no setting is called `size`"]),
        (&["--mesh", "torsu-knot"], &["did you mean `torus-knot`?", "./mine.obj"]),
        (&["--map", "pensil"], &["did you mean `pencil`?"]),
        (&["--mesh", "cube", "--time", "1"], &["no animation"]),
        (&["--out", "x.jpg"], &["x.jpg", ".png"]),
        (&["--mehs", "cube"], &["--mesh"]),
    ];
    for (options, expected) in cases {
        refuse(&folder, &[&["render"], *options].concat(), 2, expected);
    }
    let lights = ["--light", "1,1"].repeat(20);
    refuse(&folder, &[&["render", "--mesh", "cube", "--size", "16"], &lights[..]].concat(), 2, &["20 lights"]);
    refuse(&folder, &["turntable", "--path", "obrit"], 2, &["orbit"]);
    refuse(&folder, &["turntable", "--frames", "1"], 2, &["--frames"]);
    refuse(&folder, &["turntable", "--out", "x.mp4"], 2, &["x.mp4", ".gif"]);
    refuse(&folder, &["turntable", "--mesh", "cube", "--size", "16", "--path", "animation"], 2, &["no animation"]);
    refuse(&folder, &["compare", "--methods", "phong,fong"], 2, &["fong"]);
    refuse(&folder, &["compare", "--rounds", "1"], 2, &["--rounds"]);
    refuse(&folder, &["meshes", "--side", "64"], 2, &["--sheet"]);
    refuse(&folder, &["rendr"], 2, &["render"]);
}

#[test]
fn meshes_that_cannot_be_read_are_refused() {
    let folder = tempdir().expect("a folder");
    for (name, content) in [
        ("empty.obj", &b""[..]),
        ("text.stl", b"hello"),
        ("cut.ply", b"ply\nformat ascii 1.0\nelement vertex 3\n"),
        ("cut.glb", b"glTF\x02\0\0\0\xff\0\0\0"),
        ("points.obj", b"v 0 0 0\nv 1 0 0\n"),
        ("nan.obj", b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("notes.txt", b"no mesh at all"),
    ] {
        fs::write(folder.path().join(name), content).expect("a file");
        refuse(&folder, &["render", "--mesh", name], 1, &["error: ", name, "help: "]);
    }
    refuse(&folder, &["render", "--mesh", "none.obj"], 1, &["none.obj"]);
    refuse(&folder, &["render", "--mesh", "."], 1, &["folder"]);
    fs::write(folder.path().join("sheet.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").expect("a file");
    refuse(
        &folder,
        &["render", "--mesh", "./sheet.obj", "--mapping", "uv", "--size", "16"],
        1,
        &["no uv", "triplanar"],
    );
    refuse(&folder, &["render", "--mesh", "./sheet.obj", "--triangles", "50"], 2, &["--triangles"]);
}

#[test]
fn maps_that_are_none_are_refused() {
    let folder = tempdir().expect("a folder");
    let made =
        tam_gen(folder.path(), &["generate", "pencil", "--size", "64", "--levels", "2", "--format", "+png", "-o", "m"]);
    assert!(made.status < 2, "{made:?}");
    let render = |map: &str, status, expected: &[&str]| {
        refuse(&folder, &["render", "--mesh", "cube", "--size", "16", "--map", map], status, expected);
    };
    fs::write(folder.path().join("text.ktx2"), "hello").expect("a file");
    fs::write(folder.path().join("cut.dds"), b"DDS |\0\0\0").expect("a file");
    render("text.ktx2", 1, &["text.ktx2"]);
    render("cut.dds", 1, &["cut.dds"]);
    render("none.ktx2", 1, &["none.ktx2"]);
    render("m/pencil.strokemap.ktx2", 1, &["stroke map"]);
    render("m/cells/tone0_level0.png", 1, &["tone0_level0.png"]);
    fs::create_dir(folder.path().join("flat")).expect("a folder");
    for tone in 0..3 {
        let name = format!("tone{tone}_level0.png");
        fs::copy(folder.path().join("m/cells").join(&name), folder.path().join("flat").join(&name)).expect("a copy");
    }
    render("flat", 1, &["no mip levels", "tam-gen generate"]);
    fs::write(folder.path().join("bad.toml"), "[map]\nsise = 256\n").expect("a file");
    let run = tam_viewer(folder.path(), &["render", "--map", "bad.toml"]);
    assert!(run.status == 1 && run.stderr.contains("did you mean `size`?"), "{run:?}");

    let copy = folder.path().join("alone.ktx2");
    fs::copy(folder.path().join("m/pencil.ktx2"), copy).expect("a copy");
    let strokes = ["render", "--mesh", "cube", "--size", "16", "--map", "alone.ktx2", "--method", "stroke-map"];
    refuse(&folder, &strokes, 1, &["alone", "no stroke map", ".strokemap.ktx2"]);
    let run = tam_viewer(folder.path(), &[&strokes[..7], &["-o", "x.png"]].concat());
    assert_eq!(run.status, 0, "the map itself is good: {run:?}");
}

#[test]
fn without_an_adapter_the_package_to_install_is_named() {
    let folder = tempdir().expect("a folder");
    for command in [
        &["render", "--mesh", "cube"][..],
        &["compare"],
        &["turntable"],
        &["meshes", "--sheet", "x.png"],
        &["adapters"],
    ] {
        let mut process = tam_viewer_in(folder.path());
        process.args(command).env("WGPU_BACKEND", "vulkan").env_remove("WGPU_ADAPTER_NAME");
        let run: Run = process.env("VK_ICD_FILENAMES", "/nonexistent.json").output().expect("the command runs").into();
        assert_eq!(run.status, 1, "{command:?}: {run:?}");
        assert!(run.stderr.contains("mesa-vulkan-drivers"), "{command:?}: {run:?}");
    }
    assert!(listing(folder.path()).is_empty());
    let named = ["render", "--mesh", "cube", "--adapter", "Voodoo 2"];
    refuse(&folder, &named, 1, &["no adapter is called `Voodoo 2`", "--adapter"]);
}

#[test]
fn what_is_too_large_for_the_adapter_is_refused() {
    let folder = tempdir().expect("a folder");
    refuse(&folder, &["render", "--mesh", "cube", "--size", "1000000x16"], 1, &["1000000", "--size"]);
    refuse(&folder, &["turntable", "--mesh", "cube", "--size", "70000x16", "-o", "x.gif"], 1, &["65535"]);
}

#[test]
fn places_that_cannot_be_written_are_reported() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("file"), "not a folder").expect("a file");
    fs::create_dir(folder.path().join("dir.png")).expect("a folder");
    for command in ["render", "compare", "turntable"] {
        let args = [command, "--mesh", "cube", "--size", "16", "--out"];
        refuse(&folder, &[&args[..], &["file/x.png"]].concat(), 1, &["file/x.png"]);
    }
    refuse(&folder, &["render", "--mesh", "cube", "--size", "16", "--out", "dir.png"], 1, &["is a folder"]);
    refuse(&folder, &["turntable", "--mesh", "cube", "--size", "16", "--out", "file/"], 1, &["file"]);
}

/// The run of a command that is interrupted after this time.
#[cfg(unix)]
fn interrupted(folder: &std::path::Path, args: &[&str], after_ms: u64) -> Run {
    let mut command = tam_viewer_in(folder);
    command.args(args).stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
    let child = command.spawn().expect("the command runs");
    std::thread::sleep(std::time::Duration::from_millis(after_ms));
    let pid = child.id().to_string();
    let sent = std::process::Command::new("kill").args(["-INT", &pid]).status().expect("kill runs");
    assert!(sent.success());
    child.wait_with_output().expect("an end").into()
}

#[cfg(unix)]
#[test]
fn an_interrupted_turntable_leaves_nothing() {
    let folder = tempdir().expect("a folder");
    for out in ["x.png", "x.gif", "frames/"] {
        let args = ["turntable", "--mesh", "cube", "--size", "256", "--frames", "5000", "--out", out];
        // Long enough to have drawn something on most machines; any moment will do.
        let run = interrupted(folder.path(), &args, 2500);
        assert_eq!(run.status, 130, "{run:?}");
        assert!(run.stderr.contains("nothing was written"), "{run:?}");
        assert_eq!(listing(folder.path()), Vec::<String>::new(), "{out}");
    }
}

#[cfg(unix)]
#[test]
fn preparations_are_interrupted_in_the_midst_of_any_stage() {
    let folder = tempdir().expect("a folder");
    let args =
        ["render", "--mesh", "head", "--triangles", "600000", "--mapping", "patches", "--surface", "kept.surface"];
    // The mesh is made, then its surface; whichever it is.
    for (number, after_ms) in [300, 900, 1600, 2400].into_iter().enumerate() {
        let json: &[&str] = if number % 2 == 0 { &[] } else { &["--json"] };
        let run = interrupted(folder.path(), &[&args, json].concat(), after_ms);
        assert_eq!(run.status, 130, "after {after_ms} ms: {run:?}");
        let told = if json.is_empty() { &run.stderr } else { &run.stdout };
        assert_eq!(told.matches("interrupted; nothing was written").count(), 1, "after {after_ms} ms: {run:?}");
        assert_eq!(listing(folder.path()), Vec::<String>::new(), "after {after_ms} ms");
    }
}
