//! Why nothing was exported.

use std::io;
use std::path::PathBuf;

/// Why an export failed. Nothing was written and no older file was touched.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The name cannot be part of a file's name.
    #[error("`{name}` is no name for files: use letters, digits, `-`, `_` and `.`, without a folder")]
    Name {
        /// The name given.
        name: String,
    },
    /// Files of these names are there already, and overwriting was not asked for.
    #[error("{} already there; allow overwriting, or choose another name or folder", listed(.0))]
    Exists(Vec<PathBuf>),
    /// Something that is no file stands where a file is to go.
    #[error("{} is a folder, and a file of that name is to be written; remove it, or choose another name", .0.display())]
    Blocked(PathBuf),
    /// The folder cannot be made.
    #[error("cannot make the folder {}: {source}; choose one where you may write", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}; check the space left and the permissions, or choose another folder", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file's content could not be made.
    #[error("cannot encode {}: {problem}", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        problem: String,
    },
    /// The map cannot be written as it is.
    #[error("the map cannot be written: {0}")]
    Map(String),
    /// The application asked to stop.
    #[error("the export was cancelled; nothing was written")]
    Cancelled,
}

fn listed(paths: &[PathBuf]) -> String {
    const SHOWN: usize = 3;
    let mut text = paths.iter().take(SHOWN).map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ");
    if paths.len() > SHOWN {
        text += &format!(" and {} more files", paths.len() - SHOWN);
    }
    text + if paths.len() == 1 { " is" } else { " are" }
}
