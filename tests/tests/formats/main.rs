//! Exported files: foreign readers see what was written, our reader gets it back, failures leave no trace, and no
//! file, however damaged, does harm.
#![allow(clippy::unwrap_used)]

mod atomic;
mod damaged;
mod foreign;
mod others;
mod presets;
mod round_trip;
mod sample;
mod sheets;

use std::path::Path;

use tam_gen::export::{ExportOptions, Format, WrittenFile, export};
use tam_gen::{Job, Map};

fn write(map: &Map, dir: &Path, formats: &[Format]) -> Vec<WrittenFile> {
    let options = ExportOptions { formats: formats.to_vec(), ..ExportOptions::default() };
    export(map, "lines", dir, &options, &Job::default()).unwrap()
}

/// All files below a folder with their bytes, by relative path.
fn contents(dir: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    let mut folders = vec![dir.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path.clone());
            }
            let name = path.strip_prefix(dir).unwrap().to_string_lossy().into_owned();
            found.push((name, if path.is_dir() { Vec::new() } else { std::fs::read(&path).unwrap() }));
        }
    }
    found.sort();
    found
}
