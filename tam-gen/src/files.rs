//! Files that are there whole or not at all.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

/// Makes temporary files that, renamed, are as readable as any new file.
pub fn temporary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tam-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}

/// Writes a file, in place of one of that name where there is one, which stays until the new one is whole. The folder is
/// made where it is missing.
///
/// # Errors
/// What the system says; then nothing has changed.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = folder_of(path);
    std::fs::create_dir_all(folder)?;
    let mut file = temporary().tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// Why a text was not read.
#[derive(Debug, thiserror::Error)]
pub enum TextError {
    /// What the system says.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// It is no file.
    #[error("it is a folder")]
    Folder,
    /// It has more bytes than such a text can have.
    #[error("it is larger than {0} bytes")]
    TooLarge(u64),
    /// A byte, counted from 0, is no UTF-8.
    #[error("byte {0} is no UTF-8")]
    NotText(usize),
}

/// Reads a text of at most so many bytes, which is found out before more of it is read.
///
/// # Errors
/// [`TextError`].
pub fn read_text(path: &Path, most_bytes: u64) -> Result<String, TextError> {
    let metadata = std::fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(TextError::Folder);
    }
    // Pipes and devices state no length, so the reading is bounded as well.
    let mut bytes = Vec::new();
    if metadata.len() <= most_bytes {
        File::open(path)?.take(most_bytes + 1).read_to_end(&mut bytes)?;
    }
    if metadata.len().max(bytes.len() as u64) > most_bytes {
        return Err(TextError::TooLarge(most_bytes));
    }
    String::from_utf8(bytes).map_err(|error| TextError::NotText(error.utf8_error().valid_up_to()))
}

/// The folder that a path is in.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_or_stays() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("new/preset.toml");
        replace(&path, b"one").expect("a writable folder");
        replace(&path, b"two").expect("a writable folder");
        assert_eq!(std::fs::read(&path).expect("it is there"), b"two");
        std::fs::create_dir(folder.path().join("taken")).expect("a writable folder");
        assert!(replace(&folder.path().join("taken"), b"three").is_err());
        let left: Vec<_> = std::fs::read_dir(folder.path()).expect("readable").collect();
        assert_eq!(left.len(), 2, "nothing temporary is left");
    }
}
