//! What is said about a finished map.

use std::path::Path;
use std::time::Duration;

use serde_json::{Value, json};
use tam_gen::checks::Report;
use tam_gen::command::words::{counted, duration, milliseconds, path_text, size};
use tam_gen::export::WrittenFile;
use tam_gen::{Deficit, Map};

/// Cells that miss their tone, listed one by one; more of them have one cause.
const DEFICITS_SHOWN: usize = 8;

/// A map that was made, judged and written.
pub(super) struct Finished<'a> {
    pub(super) name: &'a str,
    pub(super) map: &'a Map,
    pub(super) report: &'a Report,
    pub(super) files: &'a [WrittenFile],
    pub(super) took: Duration,
}

impl Finished<'_> {
    /// For people.
    pub(super) fn to_text(&self) -> String {
        let Self { name, map, report, files, took } = self;
        let preset = &map.preset;
        let columns = counted(map.grid.columns(), "tone");
        let levels = counted(map.grid.hand_built, "level");
        let mut text =
            format!("{name}: {} px, {levels}, {columns}, {} strokes\n\n", preset.map.size, map.strokes.strokes.len());
        text += &file_table(files);
        text += &format!("\n{}\n", report.table());
        text += &deficit_list(&map.deficits);
        text += &match report.failing().len() {
            0 => format!("every constraint holds; took {}\n", duration(*took)),
            failing => format!(
                "{} not hold; the files are written all the same; took {}\n",
                if failing == 1 { "1 constraint does".to_owned() } else { format!("{failing} constraints do") },
                duration(*took)
            ),
        };
        text
    }

    /// For machines.
    pub(super) fn to_json(&self) -> Value {
        let files: Vec<Value> = self
            .files
            .iter()
            .map(|file| json!({ "path": path_text(&file.path), "bytes": file.bytes, "what": file.what }))
            .collect();
        json!({
            "name": self.name,
            "holds": self.report.holds(),
            "size": self.map.preset.map.size,
            "levels": self.map.grid.hand_built,
            "tones": self.map.grid.tones,
            "strokes": self.map.strokes.strokes.len(),
            "files": files,
            "report": self.report,
            "deficits": self.map.deficits.iter().map(deficit_json).collect::<Vec<_>>(),
            "milliseconds": milliseconds(self.took),
        })
    }
}

/// Cells that miss their tone, with the way out, or nothing.
pub(super) fn deficit_list(deficits: &[Deficit]) -> String {
    let mut text = String::new();
    for deficit in deficits.iter().take(DEFICITS_SHOWN) {
        let Deficit { level, column, wanted, reached, cause } = deficit;
        text += &format!(
            "level {level}, tone {column}: wanted {wanted:.4}, reached {reached:.4} ({:+.1e}); {}\n",
            reached - wanted,
            cause.remedy()
        );
    }
    if deficits.len() > DEFICITS_SHOWN {
        text += &format!("… and {}\n", counted(deficits.len() - DEFICITS_SHOWN, "more cell"));
    }
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

fn deficit_json(deficit: &Deficit) -> Value {
    let mut value = json!(deficit);
    value["deficit"] = json!(deficit.wanted - deficit.reached);
    value["remedy"] = deficit.cause.remedy().into();
    value
}

/// The files with their sizes. Many of one folder, such as a picture per cell, take one line.
fn file_table(files: &[WrittenFile]) -> String {
    const FOLDED: usize = 12;
    let mut rows: Vec<(String, u64, &str)> = Vec::new();
    for file in files {
        let folder = file.path.parent().unwrap_or(Path::new(""));
        let beside = files.iter().filter(|other| other.path.parent() == Some(folder)).count();
        if beside <= FOLDED {
            rows.push((path_text(&file.path), file.bytes, &file.what));
            continue;
        }
        let label = format!("{} ({beside} files)", path_text(folder));
        match rows.iter_mut().find(|(known, ..)| *known == label) {
            Some((_, bytes, _)) => *bytes += file.bytes,
            None => rows.push((label, file.bytes, &file.what)),
        }
    }
    let width = rows.iter().map(|(path, ..)| path.chars().count()).max().unwrap_or(0);
    rows.iter().map(|(path, bytes, what)| format!("{path:<width$}  {:>9}  {what}\n", size(*bytes))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, bytes: u64) -> WrittenFile {
        WrittenFile { path: path.into(), bytes, what: "a file".into() }
    }

    #[test]
    fn many_files_of_a_folder_take_one_line() {
        let mut files: Vec<WrittenFile> = (0..24).map(|index| file(&format!("out/cells/{index}.png"), 100)).collect();
        files.push(file("out/a.ktx2", 1_500));
        let table = file_table(&files);
        assert_eq!(table.lines().count(), 2, "{table}");
        assert!(table.contains("(24 files)") && table.contains("2.4 kB") && table.contains("1.5 kB"), "{table}");
    }
}
