//! Files that are there whole or not at all.

use std::io::{self, Write};
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
