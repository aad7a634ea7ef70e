//! Bad input gives one readable report with place, cause and way out, status 2, and nothing written.

use std::fs;
use std::path::Path;

use tam_tests::command::{Run, listing, tam_gen, tam_gen_path};
use tempfile::{TempDir, tempdir};

/// Runs the command on bad input, and checks that it wrote nothing and said what is expected.
fn refuse(folder: &TempDir, args: &[&str], expected: &[&str]) -> Run {
    let before = listing(folder.path());
    let run = tam_gen(folder.path(), args);
    assert_eq!(run.status, 2, "{args:?}: {run:?}");
    assert_eq!(listing(folder.path()), before, "{args:?} wrote something");
    assert!(run.stdout.is_empty(), "{args:?}: {run:?}");
    for part in expected {
        assert!(run.stderr.contains(part), "{args:?}: {part:?} is missing in\n{}", run.stderr);
    }

    let with_json = tam_gen(folder.path(), &[args, &["--json"]].concat());
    assert_eq!(with_json.status, 2, "{args:?}: {with_json:?}");
    assert_eq!(listing(folder.path()), before, "{args:?} --json wrote something");
    let error = with_json.json()["error"].clone();
    assert!(error["kind"].is_string() && error["message"].as_str().is_some_and(|text| !text.is_empty()), "{error}");
    run
}

fn folder_with(name: &str, content: impl AsRef<[u8]>) -> TempDir {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join(name), content).expect("a file");
    folder
}

#[test]
fn bad_presets_are_refused_with_their_place() {
    let cases: &[(&str, &[&str])] = &[
        ("[map]\nsise = 256\n", &["my.toml:2:1", "^^^^", "did you mean `size`?"]),
        ("[map]\nsize = \"large\"\n", &["my.toml:2:8", "a whole number, 64 to 4096 px"]),
        ("[stroke]\nwidth_px = nan\n", &["my.toml:2:12", "not a number", "0.3 to 128 px"]),
        ("[stroke]\nwidth_px = 1000\n", &["my.toml:2:12", "0.3 to 128 px"]),
        ("[map]\nsize = \n", &["my.toml:2"]),
        ("[map]\nsiz", &["my.toml:2"]),
        ("", &["my.toml", "the preset is empty", "presets new"]),
        ("schedule = [\"h\", \"w\"]\n", &["my.toml:1:18", "the family \"w\"", "[families.w]"]),
        ("[map]\ntones = [0.5, 0.2]\n", &["my.toml:2:15", "above 0.5"]),
        ("[map]\ncoarsest = 8\ntones = [0.5, 0.501]\n", &["my.toml:3", "too near", "raise map.coarsest"]),
        (
            "[map]\ncoarsest = 8\n[stroke]\nwidth_px = 9\n",
            &["my.toml:4:12", "as wide as the coarsest level", "raise map.coarsest"],
        ),
        ("[stroke.tip]\npath = \"M0 0 L1 0 L\"\n", &["my.toml:2:8", "does not parse"]),
        ("[stroke.tip]\nimage = \"none.png\"\n", &["my.toml:2:9", "none.png", "relative to the preset"]),
        ("[colours]\nink = \"inky\"\n", &["my.toml:2:7", "CSS colour"]),
    ];
    for (source, expected) in cases {
        let folder = folder_with("my.toml", source);
        for command in ["generate", "sheet"] {
            refuse(&folder, &[command, "my.toml"], expected);
        }
    }
}

#[test]
fn errors_of_presets_are_listed_for_machines() {
    let folder = folder_with("my.toml", "[map]\nsise = 256\nsize = 300\n");
    let error = tam_gen(folder.path(), &["generate", "my.toml", "--json"]).json()["error"].clone();
    assert_eq!((error["kind"].as_str(), error["file"].as_str()), (Some("preset"), Some("my.toml")));
    let problems = error["problems"].as_array().expect("a list");
    assert_eq!(problems.len(), 2, "{error}");
    assert_eq!((problems[1]["at"].as_str(), problems[1]["line"].as_u64()), (Some("map.size"), Some(3)));
}

