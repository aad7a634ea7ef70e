//! The session on disk: what was open comes back, also after a crash.

use std::path::{Path, PathBuf};

use egui_tiles::Tree;
use serde::{Deserialize, Serialize};

use super::layout::{Pane, default_layout, is_whole};
use super::state::State;

/// Sessions are a few kilobytes; what is much larger is something else.
const BYTES_MAX: u64 = 64 << 20;

/// What a restart brings back.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Session {
    /// Document, camera and settings.
    pub state: State,
    /// Where the panels are.
    pub layout: Tree<Pane>,
    /// Whether the window was closed, rather than lost.
    pub closed: bool,
}

/// A session that cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SessionError {
    /// The file.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Its content.
    #[error("{} holds no session: {problem}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
}

/// Where the session is kept, if the system has such a place.
pub fn default_path() -> Option<PathBuf> {
    eframe::storage_dir("tam-viewer").map(|folder| folder.join("session.json"))
}

/// Reads a session; `None` where there is none yet. Panels that are missing or doubled are put back to where they were
/// at first.
///
/// # Errors
/// [`SessionError`]: the file cannot be read or holds something else.
pub(crate) fn read(path: &Path) -> Result<Option<Session>, SessionError> {
    let failed = |source| SessionError::File { path: path.to_owned(), source };
    let content = |problem: String| SessionError::Content { path: path.to_owned(), problem };
    let size = match std::fs::metadata(path) {
        Ok(metadata) => metadata.len(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(failed(error)),
    };
    if size > BYTES_MAX {
        return Err(content(format!("{size} bytes")));
    }
    let text = std::fs::read(path).map_err(failed)?;
    let mut session: Session = serde_json::from_slice(&text).map_err(|error| content(error.to_string()))?;
    if !is_whole(&session.layout) {
        session.layout = default_layout();
    }
    Ok(Some(session))
}

/// Writes a session; the file is whole at any time.
///
/// # Errors
/// [`SessionError::File`].
pub(crate) fn write(path: &Path, session: &Session) -> Result<(), SessionError> {
    let failed = |source| SessionError::File { path: path.to_owned(), source };
    let text = serde_json::to_vec_pretty(session)
        .map_err(|error| SessionError::Content { path: path.to_owned(), problem: error.to_string() })?;
    tam_gen::files::replace(path, &text).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_comes_back_as_it_was() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("deep/session.json");
        assert!(read(&path).expect("no file is no error").is_none());
        let mut state = State::default();
        state.document.preset.stroke.width_px = 3.25;
        state.settings.recent_meshes.push(PathBuf::from("bunny.obj"));
        let session = Session { state: state.clone(), layout: default_layout(), closed: false };
        write(&path, &session).expect("a writable folder");
        let back = read(&path).expect("readable").expect("there");
        assert_eq!(back.state, state);
        assert!(is_whole(&back.layout) && !back.closed);
    }

    #[test]
    fn what_is_no_session_is_an_error_and_a_torn_layout_is_mended() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("session.json");
        for text in ["", "{", "[]", "{\"state\": 3}"] {
            std::fs::write(&path, text).expect("a writable folder");
            assert!(matches!(read(&path), Err(SessionError::Content { .. })), "{text:?}");
        }
        let mut layout = default_layout();
        let view = layout.tiles.find_pane(&Pane::View).expect("a view");
        layout.remove_recursively(view);
        write(&path, &Session { state: State::default(), layout, closed: true }).expect("a writable folder");
        assert!(is_whole(&read(&path).expect("readable").expect("there").layout));
    }
}
