//! Files that the user names: their extensions, and what is written to them at once.

use std::path::{Path, PathBuf};

use super::super::command::Command;
use super::super::state::{PresetSource, Severity, State};
use super::{open, tell};
use crate::surface::guides;

/// The file to be written, and the same command with that, where its extension has been left out.
///
/// The system's dialog has asked whether the file may be replaced, but by the name without it.
pub(super) fn with_extension(command: &Command) -> Option<(PathBuf, Command)> {
    type Save = fn(Option<PathBuf>) -> Command;
    let (path, extension, save): (&PathBuf, &str, Save) = match command {
        Command::SaveAs(Some(path)) => (path, "toml", Command::SaveAs),
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

/// Writes the guides; the old file stays until the new one is whole.
pub(super) fn save_guides(state: &mut State, path: &Path) {
    let text = guides::to_text(&state.document.look.guides);
    match tam_gen::files::replace(path, text.as_bytes()) {
        Ok(()) => tell(state, Severity::Done, format!("Saved {}", path.display())),
        Err(error) => tell(state, Severity::Error, format!("{} could not be saved: {error}", path.display())),
    }
}
