//! Files that the user names: their extensions, and what is written to them at once.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use tam_gen::Preset;

use super::super::command::Command;
use super::super::scenes::{self, Beside};
use super::super::state::{MeshSource, PresetSource, Severity, State};
use super::super::work::Results;
use super::{open, tell};
use crate::Inspect;
use crate::surface::guides;

/// The file to be written, and the same command with that, where its extension has been left out.
///
/// The system's dialog has asked whether the file may be replaced, but by the name without it.
pub(super) fn with_extension(command: &Command) -> Option<(PathBuf, Command)> {
    type Save = fn(Option<PathBuf>) -> Command;
    let (path, extension, save): (&PathBuf, &str, Save) = match command {
        Command::SaveAs(Some(path)) => (path, "toml", Command::SaveAs),
        Command::SaveScene(Some(path)) => (path, "toml", Command::SaveScene),
        Command::SaveGuides(Some(path)) => (path, "json", Command::SaveGuides),
        Command::SavePicture(Some(path)) => (path, "png", Command::SavePicture),
        Command::SaveTurntable(Some(path)) => (path, "png", Command::SaveTurntable),
        _ => return None,
    };
    if path.extension().is_some() || path.file_name().is_none() {
        return None;
    }
    let path = path.with_extension(extension);
    Some((path.clone(), save(Some(path))))
}

/// Writes the preset; the old file stays until the new one is whole.
pub(super) fn save(state: &mut State, path: &Path) {
    match tam_gen::files::replace(path, state.document.preset.to_toml().as_bytes()) {
        Ok(()) => {
            state.remember_preset(path);
            let preset = state.document.preset.clone();
            open(state, PresetSource::File(path.to_owned()), preset);
            tell(state, Severity::Done, format!("Saved {}", path.display()));
        }
        Err(error) => {
            tell(
                state,
                Severity::Error,
                format!("{} could not be saved: {error}. The preset is still here.", path.display()),
            );
        }
    }
}

/// Writes the scene, and beside it presets and guides that are in no file yet; old files stay until new ones are whole.
pub(crate) fn save_scene(state: &mut State, results: &Results, path: &Path) {
    let mut beside = Written { scene: path.to_owned(), state_saved: &state.saved, presets: Vec::new() };
    let mesh_of = |source: &MeshSource| {
        results.meshes.iter().find(|mesh| mesh.source == *source).map(std::convert::AsRef::as_ref)
    };
    let written = scenes::to_file(state, mesh_of, &mut beside).and_then(|file| {
        let folder = path.parent().unwrap_or(Path::new(""));
        let text = file.relative_to(folder).to_toml();
        tam_gen::files::replace(path, text.as_bytes()).map_err(|error| error.to_string())
    });
    let presets = beside.presets;
    // What was written is where it is saved from now on.
    for (source, preset, file) in presets {
        let own = PresetSource::File(file);
        state.saved.insert(own.key(), preset);
        let document = &mut state.document;
        if document.source == source {
            document.source = own.clone();
        }
        document.others.iter_mut().filter(|other| other.source == source).for_each(|other| other.source = own.clone());
    }
    match written {
        Ok(()) => tell(state, Severity::Done, format!("Saved {}", path.display())),
        Err(problem) => {
            tell(state, Severity::Error, format!("{} could not be saved: {problem}", path.display()));
        }
    }
}

/// The command that draws the view, or why there is none.
pub(crate) fn command_line(state: &State, results: &Results, size_px: [u32; 2]) -> Result<String, String> {
    let mesh_of = |source: &MeshSource| {
        results.meshes.iter().find(|mesh| mesh.source == *source).map(std::convert::AsRef::as_ref)
    };
    let file = scenes::to_file(state, mesh_of, &mut OnDisk { saved: &state.saved })?;
    let [width, height] = size_px;
    let mut words = vec!["tam-viewer".to_owned(), "render".to_owned()];
    for (name, value) in file.to_options() {
        // A value that begins with a dash would be taken for an option by some readers.
        words.push(name);
        words.extend(Some(value).filter(|value| !value.is_empty()));
    }
    let Inspect { debug, wireframe } = state.document.inspect;
    if let Some(debug) = debug {
        words.extend(["--debug".to_owned(), debug.name().to_owned()]);
    }
    if let Some(width_px) = wireframe {
        words.extend(["--wireframe".to_owned(), width_px.to_string()]);
    }
    words.extend(["--size".to_owned(), format!("{width}x{height}")]);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    shlex::try_join(words).map_err(|error| error.to_string())
}

