//! The session on disk: what was open comes back, also after a crash.

mod lock;
mod parts;

use std::path::{Path, PathBuf};

use egui_tiles::Tree;
use serde::{Deserialize, Serialize};

use super::layout::{Pane, default_layout, is_whole};
use super::state::State;

pub(crate) use lock::{Lock, Owner};

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

/// What a session file holds.
pub(crate) enum Found {
    /// There is none yet.
    Nothing,
    /// A session.
    Whole(Box<Session>),
    /// A session of which a part cannot be read.
    Part(Box<Session>, SessionError),
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
    /// Some of its content.
    #[error("{} cannot be read whole. Left as at first: {}", path.display(), in_words(left))]
    Parts {
        /// The file.
        path: PathBuf,
        /// What of it could not be read, by its place in the file.
        left: Vec<String>,
    },
}

/// Places that a message names; more are counted.
const NAMED: usize = 6;

fn in_words(left: &[String]) -> String {
    let named = left[..left.len().min(NAMED)].join(", ");
    match left.len().saturating_sub(NAMED) {
        0 => named,
        more => format!("{named} and {more} more"),
    }
}

/// Where the session is kept, if the system has such a place.
pub fn default_path() -> Option<PathBuf> {
    eframe::storage_dir("tam-viewer").map(|folder| folder.join("session.json"))
}

/// Reads a session, and where it cannot be read whole, what of it can be. Panels that are missing or doubled are put back
/// to where they were at first.
///
/// # Errors
/// [`SessionError`]: the file cannot be read or holds something else.
pub(crate) fn read(path: &Path) -> Result<Found, SessionError> {
    let failed = |source| SessionError::File { path: path.to_owned(), source };
    let content = |problem: String| SessionError::Content { path: path.to_owned(), problem };
    let size = match std::fs::metadata(path) {
        Ok(metadata) => metadata.len(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Found::Nothing),
        Err(error) => return Err(failed(error)),
    };
    if size > BYTES_MAX {
        return Err(content(format!("{size} bytes")));
    }
    let text = std::fs::read(path).map_err(failed)?;
    let problem = match serde_json::from_slice::<Session>(&text) {
        Ok(mut session) => {
            if !is_whole(&session.layout) {
                session.layout = default_layout();
            }
            return Ok(Found::Whole(Box::new(session)));
        }
        Err(problem) => problem.to_string(),
    };
    let Ok(serde_json::Value::Object(fields)) = serde_json::from_slice(&text) else { return Err(content(problem)) };
    if !fields.get("state").is_some_and(serde_json::Value::is_object) {
        return Err(content(problem));
    }
    let (session, left) = parts::session(fields);
    Ok(Found::Part(Box::new(session), SessionError::Parts { path: path.to_owned(), left }))
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

/// Puts a file that cannot be read out of the way, beside where it was, so that the next session does not replace it.
/// Returns where it is now: under a number of its own, as earlier ones stay too.
///
/// # Errors
/// What the system says; the file is then where it was.
pub(crate) fn put_aside(path: &Path) -> std::io::Result<PathBuf> {
    let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let extension = path.extension().map_or_else(String::new, |kind| format!(".{}", kind.to_string_lossy()));
    let mut number = 1;
    loop {
        let aside = path.with_file_name(format!("{stem}.unread-{number}{extension}"));
        if aside.symlink_metadata().is_err() {
            std::fs::rename(path, &aside)?;
            return Ok(aside);
        }
        number += 1;
    }
}

#[cfg(test)]
mod tests;
