//! `tam-gen watch`, and interruptions.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use tam_tests::command::{listing, tam_gen_in};
use tempfile::tempdir;

/// Long enough for a loaded machine; reached only when something is broken.
const PATIENCE: Duration = Duration::from_secs(60);

const PRESET: &str = "[map]\nsize = 64\ncoarsest = 32\n";

fn interrupt(child: &Child) {
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status().expect("a shell");
    assert!(sent.success());
}

/// Lines of standard output, as they come.
fn lines(child: &mut Child) -> Receiver<String> {
    let (sender, receiver) = channel();
    let out = BufReader::new(child.stdout.take().expect("a pipe"));
    std::thread::spawn(move || out.lines().map_while(Result::ok).try_for_each(|line| sender.send(line)));
    receiver
}

#[test]
fn every_save_regenerates_and_errors_do_not_end_the_watch() {
    let folder = tempdir().expect("a folder");
    let preset = folder.path().join("mine.toml");
    fs::write(&preset, PRESET).expect("a preset");
    let mut child = tam_gen_in(folder.path())
        .args(["watch", "mine.toml", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command runs");
    let lines = lines(&mut child);
    let next = || -> serde_json::Value {
        serde_json::from_str(&lines.recv_timeout(PATIENCE).expect("a line")).expect("one object per line")
    };
    assert_eq!(next()["name"], "mine");
    assert!(folder.path().join("out/mine.ktx2").is_file());

    fs::write(&preset, format!("seed = 2\n{PRESET}")).expect("a saved preset");
    assert!(next()["milliseconds"].as_f64().is_some_and(|time| time > 0.0));
    let manifest = || fs::read_to_string(folder.path().join("out/mine.json")).expect("a manifest");
    assert!(manifest().contains("\"seed\": 2"));

    fs::write(&preset, "seed = \"two\"\n").expect("a broken preset");
    assert_eq!(next()["error"]["kind"], "preset");
    assert!(manifest().contains("\"seed\": 2"));

    // As many editors do: write another file and rename it.
    let temporary = folder.path().join("mine.toml.tmp");
    fs::write(&temporary, format!("seed = 3\n{PRESET}")).expect("a file");
    fs::rename(&temporary, &preset).expect("a replaced preset");
    assert_eq!(next()["name"], "mine");
    assert!(manifest().contains("\"seed\": 3"));

    interrupt(&child);
    let status = child.wait().expect("an end");
    assert_eq!(status.code(), Some(0));
}

#[test]
fn watching_does_not_replace_files_of_another_making() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("mine.toml"), PRESET).expect("a preset");
    fs::create_dir(folder.path().join("out")).expect("a folder");
    fs::write(folder.path().join("out/mine.ktx2"), "theirs").expect("a file");
    let output = tam_gen_in(folder.path()).args(["watch", "mine.toml"]).output().expect("the command runs");
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(listing(&folder.path().join("out")), ["mine.ktx2"]);
}

#[test]
fn an_interrupted_generation_writes_nothing() {
    let folder = tempdir().expect("a folder");
    // Far longer than the wait before the interruption.
    let child = tam_gen_in(folder.path())
        .args(["generate", "pencil", "--size", "4096", "--effort", "256", "--tones", "32"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command runs");
    std::thread::sleep(Duration::from_millis(700));
    interrupt(&child);
    let output = child.wait_with_output().expect("an end");
    assert_eq!(output.status.code(), Some(130), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stderr).contains("nothing was written"), "{output:?}");
    assert!(listing(folder.path()).is_empty());
}