/// Files that are there already.
struct OnDisk<'a> {
    saved: &'a BTreeMap<String, Preset>,
}

/// The file of a preset that is saved.
fn saved_as(saved: &BTreeMap<String, Preset>, source: &PresetSource, preset: &Preset) -> Option<PathBuf> {
    let is_saved = saved.get(&source.key()) == Some(preset);
    match source {
        PresetSource::Shipped(name) if Preset::named(name).and_then(Result::ok).as_ref() == Some(preset) => {
            Some(name.into())
        }
        PresetSource::File(path) if is_saved || Preset::load(path).ok().as_ref() == Some(preset) => Some(path.clone()),
        _ => None,
    }
}

impl Beside for OnDisk<'_> {
    fn preset(&mut self, source: &PresetSource, preset: &Preset) -> Result<PathBuf, String> {
        let unsaved =
            || format!("The preset {} has changes that no file holds: save it, or the scene, first.", source.name());
        saved_as(self.saved, source, preset).ok_or_else(unsaved)
    }

    fn guides(&mut self, object: &str, _: &str) -> Result<PathBuf, String> {
        Err(format!("The guides of {object} are in no file: save the scene, which the command can draw as well."))
    }
}

/// Files that are written beside a scene.
struct Written<'a> {
    scene: PathBuf,
    state_saved: &'a BTreeMap<String, Preset>,
    /// Presets, with what they came from and where they are now.
    presets: Vec<(PresetSource, Preset, PathBuf)>,
}

impl Written<'_> {
    /// Writes a text to a file of this name, or of one with a number where that holds something else.
    fn write(&self, name: &str, extension: &str, text: &str) -> Result<PathBuf, String> {
        let stem = self.scene.file_stem().unwrap_or_default().to_string_lossy();
        for number in 1..1000 {
            let numbered = if number == 1 { String::new() } else { format!("-{number}") };
            let path = self.scene.with_file_name(format!("{stem}-{name}{numbered}.{extension}"));
            match std::fs::read(&path) {
                Ok(there) if there == text.as_bytes() => return Ok(path),
                Ok(_) => {}
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                    let failed = |error| format!("{}: {error}", path.display());
                    tam_gen::files::replace(&path, text.as_bytes()).map_err(failed)?;
                    return Ok(path);
                }
                Err(error) => return Err(format!("{}: {error}", path.display())),
            }
        }
        Err(format!("there are too many files beside {}", self.scene.display()))
    }
}

impl Beside for Written<'_> {
    fn preset(&mut self, source: &PresetSource, preset: &Preset) -> Result<PathBuf, String> {
        if let Some(path) = saved_as(self.state_saved, source, preset) {
            return Ok(path);
        }
        if let Some((_, _, path)) = self.presets.iter().find(|(known, same, _)| known == source && same == preset) {
            return Ok(path.clone());
        }
        let path = self.write(&source.name(), "toml", &preset.to_toml())?;
        self.presets.push((source.clone(), preset.clone(), path.clone()));
        Ok(path)
    }

    fn guides(&mut self, object: &str, text: &str) -> Result<PathBuf, String> {
        self.write(object, "json", text)
    }
}

/// Writes the guides; the old file stays until the new one is whole.
pub(super) fn save_guides(state: &mut State, path: &Path) {
    let text = guides::to_text(&state.document.look.guides);
    match tam_gen::files::replace(path, text.as_bytes()) {
        Ok(()) => tell(state, Severity::Done, format!("Saved {}", path.display())),
        Err(error) => tell(state, Severity::Error, format!("{} could not be saved: {error}", path.display())),
    }
}
