//! Running the commands `tam-gen` and `tam-viewer` as their users do.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The command `tam-gen`, built by the same `cargo test --workspace`.
///
/// # Panics
/// If it has not been built.
pub fn tam_gen_path() -> PathBuf {
    path_of("tam-gen")
}

/// The command `tam-viewer`, likewise.
///
/// # Panics
/// If it has not been built.
pub fn tam_viewer_path() -> PathBuf {
    path_of("tam-viewer")
}

fn path_of(name: &str) -> PathBuf {
    let test = std::env::current_exe().expect("a test is an executable");
    let folder = test.parent().and_then(Path::parent).expect("tests lie in target/PROFILE/deps");
    let path = folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(path.is_file(), "{} is missing: run `cargo test --workspace`, which builds it", path.display());
    path
}

/// The command, to be run in a folder.
pub fn tam_gen_in(folder: &Path) -> Command {
    let mut command = Command::new(tam_gen_path());
    command.current_dir(folder).env_remove("NO_COLOR");
    command
}

/// A finished run.
#[derive(Debug)]
pub struct Run {
    /// Exit status; -1 if a signal ended it.
    pub status: i32,
    /// What it printed as its result.
    pub stdout: String,
    /// What it said besides.
    pub stderr: String,
}

impl Run {
    /// Its result as JSON.
    ///
    /// # Panics
    /// If it is not exactly one JSON object.
    pub fn json(&self) -> serde_json::Value {
        let value: serde_json::Value =
            serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error} in {self:?}"));
        assert!(value.is_object(), "{self:?}");
        value
    }
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is text");
        let run = Self {
            status: output.status.code().unwrap_or(-1),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        };
        assert!(!run.stderr.contains("panicked"), "{run:?}");
        run
    }
}

/// Runs the command in a folder.
///
/// # Panics
/// If it cannot be run, or panics.
pub fn tam_gen(folder: &Path, args: &[&str]) -> Run {
    tam_gen_in(folder).args(args).output().expect("the command runs").into()
}

/// `tam-viewer` on the software adapter, to be run in a folder.
pub fn tam_viewer_in(folder: &Path) -> Command {
    let mut command = Command::new(tam_viewer_path());
    command.current_dir(folder).env_remove("NO_COLOR");
    crate::adapter::pin(&mut command);
    command
}

/// Runs `tam-viewer` on the software adapter in a folder.
///
/// # Panics
/// If it cannot be run, or panics.
pub fn tam_viewer(folder: &Path, args: &[&str]) -> Run {
    tam_viewer_in(folder).args(args).output().expect("the command runs").into()
}

/// Every file and folder below a folder, by path relative to it, sorted.
///
/// # Panics
/// If the folder cannot be read.
pub fn listing(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(&next).expect("a readable folder") {
            let path = entry.expect("an entry").path();
            found.push(path.strip_prefix(folder).expect("a path below").display().to_string());
            if path.is_dir() {
                folders.push(path);
            }
        }
    }
    found.sort();
    found
}
