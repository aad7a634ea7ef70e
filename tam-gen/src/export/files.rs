//! All files of a run, or none.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::{NamedTempFile, TempPath};

use crate::files::temporary;

use super::ExportError;

/// Files on their way into a folder: written beside their targets under temporary names, then renamed together.
///
/// Dropped before [`Staging::commit`], it leaves no trace, the folders it made included.
#[derive(Debug)]
pub(super) struct Staging {
    dir: PathBuf,
    made: Vec<PathBuf>,
}

/// A file written in full under a temporary name.
#[derive(Debug)]
pub(super) struct Staged {
    temporary: NamedTempFile,
    target: PathBuf,
}

impl Staging {
    /// Makes the folder where it is missing.
    pub(super) fn new(dir: &Path) -> Result<Self, ExportError> {
        let mut staging = Self { dir: dir.to_path_buf(), made: Vec::new() };
        staging.folder(dir)?;
        Ok(staging)
    }

    /// Makes a folder and those above it where they are missing.
    pub(super) fn folder(&mut self, path: &Path) -> Result<(), ExportError> {
        let missing: Vec<_> = path
            .ancestors()
            .take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists())
            .map(Path::to_path_buf)
            .collect();
        for folder in missing.into_iter().rev() {
            match fs::create_dir(&folder) {
                Ok(()) => self.made.push(folder),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(source) => return Err(ExportError::Folder { path: folder, source }),
            }
        }
        if path.as_os_str().is_empty() || path.is_dir() {
            return Ok(());
        }
        Err(ExportError::Folder { path: path.to_path_buf(), source: io::ErrorKind::NotADirectory.into() })
    }

    /// Writes a file, given in pieces, under a temporary name.
    pub(super) fn write(&self, target: &Path, pieces: &[Vec<u8>]) -> Result<Staged, ExportError> {
        let write = || {
            let mut temporary = temporary_in(&self.dir)?;
            pieces.iter().try_for_each(|piece| temporary.write_all(piece))?;
            temporary.flush()?;
            Ok(Staged { temporary, target: target.to_path_buf() })
        };
        write().map_err(|source| ExportError::Write { path: target.to_path_buf(), source })
    }

    /// Renames all files to their targets. Where one fails, those before it are taken back and older files restored.
    pub(super) fn commit(mut self, staged: Vec<Staged>) -> Result<(), ExportError> {
        let mut placed = Vec::with_capacity(staged.len());
        for Staged { temporary, target } in staged {
            let result = self.keep_older(&target).and_then(|older| {
                temporary.persist(&target).map_err(|error| error.error)?;
                placed.push((target.clone(), older));
                Ok(())
            });
            if let Err(source) = result {
                take_back(placed);
                return Err(ExportError::Write { path: target, source });
            }
        }
        self.made.clear();
        Ok(())
    }

    /// A second name for the file at the target, to restore it from.
    fn keep_older(&self, target: &Path) -> io::Result<Option<TempPath>> {
        if !target.try_exists()? {
            return Ok(None);
        }
        let spare = temporary_in(&self.dir)?.into_temp_path();
        fs::remove_file(&spare)?;
        // Not every file system links.
        if fs::hard_link(target, &spare).is_err() {
            fs::copy(target, &spare)?;
        }
        Ok(Some(spare))
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        for folder in self.made.iter().rev() {
            // Another program may have put something there meanwhile; it stays.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Undoes renames as far as the system lets it.
fn take_back(placed: Vec<(PathBuf, Option<TempPath>)>) {
    for (target, older) in placed.into_iter().rev() {
        let _ = match older {
            Some(older) => older.persist(&target).map_err(|error| error.error),
            None => fs::remove_file(&target),
        };
    }
}

fn temporary_in(dir: &Path) -> io::Result<NamedTempFile> {
    temporary().tempfile_in(if dir.as_os_str().is_empty() { Path::new(".") } else { dir })
}