#[test]
fn files_that_are_no_presets_are_refused() {
    let folder = folder_with("bytes.toml", [b'a', 0xff, 0xfe]);
    refuse(&folder, &["generate", "bytes.toml"], &["not text", "UTF-8"]);
    refuse(&folder, &["generate", "missing.toml"], &["missing.toml", "cannot read"]);
    fs::create_dir(folder.path().join("folder.toml")).expect("a folder");
    refuse(&folder, &["generate", "folder.toml"], &["it is a folder"]);
    refuse(&folder, &["generate", "."], &["it is a folder"]);
    #[cfg(unix)]
    refuse(&folder, &["generate", "/dev/zero"], &["larger than 1024 KiB"]);
}

#[test]
fn a_preset_of_a_gigabyte_is_refused_before_it_is_read() {
    let folder = tempdir().expect("a folder");
    let file = fs::File::create(folder.path().join("huge.toml")).expect("a file");
    file.set_len(1 << 30).expect("a sparse file");
    let started = std::time::Instant::now();
    refuse(&folder, &["generate", "huge.toml"], &["huge.toml", "larger than 1024 KiB"]);
    // Reading a gigabyte twice takes far longer, on any machine.
    assert!(started.elapsed().as_secs_f64() < 5.0);
}

#[test]
fn corrupt_tip_pictures_are_refused() {
    let folder = folder_with("my.toml", "[stroke.tip]\nimage = \"tip.png\"\n");
    for (content, expected) in [(&b"\x89PNG\r\n\x1a\ncut"[..], "picture"), (b"<svg><path", "SVG"), (b"", "tip.png")] {
        fs::write(folder.path().join("tip.png"), content).expect("a picture");
        refuse(&folder, &["generate", "my.toml"], &["my.toml:2:9", expected]);
    }
}

#[test]
fn an_unknown_preset_names_the_nearest_and_all() {
    let folder = tempdir().expect("a folder");
    let expected = ["no preset is called `pensil`", "did you mean `pencil`?", "woodcut", "./mine.toml"];
    for args in [&["generate", "pensil"][..], &["sheet", "pensil"], &["presets", "show", "pensil"]] {
        refuse(&folder, args, &expected);
    }
    refuse(&folder, &["presets", "new", "mine", "--from", "pensil"], &expected);
}

#[test]
fn options_out_of_range_are_named_as_they_were_given() {
    let folder = tempdir().expect("a folder");
    let cases: &[(&[&str], &[&str])] = &[
        (&["--size", "300"], &["--size 300: a power of two from 64 to 4096 px"]),
        (&["--size", "8192"], &["--size 8192", "4096"]),
        (&["--size", "big"], &["'big'", "--size"]),
        (&["--size", "-5"], &["-5"]),
        (&["--levels", "9"], &["--levels 9: 1 to 6 levels"]),
        (&["--levels", "0"], &["--levels 0"]),
        (&["--tones", "0.5,0.1"], &["--tones 0.5,0.1", "above 0.5"]),
        (&["--tones", "nan"], &["--tones NaN", "no darkness"]),
        (&["--tones", "65"], &["--tones 65: 1 to 64 tones"]),
        (&["--tones", "dark"], &["is no number"]),
        (&["--tones", "-1"], &["--tones -1"]),
        (&["--seed", "99999999999999999999"], &["--seed"]),
        (&["--effort", "0"], &["--effort 0: 1 to 256 candidates"]),
        (&["--placement", "praum"], &["praun"]),
        (&["--threads", "0"], &["--threads"]),
        (&["--format", "targa"], &["no format is called `targa`", "dds-array"]),
        (&["--also", "ktx3"], &["did you mean `ktx2`?"]),
        (&["--name", "../up"], &["../up", "--name"]),
        (&["--name", ""], &["--name"]),
        (&["--fromat", "png"], &["--format"]),
    ];
    for (options, expected) in cases {
        refuse(&folder, &[&["generate", "pencil"], *options].concat(), expected);
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_reported() {
    let folder = folder_with("file", "not a folder");
    refuse(&folder, &["generate", "pencil", "-o", "file"], &["file"]);
    refuse(
        &folder,
        &["generate", "pencil", "-o", "mine.ktx2"],
        &["mine.ktx2 is named like a file", "-o takes the folder"],
    );
    refuse(&folder, &["generate", "pencil", "-o", "file/below"], &["file/below"]);
    refuse(&folder, &["sheet", "pencil", "-o", "file/below.png"], &["file/below.png"]);
    refuse(&folder, &["schema", "-o", "file/below.json"], &["file/below.json"]);
    refuse(&folder, &["presets", "new", "-o", "file/mine.toml"], &["file/mine.toml"]);
    refuse(&folder, &["man", "-o", "file"], &["file"]);
    #[cfg(target_os = "linux")]
    refuse(&folder, &["generate", "pencil", "-o", "/proc/maps"], &["/proc/maps"]);
}

/// A limit on the size of files stands for a full disk: writing fails half-way in the same way.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_nothing_half_written() {
    let folder = tempdir().expect("a folder");
    let older = folder.path().join("out/pencil.ktx2");
    fs::create_dir(folder.path().join("out")).expect("a folder");
    fs::write(&older, "older").expect("an older file");
    let script = "trap '' XFSZ; ulimit -f 8; exec \"$0\" generate pencil --force";
    let run: Run = std::process::Command::new("sh")
        .args(["-c", script])
        .arg(tam_gen_path())
        .current_dir(folder.path())
        .output()
        .expect("a shell")
        .into();
    assert_eq!(run.status, 2, "{run:?}");
    assert!(run.stderr.contains("cannot write"), "{run:?}");
    assert_eq!(listing(folder.path()), ["out", "out/pencil.ktx2"]);
    assert_eq!(fs::read_to_string(older).expect("the older file"), "older");
}

#[cfg(target_os = "linux")]
#[test]
fn standard_output_that_takes_nothing_is_an_error_and_one_that_is_closed_is_not() {
    let folder = tempdir().expect("a folder");
    let full = fs::File::create("/dev/full").expect("a full device");
    let run: Run = tam_tests::command::tam_gen_in(folder.path())
        .arg("presets")
        .stdout(full)
        .output()
        .expect("the command runs")
        .into();
    assert_eq!(run.status, 2, "{run:?}");

    for args in ["presets", "schema", "completions bash", "man"] {
        let mut command = tam_tests::command::tam_gen_in(folder.path());
        command.args(args.split(' ')).stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        let mut child = command.spawn().expect("the command runs");
        drop(child.stdout.take());
        let run: Run = child.wait_with_output().expect("an end").into();
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{args}");
    }
}

#[test]
fn maps_that_cannot_be_read_are_refused() {
    let folder = folder_with("cut.ktx2", b"\xabKTX 20\xbb\r\n\x1a\n\0\0");
    for (name, content) in [("cut.dds", &b"DDS |\0\0\0"[..]), ("text.ktx2", b"hello"), ("empty.dds", b"")] {
        fs::write(folder.path().join(name), content).expect("a file");
    }
    fs::create_dir(folder.path().join("cells")).expect("a folder");
    fs::write(folder.path().join("cells/tone0_level0.png"), b"\x89PNG\r\n\x1a\n").expect("a file");
    for source in ["cut.ktx2", "cut.dds", "text.ktx2", "empty.dds", "cells", "none.ktx2", "."] {
        for command in ["check", "sheet"] {
            refuse(&folder, &[command, source], &["error: "]);
        }
    }
    refuse(&folder, &["check", "cells", "--pattern", "tone.png"], &["pattern"]);
    refuse(&folder, &["check", "cells", "--polarity", "upside-down"], &["polarity"]);
}

#[test]
fn arguments_that_make_no_sense_are_refused_with_a_hint() {
    let folder = tempdir().expect("a folder");
    refuse(&folder, &["generat", "pencil"], &["generate"]);
    refuse(&folder, &["generate"], &["NAME_OR_PATH"]);
    refuse(&folder, &["watch", "none.toml"], &["none.toml", "presets new"]);
    refuse(&folder, &["sheet", "pencil", "--column", "1"], &["--tile"]);
    refuse(&folder, &["sheet", "pencil", "--tile", "--column", "6"], &["--column 6", "0 to 5"]);
    refuse(&folder, &["presets", "new", "a/b"], &["-o"]);
    assert!(Path::new(&tam_gen_path()).is_absolute());
}
